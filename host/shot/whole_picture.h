// A frame's colour with all effects that were computed for it, as one picture.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "auto/report.h"
#include "gloam/composition.h"
#include "gloam/unfit.h"
#include "shot/colour_layer.h"

namespace gloam {

/// How light is counted in a whole picture.
struct LightChoice {
  std::optional<ColorHolds> holds;               ///< none: as the file says
  std::optional<std::array<double, 3>> ambient;  ///< radiance of an even sky; none: a plane of the frame
};

/// The colour of a frame, and what else of it a picture is made of, as the files store it.
struct CompositeSource {
  ColourLayer layer;
  ComposeOptions options;
  std::vector<std::string> notes;  ///< what is assumed
  Frame colour;                    ///< once it is read
};

/// How a frame's light is counted, with notes on what is assumed; the usual where it has no colour. Throws UsageError for a choice that a
/// frame without colour has no use for.
ComposeOptions compose_options(const LightChoice& light, const FrameFiles& files, std::vector<std::string>& notes);

/// `light`: none where no composite is asked for. Throws Error for a frame without colour, with the effects that fall
/// away; UsageError for ambient light and a frame without albedo.
std::optional<CompositeSource> open_composite(const std::optional<LightChoice>& light,
                                              const std::vector<std::string>& paths, const ReadOptions& options);

/// Composes without the planes that are unfit. Throws Error where colour is one.
void leave_out(std::optional<CompositeSource>& source, const std::vector<Unfit>& unfit);

/// Memory for a composite; 0 for none.
unsigned long long bytes_of(const std::optional<CompositeSource>& source);

/// A whole picture.
struct Composite {
  Frame picture;
  Composition composition;
  std::string like;                      ///< the file whose header it takes over
  int part = 0;                          ///< of that file
  std::vector<std::string> half_planes;  ///< as that file stores them
};

void read_colour(CompositeSource& source);

/// Takes the colour that was read. `computed`: the planes of the effects, and how they were made.
Composite make_composite(CompositeSource& source, const Frame& computed);
/// `writing`: its compression and its margin.
void write_composite(const std::string& path, const Composite& composite, const WriteOptions& writing);

}  // namespace gloam
