#include "measure/sequence.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "base/statistics.h"
#include "gloam/error.h"
#include "gloam/history.h"
#include "gloam/metrics.h"
#include "gloam/option.h"
#include "measure/similarity.h"
#include "sequence/history_chain.h"

namespace gloam::bench {
namespace {

/// A setting on its way through the frames.
struct Walker {
  SequenceRow row;
  Plan plan;
  HistoryChain history;
  std::vector<FlickerMeter> meters;  ///< of each view
};

/// So many settings share one run of HBAO+ per frame, so that the two times of a ratio are close together.
constexpr size_t walkers_together = 4;

void remove_history(Frame& frame) {
  for (View& view : frame.views) {
    for (const std::string& plane : history_planes()) view.planes.erase(plane);
    view.camera_before.reset();
  }
}

/// Settings on the frames of a sequence, a few at a time.
class Walk {
 public:
  Walk(MeasuredSequence& sequence, const MeasureOptions& options, Device& device)
      : sequence_(sequence), options_(options), device_(device), available_(planes_of(sequence.frames.front().frame)) {
    try {
      const Variation baseline{&find_technique("hbao+"), "medium", sequence.radius.value};
      reference_ = whole_plan(baseline, available_, sequence.holds);
    } catch (const MissingPlanes&) {
    }
  }

  SequenceMeasurement measured() {
    std::vector<Walker> walkers;
    for (const Technique* technique : options_.techniques) {
      for (const std::string& preset : presets_of(*technique, options_)) enter(*technique, preset, walkers);
    }
    for (size_t first = 0; first < walkers.size(); first += walkers_together) {
      done_ = double(first) / double(walkers.size());
      const size_t last = std::min(first + walkers_together, walkers.size());
      share_ = double(last - first) / double(walkers.size());
      walk(std::vector<Walker>(std::make_move_iterator(walkers.begin() + std::ptrdiff_t(first)),
                               std::make_move_iterator(walkers.begin() + std::ptrdiff_t(last))));
    }
    return std::move(result_);
  }

 private:
  void skip(const Variation& v, const std::string& why) {
    const Skipped skipped{v.technique->name, v.name(), sequence_.name, v.temporal ? "over time: " + why : why};
    result_.skipped.push_back(skipped);
  }

  void enter(const Technique& technique, const std::string& preset, std::vector<Walker>& walkers) {
    for (const bool temporal : {false, true}) {
      Variation v{&technique, preset, sequence_.radius.value};
      v.temporal = temporal;
      if (temporal) v.variant = "temporal";
      if (temporal && !can_accumulate(technique)) continue;
      try {
        Walker walker;
        walker.plan = whole_plan(v, available_, sequence_.holds);
        walker.row.variation = v;
        warm_up(walker);
        walkers.push_back(std::move(walker));
      } catch (const Error& error) {
        skip(v, error.what());
        return;  // over time it would fail alike
      }
    }
  }

  /// Compiles, and tells what the device refuses.
  void warm_up(Walker& walker) {
    tell("compiling " + walker.row.variation.technique->name, 0);
    Frame& frame = sequence_.frames.front().frame;
    if (walker.row.variation.temporal) add_no_history(frame, walker.plan.inputs);
    try {
      gloam::run(walker.plan, frame, device_);
    } catch (...) {
      remove_history(frame);
      throw;
    }
    remove_history(frame);
  }

  void walk(std::vector<Walker> walkers) {
    Series reference;
    for (MeasuredFrame& at : sequence_.frames) {
      tell("all frames", share_ * double(&at - sequence_.frames.data()) / double(sequence_.frames.size()));
      for (Walker& walker : walkers) step(walker, at);
      if (reference_) reference.push_back(gloam::run(*reference_, at.frame, device_).total_ms.front());
    }
    for (Walker& walker : walkers) finish(walker, reference);
  }

  bool follows(const MeasuredFrame& at) const {
    return &at != sequence_.frames.data() && (&at - 1)->number + 1 == at.number;
  }

  void step(Walker& walker, MeasuredFrame& at) {
    RunOptions options = walker.row.variation.run_options();
    const bool temporal = walker.row.variation.temporal;
    if (temporal) {
      // motion leads to the frame of the number before
      if (!follows(at)) walker.history.begin_anew();
      walker.history.take_over(at.frame, walker.plan.inputs);
      options.seed = seed_in_sequence(options.seed, at.number);
    }
    RunResult run = gloam::run(walker.plan, at.frame, device_, options);
    if (temporal) {
      walker.history.leave_for_next(at.frame, run.frame, {"ao"}, fmt::format("frame {}", at.number));
      remove_history(at.frame);
    }
    walker.row.ms.push_back(run.total_ms.front());
    judge(walker, at, image_of(std::move(run.frame), "ao"));
  }

