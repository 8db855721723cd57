#include "cli/compare/inputs.h"

#include "cli/shot/shot.h"
#include "gloam/error.h"

namespace gloam::cli {

void CompareFlags::take_plane_names() {
  std::vector<std::string>& planes = frame_flags.planes;
  for (auto it = planes.begin(); it != planes.end();) {
    if (it->empty() || it->find('=') != std::string::npos) {
      ++it;
      continue;
    }
    if (!plane.empty() && plane != *it)
      throw UsageError("--plane {}: one plane is compared, and {} is named already; leave one of the two out", *it,
                       plane);
    plane = *it;
    it = planes.erase(it);
  }
}

comparison::ComparedShot open_shot(const CompareFlags& flags, const FrameChoice& choice,
                                   const std::string& differences) {
  std::vector<std::string> notes;
  comparison::ComparedShot compared(flags, flags.frame_flags.read_options(), choice, notes);
  note(notes);
  const std::vector<NamedPath> others = {{"-o", flags.picture}, {"--json", flags.json.file()}};
  std::vector<NamedPath> inputs;  // the others are frames, of which the shot has told
  for (const std::string& file : compared.files_of_all_frames()) inputs.emplace_back("a file that is compared", file);
  check_paths(inputs, others);
  if (differences.empty()) return compared;
  if (!FramePattern::is_pattern(differences))
    throw UsageError("--differences {}: has no place for the frame's number; write one, such as differences.####.png",
                     differences);
  check_outputs({{"--differences", FramePattern(differences, "--differences")}}, compared.shot(), others);
  return compared;
}

}  // namespace gloam::cli
