// The whole picture of a captured frame, of ray-traced parts: the truth of `gloam auto --composite`.
#pragma once

#include <memory>
#include <optional>

#include "gloam/composition.h"
#include "gloam/environment_map.h"
#include "gloam/scene/reference.h"

namespace gloam {

struct CompositeReferenceOptions : ReferenceOptions {
  int reflection_samples = 1024;  ///< rays per pixel of reflections; `samples`: of all other parts
  std::optional<ColorHolds> holds =
      {};  ///< empty: as the frame's attribute gloamColorHolds says, else ambient and shadows
  std::optional<std::array<double, 3>> ambient = {};       ///< as in `ComposeOptions`
  std::shared_ptr<const EnvironmentMap> environment = {};  ///< null: the frame's own ambient light stays
};

/// Traces the parts that the picture is made of, by their own references: `ao` (or `bounces`), `indirect`, `reflection`, `environment`
/// if there is one, `contact` with the scene's sun if the colour holds no shadows; then `compose` (composition.h).
///
/// `frame`: planes `depth`, `color` and, as far as it has them, `normal`, `ambient`, `albedo`, `metallic`, `roughness`, `reflectance`.
/// Planes of the result: `color`, the whole picture; `color_noise`, which the parts' noises make in it, taken as independent of each
/// other; the parts, their noises, `depth`. Attributes: colorSamples, colorNoise, colorDefinition, gloamColorHolds, gloamComposite,
/// and those of the parts. Each part has a checkpoint of its own, the name with the part's behind.
/// Throws Error for a frame without color, and as the parts' references do.
Reference composite_reference(const Tracer& tracer, const Frame& frame, const CompositeReferenceOptions& options);

}  // namespace gloam
