// gloam run TECHNIQUE FRAME.exr -o OUT.exr
#include <algorithm>
#include <chrono>
#include <future>
#include <memory>

#include "base/statistics.h"
#include "cli/list_techniques.h"
#include "cli/memory.h"
#include "cli/options.h"
#include "cli/radius.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/provenance.h"
#include "gloam/stereo_consistency.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

struct RunCommand {
  std::string technique, out, outputs, picture, compression = "zip";
  bool bare = false, half = false;
  FrameArguments frame;
  FrameFlags frame_flags;
  TechniqueFlags technique_flags;
  RunFlags run_flags;
  JsonFlag json;
};

/// Wall-clock times of the parts of a command, in order.
class Stopwatch {
 public:
  void lap(const std::string& name) {
    const auto now = std::chrono::steady_clock::now();
    laps.emplace_back(name, std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  }
  double total() const {
    double sum = 0;
    for (const auto& [name, ms] : laps) sum += ms;
    return sum;
  }
  std::vector<std::pair<std::string, double>> laps;

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Adds a note if two eyes have no surface in common: most likely they show two scenes, or have each other's cameras.
void check_views(const Plan& plan, const Frame& frame) {
  const auto is_of_two = [](const PlannedPass& planned) { return planned.technique->views == 2; };
  if (!std::any_of(plan.passes.begin(), plan.passes.end(), is_of_two) || frame.views.size() != 2) return;
  for (const View& view : frame.views) {
    if (!view.find("depth") || !view.camera || !view.camera->pose) return;  // another message says so
  }
  if (!have_surface_in_common(frame)) {
    note({fmt::format(
        "the views '{}' and '{}' have no surface in common, and each gets a result of its own; do both show "
        "one scene, each with its own camera?",
        frame.views[0].name, frame.views[1].name)});
  }
}

/// Times summed over many views; each pass has the number of its views.
std::vector<PassTime> summed_over_views(const std::vector<PassTime>& passes) {
  std::vector<PassTime> sums;
  std::vector<int> views;
  for (const PassTime& pass : passes) {
    const auto known =
        std::find_if(sums.begin(), sums.end(), [&](const PassTime& sum) { return sum.name == pass.name; });
    if (known == sums.end()) {
      sums.push_back(pass);
      views.push_back(1);
      continue;
    }
    ++views[size_t(known - sums.begin())];
    for (size_t i = 0; i < pass.ms.size(); ++i) known->ms[i] += pass.ms[i];
  }
  for (size_t i = 0; i < sums.size(); ++i) sums[i].view = fmt::format("{} of them", views[i]);
  return sums;
}

void print_times(const RunResult& result, const DeviceInfo& device, const Stopwatch& watch) {
  constexpr size_t few = 4;
  const size_t count = result.frame.views.size();
  const bool views = count > 1;
  const std::string heading = count > few ? fmt::format("{} views", count) : views ? "view" : "";
  std::vector<std::vector<std::string>> rows = {{heading, "pass", "ms median", "min", "max"}};
  const auto row = [&](const std::string& view, const std::string& name, const std::vector<double>& ms) {
    const auto [least, most] = std::minmax_element(ms.begin(), ms.end());
    rows.push_back(
        {view, name, fmt::format("{:.2f}", median(ms)), fmt::format("{:.2f}", *least), fmt::format("{:.2f}", *most)});
  };
  for (const PassTime& pass : count > few ? summed_over_views(result.passes) : result.passes)
    row(pass.view, pass.name, pass.ms);
  row("", "total", result.total_ms);
  if (!views) {
    for (auto& r : rows) r.erase(r.begin());
  }
  print_table(rows, views ? 2 : 1);
  std::vector<std::string> parts;
  for (const auto& [name, ms] : watch.laps) parts.push_back(fmt::format("{} {:.0f}", name, ms));
  fmt::print("{}, {} lanes; wall {:.0f} ms: {}\n", device.name, result.lanes, watch.total(), fmt::join(parts, ", "));
}

/// The label of the pass that computes the pixels that the first estimate leaves out.
std::string second_estimate(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& read : planned.pass.reads) {
      if (read.argument == "wanted" && read.plane == plan.rest) return planned.label();
    }
  }
  return "";
}

