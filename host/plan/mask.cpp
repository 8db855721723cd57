#include "plan/mask.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/lists.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "plan/adaptive.h"
#include "plan/layouts.h"
#include "plan/resample.h"

namespace gloam {
namespace {

/// Planes of bits at a resolution: the wanted pixels, and these with the pixels that filters read around them.
std::string wanted(int scale) { return scale == 1 ? "wanted" : fmt::format("wanted@{}", scale); }
std::string grown(int scale) { return scale == 1 ? "wanted.grown" : fmt::format("wanted.grown@{}", scale); }

std::string wanted_around(int scale) { return fmt::format("wanted.around{}", scale); }

PlannedPass mask_pass(std::string name, std::string kernel, Binding read, Binding written, Defines defines, int scale) {
  if (scale > 1) name += fmt::format(" at 1/{}", scale);
  Pass pass{.name = std::move(name), .kernel = std::move(kernel), .defines = std::move(defines), .scale = scale};
  pass.reads = {std::move(read)};
  pass.writes = {std::move(written)};
  return {&masking(), std::move(pass), ParameterValues(masking().parameters)};
}

const char* const rest = "wanted.rest";

class Restriction {
 public:
  Restriction(const Plan& plan, const std::vector<const Technique*>& techniques, const Technique* elsewhere)
      : plan_(plan), elsewhere_(elsewhere), source_(plan.mask) {
    for (const PlannedPass& planned : plan.passes) {
      const bool is_asked_for = std::find(techniques.begin(), techniques.end(), planned.technique) != techniques.end();
      // Of two estimates, the second writes beside the first: no filter may ask either for more pixels.
      const bool may_be = planned.pass.can_skip && (!elsewhere || is_estimate(planned.pass));
      is_restricted_.push_back(may_be && (is_asked_for || planned.technique == &resampling()));
      if (planned.pass.repeats_cells && planned.pass.writes.front().plane == plan.mask &&
          !contains(plan.outputs, plan.mask)) {
        // The cells serve as the mask.
        left_out_ = &planned;
        source_ = planned.pass.reads.front().plane;
        cell_ = plane_scales(plan).at(source_);
      }
    }
  }

  bool has_work() const {
    return std::find(is_restricted_.begin(), is_restricted_.end(), true) != is_restricted_.end();
  }

  /// Whether the mask is made of what it would restrict (gtao --only ao).
  bool is_of_what_it_restricts() const {
    // Planes that it is made of, each with the pass that reads it: later passes may write another plane of the same name.
    std::vector<std::pair<std::string, size_t>> made_of = {{plan_.mask, plan_.passes.size()}};
    for (size_t k = 0; k < made_of.size(); ++k) {
      const auto [plane, reader] = made_of[k];  // a copy: more are added
      for (size_t i = 0; i < reader && !contains(plan_.inputs, plane); ++i) {
        if (!writes(plan_.passes[i].pass, plane)) continue;
        if (is_restricted_[i]) return true;
        for (const Binding& read : plan_.passes[i].pass.reads) {
          const std::pair found(read.plane, i);
          if (std::find(made_of.begin(), made_of.end(), found) == made_of.end()) made_of.push_back(found);
        }
      }
    }
    return false;
  }

  void rewrite() {
    for (size_t i = 0; i < plan_.passes.size(); ++i) {
      if (&plan_.passes[i] == left_out_) continue;
      PlannedPass planned = plan_.passes[i];
      if (is_restricted_[i]) {
        const int scale = planned.pass.scale;
        const Footprint after = footprint_after(i);
        const bool is_read_around = after.columns > 0 || after.rows > 0;
        need_wanted(scale);
        if (is_read_around) need_grown(scale);
        const std::string bits = is_read_around ? grown(scale) : wanted(scale);
        if (estimated.empty()) estimated = bits;
        skip_by(planned.pass, planned.technique == elsewhere_ ? rest : bits);
        if (elsewhere_ && planned.technique != elsewhere_) keep_skipped(planned.pass);
      }
      passes.push_back(std::move(planned));
    }
  }

  std::vector<PlannedPass> passes;
  std::string estimated;  ///< bits by which the first restricted pass skips pixels

 private:
  bool reads_result_of(const Pass& reader, const Pass& writer) const {
    return std::any_of(reader.reads.begin(), reader.reads.end(), [&](const Binding& read) {
      return std::any_of(writer.writes.begin(), writer.writes.end(),
                         [&](const Binding& written) { return written.plane == read.plane; });
    });
  }

  /// How far around a pixel later passes of the same resolution read the results of pass `i`: filters one after another add up.
  Footprint footprint_after(size_t i) const {
    Footprint widest;
    for (size_t k = i + 1; k < plan_.passes.size(); ++k) {
      const Pass& later = plan_.passes[k].pass;
      if (!is_restricted_[k] || later.scale != plan_.passes[i].pass.scale ||
          !reads_result_of(later, plan_.passes[i].pass))
        continue;
      const Footprint after = footprint_after(k);
      widest.columns = std::max(widest.columns, later.footprint.columns + after.columns);
      widest.rows = std::max(widest.rows, later.footprint.rows + after.rows);
    }
    return widest;
  }

