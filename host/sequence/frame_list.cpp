#include "sequence/frame_list.h"

#include <algorithm>
#include <iterator>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/option.h"

namespace gloam {
namespace {

using Numbers = std::vector<int>;

std::string names_of(const std::vector<FramePattern>& files) {
  std::vector<std::string> names;
  for (const FramePattern& pattern : files) names.push_back(pattern.text());
  return enumerate(names);
}

/// Frames of which every file is there, and frames of which one is.
struct Found {
  Numbers whole, any;
};

Found frames_found(const std::vector<FramePattern>& files) {
  Found found{files.front().frames_there(), {}};
  found.any = found.whole;
  for (size_t i = 1; i < files.size(); ++i) {
    const Numbers more = files[i].frames_there();
    Numbers both, either;
    std::set_intersection(found.whole.begin(), found.whole.end(), more.begin(), more.end(), std::back_inserter(both));
    std::set_union(found.any.begin(), found.any.end(), more.begin(), more.end(), std::back_inserter(either));
    found = {both, either};
  }
  return found;
}

Numbers asked_for(const Found& found, const FrameChoice& choice, std::vector<std::string>& notes) {
  if (choice.frames) return *choice.frames;
  Numbers all, between;
  for (int frame = found.any.front(); frame <= found.any.back(); ++frame) {
    (std::binary_search(found.any.begin(), found.any.end(), frame) ? all : between).push_back(frame);
    if (all.size() + between.size() > most_frames)
      throw Error("frames {} to {}: more than {}; {} names fewer", found.any.front(), found.any.back(), most_frames,
                  option("frames"));
  }
  if (choice.missing) {
    all.insert(all.end(), between.begin(), between.end());
    std::sort(all.begin(), all.end());
  } else if (!between.empty()) {
    notes.push_back(
        fmt::format("frames: {} of {}-{} are not there", frames_in_words(between), all.front(), all.back()));
  }
  return all;
}

/// "shot.0007.exr": the first file that a frame lacks.
std::string lacking_file(const std::vector<FramePattern>& files, int frame) {
  for (const FramePattern& pattern : files) {
    std::error_code unknown;
    if (!std::filesystem::exists(pattern.path_of(frame), unknown)) return pattern.path_of(frame).string();
  }
  return files.front().path_of(frame).string();
}

}  // namespace

std::vector<SequenceFrame> list_frames(const std::vector<FramePattern>& files, const FrameChoice& choice,
                                       std::vector<std::string>& notes) {
  const Found found = frames_found(files);
  if (found.any.empty()) throw Error("{}: no file of this pattern is there", names_of(files));
  const Numbers& there = found.whole;
  std::vector<SequenceFrame> frames;
  Numbers missing;
  for (const int frame : asked_for(found, choice, notes)) {
    const auto next = std::upper_bound(there.begin(), there.end(), frame);
    if (next != there.begin() && *std::prev(next) == frame)
      frames.push_back({frame, frame});
    else
      missing.push_back(frame);
    if (missing.empty() || missing.back() != frame || choice.missing != MissingFrames::hold) continue;
    if (next == there.begin())
      throw Error("{}: frame {} is missing, and no frame before it is there to hold", names_of(files), frame);
    frames.push_back({frame, *std::prev(next)});
  }
  const bool is_error = choice.missing.value_or(MissingFrames::error) == MissingFrames::error;
  if (!missing.empty() && is_error)
    throw Error("{} missing ({}); {} leaves {} out{}",
                missing.size() == 1 ? fmt::format("frame {} is", missing.front())
                                    : fmt::format("frames {} are", frames_in_words(missing)),
                lacking_file(files, missing.front()), option("missing", "skip"), missing.size() == 1 ? "it" : "them",
                choice.may_hold ? fmt::format(", {} takes the frame before", option("missing", "hold")) : "");
  if (frames.empty())
    throw Error("{}: none of the frames {} is there, but {} are", names_of(files), frames_in_words(missing),
                frames_in_words(there));
  if (!missing.empty())
    notes.push_back(fmt::format("frames: {} missing: {}", frames_in_words(missing),
                                choice.missing == MissingFrames::skip ? "left out" : "the frame before is held"));
  return frames;
}

}  // namespace gloam
