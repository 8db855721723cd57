#include "shot/run_step.h"

#include "base/lists.h"
#include "gloam/compute.h"
#include "gloam/error.h"
#include "gloam/margin.h"
#include "gloam/planes.h"
#include "gloam/provenance.h"

namespace gloam {
namespace {

Layout layout_of(const FrameFiles& files) { return Layout(files.window().width(), files.window().height()); }

unsigned long long bytes_in_flight(const PlannedFrame& planned) {
  // On a device with memory of its own, a run takes the host's memory for its results only: those that wait to be written. As
  // half, they are copied.
  const unsigned long long results =
      bytes_beside_frame(planned.plan, layout_of(planned.files), planned.files.views().size(), false);
  return bytes_to_read(planned.files, planned.planes) + bytes_of_colour(planned) + results + results / 2;
}

/// What a frame leaves for the next, while that takes it over.
unsigned long long bytes_of_history(const PlannedFrame& planned) {
  if (!planned.request.temporal) return 0;
  unsigned long long bytes = 0;
  for (const std::string& plane : planned.plan.inputs) {
    if (is_of_history(plane)) bytes += plane_kind(plane).components.size() * sizeof(float);
  }
  const Window window = planned.files.window();
  return 2 * bytes * size_t(window.width()) * size_t(window.height()) * planned.files.views().size();
}

/// Of the first frame: what holds for one frame of a shot mostly holds for all.
void add_warnings(const std::optional<Radius>& radius, const Plan& plan, const Frame& frame, ShotEvents& events) {
  if (radius) {
    if (const std::string warning = warning_about(*radius, frame, cap_of(plan)); !warning.empty()) events.note(warning);
    if (radius->from == RadiusSource::frame)
      events.note(
          fmt::format("{0}: each frame has its own, made from its depths; --{0} gives one to all", radius->name));
  }
  for (const std::string& note : notes_about_views(plan, frame)) events.note(note);
}

}  // namespace

PlannedFrame first_planned(const SequenceFiles& shot, const RunSettings& settings) {
  std::optional<PlannedFrame> planned;
  first_that_can(shot, [&](const SequenceFrame& frame) {
    planned.emplace(planned_frame(shot.open(frame), settings.request, settings.carried.depth));
    if (settings.outputs.has_composite())
      planned->colour.emplace(open_colour(shot.paths_of(frame), shot.options_for(frame)));
  });
  keep_first_output(*planned, settings.carried.depth);
  return std::move(*planned);
}

class RunStep::Work : public FrameWork {
 public:
  Work(RunStep& step, PlannedFrame planned) : step_(step), planned_(std::move(planned)) {}

  unsigned long long bytes() const override { return bytes_in_flight(*planned_); }

  void decode() override {
    PlannedFrame& planned = *planned_;
    frame_ = planned.files.read(planned.planes);
    if (step_.settings_.as_read) step_.settings_.as_read(frame_);
    sources_ = read_sources(planned);
    std::vector<std::string> notes = frame_.assumed;
    add_new(notes, sources_.notes);
    const bool keeps_margin = step_.settings_.writing.out.keeps_margin;
    add_new(notes, notes_on_margin(frame_, keeps_margin, keeps_margin));
    const std::optional<Radius> radius = settle(planned, frame_, notes);
    step_.notes_.add(turn.frame, notes);
    if (turn.index == 0) add_warnings(radius, planned.plan, frame_, step_.events_);
    plan_ = std::move(planned.plan);
    planned_.reset();  // closes the files
    if (Device* device = step_.ready_device_) uploads_ = upload(plan_, frame_, *device);
  }

