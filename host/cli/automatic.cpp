// gloam auto FRAME.exr -o OUT.exr
#include "gloam/automatic.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/visualise.h"
#include "options.h"
#include "statistics.h"

namespace gloam::cli {
namespace {

struct AutoCommand {
  std::string out, explain, compression = "zip";
  bool half = false, measure = false;
  FrameArguments frame;
  FrameFlags frame_flags;
  TechniqueFlags technique_flags;
  RunFlags run_flags;
  JsonFlag json;
};

/// An effect from the first look to its planes.
struct Outcome {
  EffectChoice choice;
  std::vector<std::string> outputs;
  double ms = 0;             ///< on the device, classification and mask included
  double ms_everywhere = 0;  ///< of everything everywhere; NaN where it has not been measured
};

double best(const RunResult& result) {
  return result.total_ms.empty() ? 0 : *std::min_element(result.total_ms.begin(), result.total_ms.end());
}

/// Planes of what is not called for: nothing is occluded, nothing is reflected.
void add_idle_planes(const Frame& frame, const std::vector<std::string>& outputs, Frame& out) {
  const Layout layout(frame.width(), frame.height());
  for (View& view : out.views) {
    for (const std::string& name : outputs) {
      const PlaneKind kind = plane_kind(name);
      Plane plane{name, {}};
      for (size_t i = 0; i < kind.components.size(); ++i) {
        Channel& channel = plane.channels.emplace_back(layout);
        for (int y = 0; y < layout.height; ++y) std::fill_n(channel.row(y), layout.width, kind.outside);
        channel.fill_padding(kind.outside);
      }
      view.planes[name] = std::move(plane);
    }
  }
}

void take_planes(Frame& from, Frame& to) {
  for (View& view : from.views) {
    for (auto& [name, plane] : view.planes) to.view(view.name).planes[name] = std::move(plane);
  }
}

/// Everything that a command works with.
struct Work {
  const AutoCommand& flags;
  PlanRequest asked;
  std::vector<std::string> available;
  std::string holds;
  RunOptions options;
  Frame frame;
  Device& device;
};

Outcome outcome_of(const Technique& technique, Work& work, Frame& out) {
  Outcome outcome{
      choose(technique, work.asked, work.frame, work.available, work.holds, work.device, work.options), {}, 0, 0};
  EffectChoice& choice = outcome.choice;
  const Plan plan = make_plan(request_for(technique, work.asked, !choice.is_everywhere), work.available, work.holds);
  outcome.outputs = plan.outputs;
  outcome.ms = choice.classify_ms;
  outcome.ms_everywhere = std::numeric_limits<double>::quiet_NaN();
  if (choice.is_wanted) {
    RunResult result = run(plan, work.frame, work.device, work.options);
    outcome.ms += best(result);
    take_planes(result.frame, out);
  } else {
    add_idle_planes(work.frame, plan.outputs, out);
  }
  if (!work.flags.explain.empty() && choice.is_wanted && !choice.is_everywhere)
    choice.seen = cells_of(technique, work.asked, work.frame, work.available, work.holds, work.device);
  if (work.flags.measure) {
    const Plan everywhere = make_plan(request_for(technique, work.asked, false), work.available, work.holds);
    outcome.ms_everywhere = best(run(everywhere, work.frame, work.device, work.options));
  }
  return outcome;
}

Json number_or_null(double value) { return std::isnan(value) ? Json(nullptr) : Json(value); }

Json document_of(const std::vector<Outcome>& outcomes, const DeviceInfo& device) {
  Json effects = Json::array();
  double classify_ms = 0, total_ms = 0;
  for (const Outcome& o : outcomes) {
    effects.push_back({{"name", o.choice.technique->effect.name},
                       {"technique", o.choice.technique->name},
                       {"wanted", o.choice.is_wanted},
                       {"everywhere", o.choice.is_everywhere},
                       {"why", o.choice.why},
                       {"share_of_tiles", o.choice.share},
                       {"ms", o.ms},
                       {"ms_everywhere", number_or_null(o.ms_everywhere)}});
    classify_ms += o.choice.classify_ms;
    total_ms += o.ms;
  }
  return {{"effects", effects}, {"classify_ms", classify_ms}, {"total_ms", total_ms}, {"device", device.name}};
}

void print(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows = {{"effect", "wanted", "where", "technique", "ms", "everywhere", "why"}};
  for (const Outcome& o : outcomes) {
    const EffectChoice& c = o.choice;
    rows.push_back({c.technique->effect.name, c.is_wanted ? "yes" : "no",
                    c.is_everywhere ? "everywhere" : fmt::format("{:.0f} %", 100 * c.share), c.technique->name,
                    fmt::format("{:.2f}", o.ms),
                    std::isnan(o.ms_everywhere) ? "-" : fmt::format("{:.2f}", o.ms_everywhere), c.why});
  }
  print_table(rows, 7);
}

std::vector<Explanation> explanations_of(const std::vector<Outcome>& outcomes, const std::string& view) {
  std::vector<Explanation> all;
  for (const Outcome& o : outcomes) {
    const std::string saving = std::isnan(o.ms_everywhere)
                                   ? fmt::format("{:.1f} ms", o.ms)
                                   : fmt::format("{:.1f} ms, everywhere {:.1f}", o.ms, o.ms_everywhere);
    all.push_back({fmt::format("{}: {}", o.choice.technique->effect.name, o.choice.is_wanted ? "yes" : "no"),
                   o.choice.why, saving, o.choice.seen.view(view).find(o.choice.cells), o.choice.is_everywhere});
  }
  return all;
}

void auto_command(const AutoCommand& flags) {
  RunOptions options = flags.run_flags.run_options();
  // What is compared is not to hold what a device does once.
  if (flags.measure) options.repeat = std::max(options.repeat, 3);
  const WriteOptions writing{flags.half, flags.compression};
  check(writing);
  check_frame_name(flags.out, "-o");
  check_picture_name(flags.explain, "--explain");
  std::vector<NamedPath> inputs = flags.frame.inputs();
  inputs.emplace_back("--camera", flags.frame_flags.camera);
  check_paths(inputs, {{"-o", flags.out}, {"--explain", flags.explain}, {"--json", flags.json.file()}});
  FrameFiles files(flags.frame.paths(), flags.frame_flags.read_options());
  const PlanRequest asked = flags.technique_flags.request({});
  const std::vector<const Technique*> techniques = techniques_with_effects();
  std::vector<std::string> planes = {"depth"};
  for (const Technique* technique : techniques) {
    for (const std::string& plane : inputs_of_effect(*technique, asked, files.common_planes(), holdings(files)))
      add_new(planes, plane);
  }
  if (!flags.explain.empty() && contains(files.common_planes(), "color")) add_new(planes, "color");
  Device device(flags.run_flags.device);
  Work work{flags, asked, {}, holdings(files), options, files.read(planes), device};
  note(work.frame.assumed);
  for (const std::string& plane : planes) {
    const auto has = [&](const View& view) { return view.find(plane) != nullptr; };
    if (std::all_of(work.frame.views.begin(), work.frame.views.end(), has)) work.available.push_back(plane);
  }
  work.options.progress = progress_bar();
  Frame out;
  out.display = work.frame.display;
  out.window = work.frame.window;
  out.assumed = work.frame.assumed;
  for (const View& view : work.frame.views)
    out.views.push_back({.name = view.name, .camera = view.camera, .origin = view.origin, .planes = {}});
  std::vector<Outcome> outcomes;
  for (const Technique* technique : techniques) outcomes.push_back(outcome_of(*technique, work, out));
  std::vector<std::string> written = {flags.out};
  if (!flags.explain.empty()) {
    for (const View& view : work.frame.views) {
      written.push_back(picture_path(flags.explain, view.name, work.frame.views.size() > 1).string());
      write_explanation(written.back(), view, explanations_of(outcomes, view.name));
    }
  }
  for (View& view : out.views) view.planes["depth"] = std::move(work.frame.view(view.name).planes.at("depth"));
  write_frame(flags.out, out, writing);
  flags.json.write(document_of(outcomes, device.info()), written);
  if (flags.json.only_json()) return;
  print(outcomes);
  for (const std::string& path : written) fmt::print("wrote {}\n", printable(path));
}

}  // namespace

void add_auto(CLI::App& app) {
  auto flags = std::make_shared<AutoCommand>();
  CLI::App* command = app.add_subcommand("auto", "look at a frame, and compute only the effects that it calls for");
  flags->frame.add_to(*command);
  command->add_option("-o,--output", flags->out, "EXR file to write")->required()->type_name("OUT.exr");
  command->add_option("--explain", flags->explain, "picture of what is called for where, and why")
      ->type_name("OUT.png");
  command->add_flag("--measure", flags->measure,
                    "also compute everything everywhere, and tell what that takes; 3 timed runs at least");
  command->add_flag("--half", flags->half, "write AO as half instead of float");
  command->add_option("--compression", flags->compression, "none, rle, zips, zip or piz; none is fastest")
      ->type_name("NAME");
  flags->technique_flags.add_to(*command, false);
  flags->run_flags.add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "What a frame does not call for is written as if computed: AO of 1.\n"
      "Examples:\n"
      "  gloam auto frame.exr -o out.exr\n"
      "  gloam auto frame.exr -o out.exr --explain why.png --measure --repeat 9\n"
      "Parameters are set with --set NAME=VALUE (gloam list techniques).");
  command->callback([flags] { auto_command(*flags); });
}

}  // namespace gloam::cli
