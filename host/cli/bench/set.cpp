#include "cli/bench/set.h"

#include <algorithm>

#include "base/json_text.h"
#include "cli/bench/file.h"
#include "cli/bench/print.h"
#include "gloam/error.h"
#include "measure/document.h"
#include "measure/effects.h"
#include "measure/sequence.h"
#include "measure/sequence_document.h"
#include "score/targets.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;
using score::Target;

/// The effects that targets have and gloam measures, as --effects takes them.
std::string effects_of_set(const std::vector<Target>& targets) {
  std::vector<std::string> effects;
  for (const Target& target : targets) {
    if (contains(effect_names(), target.effect)) add_new(effects, target.effect);
  }
  return fmt::format("{}", fmt::join(effects, ","));
}

/// Sets are measured without what takes longest, unless it is asked for.
BenchCommand with_defaults(BenchCommand flags, const std::vector<Target>& targets) {
  const auto is_given = [&](const char* flag) { return flags.app->get_option(flag)->count() > 0; };
  if (!is_given("--variants")) flags.variants = "none";
  if (!is_given("--ladder")) flags.ladder = LadderFor::none;
  if (flags.effects.empty() && flags.techniques.empty()) flags.effects = effects_of_set(targets);
  flags.no_growth = flags.no_checks = true;
  return flags;
}

void check_set_flags(const BenchCommand& flags) {
  for (const char* flag : {"--scenes", "--frame", "--truth", "--sequence", "--frames", "--size", "--rays", "--radius",
                           "--paper", "--chunks"}) {
    if (flags.app->get_option(flag)->count() > 0)
      throw UsageError("{}: the set says what is measured; leave it out", flag);
  }
  if (flags.app->get_option("--time")->count() > 0)
    throw UsageError(
        "--time: of a set everything is measured; leave it out, or choose --items, --techniques or --presets");
  check_no_reading_flags(*flags.app);
}

class SetBench {
 public:
  SetBench(const BenchCommand& given, Device& device, const RowsOfSet& again)
      : set_(score::read_set(given.set, result_.notes)),
        device_(device),
        flags_(with_defaults(given, set_.targets)),
        again_(again) {
    note(result_.notes);
    if (!flags_.items.empty()) score::keep_items(set_.targets, split_list(flags_.items, "--items"));
    options_ = options_of(flags_, device.info(), result_);
    options_.rows = again_.rows;
    // of eyes they are measured, and no frame is left out
    std::erase_if(result_.skipped, [](const Skipped& skipped) {
      return skipped.scene.empty() && !needs_naming(find_technique(skipped.technique)).empty();
    });
    make_output_folder(flags_.folder);
    check_paths({}, {{"--json", flags_.json.file()}},
                {{"-o", (std::filesystem::path(flags_.folder) / "bench.json").string()}});
    file_.emplace(flags_.folder, set_.id);
  }

  void run() {
    for (const Target& target : set_.targets) {
      try {
        measure_target(target);
      } catch (const UsageError&) {
        throw;
      } catch (const Error& error) {
        left_out_.push_back(fmt::format("{}: left out: {}", target.in_words(), error.what()));
        erase_status();
        std::fputs(("gloam: " + printable(left_out_.back()) + "\n").c_str(), stderr);
        continue;
      }
      write();
    }
    erase_status();
    note(result_.notes);
    if (result_.rows.empty() && sequence_rows_.empty())
      throw Error("nothing could be measured: {}",
                  left_out_.empty() ? "no technique makes the set's effects" : left_out_.front());
    Json made = document();
    if (again_.complete) again_.complete(made);
    flags_.json.write(made);
    if (!flags_.json.only_json() && !again_.complete) print();
    if (left_out_.empty()) return;
    std::fflush(stdout);
    print_notes();
    throw Error("{} left out, {} measured", counted(left_out_.size(), "item"), counted(kinds_.size(), "item"));
  }

 private:
  struct Measured {
    MeasuredSequence sequence;
    SequenceMeasurement rows;
  };

  /// Those for an effect; for two eyes also the techniques of two views, unless the user names techniques.
  MeasureOptions options_for(const Target& target) const {
    MeasureOptions options = for_effect(options_, target.effect);
    if (target.views.size() != 2 || !flags_.techniques.empty()) return options;
    for (const Technique& technique : registry()) {
      if (!needs_naming(technique, flags_.variant).empty() && why_not_measured(technique, {target.effect}).empty())
        options.techniques.push_back(&technique);
    }
    return options;
  }

  void measure_target(const Target& target) {
    if (!contains(effect_names(), target.effect) || !contains(options_.effects, target.effect)) {
      result_.skipped.push_back({"", "", target.in_words(), fmt::format("{} is not measured here", target.effect)});
      return;
    }
    for (const score::TargetFrame& at : target.frames) {
      if (at.check) at.check();
    }
    if (target.is_sequence)
      measure_frames(target);
    else
      measure_frame(target);
    kinds_[target.name] = target.kind;
  }

