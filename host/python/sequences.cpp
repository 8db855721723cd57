// gloam.Sequence: the frames of a sequence, and runs over them.
#include <algorithm>
#include <mutex>

#include "base/lists.h"
#include "gloam/frame_numbers.h"
#include "python/devices.h"
#include "python/files.h"
#include "python/frames.h"
#include "python/outcome.h"
#include "python/requests.h"
#include "shot/history.h"
#include "shot/shot.h"

namespace gloam::python {
namespace {

/// A sequence as it was found when it was opened.
struct HeldSequence {
  HeldSequence(std::vector<FramePattern> patterns, const ReadOptions& options, const FrameChoice& choice)
      : files(std::move(patterns), options, choice, notes) {}
  std::vector<std::string> notes;
  SequenceFiles files;

  const SequenceFrame& frame_of(int number) const {
    for (const SequenceFrame& frame : files.frames()) {
      if (frame.number == number) return frame;
    }
    throw Error("{}: no frame {}; there are {}", files.name(), number, frames_in_words(files.numbers()));
  }
};
using SharedSequence = std::shared_ptr<HeldSequence>;

SharedSequence open_sequence(const std::vector<std::string>& paths, const py::object& frames, const py::object& missing,
                             const py::dict& words) {
  std::vector<FramePattern> patterns;
  for (const std::string& path : paths) patterns.emplace_back(path, "Sequence");
  FrameChoice choice;
  if (!frames.is_none()) choice.frames = parse_frame_numbers(py::cast<std::string>(frames), "frames");
  if (!missing.is_none()) choice.missing = value_of(py::cast<std::string>(missing), "missing", missing_words);
  const ReadOptions options = read_options(words);
  return without_lock(
      [&](Interrupts&) { return std::make_shared<HeldSequence>(std::move(patterns), options, choice); });
}

SharedFrame read_number(const HeldSequence& sequence, int number, const py::dict& words,
                        const std::vector<std::string>& planes) {
  const std::optional<Camera> camera = given_camera(words);
  return without_lock([&](Interrupts&) {
    FrameFiles files = sequence.files.open(sequence.frame_of(number));
    return read_frame(files, planes.empty() ? files.common_planes() : planes, camera);
  });
}

/// What a run over a sequence does with each frame: the outcome is handed to Python.
class OutcomeStep : public FrameStep {
 public:
  class Work;
  OutcomeStep(std::optional<Camera> camera, PlanRequest request, const RunOptions& options,
              std::shared_ptr<Device> device)
      : camera_(std::move(camera)), request_(std::move(request)), options_(options), device_(std::move(device)) {
    if (!request_.temporal || request_.only_outputs.empty()) return;
    written_ = request_.only_outputs;
    request_.only_outputs = with_planes_for_history(written_, request_.outputs.front());
  }

  bool goes_on() const { return request_.temporal; }
  std::unique_ptr<FrameWork> begin(const FrameTurn& turn, FrameFiles files) override;

  Interrupts* interrupts = nullptr;  ///< of the call at work

 private:
  const std::optional<Camera> camera_;
  PlanRequest request_;
  const RunOptions options_;
  const std::shared_ptr<Device> device_;
  std::vector<std::string> written_;
  ShotHistory history_;
};

class OutcomeStep::Work : public FrameWork {
 public:
  Work(OutcomeStep& step, FrameFiles files) : step_(step), files_(std::move(files)) {}

  void decode() override {
    if (step_.request_.temporal) files_.expect_history();
    held_ = read_planned(files_, step_.request_, step_.camera_);
  }

  void compute() override {
    step_.interrupts->poll();
    const int number = turn.frame.number;
    RunOptions options = step_.options_;
    ShotHistory& history = step_.history_;
    if (!step_.request_.temporal) {
      outcome = compute_outcome(step_.request_, held_, true, *step_.device_, options, *step_.interrupts);
    } else {
      const bool leads_elsewhere = history.follow(turn, common_planes(held_->frame), making);
      Chained chained{history.chain, step_.written_, fmt::format("frame {}", number)};
      options.seed = seed_in_sequence(options.seed, number);
      outcome = compute_outcome(step_.request_, held_, true, *step_.device_, options, *step_.interrupts, &chained);
      history.has_left(turn);
      if (leads_elsewhere)
        outcome.notes.push_back(
            fmt::format("frame {}: its motion leads to frame {}, which is not computed; accumulation begins anew there",
                        number, number - 1));
    }
    outcome.number = number;
  }

  Outcome outcome;

 private:
  OutcomeStep& step_;
  FrameFiles files_;
  SharedFrame held_;
};

std::unique_ptr<FrameWork> OutcomeStep::begin(const FrameTurn& /*turn*/, FrameFiles files) {
  return std::make_unique<Work>(*this, std::move(files));
}

/// A run over a sequence, frame by frame.
class SequenceRun {
 public:
  SequenceRun(SharedSequence sequence, std::optional<Camera> camera, PlanRequest request, const RunOptions& options,
              std::shared_ptr<Device> device)
      : sequence_(std::move(sequence)),
        step_(std::move(camera), std::move(request), options, std::move(device)),
        run_(sequence_->files, step_, {.goes_on = step_.goes_on()}, events_) {}

