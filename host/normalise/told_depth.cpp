#include "normalise/told_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/statistics.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "normalise/depth_encoding.h"
#include "normalise/straightness.h"
#include "normalise/told_by_normals.h"

namespace gloam {
namespace {

/// A depth that is read, and what was found of it.
struct Untold {
  const Channel& depth;
  const StoredDepth& found;
  const Camera& camera;
  const StatedDepth& stated;
  bool is_in_unit_interval = found.is_in_unit_interval;
  DepthEncoding encoding = {};  ///< found
};

/// What tells a meaning, in words.
struct Reason {
  const char* by;      ///< "taken as the distance along the ray, ..."
  const char* though;  ///< "taken as planar distance, though ... if it is the distance along the ray"
  std::string why;     ///< numbers, in brackets behind it
};

Reason by_planes(long long segments, long long all) {
  return {"by which plane surfaces are plane", "plane surfaces are plane",
          fmt::format("{} of {} straight pieces of rows and columns", segments, all)};
}

double median_of_surfaces(const Channel& depth, const Background& background) {
  const Layout& layout = depth.layout();
  const int apart = std::max(1, int(std::sqrt(double(layout.width) * layout.height / 4096)));
  std::vector<double> values;
  for (int y = 0; y < layout.height; y += apart)
    for (int x = 0; x < layout.width; x += apart)
      if (is_surface(depth.at(x, y), background)) values.push_back(double(depth.at(x, y)));
  return values.empty() ? 0 : median(std::move(values));
}

StatedDepth read_as(const Untold& untold, DepthConvention convention) {
  StatedDepth read = untold.stated;
  read.convention = convention;
  if (untold.encoding != DepthEncoding()) read.encoding = untold.encoding;
  return read;
}

/// ", stored with the sRGB curve"
std::string encoding_of(const Untold& untold) {
  return std::string(untold.encoding.srgb ? ", stored with the sRGB curve" : "") +
         (untold.encoding.bottom_up ? ", its rows (or those of the normals) from the bottom up" : "");
}

/// Flags that state a meaning, with those of the encoding before them.
std::string all_flags(const Untold& untold, const std::string& flags) {
  if (untold.encoding == DepthEncoding()) return flags;
  return option("depth-encoding", in_words(untold.encoding)) + (flags.empty() ? "" : " ") + flags;
}

/// What is told, of a frame of a shot or where something that it needs is not known: planar distance is taken, and the note names the flags.
StatedDepth only_told(const Untold& untold, const std::string& what, const Reason& reason, const std::string& flags,
                      std::vector<std::string>& assumed) {
  assumed.push_back(
      fmt::format("depth: taken as planar distance along the viewing axis, though {} if it is {}{} ({}); {}",
                  reason.though, what, encoding_of(untold), reason.why, all_flags(untold, flags)));
  StatedDepth read = untold.stated;
  read.convention = DepthConvention::z;
  return read;
}

/// `flags`: that state it; empty where its name does.
StatedDepth taken(const Untold& untold, const std::string& what, const Reason& reason, const std::string& flags,
                  StatedDepth read, std::vector<std::string>& assumed) {
  const std::string all = all_flags(untold, flags);
  const std::string otherwise = untold.encoding != DepthEncoding() ? option("depth-encoding", "plain")
                                : read.convention == DepthConvention::z && all.empty() ? option("depth")
                                                                                       : option("depth", "z");
  assumed.push_back(fmt::format("depth: taken as {}{}, {} ({}){}{}; {} says otherwise", what, encoding_of(untold),
                                reason.by, reason.why, all.empty() || all.starts_with(";") ? "" : ": ", all,
                                otherwise));
  return read;
}

StatedDepth along_rays(const Untold& untold, const Reason& reason, std::vector<std::string>& assumed) {
  if (untold.stated.is_of_shot)
    return only_told(untold, "the distance along the ray", reason, option("depth", "ray") + " reads a whole shot so",
                     assumed);
  return taken(untold, "the distance along the ray", reason, "", read_as(untold, DepthConvention::ray), assumed);
}

/// 1/z is a linear function of what is stored.
struct LinearInInverse {
  bool is_sure = true;              ///< else it is told alone
  bool is_above = false;            ///< the pole lies above all values
  std::optional<double> pole = {};  ///< the value at an infinite distance, which only normals tell
  double beside_pole = 0;           ///< how near the values come to it
};

/// Flags for a linear function of what is stored that is 0 at the pole and positive elsewhere; sets it.
std::string flags_for_pole(double pole, bool is_above, StatedDepth& read) {
  if (pole == 0) return "";
  read.scale = is_above ? -1 : 1, read.offset = is_above ? pole : -pole;
  return fmt::format("{} {}", option("depth-scale", fmt::format("{:g}", *read.scale)),
                     option("depth-offset", fmt::format("{:.6g}", *read.offset)));
}

/// Clipping planes, and what is to be said of them.
struct ClippingPlanes {
  std::optional<double> near, far;
  std::string flags;  ///< that state those that were found
  std::string note;
};

/// The value of device depth at an infinite distance.
double pole_of(double near, double far, bool is_reversed) {
  if (std::isinf(far)) return is_reversed ? 0 : 1;
  return is_reversed ? -near / (far - near) : far / (far - near);
}

/// Far over near, by the same.
double ratio_of(double pole, bool is_reversed) {
  if (pole == (is_reversed ? 0 : 1)) return std::numeric_limits<double>::infinity();
  return is_reversed ? 1 - 1 / pole : pole / (pole - 1);
}

/// The planes that are known, with what the pole tells of those that are not; in units of the near plane where neither is. Those of a camera
/// are given up where the pole contradicts them, and stated ones with a note alone.
ClippingPlanes planes_of(const Untold& untold, const LinearInInverse& linear, bool is_reversed) {
  constexpr double most_apart = 0.03;
  const StatedDepth& stated = untold.stated;
  ClippingPlanes planes{stated.near ? stated.near : untold.camera.near, stated.far ? stated.far : untold.camera.far, "",
                        ""};
  const std::string in_units_of_near =
      fmt::format("; lengths are in units of the near plane, which {} gives", option("near"));
  if (!linear.pole) {  // reversed depth is read without its far plane
    if (is_reversed && !planes.near) planes.near = 1, planes.note = in_units_of_near;
    return planes;
  }
  const double ratio = ratio_of(*linear.pole, is_reversed);
  if (planes.near && planes.far) {
    const double apart = std::abs(pole_of(*planes.near, *planes.far, is_reversed) - *linear.pole);
    if (apart <= most_apart * linear.beside_pole) return planes;
    const bool are_stated = stated.near && stated.far;
    planes.note =
        fmt::format("; near and far, {:g} and {:g}, do not fit, by which far / near may be {:.4g}: lengths may be off",
                    *planes.near, *planes.far, ratio);
    if (are_stated) return planes;
    if (!stated.far) planes.far = {};
  }
  const bool is_near_known = planes.near.has_value();
  if (!is_near_known) planes.near = planes.far && std::isfinite(ratio) ? *planes.far / ratio : 1;
  planes.flags = option("near", fmt::format("{:.6g}", *planes.near));
  if (!planes.far) {
    planes.far = *planes.near * ratio;
    if (std::isfinite(ratio)) planes.flags += " " + option("far", fmt::format("{:.6g}", *planes.far));
  }
  if (!is_near_known) planes.note = in_units_of_near;
  return planes;
}

/// Disparities, or another linear function of 1/z.
StatedDepth of_disparity(const Untold& untold, const LinearInInverse& linear, const Reason& reason,
                         std::vector<std::string>& assumed) {
  StatedDepth read = read_as(untold, DepthConvention::inverse);
  const std::string flags = flags_for_pole(linear.pole.value_or(0), linear.is_above, read);
  const std::string all = option("depth", "inverse") + (flags.empty() ? "" : " ") + flags;
  if (untold.stated.is_of_shot || untold.stated.scale || !linear.is_sure)
    return only_told(untold, "a disparity", reason, all + " reads it so", assumed);
  return taken(untold, "inverse", reason, flags.empty() ? "" : all, read, assumed);
}

/// Normalised device depth where all values lie in 0 to 1 and the pole where such depth has it, else disparities.
StatedDepth linear_in_inverse(const Untold& untold, const LinearInInverse& linear, const Reason& reason,
                              std::vector<std::string>& assumed) {
  const StatedDepth& stated = untold.stated;
  const bool is_reversed =
      linear.pole ? !linear.is_above : median_of_surfaces(untold.depth, untold.found.background) < 0.5;
  const bool may_be_window =
      !linear.pole || (is_reversed ? *linear.pole > -0.5 && *linear.pole <= 0 : *linear.pole > 1);
  if (!untold.is_in_unit_interval || !may_be_window) return of_disparity(untold, linear, reason, assumed);
  const ClippingPlanes planes = planes_of(untold, linear, is_reversed);
  if (!is_reversed && !(planes.near && planes.far))
    return only_told(untold, "normalised device depth", reason,
                     fmt::format("{} with {} and {} reads it", option("depth", "ndc"), option("near"), option("far")),
                     assumed);
  const std::string name = option("depth", is_reversed ? "reversed" : "ndc");
  if (stated.is_of_shot || stated.scale || !linear.is_sure)
    return only_told(untold, "normalised device depth", reason, name + " reads it so", assumed);
  StatedDepth read = read_as(untold, is_reversed ? DepthConvention::reversed : DepthConvention::ndc);
  read.near = planes.near, read.far = planes.far;
  return taken(untold, fmt::format("{}normalised device depth", is_reversed ? "reversed " : ""), reason,
               (planes.flags.empty() ? "" : name + " " + planes.flags) + planes.note, read, assumed);
}

/// Proportional to the distance from a value that is not 0.
StatedDepth of_grey(const Untold& untold, double pole, bool is_above, const Reason& reason,
                    std::vector<std::string>& assumed) {
  StatedDepth read = read_as(untold, DepthConvention::z);
  const std::string flags = flags_for_pole(pole, is_above, read);
  const std::string what = fmt::format("a grey that is linear in the distance, {} near", is_above ? "white" : "black");
  if (untold.stated.is_of_shot || untold.stated.scale)
    return only_told(untold, what, reason, flags + " reads it so", assumed);
  return taken(untold, what, reason, flags + "; lengths are in units of what is stored", read, assumed);
}

StatedDepth planar(const Untold& untold, const Reason& reason, std::vector<std::string>& assumed) {
  const std::string what = "planar distance along the viewing axis";
  if (untold.stated.is_of_shot && untold.encoding != DepthEncoding())
    return only_told(untold, "stored otherwise", reason, "reads a whole shot so", assumed);
  return taken(untold, what, reason, untold.encoding == DepthEncoding() ? "" : option("depth", "z"),
               read_as(untold, DepthConvention::z), assumed);
}

const char* in_words(const DepthMeaning& meaning) {
  switch (meaning.kind) {
    case DepthMeaning::along_ray:
      return "distance along the ray";
    case DepthMeaning::inverse:
      return "1 / distance";
    case DepthMeaning::grey:
      return "a grey that is linear in the distance";
    default:
      return "planar distance";
  }
}

Reason by_normals(const MeaningByNormals& told, const std::optional<std::pair<DepthEncoding, double>>& encoded) {
  constexpr double many = 4, many_of_median = 1.5;  // degrees
  std::string why = fmt::format("to {:.1f} degrees", told.taken.degrees);
  if (told.as_good_as)
    why += fmt::format("; as {} to {:.1f}, which may be meant as well", in_words(told.as_good_as->meaning),
                       told.as_good_as->degrees);
  if (told.other_view)
    why +=
        fmt::format("; by a field of view of {:.0f} degrees to {:.1f}", *told.other_view, told.degrees_of_other_view);
  else if (!told.as_good_as && told.taken.meaning.kind != DepthMeaning::planar)
    why += fmt::format("; as planar distance to {:.1f}", told.planar.degrees);
  if (encoded)
    why += fmt::format("; by {} to {:.1f}, which may be meant as well",
                       option("depth-encoding", in_words(encoded->first)), encoded->second);
  if (told.taken.meaning.pole != 0 && (told.taken.degrees > many || told.taken.median > many_of_median))
    why += "; that is much, and distances may be some percent off: state what is known";
  return {"by which it agrees with the normals", "it agrees with the normals", why};
}

StatedDepth of_meaning(const Untold& untold, const MeaningByNormals& told,
                       const std::optional<std::pair<DepthEncoding, double>>& encoded,
                       std::vector<std::string>& assumed) {
  const Reason reason = by_normals(told, encoded);
  switch (told.taken.meaning.kind) {
    case DepthMeaning::along_ray:
      return along_rays(untold, reason, assumed);
    case DepthMeaning::inverse:
      return linear_in_inverse(untold, {true, told.is_above, told.taken.meaning.pole, told.beside_pole}, reason,
                               assumed);
    case DepthMeaning::grey:
      return of_grey(untold, told.taken.meaning.pole, told.is_above, reason, assumed);
    default:
      return planar(untold, reason, assumed);
  }
}

/// By plane surfaces alone.
ToldDepth of_planes(const Untold& untold, const Window& window, std::vector<std::string>& assumed) {
  const StoredDepth& found = untold.found;
  const Camera& camera = untold.camera;
  const DepthRows rows = rows_of(untold.depth);
  const Straightness straightness = straightness_of(rows, found.sign, found.background, window, camera);
  const auto reason_for = [&](Straightness::Meaning meaning) {
    return by_planes(straightness.of(meaning), straightness.all());
  };
  if (straightness.meaning() == Straightness::along_ray)
    return {along_rays(untold, reason_for(Straightness::along_ray), assumed)};
  const bool may_be_grey = found.sign > 0 && !camera.orthographic && !camera.slits &&
                           (found.is_in_unit_interval || straightness.meaning() != Straightness::of_inverse);
  const bool is_proportional =
      straightness.meaning() == Straightness::planar && is_proportional_to_distance(rows, found.background);
  if (may_be_grey && !is_proportional) {
    const std::optional<LinearGrey> grey = linear_grey_of(rows, found.background);
    if (grey && std::isinf(grey->pole))
      return {linear_in_inverse(untold, {grey->is_both_ways}, by_planes(grey->segments, grey->all), assumed)};
    if (grey && !grey->is_zero)
      return {of_grey(untold, grey->pole, grey->is_above, by_planes(grey->segments, grey->all), assumed)};
  }
  if (straightness.meaning() == Straightness::of_inverse && found.sign > 0)
    return {linear_in_inverse(untold, {straightness.is_of_inverse_both_ways()}, reason_for(Straightness::of_inverse),
                              assumed)};
  if (found.sign < 0) return {read_as(untold, DepthConvention::z)};  // which another note tells
  if (straightness.meaning() == Straightness::planar) {
    assumed.push_back(fmt::format("depth: taken as planar distance along the viewing axis, {}; {} says otherwise",
                                  reason_for(Straightness::planar).by, option("depth")));
    return {read_as(untold, DepthConvention::z)};
  }
  assumed.push_back(note_on_planar_depth(found.is_in_unit_interval));
  return {read_as(untold, DepthConvention::z), false};
}

}  // namespace

ToldDepth told_by_surfaces(const Channel& depth, const StoredDepth& found, const Window& window, const Camera& camera,
                           const StatedDepth& stated, const NormalsBeside* normals, std::vector<std::string>& assumed) {
  Untold untold{depth, found, camera, stated};
  const std::optional<ToldByNormals> told =
      normals ? told_by_normals(depth, found, window, camera, *normals, !stated.encoding) : std::nullopt;
  // Of negative depth another note tells, and no file has any but lengths in it.
  if (!told || (found.sign < 0 && told->meaning.taken.meaning.kind != DepthMeaning::along_ray)) {
    if (normals && !told && !camera.orthographic && !camera.slits)
      assumed.emplace_back("depth: the normals tell nothing of its meaning, and it is read without them");
    return of_planes(untold, window, assumed);
  }
  untold.encoding = told->encoding;
  untold.is_in_unit_interval |= told->encoding.srgb;
  return {of_meaning(untold, told->meaning, told->as_good_as, assumed)};
}

std::string note_on_contradicted_planar(const DepthRows& depth, const StoredDepth& found, const Window& window,
                                        const Camera& camera, const NormalsBeside& normals) {
  const auto told = meaning_by_normals(values_of(depth), found.sign, found.background, window, camera, normals);
  if (!told || told->taken.meaning.kind == DepthMeaning::planar || told->as_good_as) return "";
  const DepthMeaning& meaning = told->taken.meaning;
  const bool is_device = meaning.kind == DepthMeaning::inverse && found.is_in_unit_interval;
  const char* const word = meaning.kind == DepthMeaning::along_ray ? "ray"
                           : is_device                             ? (told->is_above ? "ndc" : "reversed")
                                                                   : "inverse";
  const std::string flag = meaning.kind == DepthMeaning::grey ? option("depth-scale") + " and " + option("depth-offset")
                                                              : option("depth", word);
  return fmt::format(
      "depth: taken as planar distance along the viewing axis, though it agrees with the normals if it is {} ({}); "
      "give {}",
      in_words(meaning), by_normals(*told, {}).why, flag);
}

}  // namespace gloam
