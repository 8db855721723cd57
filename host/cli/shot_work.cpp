#include "cli/shot_work.h"

#include "base/elapsed.h"
#include "base/files.h"
#include "base/memory.h"
#include "cli/memory.h"
#include "cli/radius.h"
#include "gloam/error.h"
#include "gloam/provenance.h"

namespace gloam::cli {
namespace {

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// Of the first frame: what holds for one frame of a shot mostly holds for all.
void add_warnings(const std::optional<Radius>& radius, const Plan& plan, const Frame& frame) {
  report_on(radius, frame, plan);
  if (radius && radius->from == RadiusSource::frame)
    note({"radius: each frame has its own, made from its depths; --radius gives one to all"});
  if (const std::string warning = warning_about_views(plan, frame); !warning.empty()) note({warning});
}

}  // namespace

unsigned long long bytes_in_flight(const PlannedFrame& planned) {
  const Layout layout(planned.files.window().width(), planned.files.window().height());
  // On a device with memory of its own, a run takes the host's memory for its results only: those that wait to be written. As
  // half, they are copied.
  const unsigned long long results = bytes_beside_frame(planned.plan, layout, planned.files.views().size(), false);
  return bytes_to_read(planned.files, planned.planes) + results + results / 2;
}

ShotWork::ShotWork(const ShotFiles& files, const ShotSettings& settings, std::future<Device> device, ShotReport& report,
                   std::function<void()> stop)
    : files_(files),
      settings_(settings),
      starting_(std::move(device)),
      report_(report),
      stop_(std::move(stop)),
      flights_(files.frames().size()) {}

bool ShotWork::guarded(size_t i, double StepTimes::*time, const std::function<bool(InFlight&)>& step) {
  const auto timed = [&] {
    const auto start = std::chrono::steady_clock::now();
    const bool goes_on = step(*flights_[i]);
    flights_[i]->times.*time = 1000 * seconds_since(start);
    return goes_on;
  };
  const bool goes_on = report_.attempt(frame_at(i).number, timed, stop_);
  if (!goes_on) flights_[i].reset();
  return goes_on;
}

void ShotWork::add_notes(size_t i, const std::vector<std::string>& notes) {
  for (std::string text : notes) {
    for (const FramePattern& pattern : files_.inputs())
      replace_all(text, pattern.path_of(frame_at(i).source).filename().string(), pattern.name());
    note({text});
  }
}

bool ShotWork::open(size_t i, InFlight& flight) {
  FrameFiles files = files_.open(frame_at(i));
  flight.making = {settings_.version, settings_.contents, identity_of(files)};
  if (settings_.resume) {
    const std::string why = why_again(output_of(i), flight.making);
    if (why.empty()) {
      report_.skipped(frame_at(i).number);
      return false;
    }
    if (std::filesystem::exists(output_of(i))) report_.written_again(frame_at(i).number, why);
  }
  const Window display = files.files().front().display();
  if (display.width() != settings_.display.width() || display.height() != settings_.display.height())
    throw Error("{}: is {}x{}, and the shot's first frame {}x{}; render all alike", files.name(), display.width(),
                display.height(), settings_.display.width(), settings_.display.height());
  flight.planned.emplace(planned_frame(std::move(files), settings_.request, settings_.carried.depth));
  const unsigned long long bytes = bytes_in_flight(*flight.planned);
  if (bytes > settings_.frame_bytes)
    throw Error("{}: takes {} of memory, and a frame of this shot has {}; --memory gives more",
                flight.planned->files.name(), memory_in_words(bytes), memory_in_words(settings_.frame_bytes));
  return true;
}

bool ShotWork::decode(size_t i) {
  flights_[i] = std::make_unique<InFlight>();
  return guarded(i, &StepTimes::decode, [&](InFlight& flight) {
    if (!open(i, flight)) return false;
    PlannedFrame& planned = *flight.planned;
    flight.frame = planned.files.read(planned.planes);
    add_notes(i, flight.frame.assumed);
    const std::optional<Radius> radius = settle(planned, flight.frame);
    if (i == 0) add_warnings(radius, planned.plan, flight.frame);
    flight.plan = std::move(planned.plan);
    flight.planned.reset();  // closes the files
    return true;
  });
}

/// Frames come in order: what a frame takes over from the one before is at hand here.
bool ShotWork::compute(size_t i) {
  if (!device_) device_.emplace(starting_.get());
  return guarded(i, &StepTimes::compute, [&](InFlight& flight) {
    compute_planes(flight);
    return true;
  });
}

void ShotWork::compute_planes(InFlight& flight) {
  const Plan& plan = flight.plan;
  flight.result = run(plan, flight.frame, *device_, settings_.options).frame;
  carry_over(flight.frame, flight.result, settings_.carried);
  flight.result.attributes = provenance({{&plan}}, settings_.options);
  flight.result.attributes.merge(attributes_of(flight.making));
  flight.frame = {};
}

bool ShotWork::write(size_t i) {
  const bool is_written = guarded(i, &StepTimes::write, [&](InFlight& flight) {
    write_frame(output_of(i), flight.result, settings_.writing);
    return true;
  });
  if (!is_written) return false;
  report_.done(frame_at(i).number, flights_[i]->times);
  flights_[i].reset();
  return true;
}

}  // namespace gloam::cli