  /// None after the last frame; whoever catches the error of a frame may go on with the next one. Threads may share a run: each gets a frame
  /// of its own.
  std::optional<Outcome> next() {
    return without_lock([&](Interrupts& interrupts) -> std::optional<Outcome> {
      const std::lock_guard alone(busy_);  // taken without the interpreter's lock, which whoever holds it may need
      step_.interrupts = &interrupts;
      const std::unique_ptr<FrameWork> work = run_.next();
      if (!work) return {};
      return std::move(static_cast<OutcomeStep::Work&>(*work).outcome);
    });
  }

  size_t frames() const { return sequence_->files.frames().size(); }

 private:
  const SharedSequence sequence_;
  ShotEvents events_;  // an outcome has its notes
  std::mutex busy_;    ///< held while a frame is computed
  OutcomeStep step_;
  ShotRun run_;
};

std::unique_ptr<SequenceRun> run_over(const SharedSequence& sequence, const py::dict& words,
                                      const py::dict& request_words, bool temporal,
                                      const std::shared_ptr<Device>& device, const py::dict& option_words) {
  PlanRequest request = plan_request(request_words);
  request.temporal = temporal || accumulates_by_itself(find_technique(request.outputs.front()));
  if (request.temporal) check_temporal(request);
  return std::make_unique<SequenceRun>(sequence, given_camera(words), std::move(request), run_options(option_words),
                                       device);
}

/// What is told of frames that are written.
class KeptEvents : public ShotEvents {
 public:
  void note(const std::string& sentence) override {
    const std::lock_guard lock(mutex_);
    add_new(notes, {sentence});
  }
  void written_again(int frame, const std::string& why) override { again[frame] = why; }
  void failed(int frame, const std::string& why, bool /*lacks_space*/) override { failures[frame] = why; }

  std::vector<std::string> notes;
  std::map<int, std::string> again, failures;

 private:
  std::mutex mutex_;
};

/// Numbers of the frames that were written, those left alone, reasons by number of those that failed and of those written again, notes.
py::tuple write_over(const SharedSequence& sequence, const py::dict& words, const py::dict& request_words,
                     const py::dict& option_words, const std::shared_ptr<Device>& device, const std::string& path,
                     const py::dict& writing) {
  ShotRequest request{.output = path,
                      .reading = read_options(words),
                      .computing = plan_request(request_words),
                      .options = run_options(option_words),
                      .writing = {.half = py::cast<bool>(writing["half"]),
                                  .compression = py::cast<std::string>(writing["compression"]),
                                  .half_planes = {},
                                  .shows_result = true,
                                  .keeps_margin = py::cast<bool>(writing["keep_margin"])},
                      .keeps_depth = py::cast<bool>(writing["keep_depth"]),
                      .resumes = py::cast<bool>(writing["resume"])};
  request.computing.temporal = py::cast<bool>(writing["temporal"]);
  const std::optional<Camera> camera = given_camera(words);
  KeptEvents events;
  ShotSummary summary = without_lock([&](Interrupts& interrupts) {
    bool is_interrupted = false;
    request.options.progress = [&](int, int) {
      if (is_interrupted) throw Interrupted();  // nor are the frames computed that were begun
      is_interrupted = true;
      interrupts.poll();
      is_interrupted = false;
    };
    return run_shot(
        sequence->files, request, [&] { return device; }, events, [&](Frame& frame) { take_camera(camera, frame); });
  });
  std::sort(summary.done.begin(), summary.done.end());
  std::sort(summary.skipped.begin(), summary.skipped.end());
  const auto by_number = [](const std::map<int, std::string>& reasons) {
    py::dict dict;
    for (const auto& [number, why] : reasons) dict[py::int_(number)] = text_of(why);
    return dict;
  };
  return py::make_tuple(summary.done, summary.skipped, by_number(events.failures), by_number(events.again),
                        texts_of(events.notes), summary.is_disk_full);
}

}  // namespace

void add_sequences(py::module_& module) {
  py::class_<HeldSequence, SharedSequence>(module, "HeldSequence")
      .def_property_readonly("numbers", [](const HeldSequence& self) { return self.files.numbers(); })
      .def_property_readonly("name", [](const HeldSequence& self) { return text_of(self.files.name()); })
      .def_property_readonly("notes", [](const HeldSequence& self) { return texts_of(self.notes); })
      .def("read", &read_number)
      .def("__repr__", [](const HeldSequence& self) {
        return fmt::format("<gloam.Sequence '{}', frames {}>", printable(self.files.name()),
                           frames_in_words(self.files.numbers()));
      });
  py::class_<SequenceRun>(module, "SequenceRun").def("next", &SequenceRun::next).def("__len__", &SequenceRun::frames);
  module.def("open_sequence", &open_sequence);
  module.def("run_over", &run_over);
  module.def("write_over", &write_over);
  module.def("frames_in_words", [](const std::vector<int>& frames) { return frames_in_words(frames); });
}

}  // namespace gloam::python
