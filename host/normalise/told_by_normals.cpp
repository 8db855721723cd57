#include "normalise/told_by_normals.h"

#include "normalise/depth_encoding.h"

namespace gloam {
namespace {

struct Stored {
  const Channel& depth;
  const StoredDepth& found;
  const Window& window;
  const Camera& camera;
  const NormalsBeside& normals;
};

/// Of the values with an encoding undone, pixel by pixel.
std::optional<MeaningByNormals> meaning_of(const Stored& stored, const DepthEncoding& encoding) {
  const Channel& depth = stored.depth;
  const int width = depth.layout().width, height = depth.layout().height;
  const auto linear = encoding.srgb ? without_curve(depth) : std::function<float(float)>();
  const auto at = [&](int x, int y) {
    const float value = depth.at(x, encoding.bottom_up ? height - 1 - y : y);
    return linear ? linear(value) : value;
  };
  return meaning_by_normals({at, width, height}, stored.found.sign, stored.found.background, stored.window,
                            stored.camera, stored.normals);
}

/// Whether a meaning leaves room for an encoding.
bool is_doubtful(const std::optional<ToldByNormals>& told) {
  constexpr double most = 1.5, most_with_pole = 0.6;  // degrees
  if (!told) return true;
  return told->meaning.taken.degrees > (told->meaning.taken.meaning.pole != 0 ? most_with_pole : most);
}

/// With the sRGB curve undone, if that agrees much better. A meaning with a pole of any value can come near to the curve, and is given up
/// for it sooner.
void try_curve(const Stored& stored, std::optional<ToldByNormals>& told) {
  constexpr double least_gain = 0.6, least_gain_over_a_pole = 0.95, most_alike_by_curve = 1.05;
  // Where most samples agree already, what is left is rounding, and the curve has to better those as well.
  constexpr double well_agreeing = 0.6, least_factor_of_medians = 0.7;
  if (stored.found.sign < 0 || !may_have_curve(stored.depth)) return;
  const auto meaning = meaning_of(stored, {.srgb = true});
  if (!meaning) return;
  if (!told) {
    told = {*meaning, {.srgb = true}};
    return;
  }
  const ReadDepth &taken = told->meaning.taken, &curved = meaning->taken;
  const std::optional<ReadDepth>& other = told->meaning.as_good_as;
  const bool has_pole = taken.meaning.pole != 0;
  const bool may_be = taken.median > well_agreeing || curved.median < least_factor_of_medians * taken.median;
  if (may_be && curved.degrees < (has_pole ? least_gain_over_a_pole : least_gain) * taken.degrees &&
      !(other && other->degrees < curved.degrees))
    told = {*meaning, {.srgb = true}};
  else if (has_pole && curved.degrees < most_alike_by_curve * taken.degrees)
    told->as_good_as = {{.srgb = true}, curved.degrees};
}

/// With the rows turned over, if that agrees much better, and not by normals in an odder convention.
void try_turned(const Stored& stored, std::optional<ToldByNormals>& told) {
  constexpr double least_factor = 0.5, least_gain = 1, least_gain_by_plainer = 0.3, most_alike_by_plainer = 1.5;
  const auto meaning = meaning_of(stored, {.bottom_up = true});
  if (!meaning) return;
  if (!told) {
    told = {*meaning, {.bottom_up = true}};
    return;
  }
  const ReadDepth &read = meaning->taken, &taken = told->meaning.taken;
  const bool is_plainer = read.departure < taken.departure;
  if (read.departure <= taken.departure && read.degrees < least_factor * taken.degrees &&
      read.degrees < taken.degrees - (is_plainer ? least_gain_by_plainer : least_gain))
    told = {*meaning, {.bottom_up = true}};
  else if (is_plainer && read.degrees < most_alike_by_plainer * taken.degrees)
    told->as_good_as = {{.bottom_up = true}, read.degrees};
}

}  // namespace

std::optional<ToldByNormals> told_by_normals(const Channel& depth, const StoredDepth& found, const Window& window,
                                             const Camera& camera, const NormalsBeside& normals, bool may_be_encoded) {
  const Stored stored{depth, found, window, camera, normals};
  std::optional<ToldByNormals> told;
  if (const auto meaning = meaning_of(stored, {})) told = {*meaning, {}};
  if (!may_be_encoded) return told;
  if (is_doubtful(told)) try_curve(stored, told);
  // Where one plane is all there is, turned rows are normals with another y.
  if (is_doubtful(told) || !told->meaning.taken.has_plain_axes) try_turned(stored, told);
  return told;
}

}  // namespace gloam
