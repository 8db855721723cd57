#include "scene/capture_options.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "shared/both/stochastic.h"

namespace gloam {
namespace {

void check_margin(const CaptureOptions& options) {
  if (options.margin_x < 0 || options.margin_y < 0)
    throw UsageError("a margin of {} and {} pixels is less than none; give 0 or more", options.margin_x,
                     options.margin_y);
  const long long width = options.width + 2LL * options.margin_x, height = options.height + 2LL * options.margin_y;
  if (width * height > max_pixels)
    throw UsageError("a capture of {}x{} pixels, with its margin, is too large; at most {} can be made", width, height,
                     max_pixels);
  if (options.margin_x + options.margin_y == 0) return;
  for (const CaptureView& view : options.views)
    if (view.camera.slits)
      throw UsageError("the views of a light-field display end where its screen does, and have no margin; leave out {}",
                       option("overscan"));
}

/// A map of relevant surfaces needs to know how far a radius reaches on the screen.
void check_relevant(const CaptureOptions& options) {
  const StochasticOptions& map = options.stochastic;
  if (!is_of_relevant(map)) return;
  if (map.radius && !(*map.radius > 0 && *map.radius <= 1e30))
    throw UsageError("radius {:g} has no relevant surfaces; give a number above 0, 1e30 at most", *map.radius);
  if (!(map.max_reach >= 0 && map.max_reach <= 1))
    throw UsageError("a reach of {:g} is no share of the image's width; give 0 to 1", map.max_reach);
  for (const CaptureView& view : options.views)
    if (view.camera.slits)
      throw UsageError(
          "which surfaces are relevant is unknown for the views of a light-field display, where a radius has another "
          "size at each pixel; use {}",
          option("stochastic-surfaces", "hidden"));
}

void check_stochastic(const StochasticOptions& options) {
  if (options.samples < 0 || options.samples > STOCHASTIC_MOST)
    throw UsageError("a stochastic depth map of {} samples cannot be made; 1 to {} can", options.samples,
                     STOCHASTIC_MOST);
  if (!(options.alpha >= 0 && options.alpha <= 1))
    throw UsageError("alpha {:g} is no share of the samples; give 0 to 1", options.alpha);
  if (options.seed < 0) throw UsageError("seed {} is negative; give 0 or more", options.seed);
}

/// Checks that `what`, which makes two views from the only one, is possible.
void check_can_become_two(const CaptureOptions& options, const char* what, const char* how) {
  if (options.second_view && options.stereo)
    throw UsageError("a second view and a pair of eyes cannot be captured together; leave out one of them");
  if (options.views.size() != 1) throw UsageError("{} {} one view, and there are {}", what, how, options.views.size());
}

void check_second_view(const CaptureOptions& options) {
  const double degrees = *options.second_view;
  if (!(std::abs(degrees) <= 90) || degrees == 0)
    throw UsageError("a second view turned by {:g} degrees is not allowed; -90 to 90 is, but not 0", degrees);
  check_can_become_two(options, "a second view", "goes beside");
  if (contains(options.planes, "motion"))
    throw UsageError(
        "a second view has no motion, as its camera turns about what the first view shows in each frame; leave out one "
        "of them");
  if (options.views[0].name == second_view_name)
    throw UsageError("the first view is called '{}', as the second would be; give it another name", second_view_name);
}

}  // namespace

void check_options(const CaptureOptions& options) {
  if (options.width < 1 || options.height < 1)
    throw UsageError("a capture of {}x{} pixels has none; give a size such as 1920x1080", options.width,
                     options.height);
  check_margin(options);
  if (options.peel < 0 || options.peel > 64) throw UsageError("{} layers cannot be peeled; 0 to 64 can", options.peel);
  if (options.peel_light && options.peel == 0)
    throw UsageError("light of layers is captured with layers; give their number too ({})", option("peel", "8"));
  for (const std::string& plane : options.planes) {
    if (contains(capture_planes(), plane)) continue;
    throw UsageError("plane '{}' cannot be captured{}; {} can, and layers by their number", plane,
                     suggestion(plane, capture_planes()), enumerate(capture_planes()));
  }
  check_stochastic(options.stochastic);
  check_relevant(options);
  if (options.second_view) check_second_view(options);
  if (options.stereo) check_can_become_two(options, "a pair of eyes", "takes the place of");
  for (const CaptureView& view : options.views) {
    if (!view.camera.pose || (view.previous_camera && !view.previous_camera->pose))
      throw Error("view '{}' has a camera without a pose; give its camera_to_world", view.name);
  }
}

}  // namespace gloam
