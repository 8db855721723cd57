#include "cli/shot/steps.h"

#include <cctype>

#include "base/elapsed.h"
#include "base/memory.h"
#include "cli/flags/notes.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

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

}  // namespace

bool ShotSteps::run(size_t i, double& ms, const std::function<bool()>& step, bool is_told) {
  const auto timed = [&] {
    const auto start = std::chrono::steady_clock::now();
    const bool goes_on = step();
    ms = 1000 * seconds_since(start);
    return goes_on;
  };
  return report_.attempt(files_.frames()[i].number, timed, stop_, is_told);
}

void ShotSteps::add_notes(size_t i, const std::vector<std::string>& notes) {
  for (std::string text : notes) {
    for (const FramePattern& pattern : files_.inputs())
      replace_all(text, pattern.path_of(files_.frames()[i].source).filename().string(), pattern.name());
    const std::lock_guard lock(mutex_);
    if (told_.insert(without_numbers(text)).second) note({text});
  }
}

void check_size_in_shot(const FrameFiles& files, const Window& first) {
  const Window display = files.files().front().display();
  if (display.width() != first.width() || display.height() != first.height())
    throw Error("{}: is {}x{}, and the shot's first frame {}x{}; render all alike", files.name(), display.width(),
                display.height(), first.width(), first.height());
}

void check_bytes_in_shot(const FrameFiles& files, unsigned long long bytes, unsigned long long most) {
  if (bytes > most)
    throw Error("{}: takes {} of memory, and a frame of this shot has {}; --memory gives more", files.name(),
                memory_in_words(bytes), memory_in_words(most));
}

void first_that_can(const ShotFiles& shot, const std::function<void(const SequenceFrame&)>& attempt) {
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

}  // namespace gloam::cli
