#include "cli/shot/work.h"

#include "base/hash.h"
#include "base/memory.h"
#include "cli/flags/memory.h"
#include "cli/flags/radius.h"
#include "gloam/error.h"
#include "gloam/provenance.h"

namespace gloam::cli {
namespace {

/// Of the first frame: what holds for one frame of a shot mostly holds for all.
void add_warnings(const std::optional<Radius>& radius, const Plan& plan, const Frame& frame) {
  report_on(radius, frame, plan);
  if (radius && radius->from == RadiusSource::frame)
    note({fmt::format("{0}: each frame has its own, made from its depths; --{0} gives one to all", radius->name)});
  note(notes_about_views(plan, frame));
}

}  // namespace

std::pair<std::string, std::string> first_to_write_again(const FrameOutputs& outputs, const OutputSettings& settings,
                                                         const FrameMaking& making) {
  for (const std::string& path : outputs.paths()) {
    const std::string added = path == outputs.into ? settings.copied.front() : "";
    if (const std::string why = why_again(path, making, added); !why.empty()) return {path, why};
  }
  return {};
}

unsigned long long bytes_in_flight(const PlannedFrame& planned) {
  const Layout layout(planned.files.window().width(), planned.files.window().height());
  // On a device with memory of its own, a run takes the host's memory for its results only: those that wait to be written. As
  // half, they are copied.
  const unsigned long long results = bytes_beside_frame(planned.plan, layout, planned.files.views().size(), false);
  return bytes_to_read(planned.files, planned.planes) + bytes_of_colour(planned) + results + results / 2;
}

FrameMaking making_of(const ShotSettings& settings, const FrameFiles& files) {
  return {settings.version, settings.contents, identity_of(files)};
}

std::string add_history_to(FrameMaking& making, const std::string& before) {
  making.settings += fmt::format(" history {}", before.empty() ? "none" : before);
  return fmt::format("{:016x}", hash_of(before + making.input));
}

ShotWork::ShotWork(const ShotFiles& files, const ShotSettings& settings, const std::vector<Turn>& turns,
                   std::future<Device> device, ShotReport& report, std::function<void()> stop)
    : files_(files),
      settings_(settings),
      turns_(turns),
      starting_(std::move(device)),
      report_(report),
      steps_(files, report, std::move(stop)),
      flights_(turns.size()) {}

bool ShotWork::step(size_t i, double StepTimes::*time, const std::function<bool(InFlight&)>& work) {
  const bool goes_on = steps_.run(
      turns_[i].frame, flights_[i]->times.*time, [&] { return work(*flights_[i]); }, turns_[i].is_written);
  if (!goes_on) flights_[i].reset();
  return goes_on;
}

bool ShotWork::open(size_t i, InFlight& flight) {
  FrameFiles files = files_.open(frame_at(i));
  flight.making = making_of(settings_, files);
  // Of frames that go on over time, those to leave alone have been left out.
  if (settings_.resume && !settings_.request.temporal) {
    const auto [path, why] = first_to_write_again(outputs_of(i), settings_.writing, flight.making);
    if (report_.leaves_alone(frame_at(i).number, path, why)) return false;
  }
  check_size_in_shot(files, settings_.display);
  flight.planned.emplace(planned_frame(std::move(files), settings_.request, settings_.carried.depth));
  if (turns_[i].is_written && outputs_of(i).has_composite())
    flight.planned->colour.emplace(open_colour(files_.paths_of(frame_at(i)), files_.options_for(frame_at(i))));
  check_bytes_in_shot(flight.planned->files, bytes_in_flight(*flight.planned), settings_.frame_bytes);
  return true;
}

bool ShotWork::decode(size_t i) {
  flights_[i] = std::make_unique<InFlight>();
  return step(i, &StepTimes::decode, [&](InFlight& flight) {
    if (!open(i, flight)) return false;
    PlannedFrame& planned = *flight.planned;
    flight.frame = planned.files.read(planned.planes);
    flight.sources = read_sources(planned);
    steps_.add_notes(turns_[i].frame, flight.frame.assumed);
    steps_.add_notes(turns_[i].frame, flight.sources.notes);
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
  return step(i, &StepTimes::compute, [&](InFlight& flight) {
    compute_planes(i, flight);
    return turns_[i].is_written;
  });
}

bool ShotWork::take_over(size_t i, InFlight& flight) {
  const int number = frame_at(i).number;
  if (turns_[i].begins || turn_before_ + 1 != i) history_.begin_anew();
  files_before_ = add_history_to(flight.making, history_.holds_any() ? files_before_ : "");
  if (history_.holds_any() && motion_leads_elsewhere(flight.plan.inputs, frame_at(i - 1).number, number)) {
    if (!gap_noted_)
      note(
          {fmt::format("frame {}: its motion leads to frame {}, which is not computed; accumulation begins anew "
                       "there, and at all frames like it",
                       number, number - 1)});
    gap_noted_ = true;
    history_.begin_anew();
  }
  return history_.take_over(flight.frame, flight.plan.inputs);
}

void ShotWork::leave_for_next(size_t i, InFlight& flight) {
  history_.leave_for_next(flight.frame, flight.result, settings_.written, fmt::format("frame {}", frame_at(i).number));
  turn_before_ = i;
}

void ShotWork::compute_planes(size_t i, InFlight& flight) {
  const Plan& plan = flight.plan;
  RunOptions options = settings_.options;
  bool goes_on = false;
  if (settings_.request.temporal) {
    goes_on = take_over(i, flight);
    options.seed = seed_in_sequence(options.seed, frame_at(i).number);
  }
  flight.result = run(plan, flight.frame, *device_, options).frame;
  if (goes_on)
    add_warning_about_history(
        flight.frame, flight.result,
        fmt::format("frame {}: shows next to nothing that the frame before showed", frame_at(i).number));
  if (settings_.request.temporal) leave_for_next(i, flight);
  carry_over(flight.frame, flight.result, settings_.carried);
  flight.result.attributes = provenance({{&plan}}, options);
  flight.result.attributes.merge(attributes_of(flight.making));
  flight.frame = {};
}

bool ShotWork::write(size_t i) {
  const bool is_written = step(i, &StepTimes::write, [&](InFlight& flight) {
    steps_.add_notes(turns_[i].frame, write_outputs(outputs_of(i), flight.sources, flight.result, settings_.writing));
    return true;
  });
  if (!is_written) return false;
  report_.done(frame_at(i).number, flights_[i]->times);
  flights_[i].reset();
  return true;
}

}  // namespace gloam::cli
