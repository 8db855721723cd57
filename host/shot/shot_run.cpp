#include "shot/shot_run.h"

#include <cctype>
#include <new>

#include "base/elapsed.h"
#include "base/files.h"
#include "base/memory.h"
#include "base/page_pool.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "shot/history.h"

namespace gloam {
namespace {

/// So many frames in a row that lack space on the disk end a shot.
constexpr size_t most_without_space = 3;

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

std::string without_numbers(const std::string& text) {
  std::string words;
  for (const char c : text)
    if (!std::isdigit(static_cast<unsigned char>(c))) words += c;
  return words;
}

void check_size(const FrameFiles& files, const Window& first) {
  const Window display = files.files().front().display();
  if (display.width() != first.width() || display.height() != first.height())
    throw Error("{}: is {}x{}, and the shot's first frame {}x{}; render all alike", files.name(), display.width(),
                display.height(), first.width(), first.height());
}

}  // namespace

ShotRun::ShotRun(const SequenceFiles& files, FrameStep& step, const ShotSettings& settings, ShotEvents& events)
    : files_(files), step_(step), settings_(settings), events_(events), outputs_(step.outputs()) {
  std::vector<int> numbers = files.numbers();
  numbers.erase(numbers.begin(), numbers.begin() + std::ptrdiff_t(settings.warm_up));
  for (const ShotOutput& output : outputs_) {
    locks_.emplace_back(output.pattern, numbers);
    remove_leftovers(output.pattern.folder());
  }
  turns_ = turns();
  flights_.resize(turns_.size());
}

FrameTurn ShotRun::turn_at(size_t i) const {
  const std::vector<SequenceFrame>& frames = files_.frames();
  const Turn& turn = turns_[i];
  return {i, frames[turn.frame], i > 0 ? frames[turns_[i - 1].frame].number : 0, turn.begins, turn.is_written};
}

FrameMaking ShotRun::making_of(const SequenceFrame& frame, const FrameFiles& files) {
  return {settings_.version, step_.settings_of(frame, files), identity_of(files)};
}

/// Why a frame is written, told of those whose file is there; empty if it is left alone.
std::string ShotRun::why_again(int frame, const FrameMaking& making) {
  for (const ShotOutput& output : outputs_) {
    const std::filesystem::path path = output.pattern.path_of(frame);
    const std::string why = gloam::why_again(path, making, output.added);
    if (why.empty()) continue;
    const std::lock_guard lock(telling_);
    if (std::filesystem::exists(path)) events_.written_again(frame, why);
    return why;
  }
  return "";
}

/// The frames to compute, in order. Of those that go on over time it is known here which are left alone, and told.
std::vector<Turn> ShotRun::turns() {
  const std::vector<int> numbers = files_.numbers();
  std::vector<Turn> turns;
  if (!settings_.goes_on) {
    for (size_t i = 0; i < numbers.size(); ++i) turns.push_back({.frame = i, .begins = true});
    return turns;
  }
  std::vector<bool> is_whole(numbers.size(), false);
  turns = turns_of(numbers, settings_.warm_up, is_whole);
  if (!settings_.resumes) return turns;
  std::string history;
  for (const Turn& turn : turns) {
    const SequenceFrame& frame = files_.frames()[turn.frame];
    if (turn.begins) history.clear();
    try {
      FrameMaking making = making_of(frame, files_.open(frame));
      history = add_history_to(making, history);
      if (turn.is_written) is_whole[turn.frame] = why_again(frame.number, making).empty();
    } catch (const Error&) {
      // Told when the frame's turn comes. The next one begins anew.
      history.clear();
    }
  }
  turns = turns_of(numbers, settings_.warm_up, is_whole);
  std::vector<bool> is_left(numbers.size(), true);
  for (const Turn& turn : turns)
    if (turn.is_written) is_left[turn.frame] = false;
  for (size_t i = settings_.warm_up; i < numbers.size(); ++i)
    if (is_left[i]) events_.skipped(numbers[i]);
  return turns;
}

/// Null for a frame that is left alone.
std::unique_ptr<FrameWork> ShotRun::begin(size_t i) {
  const FrameTurn turn = turn_at(i);
  FrameFiles files = files_.open(turn.frame);
  FrameMaking making;
  if (!outputs_.empty()) making = making_of(turn.frame, files);
  // Of frames that go on over time, those to leave alone have been left out.
  if (settings_.resumes && !settings_.goes_on && why_again(turn.frame.number, making).empty()) {
    const std::lock_guard lock(telling_);
    events_.skipped(turn.frame.number);
    return nullptr;
  }
  if (settings_.size) check_size(files, *settings_.size);
  const std::string name = files.name();
  std::unique_ptr<FrameWork> work = step_.begin(turn, std::move(files));
  if (settings_.memory.frame > 0 && work->bytes() > settings_.memory.frame)
    throw Error("{}: takes {} of memory, and a frame of this shot has {}; {} gives more", name,
                memory_in_words(work->bytes()), memory_in_words(settings_.memory.frame), option("memory"));
  work->turn = turn;
  work->making = std::move(making);
  return work;
}

void ShotRun::fail(const FrameTurn& turn, const std::string& why, bool lacks_space) {
  const int number = turn.frame.number;
  if (!turn.is_written)
    return events_.note(fmt::format("frame {}: failed, and frames that go on from it begin anew: {}", number, why));
  const std::lock_guard lock(telling_);
  events_.failed(number, why, lacks_space);
  if (!lacks_space || ++without_space_ != most_without_space) return;
  events_.disk_is_full();
  stop_();
}

bool ShotRun::attempt(size_t i, double StepTimes::*time, const std::function<bool(Flight&)>& step) {
  std::string why;
  bool lacks_space = false;
  try {
    const auto start = std::chrono::steady_clock::now();
    const bool goes_on = step(flights_[i]);
    flights_[i].times.*time = 1000 * seconds_since(start);
    if (!goes_on) flights_[i].work.reset();
    return goes_on;
  } catch (const Error& error) {
    why = error.what();
    lacks_space = is_lack_of_space(error);
  } catch (const std::bad_alloc&) {
    why = fmt::format("out of memory; {} sets how much is used", option("memory"));
  } catch (const std::exception& error) {
    why = error.what();
  }
  flights_[i].work.reset();
  fail(turn_at(i), why, lacks_space);
  return false;
}

void ShotRun::run() {
  std::optional<PageReuse> reuse;
  if (settings_.memory.all > process_bytes_with_device) reuse.emplace(settings_.memory.all - process_bytes_with_device);
  const auto decode = [&](size_t i) {
    return attempt(i, &StepTimes::decode, [&](Flight& flight) {
      flight.work = begin(i);
      if (flight.work) flight.work->decode();
      return flight.work != nullptr;
    });
  };
  const auto compute = [&](size_t i) {
    if (!is_ready_) step_.get_ready();
    is_ready_ = true;
    return attempt(i, &StepTimes::compute, [&](Flight& flight) {
      flight.work->compute();
      return turns_[i].is_written;
    });
  };
  const auto write = [&](size_t i) {
    const bool is_written = attempt(i, &StepTimes::write, [](Flight& flight) {
      flight.work->write();
      return true;
    });
    if (!is_written) return false;
    flights_[i].work.reset();
    const std::lock_guard lock(telling_);
    without_space_ = 0;
    events_.done(turn_at(i).frame.number, flights_[i].times);
    return true;
  };
  Pipeline pipeline(turns_.size(), settings_.memory.size, {decode, compute, write});
  stop_ = [&] { pipeline.stop(); };
  pipeline.run();
}

std::future<std::unique_ptr<FrameWork>> ShotRun::begin_decoding(size_t i) {
  return std::async(std::launch::async, [this, i] {
    std::unique_ptr<FrameWork> work = begin(i);
    work->decode();
    return work;
  });
}

std::unique_ptr<FrameWork> ShotRun::next() {
  while (turn_ < turns_.size()) {
    const size_t i = turn_++;
    std::future<std::unique_ptr<FrameWork>> decoding = decoding_.valid() ? std::move(decoding_) : begin_decoding(i);
    if (turn_ < turns_.size()) decoding_ = begin_decoding(turn_);
    std::unique_ptr<FrameWork> work = decoding.get();
    work->compute();
    if (work->turn.is_written) return work;
  }
  return nullptr;
}

void ShotNotes::add(const SequenceFrame& frame, const std::vector<std::string>& notes) {
  for (std::string text : notes) {
    for (const FramePattern& pattern : files_.inputs())
      replace_all(text, pattern.path_of(frame.source).filename().string(), pattern.name());
    const std::lock_guard lock(mutex_);
    if (told_.insert(without_numbers(text)).second) events_.note(text);
  }
}

void first_that_can(const SequenceFiles& shot, const std::function<void(const SequenceFrame&)>& attempt) {
  std::string first_error;
  for (const SequenceFrame& frame : shot.frames()) {
    try {
      return attempt(frame);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  if (shot.frames().size() == 1) throw Error("{}", first_error);
  throw Error("none of the {} frames can be computed; the first: {}", shot.frames().size(), first_error);
}

}  // namespace gloam