  void judge(Walker& walker, const MeasuredFrame& at, Image image) {
    SequenceRow& row = walker.row;
    const double error = rmse(image, at.truth, at.foreground);
    row.rmse += error;
    row.bias += bias(image, at.truth, at.foreground);
    if (error > row.worst_rmse || row.worst_frame == 0) row.worst_rmse = error, row.worst_frame = at.number;
    double ssim = 0, flip = 0;
    size_t views = 0;
    for (const View& view : at.frame.views) {
      const auto test = image.find(view.name);
      const auto truth = at.truth.find(view.name);
      if (test == image.end() || truth == at.truth.end()) continue;
      const Mask& mask = at.foreground.at(view.name);
      const Metrics metrics = metrics_of(test->second, truth->second, mask);
      ssim += metrics.ssim;
      flip += metrics.flip.value_or(0);
      if (walker.meters.size() <= views) walker.meters.emplace_back();
      FlickerMeter& meter = walker.meters[views++];
      if (!follows(at)) meter.begin_anew();
      const auto pair =
          meter.add({std::move(test->second), truth->second.clone(), mask, surfaces_of_view(at.frame, view)});
      if (!pair) continue;
      row.flicker += *pair;
      add_new(result_.motions, in_words(*meter.source()));
    }
    row.ssim += ssim / double(std::max<size_t>(views, 1));
    row.flip = row.flip.value_or(0) + flip / double(std::max<size_t>(views, 1));
  }

  void finish(Walker& walker, const Series& reference) {
    SequenceRow& row = walker.row;
    const double frames = double(sequence_.frames.size());
    row.rmse /= frames;
    row.bias /= frames;
    row.ssim /= frames;
    if (row.flip) *row.flip /= frames;
    // Of one view alone the time of HBAO+ on all is no measure.
    if (!reference.empty() && !makes_first_view_only(*row.variation.technique)) row.ratio = ratio(row.ms, reference);
    if (!result_.truth_change) {
      result_.truth_change = row.flicker.truth_change();
      result_.comparable = row.flicker.share();
    }
    result_.rows.push_back(std::move(row));
  }

  void tell(const std::string& what, double share) const {
    if (options_.progress) options_.progress(fmt::format("{}: {}", sequence_.name, what), done_ + share);
  }

  MeasuredSequence& sequence_;
  const MeasureOptions& options_;
  Device& device_;
  std::vector<std::string> available_;
  std::optional<Plan> reference_;
  SequenceMeasurement result_;
  double done_ = 0, share_ = 0;
};

}  // namespace

Surfaces surfaces_of_view(const Frame& frame, const View& view) {
  Surfaces surfaces{.window = frame.window, .camera = view.camera};
  if (const Plane* depth = view.find("depth")) surfaces.depth = depth->channels[0].clone();
  if (const Plane* motion = view.find("motion")) surfaces.motion = motion->clone();
  return surfaces;
}

void add_frame(MeasuredSequence& sequence, int number, Subject subject) {
  if (!subject.truth)
    throw Error("frame {}: {} has no truth to measure against; {} names one for each frame", number, subject.name,
                option("truth", "'truth.####.exr'"));
  if (sequence.frames.empty()) {
    sequence.holds = subject.holds;
    sequence.radius = subject.radius;
  } else {
    const Frame& first = sequence.frames.front().frame;
    if (subject.frame.width() != first.width() || subject.frame.height() != first.height())
      throw Error("frame {} is {}x{}, and the first frame {}x{}; measure frames of one size, chosen by {}", number,
                  subject.frame.width(), subject.frame.height(), first.width(), first.height(), option("frames"));
  }
  MeasuredFrame& frame = sequence.frames.emplace_back();
  frame.number = number;
  for (const auto& [view, plane] : subject.truth->image) frame.truth.emplace(view, plane.clone());
  frame.frame = std::move(subject.frame);
  frame.foreground = foreground(frame.frame);
  if (const auto rays = subject.truth->rays) sequence.truth_rays = std::min(*rays, sequence.truth_rays.value_or(*rays));
  if (const auto noise = subject.truth->noise)
    sequence.truth_noise = std::max(*noise, sequence.truth_noise.value_or(0));
  if (!subject.truths) return;
  for (const std::string& file : subject.truths->made()) add_new(sequence.made, file);
  for (const std::string& file : subject.truths->reused()) add_new(sequence.reused, file);
}

SequenceMeasurement measure_sequence(MeasuredSequence& sequence, const MeasureOptions& options, Device& device) {
  return Walk(sequence, options, device).measured();
}

}  // namespace gloam::bench