  void compute() override {
    const RunSettings& settings = step_.settings_;
    RunOptions options = settings.options;
    bool goes_on = false;
    if (settings.request.temporal) {
      goes_on = take_over();
      options.seed = seed_in_sequence(options.seed, turn.frame.number);
    }
    options.uploads = std::move(uploads_);
    result_ = run(plan_, frame_, *step_.device_, options).frame;
    options.uploads.reset();  // before the frame goes
    if (goes_on) {
      const std::string who =
          fmt::format("frame {}: shows next to nothing that the frame before showed", turn.frame.number);
      for (const std::string& note : warning_about_history(frame_, result_, who)) step_.events_.note(note);
    }
    if (settings.request.temporal) {
      step_.history_.chain.leave_for_next(frame_, result_, step_.written_, fmt::format("frame {}", turn.frame.number));
      step_.history_.has_left(turn);
    }
    carry_over(frame_, result_, settings.carried);
    result_.attributes = provenance({{&plan_}}, options);
    result_.attributes.merge(attributes_of(making));
    frame_ = {};
  }

  void write() override {
    const FrameOutputs outputs = step_.settings_.outputs.of(turn.frame.number);
    step_.notes_.add(turn.frame, write_outputs(outputs, sources_, result_, step_.settings_.writing));
  }

 private:
  /// Adds what the frame before knew, or nothing where a sequence begins. Returns whether it goes on.
  bool take_over() {
    const int number = turn.frame.number;
    if (step_.history_.follow(turn, plan_.inputs, making) && !step_.is_gap_noted_) {
      step_.events_.note(
          fmt::format("frame {}: its motion leads to frame {}, which is not computed; accumulation begins anew there, "
                      "and at all frames like it",
                      number, number - 1));
      step_.is_gap_noted_ = true;
    }
    return step_.history_.chain.take_over(frame_, plan_.inputs);
  }

  RunStep& step_;
  std::optional<PlannedFrame> planned_;  ///< until it is decoded
  Plan plan_;
  Frame frame_, result_;              ///< as decoded; what is written
  std::shared_ptr<Uploads> uploads_;  ///< of the frame
  OutputSources sources_;
};

RunStep::RunStep(const SequenceFiles& shot, const RunSettings& settings, PlannedFrame first, ShotEvents& events)
    : shot_(shot),
      settings_(settings),
      events_(events),
      first_(std::move(first)),
      written_(first_.request.only_outputs),
      notes_(shot, events) {
  if (settings_.request.temporal) {
    first_.request.only_outputs = with_planes_for_history(written_, first_.plan.technique);
    plan_again(first_, settings_.carried.depth);
  }
  settings_.request = first_.request;
}

ShotMemory RunStep::memory(const MemoryLimit& limit, const std::string& ways_out) const {
  const unsigned long long beside =
      process_bytes_with_device + bytes_of_history(first_) +
      bytes_beside_frame(first_.plan, layout_of(first_.files), first_.files.views().size(), true);
  return shot_memory(first_.files.name(), bytes_in_flight(first_), beside, limit, ways_out);
}

void RunStep::start(std::function<std::shared_ptr<Device>()> open) {
  starting_ = std::async(std::launch::async, [open = std::move(open), plan = first_.plan, options = settings_.options,
                                              layout = layout_of(first_.files), views = first_.files.views().size()] {
    std::shared_ptr<Device> device = open();
    check(plan, layout, views, *device, options);
    prepare(plan, *device, options);
    return device;
  });
}

std::vector<ShotOutput> RunStep::outputs() const {
  const ShotOutputs& named = settings_.outputs;
  std::vector<ShotOutput> outputs;
  if (named.out) outputs.push_back({*named.out, ""});
  if (named.into) outputs.push_back({*named.into, settings_.writing.copied.front()});
  if (named.composite) outputs.push_back({*named.composite, ""});
  return outputs;
}

std::string RunStep::settings_of(const SequenceFrame& /*frame*/, const FrameFiles& /*files*/) {
  return settings_.contents;
}

std::unique_ptr<FrameWork> RunStep::begin(const FrameTurn& turn, FrameFiles files) {
  PlannedFrame planned = planned_frame(std::move(files), settings_.request, settings_.carried.depth);
  if (turn.is_written && settings_.outputs.has_composite())
    planned.colour.emplace(open_colour(shot_.paths_of(turn.frame), shot_.options_for(turn.frame)));
  return std::make_unique<Work>(*this, std::move(planned));
}

}  // namespace gloam
