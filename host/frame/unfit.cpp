#include "frame/unfit.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam {
namespace {

const std::string verdict = " is unfit: ";
const std::string remedy = "; gloam auto does without";

}  // namespace

std::string note_on(const Unfit& unfit) {
  return fmt::format("{}{}{}{} (--plane {}=CHANNELS has it taken)", unfit.plane, verdict, unfit.why, remedy,
                     unfit.plane);
}

std::vector<Unfit> unfit_planes(const std::vector<std::string>& notes) {
  std::vector<Unfit> found;
  for (const std::string& note : notes) {
    const size_t at = note.find(verdict), end = note.rfind(remedy);
    if (at == std::string::npos || end == std::string::npos) continue;
    // Of two files, a note on one begins with the file's name.
    const size_t space = note.rfind(' ', at - 1), first = space == std::string::npos ? 0 : space + 1;
    const size_t why = at + verdict.size();
    const Unfit unfit{note.substr(first, at - first), note.substr(why, end - why)};
    const auto is_known = [&](const Unfit& known) { return known.plane == unfit.plane; };
    if (std::none_of(found.begin(), found.end(), is_known)) found.push_back(unfit);
  }
  return found;
}

std::vector<std::string> fit_planes(std::vector<std::string> planes, const std::vector<Unfit>& unfit) {
  std::erase_if(planes, [&](const std::string& plane) {
    return std::any_of(unfit.begin(), unfit.end(), [&](const Unfit& each) { return each.plane == plane; });
  });
  return planes;
}

}  // namespace gloam
