#include "gloam/unfit.h"

#include <algorithm>
#include <optional>

#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

const std::string verdict = " is unfit: ";
const std::string remedy = "; gloam auto does without";

/// A note in parts: "pair_L.exr: roughness is unfit: WHY" is said, and then comes what is done about it.
struct Verdict {
  Unfit unfit;
  std::string said;
};

std::optional<Verdict> verdict_in(const std::string& note) {
  const size_t at = note.find(verdict), end = note.rfind(remedy);
  if (at == std::string::npos || at == 0 || end == std::string::npos) return {};
  const size_t why = at + verdict.size();
  if (end < why) return {};
  // Of two files, a note on one begins with the file's name.
  const size_t space = note.rfind(' ', at - 1), first = space == std::string::npos ? 0 : space + 1;
  return Verdict{{note.substr(first, at - first), note.substr(why, end - why)}, note.substr(0, end)};
}

bool has(const std::vector<Unfit>& unfit, const std::string& plane) {
  return std::any_of(unfit.begin(), unfit.end(), [&](const Unfit& each) { return each.plane == plane; });
}

}  // namespace

std::string note_on(const Unfit& unfit) {
  return fmt::format("{}{}{}{} ({} has it taken)", unfit.plane, verdict, unfit.why, remedy,
                     channels_option(unfit.plane, "CHANNELS"));
}

std::string note_in_shot(const std::string& note, const std::vector<Unfit>& left_out, int decider) {
  const std::optional<Verdict> found = verdict_in(note);
  if (!found) return note;
  const std::string& plane = found->unfit.plane;
  if (has(left_out, plane))
    return fmt::format("{}{} in all frames, as frame {} decides ({} has it taken)", found->said, remedy, decider,
                       channels_option(plane, "CHANNELS"));
  return fmt::format("{}; it is taken all the same, as frame {} decides for all frames ({} leaves it out)", found->said,
                     decider, channels_option(plane, "none"));
}

std::vector<Unfit> unfit_planes(const std::vector<std::string>& notes) {
  std::vector<Unfit> found;
  for (const std::string& note : notes) {
    const std::optional<Verdict> told = verdict_in(note);
    if (told && !has(found, told->unfit.plane)) found.push_back(told->unfit);
  }
  return found;
}

std::vector<std::string> fit_planes(std::vector<std::string> planes, const std::vector<Unfit>& unfit) {
  std::erase_if(planes, [&](const std::string& plane) { return has(unfit, plane); });
  return planes;
}

}  // namespace gloam
