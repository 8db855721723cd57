// A technique is data: what it reads, what it writes, its parameters, and the passes it takes for given parameters.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/parameters.h"

namespace gloam {

/// Numbers that a kernel is compiled with, by name: {"STEPS", 8}.
using Defines = std::vector<std::pair<std::string, int>>;

/// Where the plane behind a kernel argument comes from.
enum class From {
  this_view,
  other_view,        ///< the other of two views (`Technique::views`)
  frame_before,      ///< the same view in the frame before: what its history holds, as `View::camera_before` shows it
  nearest_key_view,  ///< of the views that others look into (`Technique::key_views`)
  further_key_view   ///< the next key view on the other side, or the nearest again where there is none
};

/// A plane behind a kernel argument. Argument and plane mostly share the name; a kernel that serves several planes
/// names its argument otherwise: {"source", "ao_raw"}. A plane of several components takes as many arguments, in order
/// (`normal_x`, `normal_y`, `normal_z`).
///
/// With `layers` it is a stack that the technique makes itself: one buffer of that many layers (load.h, `layer_of`), of
/// the technique's own resolution whatever the pass's, or with `as_launched` of the pass's. A pass that reads and writes
/// such a stack names it once, as written. Of a stack of depth layers (planes.h) that a pass reads, it is the first so many
/// layers; 0: all there are.
///
/// With `starts_empty`, which is for lists that a pass writes (shared/lanes/pixel_list.h), the plane's first number is 0
/// when the pass begins.
struct Binding {
  std::string argument, plane;
  int layers = 0;
  From from = From::this_view;
  bool as_launched = false, starts_empty = false;
  Binding(const char* name) : argument(name), plane(name) {}
  Binding(std::string argument, std::string plane, int layers = 0)
      : argument(std::move(argument)), plane(std::move(plane)), layers(layers) {}
};

/// The binding with its plane taken from elsewhere: from(From::other_view, {"other_depth", "depth"}).
inline Binding from(From where, Binding binding) {
  binding.from = where;
  return binding;
}

inline Binding starts_empty(Binding binding) {
  binding.starts_empty = true;
  return binding;
}

/// The views of a frame that a pass runs on. What reads a plane runs, of these, on the views that have the plane.
enum class On {
  every_view,
  first_view,
  second_view,
  key_views,     ///< of a frame of many views, those that others look into (`Technique::key_views`)
  views_between  ///< those that are no key views
};

/// The first (0) or the second (1) view.
inline On on_view(int number) { return number == 0 ? On::first_view : On::second_view; }

/// How far around a pixel a pass reads.
struct Footprint {
  /// Columns and rows to either side, at most 32, of what earlier passes made: a filter's. A mask lets the passes before it
  /// compute that much more.
  int columns = 0, rows = 0;
  /// Many pixels at distances that parameters decide, of planes that no mask leaves out. On CPUs such a pass is launched in an
  /// order that keeps them in the cache.
  bool is_wide = false;
};

/// One kernel launch. Kernel arguments: (Frame frame, Frame other, Neighbour neighbour, projections, Params params, tables...,
/// reads..., writes...).
/// A technique without parameters has no `params`. `other` is there only where planes of a second resolution are bound:
/// their frame; `neighbour` (frame.h) only where planes of the other view or of the frame before are bound. Of a frame before
/// whose camera is not known, the neighbour sees nothing.
struct Pass {
  std::string name;                    ///< "estimate": shown as "hbao+/estimate"
  std::string kernel;                  ///< function in `source`
  std::string source;                  ///< kernel file below kernels/; empty: the technique's
  std::vector<Binding> reads, writes;  ///< planes that no technique declares are intermediate
  Defines defines;                     ///< counts that shape loops, and choices
  /// Of the technique's `extras` those that this pass can make. Of these the ones asked for join `writes`, with a define
  /// each: WITH_BENT_NORMAL.
  std::vector<Binding> extras;
  /// Pixels of the image per pixel of what is computed, along each axis: one of `scale` x `scale` pixels is launched, and
  /// the planes written are that small (`reduced`, frame.h).
  int scale = 1;
  On on = On::every_view;
  Footprint footprint;
  /// Where a mask leaves pixels out it skips rows of pixels of which none is wanted (shared/lanes/wanted.h).
  bool can_skip = false;
  /// Its kernel asks how the view projects (`projections`, shared/frame/projection.h), and how key views do that it reads: the
  /// view's own, then those of the nearest and of the further key view.
  bool projects = false;
  /// Numbers that its kernel reads, the same for all pixels, by argument.
  std::vector<std::pair<std::string, std::vector<float>>> tables;
  /// What it writes is the same in both of two views where both see the surface, and has to stay so at a lower resolution.
  bool views_agree = false;
  /// Each pixel gets what its cell holds in the one plane read, which is of a lower resolution.
  bool repeats_cells = false;
};

/// A named set of parameter values.
struct Preset {
  std::string name;  ///< low, medium, high or ultra
  Settings settings;
};

/// What `gloam auto` has to know of a technique, to tell whether a frame calls for it, and where.
struct Effect {
  std::string name;  ///< as people call it: "ambient occlusion"; empty: the technique is for those who ask for it
  /// Technique whose effect this one makes better: it runs instead where a frame holds what it reads, and calls for it. Empty
  /// for an effect by itself.
  std::string refines;
  bool for_displays =
      false;  ///< of frames of light-field displays, which techniques with `any_projection` take, and of no others
  std::string mask;  ///< technique whose mask says where it is called for
  /// The probe: settings and resolution with which the mask costs next to nothing, and still tells how much calls for it.
  Settings probe;
  int probe_resolution = 1;
  /// Shares of the image: up to the one the effect is not worth what it costs; from the other on the mask itself costs more
  /// than it saves, and the effect is computed everywhere.
  double least_share = 0, most_share = 1;
  Settings settings;               ///< of the technique in `gloam auto`, under the user's own
  std::string somewhere, nowhere;  ///< why, in words that a share follows, and why not
};

struct Technique {
  std::string name;     ///< as users type it: "hbao+"
  std::string summary;  ///< one line
  std::string paper;    ///< author, year
  std::string source;   ///< kernel file below kernels/ of passes that name none: "hbao_plus/hbao_plus.cl"
  std::vector<std::string> reads, writes;
  std::vector<std::string> outputs;  ///< planes that `gloam run` writes; empty: `writes`. Others than `writes` are made
                                     ///< by the technique that `then` names
  std::string then;                  ///< technique that follows by default, such as a filter; inherits parameters of
                                     ///< the same name
  Settings then_with;                ///< settings that the follower has by default
  std::vector<std::string> default_for;  ///< planes that it makes where they are asked for by name and several could
  int views = 1;                         ///< that a frame needs: 2 where passes read the other view's planes
  /// Its passes ask for the projection and for nothing else that only a camera with an eye has: it runs on the views of
  /// light-field displays as well.
  bool any_projection = false;
  /// For given parameters, every how many views one is a key view, which other views may look into; 1: all are alike.
  std::function<int(const ParameterValues&)> key_views;
  std::vector<std::string> extras;  ///< planes made beside `writes` where they are asked for by name
  ParameterList parameters;
  std::vector<Preset> presets;
  std::string caution;  ///< what to know before choosing a preset; may be empty
  /// Settings of so many samples that the image no longer changes, for measuring what more samples could give: not meant
  /// to be fast. Empty where there is no such thing.
  Settings converged;
  std::function<std::vector<Pass>(const ParameterValues&)> passes;
  Effect effect;  ///< what `gloam auto` makes with it, if anything
  /// Samples per pixel over one layer. Empty where the technique has not said.
  std::function<int(const ParameterValues&)> samples;
  /// What an occluder at `distance` (in radii, 0 to 1) and at an angle with the given `cosine` (above 0) to the normal
  /// takes away, in relation to the cosine-weighted integral: AO = 1 - mean over cosine-weighted directions of
  /// `contribution`. What is done to the mean afterwards, such as an exponent for contrast, is no part of it. Empty
  /// where the technique has no falloff of its own.
  std::function<double(const ParameterValues&, double cosine, double distance)> contribution;
};

/// Lets a technique write its passes as a function of its own parameter struct.
template <typename Params>
std::function<std::vector<Pass>(const ParameterValues&)> passes_of(std::vector<Pass> (*passes)(const Params&)) {
  return [passes](const ParameterValues& values) { return passes(values.as<Params>()); };
}

/// The same for its contribution.
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

/// Whether a pass reads any plane from there.
bool takes(const Pass& pass, From where);

/// The kernel file of one of a technique's passes.
const std::string& source_of(const Technique& technique, const Pass& pass);

/// Whether it needs two views and makes an image of the first alone, where others make one of each.
bool makes_first_view_only(const Technique& technique);

/// All techniques, sorted by name.
const std::vector<Technique>& registry();

/// Throws UsageError with the nearest name.
const Technique& find_technique(const std::string& name);

std::vector<std::string> technique_names();

}  // namespace gloam
