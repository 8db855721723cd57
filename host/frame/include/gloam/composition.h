// The whole picture of a frame: its colour, and what was computed of its light, nothing counted twice.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/color_holds.h"
#include "gloam/frame.h"

namespace gloam {

struct ComposeOptions {
  ColorHolds holds = {};
  /// Radiance of an even sky that the ambient light is of: in place of the plane `ambient`, where given.
  std::optional<std::array<double, 3>> ambient = {};
  /// What the file calls planes, for notes: {"emission", "ViewLayer.Emit"}. May be empty.
  std::map<std::string, std::string> names_in_file = {};
};

/// A part of a view's picture, without one effect's planes and with them.
struct PicturePart {
  double left = 0, top = 0, width = 1, height = 1;  ///< shares of the image
  Plane without, with;                              ///< its colour, linear
  int step = 1;                                     ///< every `step`-th pixel of every `step`-th row of the image
};

/// One plane of those that were computed.
struct ComposedPart {
  std::string plane;
  bool is_used = false;
  std::string how;  ///< what it does in the picture, or why it is not used: "the colour holds shadows already"
};

struct Composition {
  std::vector<ComposedPart>
      parts;  ///< of the planes computed those that a picture can be made of, in the order of `part_planes`
  std::vector<std::string> notes;      ///< a sentence each
  std::vector<std::string> untouched;  ///< planes of light that no occlusion darkens
  enum class Ambient {
    plane,
    even_sky,
    illumination,
    colour,
    unknown
  } ambient = Ambient::unknown;  ///< where ambient light is taken from
  ComposeOptions options;
  bool uses(const std::string& plane) const;
};

/// The planes that a picture can be made of, beside colour: ao, bounces, indirect, reflection, environment, contact.
const std::vector<std::string>& part_planes();
/// The planes of the frame itself that composing reads, as far as the frame has them: color, ambient, albedo, metallic, depth, illumination,
/// and light that is left as it is: emission, backdrop, volume, transmission.
const std::vector<std::string>& planes_to_compose();

/// Decides what a picture is made of, given the names of the frame's own planes and of those that were computed. Throws UsageError
/// for `ComposeOptions::ambient` where the frame has no albedo, and Error for a frame without color.
Composition composition_of(const std::vector<std::string>& frame, const std::vector<std::string>& computed,
                           const ComposeOptions& options);

/// What the picture holds, as a frame's color.
ColorHolds holds_of_picture(const Composition& composition);
/// Text for the picture's header: gloamColorHolds, and gloamComposite: "ao reflection; color had ambient,shadows; ambient: plane".
std::map<std::string, std::string> attributes_of(const Composition& composition);

/// Makes the view's color the whole picture. With C its color, A its ambient light, D its diffuse albedo (albedo (1 - metallic)),
/// scene-linear, for each pixel and channel:
///   C
///   + (V - 1) A                       V: `bounces`, else `ao`; where C does not hold ambient light, V A
///   or + D environment - A            where there is `environment`: its light in place of the ambient light
///   + D indirect
///   + reflection
///   + (contact - 1) max(C - A - U, 0)  where C does not hold shadows
/// U is the sum of emission, backdrop, volume and transmission. A is the plane `ambient`, or albedo times the even sky, or albedo times
/// `illumination`, or all of C if none is known; where C holds ambient light, A is at most C - U. Colour keeps its bits where nothing is added, where the picture would not be finite, and on the background (depth, where
/// the view has it, of +inf). Planes are of any one size. Throws Error for sizes that differ.
void compose(View& colour, const View& computed, const Composition& composition);

/// The same for all views; `composition_of` the planes that all views have.
Composition compose(Frame& colour, const Frame& computed, const ComposeOptions& options);

}  // namespace gloam
