// gloam.Sequence: the frames of a sequence, and runs over them.
#include <future>
#include <mutex>

#include "base/lists.h"
#include "gloam/frame_numbers.h"
#include "python/devices.h"
#include "python/files.h"
#include "python/frames.h"
#include "python/outcome.h"
#include "python/requests.h"
#include "sequence/sequence_files.h"
#include "sequence/turns.h"

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

/// A run over a sequence, frame by frame: `next` decodes the following frame while it computes one.
class SequenceRun {
 public:
  SequenceRun(SharedSequence sequence, std::optional<Camera> camera, PlanRequest request, const RunOptions& options,
              std::shared_ptr<Device> device)
      : sequence_(std::move(sequence)),
        camera_(std::move(camera)),
        request_(std::move(request)),
        options_(options),
        device_(std::move(device)) {
    const std::vector<int> numbers = sequence_->files.numbers();
    if (!request_.temporal) {
      for (size_t i = 0; i < numbers.size(); ++i) turns_.push_back({.frame = i, .begins = true});
    } else {
      turns_ = turns_of(numbers, 0, std::vector<bool>(numbers.size(), false));
      if (!request_.only_outputs.empty()) {
        written_ = request_.only_outputs;
        request_.only_outputs = with_planes_for_history(written_, request_.outputs.front());
      }
    }
  }

  /// None after the last frame. Threads may share a run: each gets a frame of its own.
  std::optional<Outcome> next() {
    return without_lock([&](Interrupts& interrupts) -> std::optional<Outcome> {
      const std::lock_guard alone(busy_);  // taken without the interpreter's lock, which whoever holds it may need
      while (turn_ < turns_.size()) {
        const size_t turn = turn_++;  // whoever catches the error of a frame may go on with the next one
        Outcome outcome = compute(turn, interrupts);
        if (turns_[turn].is_written) return outcome;
      }
      return {};
    });
  }

  size_t frames() const { return sequence_->files.frames().size(); }

 private:
  const SequenceFrame& frame_at(size_t turn) const { return sequence_->files.frames()[turns_[turn].frame]; }

  std::future<SharedFrame> begin_decoding(size_t turn) const {
    return std::async(std::launch::async, [this, turn] {
      FrameFiles files = sequence_->files.open(frame_at(turn));
      if (request_.temporal) files.expect_history();
      return read_planned(files, request_, camera_);
    });
  }

  Outcome compute(size_t turn, Interrupts& interrupts) {
    std::future<SharedFrame> decoding = decoding_.valid() ? std::move(decoding_) : begin_decoding(turn);
    if (turn + 1 < turns_.size()) decoding_ = begin_decoding(turn + 1);
    try {
      const SharedFrame held = decoding.get();
      interrupts.poll();
      Outcome outcome = request_.temporal ? compute_chained(turn, held, interrupts)
                                          : compute_outcome(request_, held, true, *device_, options_, interrupts);
      outcome.number = frame_at(turn).number;
      return outcome;
    } catch (...) {
      history_.begin_anew();
      throw;
    }
  }

  Outcome compute_chained(size_t turn, const SharedFrame& held, Interrupts& interrupts) {
    const int number = frame_at(turn).number;
    if (turns_[turn].begins) history_.begin_anew();
    std::string note;
    if (history_.holds_any() && motion_leads_elsewhere(common_planes(held->frame), number_before_, number)) {
      note =
          fmt::format("frame {}: its motion leads to frame {}, which is not computed; accumulation begins anew there",
                      number, number - 1);
      history_.begin_anew();
    }
    Chained chained{history_, written_, fmt::format("frame {}", number)};
    RunOptions options = options_;
    options.seed = seed_in_sequence(options.seed, number);
    Outcome outcome = compute_outcome(request_, held, true, *device_, options, interrupts, &chained);
    if (!note.empty()) outcome.notes.push_back(note);
    number_before_ = number;
    return outcome;
  }

  const SharedSequence sequence_;
  const std::optional<Camera> camera_;
  PlanRequest request_;
  const RunOptions options_;
  const std::shared_ptr<Device> device_;
  std::mutex busy_;  ///< held while a frame is computed
  std::vector<std::string> written_;
  std::vector<Turn> turns_;
  size_t turn_ = 0;
  int number_before_ = 0;
  HistoryChain history_;
  std::future<SharedFrame> decoding_;  ///< last: it ends before what it reads
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
}

}  // namespace gloam::python