  /// The widest after any restricted pass of a resolution.
  Footprint widest_footprint(int scale) const {
    Footprint widest;
    for (size_t i = 0; i < plan_.passes.size(); ++i) {
      if (!is_restricted_[i] || plan_.passes[i].pass.scale != scale) continue;
      const Footprint after = footprint_after(i);
      widest.columns = std::max(widest.columns, after.columns);
      widest.rows = std::max(widest.rows, after.rows);
    }
    return widest;
  }

  void need_wanted(int scale) {
    if (!wanted_.insert(scale).second) return;
    if (scale == 1) {
      passes.push_back(bits_pass(source_, cell_, "", "wanted", elsewhere_ ? rest : ""));
    } else {
      need_wanted(1);
      // Reduced pixels that a wanted pixel is upsampled from.
      add_grown(wanted(1), wanted_around(scale), {scale - 1, scale - 1}, 1);
      passes.push_back(mask_pass("reduced", "mask_reduced", {"whole", wanted_around(scale)}, {"wanted", wanted(scale)},
                                 {{"SCALE", scale}}, scale));
    }
  }

  /// Grown by what the longest chain of filters reads: every pass that a filter follows uses the same bits.
  void need_grown(int scale) {
    if (!grown_.insert(scale).second) return;
    add_grown(wanted(scale), grown(scale), widest_footprint(scale), scale);
  }

  void add_grown(const std::string& from, const std::string& to, Footprint by, int scale) {
    passes.push_back(mask_pass("grown", "mask_grown", {"wanted", from}, {"grown", to},
                               {{"REACH_X", by.columns}, {"REACH_Y", by.rows}}, scale));
  }

  const Plan& plan_;
  const Technique* elsewhere_;
  std::string source_;
  int cell_ = 1;
  const PlannedPass* left_out_ = nullptr;
  std::vector<bool> is_restricted_;
  std::set<int> wanted_, grown_;  ///< resolutions that have these
};

}  // namespace

const Technique& masking() {
  static const Technique technique = {.name = "mask",
                                      .summary = "from a mask to the pixels that it leaves",
                                      .source = "mask/mask.cl",
                                      .any_projection = true};
  return technique;
}

PlannedPass bits_pass(const std::string& source, int cell, const std::string& asked, const std::string& wanted,
                      const std::string& rest) {
  PlannedPass planned = mask_pass("bits", "mask_bits", {"source", source}, {"wanted", wanted},
                                  {{"CELL", cell}, {"WITH_ASKED", !asked.empty()}, {"WITH_REST", !rest.empty()}}, 1);
  if (!asked.empty()) planned.pass.reads.push_back({"asked", asked});
  if (!rest.empty()) planned.pass.writes.push_back({"rest", rest});
  return planned;
}

void skip_by(Pass& pass, const std::string& bits) {
  std::erase_if(pass.reads, [](const Binding& binding) { return binding.argument == "wanted"; });
  std::erase_if(pass.defines, [](const auto& define) { return define.first == "MASKED"; });
  pass.reads.push_back({"wanted", bits});
  pass.defines.emplace_back("MASKED", 1);
}

void keep_skipped(Pass& pass) { pass.defines.emplace_back("KEEP", 1); }

void restrict_to_mask(Plan& plan, const std::vector<const Technique*>& techniques, const Technique* elsewhere) {
  for (const Technique* technique : techniques) {
    if (technique->views > 1)
      throw UsageError("{}: restricts techniques that read one view, and {} reads two; leave {} out", option("only"),
                       technique->name, option("only"));
  }
  Restriction restriction(plan, techniques, elsewhere);
  const auto makes_mask = [&](const Technique* technique) { return contains(technique->writes, plan.mask); };
  if (std::all_of(techniques.begin(), techniques.end(), makes_mask) || restriction.is_of_what_it_restricts())
    throw UsageError("{}: {} makes '{}' itself and cannot be restricted by it; leave {} out", option("only"),
                     plan.technique, plan.mask, option("only"));
  if (elsewhere && looks_into_key_views(plan))
    throw UsageError("{}: views reuse results of one technique only (reuse=on); leave one of the two out",
                     option("elsewhere", elsewhere->name));
  if (!restriction.has_work())
    throw UsageError("{}: {} has no pass that a mask can restrict; leave {} out", option("only"), plan.technique,
                     option("only"));
  restriction.rewrite();
  plan.passes = std::move(restriction.passes);
  if (elsewhere)
    plan.rest = rest;
  else
    plan.wanted = restriction.estimated;
}

}  // namespace gloam
