#include "cli/info/verdict.h"

#include <algorithm>

#include "cli/flags/wrap.h"
#include "cli/list/techniques.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

/// The default technique where it can run, else the first other for ambient occlusion, such as one for light-field displays.
std::string technique_for_ao(const std::vector<std::string>& runs) {
  const std::string usual = technique_for("ao");
  if (contains(runs, usual)) return usual;
  const auto other = std::find_if(runs.begin(), runs.end(), [](const std::string& name) {
    return heading_of(find_technique(name)).starts_with("ambient occlusion");
  });
  return other == runs.end() ? "" : *other;
}

/// "depth and normals"; "depth, of which normals are made".
std::string sources_in_words(const FrameFile& file, const std::string& technique) {
  const Plan plan = make_plan({.outputs = {technique}}, file.common_planes(), holdings(file));
  std::vector<std::string> planes;
  for (const std::string& plane : plan.inputs) add_new(planes, plane == "normal" ? "normals" : plane);
  const bool makes_normals = std::any_of(plan.passes.begin(), plan.passes.end(), [](const PlannedPass& planned) {
    const std::vector<Binding>& writes = planned.pass.writes;
    return std::any_of(writes.begin(), writes.end(), [](const Binding& b) { return b.plane == "normal"; });
  });
  return enumerate(planes) + (makes_normals ? ", of which normals are made" : "");
}

std::string camera_in_words(const std::string& from) {
  if (from == "header") return "by the camera in its header";
  if (from == "json") return "by the camera in the JSON beside it";
  if (from == "fit") return "by a camera fitted to its positions";
  if (from == "matrix") return "by the matrix of its camera";
  if (from == "default") return "by the field of view that its data set has by default";
  if (from == "flag") return "by the camera that was given";
  return "by a camera that is a guess (60 degrees wide)";
}

}  // namespace

std::string verdict_on(const FrameFile& file, const FoundOnFrame& found) {
  const std::string technique = technique_for_ao(found.runs), path = printable(quoted_for_shell(file.path().string()));
  if (technique.empty()) {
    const bool is_there = contains(file.common_planes(), "ao");
    const std::string hint = hint_on_depth(file);
    return fmt::format("Ambient occlusion {}: the file lacks {}{}{}.",
                       is_there ? "is in this file, and cannot be computed anew" : "cannot be computed", found.lacks,
                       hint.empty() ? "" : "; ", printable(hint));
  }
  const std::string radius =
      found.radius ? fmt::format("within a radius of {:.4g} scene units", *found.radius) : "and no surface is visible";
  const std::string word = technique == technique_for("ao") ? "ao" : technique;
  return fmt::format("Ambient occlusion can be computed: from {}, {}, {}: gloam {} {}{}",
                     sources_in_words(file, technique), camera_in_words(found.camera_from), radius, word, path,
                     printable(found.flags));
}

FoundOnShotFrame found_on(int frame, const FrameFile& file, const std::string& camera_from) {
  const std::string technique = technique_for("ao");
  FoundOnShotFrame found{frame, "", "", camera_in_words(camera_from)};
  try {
    found.sources = sources_in_words(file, technique);
  } catch (const MissingPlanes& missing) {
    found.lacks = enumerate(missing.planes);
  }
  return found;
}

std::string verdict_on_shot(const std::vector<FoundOnShotFrame>& frames, const std::string& command) {
  std::vector<FoundOnShotFrame> able;
  std::vector<int> unable;
  std::vector<std::string> lacks, sources, cameras;
  for (const FoundOnShotFrame& found : frames) {
    if (found.sources.empty()) {
      unable.push_back(found.frame);
      if (!found.lacks.empty()) add_new(lacks, found.lacks);
      continue;
    }
    able.push_back(found);
    add_new(sources, found.sources);
    add_new(cameras, found.camera);
  }
  const std::string lacking = lacks.empty() ? "" : ": the files lack " + fmt::format("{}", fmt::join(lacks, "; "));
  if (able.empty()) return fmt::format("Ambient occlusion cannot be computed of any frame{}.", lacking);
  const std::string all = frames.size() == 1 ? "its frame"
                          : unable.empty()   ? fmt::format("all {} frames", frames.size())
                                             : fmt::format("{} of {} frames", able.size(), frames.size());
  const std::string from = sources.size() == 1 ? "from " + sources.front() : "from what differs below";
  const std::string by = cameras.size() == 1 ? "each " + cameras.front() : "by cameras that differ below";
  const std::string rest = unable.empty() ? "" : fmt::format("; not of {}{}", frames_in_words(unable), lacking);
  return fmt::format("Ambient occlusion can be computed of {}: {}, {}{}: {}", all, from, by, rest, command);
}

std::string runs_in_words(const std::vector<std::string>& runs) {
  constexpr size_t begin = 7;
  std::string text;
  for (const std::string& heading : technique_headings()) {
    std::vector<std::string> names;
    for (const std::string& name : runs)
      if (heading_of(find_technique(name)) == heading) names.push_back(name);
    if (names.empty()) continue;
    text += fmt::format("{:<{}}{}\n", text.empty() ? "runs" : "", begin,
                        wrapped(fmt::format("{}: {}", heading, fmt::join(names, ", ")), begin, begin + 2));
  }
  return text.empty() ? "runs   nothing\n" : text;
}

}  // namespace gloam::cli
