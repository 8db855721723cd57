#include "exr/view_planes.h"

#include <algorithm>
#include <optional>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {

std::string in_words(const Window& window) {
  return fmt::format("{}x{} pixels from ({}, {})", window.width(), window.height(), window.x0, window.y0);
}

namespace {

/// Whether a view's stack ends before this layer while another view's stack has it.
bool is_empty_layer(const std::vector<PlaneSource>& sources, const std::string& plane, const std::string& view) {
  const std::optional<StackLayer> layer = stack_layer(plane);
  if (!layer) return false;
  int here = -1;
  bool elsewhere = false;
  for (const PlaneSource& candidate : sources) {
    const std::optional<StackLayer> other = stack_layer(candidate.plane);
    if (!other || other->stack != layer->stack) continue;
    if (candidate.view == view) here = std::max(here, other->number);
    elsewhere |= candidate.plane == plane;
  }
  return elsewhere && here >= 0 && here < layer->number;
}

}  // namespace

const PlaneSource* find_source(const std::vector<PlaneSource>& sources, const std::string& plane,
                               const std::string& view) {
  for (const PlaneSource& candidate : sources)
    if (candidate.plane == plane && candidate.view == view) return &candidate;
  return nullptr;
}

bool has_plane(const std::vector<PlaneSource>& sources, const std::string& plane, const std::string& view) {
  return find_source(sources, plane, view) || is_empty_layer(sources, plane, view);
}

std::vector<std::string> common_planes(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views) {
  std::vector<std::string> common;
  for (const PlaneSource& source : sources) {
    const bool everywhere = std::all_of(
        views.begin(), views.end(), [&](const std::string& view) { return has_plane(sources, source.plane, view); });
    if (everywhere) add_new(common, source.plane);
  }
  return common;
}

std::string why_missing(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views,
                        const std::string& plane) {
  const std::string needed = is_stack(plane) ? layer_name(plane, 0) : plane;
  std::vector<std::string> lacking;
  for (const std::string& view : views)
    if (!has_plane(sources, needed, view)) lacking.push_back("'" + view + "'");
  if (lacking.empty() || lacking.size() == views.size()) return "";
  return printable(fmt::format("view{} {} {} no {}", lacking.size() == 1 ? "" : "s", enumerate(lacking),
                               lacking.size() == 1 ? "has" : "have", plane));
}

std::vector<std::string> unused_planes(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views,
                                       const std::vector<std::string>& planes, const std::string& remedy) {
  std::vector<std::string> expected = {"depth", "normal"}, sentences;
  add_new(expected, planes);
  for (const std::string& plane : expected)
    if (const std::string why = why_missing(sources, views, plane); !why.empty())
      sentences.push_back(fmt::format("{}, so no view uses it ({})", why, remedy));
  return sentences;
}

}  // namespace gloam
