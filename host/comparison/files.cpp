#include "comparison/files.h"

#include <algorithm>

#include "base/lists.h"
#include "exr/holdings.h"
#include "gloam/error.h"
#include "gloam/margin.h"
#include "gloam/option.h"

namespace gloam::comparison {
namespace {

/// The plane of the reference for a plane of the test that the user names.
std::string counterpart(const std::string& plane, const FrameFile& reference) {
  const std::vector<std::string> planes = reference.common_planes();
  if (contains(planes, plane)) return plane;
  for (const PlanePair& pair : result_pairs()) {
    if (pair.test == plane && contains(planes, pair.reference)) return pair.reference;
  }
  throw Error("{}: no plane '{}'{}; {}", reference.path().string(), plane, suggestion(plane, planes),
              holdings(reference));
}

}  // namespace

std::vector<PlanePair> comparable_planes(const FrameFile& test, const FrameFile& reference, const std::string& asked) {
  const std::vector<std::string> a = test.common_planes(), b = reference.common_planes();
  if (!asked.empty()) {
    if (!contains(a, asked))
      throw Error("{}: no plane '{}'{}; {}", test.path().string(), asked, suggestion(asked, a), holdings(test));
    return {{asked, counterpart(asked, reference)}};
  }
  std::vector<PlanePair> pairs;
  for (const PlanePair& pair : result_pairs()) {
    if (contains(a, pair.test) && contains(b, pair.reference)) pairs.push_back(pair);
  }
  if (!pairs.empty()) return pairs;
  // A result is stored with the depth that it was made from: comparing equal depths says nothing about the results.
  const std::vector<std::string> results = results_among(a), truths = results_among(b);
  if (!results.empty() && !truths.empty())
    throw Error("{} has {} and {} has {}, which cannot be compared; {} compares another plane", test.path().string(),
                enumerate(results), reference.path().string(), enumerate(truths), option("what", "PLANE"));
  for (const std::string& plane : inputs_among(a)) {
    if (contains(b, plane)) pairs.push_back({plane, plane});
  }
  if (!pairs.empty()) return pairs;
  throw Error("{} and {} have no plane in common: {}; {}", test.path().string(), reference.path().string(),
              holdings(test), holdings(reference));
}

Plane cropped(const Plane& plane, const Window& from, const Window& to) {
  return to == Window{} ? plane.clone() : part_of(plane, from, to);
}

bool covers(const Frame& frame, const Window& window, const Layout& layout) {
  if (window == Window{}) return frame.width() == layout.width && frame.height() == layout.height;
  const Window& w = frame.window;
  return w.x0 <= window.x0 && w.y0 <= window.y0 && w.x1 >= window.x1 && w.y1 >= window.y1;
}

std::string view_of(const Frame& frame, const std::string& name) {
  if (frame.views.size() == 1) return frame.views[0].name;
  for (const View& view : frame.views) {
    if (view.name == name) return name;
  }
  std::vector<std::string> names;
  for (const View& view : frame.views) names.push_back(view.name);
  throw Error("{} has the views {}, and '{}' is compared; {} says which", option("frame"), enumerate(names), name,
              option("view", "NAME"));
}

Window window_under(const Frame& extra, const std::string& path, const Frame& test, const Window& window,
                    const Layout& layout) {
  if (extra.display == test.display && covers(extra, window, layout)) return window;
  if (covers(extra, {}, layout)) return {};
  throw Error("{} is {}x{}, and the images are {}x{}; give the frame that they were made of", option("frame", path),
              extra.width(), extra.height(), layout.width, layout.height);
}

}  // namespace gloam::comparison
