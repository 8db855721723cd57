#include "gloam/frame_pattern.h"

#include <algorithm>
#include <charconv>
#include <regex>

#include "gloam/error.h"
#include "gloam/frame_numbers.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

constexpr size_t most_digits = 9;

/// Places for a number: ####, %d and %04d.
const std::regex& places() {
  static const std::regex pattern("#+|%(?:0([1-9]))?d");
  return pattern;
}

std::vector<std::smatch> places_in(const std::string& text) {
  return {std::sregex_iterator(text.begin(), text.end(), places()), std::sregex_iterator()};
}

}  // namespace

bool FramePattern::is_pattern(const std::string& path) {
  if (!std::regex_search(path, places())) return false;
  std::error_code unknown;
  return !fs::exists(path, unknown);
}

FramePattern::FramePattern(const std::string& path, const std::string& flag) : text_(path) {
  const std::string name = fs::path(path).filename().string();
  if (places_in(path).size() != places_in(name).size())
    throw UsageError("{} {}: the frame's number has its place in the name of the file, not of a folder", flag, path);
  const std::vector<std::smatch> found = places_in(name);
  if (found.size() != 1)
    throw UsageError("{} {}: has {} for the frame's number; write one, such as shot.####.exr", flag, path,
                     found.empty() ? "no place" : "several places");
  before_ = found.front().prefix();
  after_ = found.front().suffix();
  const std::string place = found.front().str();
  if (place.size() > most_digits)
    throw UsageError("{} {}: numbers of frames have {} digits at most; write fewer #", flag, path, most_digits);
  digits_ = place.front() == '#' ? int(place.size()) : found.front()[1].matched ? found.front().str(1)[0] - '0' : 1;
}

fs::path FramePattern::folder() const {
  const fs::path parent = fs::path(text_).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

std::string FramePattern::normal_name() const { return before_ + std::string(size_t(digits_), '#') + after_; }

fs::path FramePattern::path_of(int frame) const {
  return fs::path(text_).parent_path() / fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::optional<int> FramePattern::frame_of(const std::string& name) const {
  if (name.size() <= before_.size() + after_.size() || !name.starts_with(before_) || !name.ends_with(after_)) return {};
  const std::string number = name.substr(before_.size(), name.size() - before_.size() - after_.size());
  if (number.find_first_not_of("0123456789") != std::string::npos || number.size() > most_digits) return {};
  int frame = 0;
  std::from_chars(number.data(), number.data() + number.size(), frame);
  // Numbers filled up to another width belong to another sequence.
  return path_of(frame).filename().string() == name ? std::optional(frame) : std::nullopt;
}

std::vector<int> FramePattern::frames_there() const {
  std::vector<int> frames;
  std::error_code failed;
  for (fs::directory_iterator entry(folder(), failed), end; !failed && entry != end; entry.increment(failed)) {
    if (const std::optional<int> frame = frame_of(entry->path().filename().string())) frames.push_back(*frame);
  }
  if (failed) throw Error("{}: cannot read the folder '{}': {}", text_, folder().string(), failed.message());
  std::sort(frames.begin(), frames.end());
  return frames;
}

}  // namespace gloam