  Subject subject_of(const Target& target, const score::TargetFrame& at, const MeasureOptions& options,
                     const SceneOptions& making) const {
    Subject subject =
        own_subject(own_frame(at.frame.string(), {}, at.truths), target.effect, options.techniques, making, note);
    subject.name = target.name;
    subject.scene_class = target.scene_class;
    if (options.ladder == LadderFor::none) subject.truths.reset();
    return subject;
  }

  void measure_frame(const Target& target) {
    const MeasureOptions options = options_for(target);
    Subject subject = subject_of(target, target.frames.front(), options, options_.scene);
    measure(subject, options, false, device_, result_);
  }

  void measure_frames(const Target& target) {
    if (target.effect != "ao") {
      result_.skipped.push_back({"", "", target.in_words(), "of a sequence ambient occlusion alone is measured"});
      return;
    }
    MeasureOptions options = options_for(target);
    if (flags_.techniques.empty())
      std::erase_if(options.techniques, [](const Technique* technique) { return reads_layers(*technique); });
    SceneOptions making = options_.scene;
    making.more_planes = {"motion"};
    Measured measured;
    measured.sequence.name = target.name;
    measured.sequence.scene_class = target.scene_class;
    for (const score::TargetFrame& at : target.frames) {
      show_status(target.in_words(at.number), 0);
      add_frame(measured.sequence, at.number, subject_of(target, at, options, making));
    }
    measured.rows = measure_sequence(measured.sequence, options, device_);
    result_.skipped.insert(result_.skipped.end(), measured.rows.skipped.begin(), measured.rows.skipped.end());
    std::vector<std::string> notes;
    const score::LoadedFrame first = score::load(target.frames.front(), target.effect, {}, notes);
    sequence_scenes_.push_back(score::facts_of(target, first, options_.folder));
    std::erase_if(measured.rows.rows, [&](const SequenceRow& row) { return !is_asked_for(row.variation, target); });
    for (const SequenceRow& row : measured.rows.rows) sequence_rows_.push_back(row_of(row, target, first));
    sequences_.push_back(std::move(measured));
  }

  /// All rows, or those of an earlier result.
  bool is_asked_for(const Variation& v, const Target& target) const {
    return again_.rows.empty() || std::any_of(again_.rows.begin(), again_.rows.end(), [&](const WantedRow& row) {
             return row.technique == v.technique->name && row.preset == v.name() && row.variant == v.variant &&
                    row.scene == target.name && row.effect == target.effect;
           });
  }

  /// A row of a sequence, with the fields that it has in common with rows of frames.
  report::Row row_of(const SequenceRow& row, const Target& target, const score::LoadedFrame& first) const {
    const Variation& v = row.variation;
    return {.is_of_frames = false,
            .technique = v.technique->name,
            .preset = v.name(),
            .variant = v.variant,
            .scene = target.name,
            .effect = target.effect,
            .reads = reads_of(*v.technique),
            .ms = times_and_rounds(row.ms),
            .rmse_to_truth = row.rmse,
            .bias = row.bias,
            .ssim = row.ssim,
            .flip = row.flip,
            .flicker = row.flicker.flicker(),
            .ratio_to_hbao_plus = row.ratio,
            .width = first.frame.width(),
            .height = first.frame.height(),
            .resolution = "full"};
  }

  Json document() const {
    report::Measurements made = results_of(result_, options_, device_.info());
    for (const report::Scene& scene : sequence_scenes_) made.scenes.push_back(scene);
    for (const report::Row& row : sequence_rows_) made.rows.push_back(row);
    const auto add_kind = [&](std::string& kind, const std::string& item) {
      if (const auto known = kinds_.find(item); known != kinds_.end()) kind = known->second;
    };
    for (report::Scene& scene : made.scenes) add_kind(scene.kind, scene.name);
    for (report::Row& row : made.rows) add_kind(row.kind, row.scene);
    Json document = report::document_of(made);
    document["set"] = report::json_of(set_.id);
    return document;
  }

  void write() const { file_->write(document()); }

  void print() const {
    fmt::print("{}, {} ({}); set {}\n", cpu_model(), printable(device_.info().name), printable(device_.info().platform),
               printable(score::in_words(set_.id)));
    for (const report::Scene& scene : result_.scenes) cli::print(table_of_scene(result_, scene));
    for (const Measured& each : sequences_) cli::print(table_of_sequence(each.sequence, each.rows));
    print_skipped(result_.skipped);
    fmt::print("wrote {}\n", printable(file_->path().string()));
  }

  Measurement result_;
  score::ScoredSet set_;
  Device& device_;
  const BenchCommand flags_;
  const RowsOfSet& again_;
  BenchOptions options_;
  std::optional<BenchFile> file_;
  std::vector<Measured> sequences_;
  std::vector<report::Scene> sequence_scenes_;
  std::vector<report::Row> sequence_rows_;
  std::map<std::string, std::string> kinds_;  ///< by item
  std::vector<std::string> left_out_;
};

}  // namespace

void bench_set(const BenchCommand& flags, Device& device, const RowsOfSet& again) {
  check_set_flags(flags);
  SetBench(flags, device, again).run();
}

}  // namespace gloam::cli