Json document(const RunCommand& flags, const Plan& plan, const RunResult& result, const DeviceInfo& device,
              const std::vector<std::string>& decoded, const Stopwatch& watch) {
  Json passes = Json::array();
  for (const PassTime& pass : result.passes) {
    Json entry = {{"name", pass.name}, {"ms", milliseconds(pass.ms)}};
    if (!pass.view.empty()) entry["view"] = pass.view;
    passes.push_back(entry);
  }
  Json wall = Json::object();
  for (const auto& [name, ms] : watch.laps) wall[name] = ms;
  return {{"technique", plan.technique},
          {"device", device.name},
          {"lanes", result.lanes},
          {"math", word_for(flags.run_flags.math, math_words)},
          {"real", word_for(flags.run_flags.real, real_words)},
          {"passes", passes},
          {"total_ms", milliseconds(result.total_ms)},
          {"plan", plan_document(plan, decoded)},
          {"skipped_share", result.skipped_share},
          {"rest_share", result.rest_share},
          {"device_bytes", result.device_bytes},
          {"wall_ms", wall}};
}

/// Planes of the list that every view of the frame still has.
std::vector<std::string> planes_left(const Frame& frame, const std::vector<std::string>& planes) {
  std::vector<std::string> left;
  for (const std::string& plane : planes) {
    const bool everywhere =
        std::all_of(frame.views.begin(), frame.views.end(), [&](const View& view) { return view.find(plane); });
    if (everywhere) left.push_back(plane);
  }
  return left;
}

/// The plane that a picture shows; of a stack its first layer.
std::string pictured(const Plan& plan) {
  const std::string& first = plan.outputs.front();
  return is_stack(first) ? layer_name(first, 0) : first;
}

/// Moves the other contents of the output: depth and cameras, so that `compare` knows the background by itself; for two views also
/// normals, so that `compare --stereo` knows the edges.
void carry_over(Frame& from, Frame& to, bool bare) {
  std::vector<std::string> carried = {"depth"};
  if (from.views.size() == 2) carried.push_back("normal");
  for (View& view : to.views) {
    if (bare) {
      view.camera.reset();
      continue;
    }
    std::map<std::string, Plane>& given = from.view(view.name).planes;
    for (const std::string& plane : carried) {
      if (!view.find(plane) && given.count(plane)) view.planes[plane] = std::move(given[plane]);
    }
  }
}

/// One picture for each view, of the first output.
std::vector<std::string> write_pictures(const std::string& path, const Frame& frame, const Frame& input,
                                        const std::string& plane) {
  std::vector<std::string> paths;
  if (path.empty()) return paths;
  for (const View& view : frame.views) {
    paths.push_back(picture_path(path, view.name, frame.views.size() > 1).string());
    const Plane* depth = view.find("depth") ? view.find("depth") : input.view(view.name).find("depth");
    write_picture(paths.back(), *view.find(plane), depth);
  }
  return paths;
}

/// Sets the error of the promise, unless the promise has a value already.
void tell(std::promise<void>& promise, std::exception_ptr error) {
  try {
    promise.set_exception(error);
  } catch (const std::future_error&) {
  }
}

/// A seed other than that of the frame before: the same samples would add nothing.
int seed_after(const History& history) {
  const int before = history.seed().value_or(0);
  return before < std::numeric_limits<int>::max() ? before + 1 : 0;
}

