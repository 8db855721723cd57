#include "normalise/radiance.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/unfit.h"
#include "normalise/each_row.h"

namespace gloam {
namespace {

/// Components of a row that are compared with the steps of 8 bits.
constexpr int tried_of_row = 64;
/// A picture of fewer values, or of fewer different ones, tells nothing.
constexpr long long least_tried = 256;
constexpr size_t least_levels = 16;
/// Share of the values that may lie between the steps.
constexpr double most_between = 0.001;
/// Share of the pixels with a component above 1 from which a plane is no albedo: filters overshoot on fewer.
constexpr double most_above_one = 0.01;
/// Share of the pixels without a finite value from which a plane is no colour.
constexpr double most_without_light = 0.5;

/// The sRGB curve (IEC 61966-2-1), of light from 0 to 1.
double encoded(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

/// Sets the level of a value that is a multiple of 1/255, but for rounding to half (up to 2^-11 of the value).
bool is_step(double value, std::bitset<256>& levels) {
  const double k = std::round(255 * value);
  if (std::abs(255 * value - k) > 5e-4 * k + 1e-4) return false;
  levels.set(size_t(k));
  return true;
}

void try_steps(const float* row, int width, ColourCounts& counts) {
  const int stride = std::max(1, width / tried_of_row);
  for (int x = 0; x < width; x += stride) {
    if (row[x] > 1 && row[x] < infinity) {
      const bool is_whole = row[x] == std::floor(row[x]);
      ++counts.above_one;
      counts.whole += is_whole;
      if (is_whole) counts.levels_of_whole.set(size_t(std::fmod(row[x], 256.0f)));
      counts.greatest = std::max(counts.greatest, row[x]);
    }
    if (!(row[x] > 0 && row[x] < 1)) continue;
    ++counts.tried;
    counts.steps += is_step(row[x], counts.levels);
    counts.steps_of_light += is_step(encoded(row[x]), counts.levels_of_light);
  }
}

bool is_surface_at(const float* depth, int x) { return !depth || !is_background(depth[x]); }

ColourCounts colour_of_row(const Plane& plane, int y, const float* depth) {
  ColourCounts counts;
  const int width = plane.channels.front().layout().width;
  counts.pixels = width;
  std::vector<unsigned char> negative(size_t(width), 0), nonfinite(size_t(width), 0);
  for (const Channel& channel : plane.channels) {
    const float* row = channel.row(y);
    for (int x = 0; x < width; ++x) {
      negative[size_t(x)] |= row[x] < 0 && row[x] > -infinity;
      nonfinite[size_t(x)] |= !(std::abs(row[x]) < infinity);
      counts.outside += row[x] < 0 || row[x] > 1;
    }
    try_steps(row, width, counts);
  }
  counts.negative = std::count(negative.begin(), negative.end(), 1);
  counts.nonfinite = std::count(nonfinite.begin(), nonfinite.end(), 1);
  for (int x = 0; x < width; ++x) {
    counts.surfaces += is_surface_at(depth, x);
    counts.dark_surfaces += nonfinite[size_t(x)] && is_surface_at(depth, x);
  }
  return counts;
}

void merge(ColourCounts& sum, const ColourCounts& counts) {
  sum.pixels += counts.pixels;
  sum.negative += counts.negative;
  sum.nonfinite += counts.nonfinite;
  sum.surfaces += counts.surfaces;
  sum.dark_surfaces += counts.dark_surfaces;
  sum.outside += counts.outside;
  sum.tried += counts.tried;
  sum.steps += counts.steps;
  sum.steps_of_light += counts.steps_of_light;
  sum.above_one += counts.above_one;
  sum.whole += counts.whole;
  sum.greatest = std::max(sum.greatest, counts.greatest);
  sum.levels_of_whole |= counts.levels_of_whole;
  sum.levels |= counts.levels;
  sum.levels_of_light |= counts.levels_of_light;
}

bool has_eight_bits(const ColourCounts& counts, long long steps, const std::bitset<256>& levels) {
  return counts.outside == 0 && counts.tried >= least_tried && levels.count() >= least_levels &&
         double(counts.tried - steps) <= most_between * double(counts.tried);
}

/// Whether all values are whole numbers, as those of an integer picture: 0 to 255, or 0 to 65535.
bool has_whole_numbers(const ColourCounts& counts) {
  return counts.tried == 0 && counts.above_one >= least_tried && counts.whole == counts.above_one &&
         counts.levels_of_whole.count() >= least_levels;
}

/// "3 pixels are" of 100 pixels.
std::string pixels_are(long long count, long long pixels) {
  return fmt::format("{} pixel{} of {} {}", count, count == 1 ? "" : "s", pixels, count == 1 ? "is" : "are");
}

AlbedoCounts albedo_of_row(const Plane& plane, int y, const float* depth) {
  AlbedoCounts counts;
  const int width = plane.channels.front().layout().width;
  for (int x = 0; x < width; ++x) {
    if (!is_surface_at(depth, x)) continue;
    ++counts.pixels;
    bool above = false, below = false;
    for (const Channel& channel : plane.channels) {
      above |= channel.at(x, y) > 1;
      below |= !(channel.at(x, y) >= 0);
    }
    counts.above_one += above;
    counts.negative += below;
  }
  return counts;
}

void merge(AlbedoCounts& sum, const AlbedoCounts& counts) {
  sum.pixels += counts.pixels;
  sum.above_one += counts.above_one;
  sum.negative += counts.negative;
}

/// A note, or the verdict that the plane is unfit.
std::string note_or_verdict(const Unfit& found, bool is_judged) {
  return is_judged ? note_on(found) : fmt::format("{}: {}", found.plane, found.why);
}

std::vector<std::string> notes_on(const ColourCounts& counts, bool is_judged) {
  std::vector<std::string> notes;
  if (counts.nonfinite > 0) {
    const bool is_unfit = is_judged && counts.dark_surfaces > 0 &&
                          double(counts.dark_surfaces) >= most_without_light * double(counts.surfaces);
    notes.push_back(
        note_or_verdict({"color", fmt::format("{} infinite or NaN and taken for black: their light is missing",
                                              pixels_are(counts.nonfinite, counts.pixels))},
                        is_unfit));
  }
  if (counts.negative > 0)
    notes.push_back(
        fmt::format("color: {} negative; as a source of light or in a reflection, a negative component is 0",
                    pixels_are(counts.negative, counts.pixels)));
  if (has_whole_numbers(counts))
    notes.push_back(note_or_verdict(
        {"color", fmt::format("it holds whole numbers up to {:g}, as an integer picture has them, and is taken for "
                              "scene-linear light; give the renderer's linear colour, or divide by {} and take the "
                              "display's curve out",
                              counts.greatest, counts.greatest > 255 ? 65535 : 255)},
        is_judged));
  else if (has_eight_bits(counts, counts.steps, counts.levels))
    notes.push_back(note_or_verdict(
        {"color",
         "it holds the steps of an 8-bit picture from 0 to 1, as the sRGB curve of a display has them, and is taken "
         "for "
         "scene-linear light: what is computed from it will be too bright in the dark and too dark in the bright; give "
         "the renderer's linear colour"},
        is_judged));
  else if (has_eight_bits(counts, counts.steps_of_light, counts.levels_of_light))
    notes.push_back(fmt::format(
        "color: it holds the steps of an 8-bit sRGB picture made linear, and nothing above 1: light of lamps and of "
        "the sky may have been cut off; give the renderer's own colour ({} names another)",
        channels_option("color", "CHANNELS")));
  return notes;
}

std::vector<std::string> notes_on(const AlbedoCounts& counts, bool is_judged) {
  std::vector<std::string> notes;
  if (counts.above_one > 0) {
    const bool is_unfit = is_judged && double(counts.above_one) >= most_above_one * double(counts.pixels);
    notes.push_back(note_or_verdict(
        {"albedo", fmt::format("{} above 1, which no surface reflects, and cut to 1; is it a colour with light in it?",
                               pixels_are(counts.above_one, counts.pixels))},
        is_unfit));
  }
  if (counts.negative > 0)
    notes.push_back(fmt::format("albedo: {} negative or NaN, and black", pixels_are(counts.negative, counts.pixels)));
  return notes;
}

}  // namespace

void LightCounts::add_row(const View& view, int y, const float* depth) {
  if (const Plane* plane = view.find("color")) {
    const ColourCounts row = colour_of_row(*plane, y, depth);
#pragma omp critical(light_counts)
    merge(color, row);
  }
  if (const Plane* plane = view.find("albedo")) {
    const AlbedoCounts row = albedo_of_row(*plane, y, depth);
#pragma omp critical(light_counts)
    merge(albedo, row);
  }
}

void LightCounts::add(const View& view, const Plane* depth, int first_row) {
  for (const char* name : {"color", "albedo"}) {
    if (const Plane* plane = view.find(name)) {
      for_each_row(plane->channels.front().layout(),
                   [&](int y) { add_row(view, y, depth ? depth->channels.front().row(first_row + y) : nullptr); });
      return;
    }
  }
}

std::vector<std::string> LightCounts::notes(const std::vector<std::string>& judged) const {
  std::vector<std::string> notes = notes_on(color, contains(judged, "color"));
  for (std::string& note : notes_on(albedo, contains(judged, "albedo"))) notes.push_back(std::move(note));
  return notes;
}

bool is_linear(const std::string& color_interop_id) {
  return color_interop_id.empty() || color_interop_id.starts_with("lin_") || color_interop_id == "data" ||
         color_interop_id == "unknown";
}

}  // namespace gloam
