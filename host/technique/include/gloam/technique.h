// A technique as data: the planes it reads and writes, its parameters, and its passes for given parameters.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/frame.h"
#include "gloam/parameters.h"

namespace gloam {

/// Integer constants that a kernel is compiled with, by name: {"STEPS", 8}.
using Defines = std::vector<std::pair<std::string, int>>;

/// Where the plane behind a kernel argument comes from.
enum class From {
  this_view,
  other_view,        ///< the other one of two views (`Technique::views`)
  frame_before,      ///< the same view in the frame before: its history, seen by `View::camera_before`
  nearest_key_view,  ///< the nearest key view (`Technique::key_views`)
  further_key_view   ///< the next key view on the other side; if there is none, the nearest one again
};

/// A plane behind a kernel argument. Mostly both have the same name; a kernel that serves several planes names its argument
/// differently: {"source", "ao_raw"}. A plane of several components takes one argument each, in order (`normal_x`, `normal_y`,
/// `normal_z`).
///
/// With `layers` it is a stack that the technique makes: one buffer with that many layers (load.h, `layer_of`), at the
/// technique's own resolution, or with `as_launched` at the pass's. A pass that reads and writes such a stack lists it once,
/// under writes. For a stack of depth layers (planes.h), `layers` is the number of layers that are read, from the first on; 0: all.
///
/// With `starts_empty`, for lists that a pass writes (shared/lanes/pixel_list.h), the plane's first number is 0 when the pass
/// begins.
struct Binding {
  std::string argument, plane;
  int layers = 0;
  int more_rows = 0;  ///< of a stack that a kernel divides by itself: rows beyond those of its layers
  From from = From::this_view;
  bool as_launched = false, starts_empty = false;
  Binding(const char* name) : argument(name), plane(name) {}
  Binding(std::string argument, std::string plane, int layers = 0)
      : argument(std::move(argument)), plane(std::move(plane)), layers(layers) {}
};

/// The binding with its plane taken from another place: from(From::other_view, {"other_depth", "depth"}).
inline Binding from(From where, Binding binding) {
  binding.from = where;
  return binding;
}

inline Binding starts_empty(Binding binding) {
  binding.starts_empty = true;
  return binding;
}

/// The views of a frame that a pass runs on. A pass that reads a plane runs only on those that have it.
enum class On {
  every_view,
  first_view,
  second_view,
  key_views,     ///< in a frame of many views, those that others reuse (`Technique::key_views`)
  views_between  ///< all other views
};

/// The first (0) or the second (1) view.
inline On on_view(int number) { return number == 0 ? On::first_view : On::second_view; }

/// How far around a pixel a pass reads.
struct Footprint {
  /// Columns and rows to either side, at most 32, in the results of earlier passes (for filters). With a mask, the earlier passes
  /// compute that many more.
  int columns = 0, rows = 0;
  /// Reads many pixels at distances set by parameters, only in planes that no mask limits. On CPUs such a pass is launched in an
  /// order that keeps these pixels in the cache.
  bool is_wide = false;
};

/// One kernel launch. Kernel arguments, which the kernel's text calls ARGUMENTS: (Frame frame, Frame other, Neighbour neighbour,
/// projections, Params params, tables..., view_tables..., reads..., writes...). `params` is left out if the technique has no
/// parameters. `other`, the frame of planes of a second resolution, is passed only if such planes are bound; `neighbour` (frame.h)
/// only if planes of the other view or of the frame before are bound. If the camera of the frame before is unknown, the neighbour
/// sees nothing.
struct Pass {
  std::string name;                    ///< "estimate": shown as "hbao+/estimate"
  std::string kernel;                  ///< function in `source`
  std::string source;                  ///< kernel file below kernels/; empty: the technique's
  std::vector<Binding> reads, writes;  ///< planes that no technique declares are intermediate results
  Defines defines;                     ///< loop counts and choices
  /// Those of the technique's `extras` that this pass can make. If one is asked for, it joins `writes`, and the kernel gets a
  /// define: WITH_BENT_NORMAL. One that a later pass completes has the extra's name as its argument and another plane:
  /// {"ao_error", "ao_error_raw"}. A pass that makes nothing but extras runs only where one is asked for.
  std::vector<Binding> extras;
  /// Planes that it reads where the frame has them (the technique's `may_read`). They join `reads` after the others, and the kernel
  /// gets a define: WITH_BACK_DEPTH.
  std::vector<Binding> may_read;
  /// Pixels of the image per computed pixel, along each axis: the launch and the planes written are smaller by this factor
  /// (`reduced`, frame.h).
  int scale = 1;
  On on = On::every_view;
  Footprint footprint;
  /// Each work-item computes several rows, one below another; the kernel gets their number, ROWS_OF_ITEM (1 to 32).
  bool goes_down = false;
  /// With a mask it skips rows of lanes without a wanted pixel (shared/lanes/wanted.h).
  bool can_skip = false;
  /// The kernel reads `projections` (shared/both/projection.h): the view's own, then, if it reads key views, those of the
  /// nearest and of the further one.
  bool projects = false;
  /// Tables of numbers that the kernel reads, the same for all pixels, by argument.
  std::vector<std::pair<std::string, std::vector<float>>> tables;
  /// Tables that depend on the view, by argument, after the others: what lies in the world, as the view's camera sees it. The function
  /// gets the view with its camera, and throws Error where the view lacks what it needs (a pose).
  std::vector<std::pair<std::string, std::function<std::vector<float>(const View&)>>> view_tables;
  /// Both of two views get the same value where both see a surface; upsampling must keep that.
  bool views_agree = false;
  /// Gives each pixel the value of its cell in the one plane read, which has a lower resolution.
  bool repeats_cells = false;
};

/// A named set of parameter values.
struct Preset {
  std::string name;  ///< low, medium, high or ultra
  Settings settings;
};

/// What `gloam auto` needs to know about a technique to decide whether and where a frame calls for it.
struct Effect {
  std::string name;  ///< as people call it: "ambient occlusion"; empty: `gloam auto` does not run it
  /// Technique that this one improves on: it replaces that one if a frame has the planes it reads and calls for it. Empty for an
  /// effect of its own.
  std::string refines;
  /// Technique of the effect that this one completes, in the same plan, from what that makes: "evidence" for bounces made from AO.
  /// What completes an effect has no mask of its own.
  std::string completes;
  std::string changes;        ///< plane that it gives to the picture (composite.h): "ao"; empty: none
  bool for_displays = false;  ///< only for frames of light-field displays, which need `any_projection`
  std::string mask;           ///< technique whose mask tells where the effect is called for; empty: everywhere
  /// Parameter without which the effect has nothing to compute, such as the file of a map. Empty: none.
  std::string needs;
  /// The probe: settings and resolution with which the mask is very cheap and still tells how many pixels call for the effect.
  Settings probe;
  int probe_resolution = 1;
  /// Shares of the image. Up to `least_share` the effect is not worth its cost; above `most_share` the mask costs more than it
  /// saves, and the effect is computed everywhere.
  double least_share = 0, most_share = 1;
  /// Least change of the picture, as a share of the picture's RMS, that is worth the effect's cost. A glance measures the change
  /// (plan/glance.h). 0: the mask alone decides.
  double least_change = 0;
  Settings settings;               ///< settings in `gloam auto`; the user's own override them
  std::string somewhere, nowhere;  ///< the reason why, followed by "on 12 % of the image", and why not
};

/// Which depths a technique reads: those that the frame shows, hidden ones chosen at random, or all.
enum class Layers { one, stochastic, peeled };

/// What a technique is, as a variant of another that reads one layer with one eye.
struct Variant {
  std::string of;  ///< the other's name; empty: it is none
  Layers layers = Layers::one;
  bool both_eyes = false;
};

struct Technique {
  std::string name;     ///< as users type it: "hbao+"
  std::string summary;  ///< one line
  std::string paper;    ///< author, year
  std::string source;   ///< default kernel file of its passes, below kernels/: "hbao_plus/hbao_plus.cl"
  std::vector<std::string> reads, writes;
  std::vector<std::string> may_read;  ///< planes that it reads where the frame has them
  /// Those of `reads` that it reads with given parameters. Empty: all.
  std::function<std::vector<std::string>(const ParameterValues&)> reads_with;
  std::vector<std::string> outputs;  ///< planes that `gloam run` writes; empty: `writes`. The technique in `then` makes
                                     ///< those that are not in `writes`
  std::string then;                  ///< technique that follows by default, such as a filter; it inherits parameters of
                                     ///< the same name
  Settings then_with;                ///< default settings of that technique
  std::vector<std::string> default_for;  ///< planes for which it is chosen if they are asked for by name
  int views = 1;                         ///< views that a frame needs: 2 if passes read the other view's planes
  /// Its passes need no more of a camera than its projection: it also runs on the views of light-field displays.
  bool any_projection = false;
  /// For given parameters, the distance between key views, which other views may reuse; 1: there are none.
  std::function<int(const ParameterValues&)> key_views;
  std::string over_time;  ///< technique that does the same for sequences, where there is one
  /// Planes that it makes besides `writes` if they are asked for by name, or if another technique reads them.
  std::vector<std::string> extras;
  /// For some extras, a plane that the pass that makes the extra reads for it alone: {extra, plane}. No technique makes that plane.
  std::vector<std::pair<std::string, std::string>> read_for_extras;
  ParameterList parameters;
  std::vector<Preset> presets;
  std::string caution;  ///< what to know before choosing a preset; may be empty
  /// For the few that a list shows first: what one wants who takes it, as in "surfaces reflect"; empty for all others.
  std::string recommended;
  /// Settings with so many samples that the image no longer changes, to measure what more samples could gain; not meant to be fast.
  /// Empty if there are none.
  Settings converged;
  std::function<std::vector<Pass>(const ParameterValues&)> passes;
  /// What it takes for something that it needs and a view does not state, a sentence; empty: nothing. Empty function: never.
  std::function<std::string(const ParameterValues&, const View&)> assumes;
  Effect effect;  ///< its role in `gloam auto`
  /// Samples per pixel over one layer. Empty if unknown.
  std::function<int(const ParameterValues&)> samples;
  /// Weight of an occluder at `distance` (in radii, 0 to 1) whose direction has the given `cosine` (above 0) to the normal,
  /// relative to the cosine-weighted integral: AO = 1 - mean over cosine-weighted directions of `contribution`. Changes to the
  /// mean afterwards, such as an exponent for contrast, are left out. Empty if the technique has no falloff of its own.
  std::function<double(const ParameterValues&, double cosine, double distance)> contribution;
  Variant variant = {};
};

/// Adapts a function of a technique's own parameter struct to `Technique::passes`.
template <typename Params>
std::function<std::vector<Pass>(const ParameterValues&)> passes_of(std::vector<Pass> (*passes)(const Params&)) {
  return [passes](const ParameterValues& values) { return passes(values.as<Params>()); };
}

/// Adapts a function of a technique's own parameter struct to `Technique::contribution`.
template <typename Params>
std::function<double(const ParameterValues&, double, double)> contribution_of(double (*contribution)(const Params&,
                                                                                                     double cosine,
                                                                                                     double distance)) {
  return [contribution](const ParameterValues& values, double cosine, double distance) {
    return contribution(values.as<Params>(), cosine, distance);
  };
}

/// The folder of a technique, below kernels/: that of its first pass with default parameters.
std::string folder_of(const Technique& technique);

/// Whether a pass reads any plane from this place.
bool takes(const Pass& pass, From where);

/// The kernel file of one of a technique's passes.
const std::string& source_of(const Technique& technique, const Pass& pass);

/// Whether a technique needs two views and makes an image of the first only.
bool makes_first_view_only(const Technique& technique);

/// All techniques, sorted by name.
const std::vector<Technique>& registry();

/// Throws UsageError, with the nearest name, for an unknown technique.
const Technique& find_technique(const std::string& name);

std::vector<std::string> technique_names();

}  // namespace gloam