void run_command(const RunCommand& given) {
  RunCommand flags = given;
  flags.technique = technique_for(given.technique);
  Stopwatch watch;
  RunOptions options = flags.run_flags.run_options();
  find_technique(flags.technique);
  PlanRequest request = flags.technique_flags.request({flags.technique});
  if (!flags.outputs.empty()) request.only = split_list(flags.outputs, "--outputs");
  const WriteOptions writing{flags.half, flags.compression};
  check_frame_name(flags.out, "-o");
  check_picture_name(flags.picture, "--picture");
  std::vector<NamedPath> inputs = flags.frame.inputs();
  inputs.emplace_back("--camera", flags.frame_flags.camera);
  check_paths(inputs, {{"-o", flags.out}, {"--picture", flags.picture}, {"--json", flags.json.file()}});
  FrameFiles files = flags.frame.open(flags.frame_flags.read_options());
  Plan plan = plan_for(files, request);
  if (reads_history(plan) && !flags.run_flags.seed) options.seed = seed_after(*files.history());
  std::vector<std::string> planes = plan.inputs;
  const std::vector<std::string> available = files.common_planes();
  if (!flags.bare && contains(available, "depth") && !contains(planes, "depth")) planes.push_back("depth");
  const unsigned long long memory = planned_memory(
      flags.frame_flags, files.name(), flags.run_flags.device,
      [&](bool shares_memory) { return bytes_of_run(files, planes, plan, shares_memory); },
      "crop or shrink the frame, ask for less (--outputs, --resolution half), or for one view (--view)");
  watch.lap("open");
  // The device starts up and compiles while the planes are decoded. A large frame waits to hear that the device has the
  // memory for it.
  const Layout layout(files.window().width(), files.window().height());
  const size_t views = files.views().size();
  std::promise<void> checked;
  std::future<Device> starting = std::async(std::launch::async, [&, plan] {
    try {
      Device device(flags.run_flags.device);
      check(plan, layout, views, device, options);
      checked.set_value();
      prepare(plan, device, options);
      return device;
    } catch (...) {
      tell(checked, std::current_exception());
      throw;
    }
  });
  if (device_bytes(plan, layout, views) > (1ull << 30)) checked.get_future().get();
  Frame frame = files.read(planes);
  watch.lap("decode");
  note(frame.assumed);
  const std::vector<std::string> left = planes_left(frame, plan.inputs);
  // If a plane turned out to be unusable (normals in the space of an unknown camera), make it instead.
  const bool is_all_left = left.size() == plan.inputs.size();
  if (!is_all_left) plan = make_plan(request, left, holdings(files));
  const std::optional<RadiusReport> radius =
      settle_radius(request, plan, frame, stated_radius(files), is_all_left ? available : left, holdings(files));
  check_views(plan, frame);
  Device device = starting.get();
  watch.lap("device");
  options.progress = progress_bar();
  RunResult result = run(plan, frame, device, options);
  watch.lap("compute");
  carry_over(frame, result.frame, flags.bare);
  result.frame.attributes = provenance({{&plan}}, options);
  write_frame(flags.out, result.frame, writing);
  const std::vector<std::string> pictures = write_pictures(flags.picture, result.frame, frame, pictured(plan));
  watch.lap("write");
  std::vector<std::string> written = {flags.out};
  written.insert(written.end(), pictures.begin(), pictures.end());
  Json figures = document(flags, plan, result, device.info(), decoded_channels(planes, files), watch);
  figures["memory_bytes"] = memory;
  if (radius) radius->add_to(figures);
  flags.json.write(figures, written);
  if (flags.json.only_json()) return;
  if (radius) radius->print();
  print_times(result, device.info(), watch);
  if (!plan.wanted.empty()) fmt::print("'{}' left out {:.1f} % of the pixels\n", plan.mask, 100 * result.skipped_share);
  if (!plan.rest.empty())
    fmt::print("{} computed {:.1f} % of the pixels\n", second_estimate(plan), 100 * result.rest_share);
  fmt::print("wrote {} ({})\n", printable(flags.out), fmt::join(plan.outputs, ", "));
  for (const std::string& path : pictures) fmt::print("wrote {}\n", printable(path));
}

}  // namespace

void add_run(CLI::App& app) {
  auto flags = std::make_shared<RunCommand>();
  CLI::App* command = app.add_subcommand("run", "run a technique on a frame");
  command
      ->add_option("technique", flags->technique,
                   "gloam list techniques shows them; ao: the default of ambient occlusion")
      ->required()
      ->type_name("TECHNIQUE");
  flags->frame.add_to(*command);
  command->add_option("-o,--output", flags->out, "EXR file to write")->required()->type_name("OUT.exr");
  command->add_option("--outputs", flags->outputs, "write these planes only, and compute only what they need")
      ->type_name("A,B");
  command->add_option("--picture", flags->picture, "the first output as a picture for people")->type_name("OUT.png");
  command->add_flag("--bare", flags->bare, "leave depth, normals and cameras out of OUT.exr");
  command->add_flag("--half", flags->half, "write AO as half instead of float");
  add_compression(*command, flags->compression);
  flags->technique_flags.add_to(*command);
  flags->run_flags.add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Examples:\n"
      "  gloam run ao frame.exr -o ao.exr --picture ao.png\n"
      "  gloam run hbao+ frame.exr -o ao.exr --radius 0.3\n"
      "  gloam run hbao+ frame.exr -o ao.exr --preset high --filter none --repeat 9\n"
      "  gloam run hbao+ pair_L.exr pair_R.exr -o ao.exr --camera pair.camera.json\n"
      "  gloam run gtao frame.exr -o ao.exr --only corner-mask\n"
      "  gloam run temporal-sssr frame.0002.exr --history reflection.0001.exr -o reflection.0002.exr\n"
      "  gloam run normals depth_only.exr -o normals.exr --fov 60 --json -\n"
      "Every parameter of the technique is a flag: gloam run TECHNIQUE --help shows them.");
  command->callback([flags] { run_command(*flags); });
}

}  // namespace gloam::cli
