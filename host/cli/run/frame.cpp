#include <algorithm>
#include <chrono>
#include <future>
#include <limits>

#include "base/command_line.h"
#include "base/statistics.h"
#include "cli/flags/memory.h"
#include "cli/flags/options.h"
#include "cli/flags/radius.h"
#include "cli/flags/result_name.h"
#include "cli/run/command.h"
#include "cli/run/outputs.h"
#include "gloam/compute.h"
#include "gloam/error.h"
#include "gloam/margin.h"
#include "gloam/planes.h"
#include "gloam/provenance.h"
#include "gloam/visualise.h"
#include "run/missed.h"

namespace gloam::cli {
namespace {

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
  fmt::print("{}, {} lanes; wall {:.0f} ms: {}\n", printable(device.name), result.lanes, watch.total(),
             fmt::join(parts, ", "));
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

Json document(const RunCommand& flags, const Plan& plan, const RunResult& result, std::optional<double> missed,
              const DeviceInfo& device, const std::vector<std::string>& decoded, const Stopwatch& watch) {
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
          {"missed_share", missed ? Json(*missed) : Json()},
          {"rest_share", result.rest_share},
          {"device_bytes", result.device_bytes},
          {"wall_ms", wall}};
}

/// The plane that a picture shows; of a stack its first layer.
std::string pictured(const Plan& plan) {
  const std::string& first = plan.outputs.front();
  return is_stack(first) ? layer_name(first, 0) : first;
}

/// One picture for each view, of the first output.
std::vector<std::string> write_pictures(const RunCommand& flags, const Frame& frame, const Frame& input,
                                        const std::string& plane) {
  std::vector<std::string> paths;
  if (flags.picture.empty()) return paths;
  const Window shown = flags.shot.keep_margin ? frame.window : picture_within(frame.window, frame.display);
  for (const View& view : frame.views) {
    paths.push_back(picture_path(flags.picture, view.name, frame.views.size() > 1).string());
    const Plane* depth = view.find("depth") ? view.find("depth") : input.view(view.name).find("depth");
    const Plane shown_depth = depth ? part_of(*depth, frame.window, shown) : Plane();
    write_picture(paths.back(), part_of(*view.find(plane), frame.window, shown), depth ? &shown_depth : nullptr);
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

/// Starts up a device and compiles while planes are decoded. `checked` is set once the device is known to have the memory.
std::future<Device> start_device(const RunFlags& flags, const PlannedFrame& planned, const RunOptions& options,
                                 std::promise<void>& checked) {
  const Layout layout(planned.files.window().width(), planned.files.window().height());
  return std::async(std::launch::async,
                    [&flags, &checked, plan = planned.plan, options, layout, views = planned.files.views().size()] {
                      try {
                        Device device = flags.open();
                        check(plan, layout, views, device, options);
                        checked.set_value();
                        prepare(plan, device, options);
                        return device;
                      } catch (...) {
                        tell(checked, std::current_exception());
                        throw;
                      }
                    });
}

void print_result(const RunCommand& flags, const Plan& plan, const RunResult& result, std::optional<double> missed,
                  const std::vector<std::string>& copied) {
  if (!plan.wanted.empty())
    fmt::print("'{}' left out {:.1f} % of the pixels\n", printable(plan.mask), 100 * result.skipped_share);
  if (missed)
    fmt::print("'{}' misses {:.1f} % of the pixels: left out, although '{}' changes there by more than 1/255\n",
               printable(plan.mask), 100 * *missed, plan.outputs.front());
  if (!plan.rest.empty())
    fmt::print("{} computed {:.1f} % of the pixels\n", second_estimate(plan), 100 * result.rest_share);
  if (!flags.out.empty()) fmt::print("wrote {} ({})\n", printable(flags.out), fmt::join(plan.outputs, ", "));
  if (!flags.into.empty())
    fmt::print("wrote {} (all of {}, and {})\n", printable(flags.into), printable(flags.frame.frame),
               fmt::join(copied, ", "));
  if (!flags.composite.path.empty())
    fmt::print("wrote {} (colour with {})\n", printable(flags.composite.path), composited_plane(plan.outputs));
}

/// To people who named no file, and so perhaps do not know the other commands.
void print_what_next(const RunCommand& flags) {
  const std::string out = printable(quoted_for_shell(flags.out));
  fmt::print("gloam view {} {} shows both; gloam compare {} TRUTH.exr measures it; gloam run --help has more\n",
             printable(quoted_for_shell(flags.frame.frame)), out, out);
}

}  // namespace

void run_on_frame(const RunCommand& flags, const PlanRequest& request) {
  Stopwatch watch;
  RunOptions options = flags.run_flags.run_options();
  const FrameOutputs outputs = outputs_of(flags);
  check(outputs, flags);
  check_picture_name(flags.picture, "--picture");
  std::vector<NamedPath> inputs = flags.frame.inputs();
  inputs.emplace_back("--camera", flags.frame_flags.camera);
  std::vector<NamedPath> files_written = named(outputs);
  files_written.insert(files_written.end(), {{"--picture", flags.picture}, {"--json", flags.json.file()}});
  check_paths(inputs, files_written);
  // The next frame of a sequence takes over what this one knows.
  const bool carries_depth = !flags.bare && !flags.out.empty() && (flags.shot.keep_depth || is_temporal(flags));
  FrameFiles opened = flags.frame.open(flags.frame_flags.read_options());
  check_pictures({"--picture", flags.picture}, opened.views());
  const PlanRequest over_time = going_on(request, opened, flags.technique_flags.temporal);
  PlannedFrame planned = planned_frame(std::move(opened), over_time, carries_depth);
  check_history(planned.plan, planned.files);
  if (flags.out.empty()) keep_first_output(planned, carries_depth);
  const OutputSettings writing = output_settings(flags, planned.request, planned.plan);
  if (outputs.has_composite())
    planned.colour.emplace(open_colour(flags.frame.files(), flags.frame_flags.read_options()));
  FrameFiles& files = planned.files;
  if (files.history() && reads_history(planned.plan) && !flags.run_flags.seed)
    options.seed = seed_after(*files.history());
  const unsigned long long memory = planned_memory(
      flags.frame_flags, files.name(), flags.run_flags.device,
      [&](bool shares_memory) {
        return bytes_of_run(files, planned.planes, planned.plan, shares_memory) + bytes_of_colour(planned);
      },
      "crop or shrink the frame, ask for less (--outputs, --resolution half), or for one view (--view)");
  watch.lap("open");
  std::promise<void> checked;
  std::future<Device> starting = start_device(flags.run_flags, planned, options, checked);
  // A large frame waits to hear that the device has the memory for it.
  const Layout layout(files.window().width(), files.window().height());
  if (device_bytes(planned.plan, layout, files.views().size()) > (1ull << 30)) checked.get_future().get();
  Frame frame = files.read(planned.planes);
  OutputSources sources = read_sources(planned);
  watch.lap("decode");
  note(frame.assumed);
  note(sources.notes);
  const bool writes_history = writing.out.keeps_margin && !flags.out.empty();
  note(notes_on_margin(frame, writes_history || flags.shot.keep_margin, flags.shot.keep_margin));
  std::vector<std::string> notes;
  const std::optional<Radius> settled = settle(planned, frame, notes);
  note(notes);
  const Plan& plan = planned.plan;
  const std::optional<RadiusReport> radius = report_on(settled, frame, plan);
  note(notes_about_views(plan, frame));
  if (reads_history(plan) && !files.history()) add_no_history(frame, plan.inputs);
  Device device = starting.get();
  watch.lap("device");
  options.progress = progress_bar();
  RunResult result = run(plan, frame, device, options);
  watch.lap("compute");
  const std::optional<double> missed = missed_share(planned.request, plan, frame, result.frame, device, options);
  if (missed) watch.lap("missed");
  if (files.history() && reads_history(plan))
    note(warning_about_history(frame, result.frame,
                               fmt::format("--history {}: shows next to nothing that {} shows",
                                           files.history()->file().path().string(), files.name())));
  carry_over(frame, result.frame, {.depth = carries_depth, .cameras = !flags.bare});
  result.frame.attributes = provenance({{&plan}}, options);
  if (flags.is_out_made) result.frame.attributes[named_by_gloam] = frame_seen_from(flags.frame.frame, flags.out);
  const std::vector<std::string> pictures = write_pictures(flags, result.frame, frame, pictured(plan));
  note(write_outputs(outputs, sources, result.frame, writing));
  watch.lap("write");
  std::vector<std::string> written = paths_of(outputs);
  written.insert(written.end(), pictures.begin(), pictures.end());
  Json figures = document(flags, plan, result, missed, device.info(), decoded_channels(planned.planes, files), watch);
  figures["memory_bytes"] = memory;
  if (radius) radius->add_to(figures);
  flags.json.write(figures, written);
  if (flags.json.only_json()) return;
  if (radius) radius->print();
  print_times(result, device.info(), watch);
  print_result(flags, plan, result, missed, writing.copied);
  print_written(pictures);
  if (flags.is_out_made) print_what_next(flags);
}

}  // namespace gloam::cli
