#include "cli/compare/stereo_inputs.h"

#include <algorithm>

#include "cli/flags/memory.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam::cli {

static StereoInput opened(const std::string& path, const ReadOptions& options) {
  return {FrameFile(path, options), {}};
}

std::vector<StereoInput> open_results(const CompareFlags& flags, const ReadOptions& options) {
  std::vector<StereoInput> results;
  if (flags.reference.empty()) {
    results.push_back(opened(flags.test, options));
    const std::vector<std::string>& views = results[0].file.views();
    if (views.size() == 1)
      throw Error("{}: holds one view, and the stereo inconsistency is between two; give the file of the other eye too",
                  flags.test);
    if (views.size() > 2) throw Error("{}: has the views {}; --views A,B says which two", flags.test, enumerate(views));
    return results;
  }
  for (const std::string& path : {flags.test, flags.reference}) {
    ReadOptions own = options_beside(options, path);
    own.channels = options.channels;
    results.push_back(opened(path, own));
    const std::vector<std::string>& views = results.back().file.views();
    if (views.size() == 1) continue;
    throw Error("{}: has the views {}; of two files each holds one view", path, enumerate(views));
  }
  return results;
}

std::vector<StereoInput> open_frame(const CompareFlags& flags, const ReadOptions& options) {
  std::vector<StereoInput> frames;
  if (!flags.frame.empty()) frames.push_back(opened(flags.frame, options_beside(options, flags.frame)));
  return frames;
}

unsigned long long bytes_of(const std::vector<StereoInput>& results, const std::vector<StereoInput>& frames,
                            std::vector<std::string> geometry, const std::string& plane) {
  unsigned long long bytes = 0;
  for (const StereoInput& frame : frames) bytes += frame.file.bytes_to_read(geometry);
  add_new(geometry, plane);
  for (const StereoInput& result : results) bytes += result.file.bytes_to_read(geometry);
  return process_bytes + 2 * bytes;
}

void read_all(std::vector<StereoInput>& inputs, std::vector<std::string> geometry, const std::string& plane) {
  add_new(geometry, plane);
  for (StereoInput& input : inputs) input.read(geometry);
}

std::string plane_asked_for(const std::vector<StereoInput>& results, const std::string& asked) {
  if (plane_kind(asked).meaning == PlaneKind::view_depth)
    throw UsageError("--what {}: a point's depth is another for each eye; name a result", asked);
  for (const StereoInput& result : results) {
    const std::vector<std::string> planes = result.file.common_planes();
    if (!contains(planes, asked))
      throw Error("{}: no plane '{}'{}; {}", result.name(), asked, suggestion(asked, planes), holdings(result.file));
  }
  return asked;
}

std::string plane_to_compare(const std::vector<StereoInput>& results) {
  const FrameFile& first = results.front().file;
  std::vector<std::string> order = results_among(first.common_planes());
  for (const std::string& plane : inputs_among(first.common_planes())) order.push_back(plane);
  for (const std::string& plane : order) {
    const bool is_in_all = std::all_of(results.begin(), results.end(), [&](const StereoInput& result) {
      return contains(result.file.common_planes(), plane);
    });
    if (is_in_all && plane_kind(plane).meaning != PlaneKind::view_depth) return plane;
  }
  throw Error("{}: nothing that can be compared between two eyes; {}", results.front().name(), holdings(first));
}

}  // namespace gloam::cli
