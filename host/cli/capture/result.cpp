#include <cmath>
#include <numbers>

#include "cli/capture/command.h"
#include "gloam/error.h"
#include "gloam/margin.h"

namespace gloam::cli {
namespace {

/// Extent of a camera's image from its left to its right border: degrees, or scene units.
double span_of(const Camera& camera, int width) {
  const double left = camera.cx / camera.fx, right = (width - camera.cx) / camera.fx;
  if (camera.orthographic) return left + right;
  return (std::atan(left) + std::atan(right)) * 180 / std::numbers::pi;
}

/// The radius of a map of relevant surfaces; none of another map.
std::optional<double> radius_of_map(const StochasticOptions& options, const CaptureFigures& f) {
  if (!is_of_relevant(options)) return {};
  return options.radius ? options.radius : f.ao_radius;
}

Json stochastic_document(const StochasticOptions& options, const CaptureFigures& f) {
  if (options.samples == 0) return nullptr;
  const std::optional<double> radius = radius_of_map(options, f);
  const bool is_random = options.subset != StochasticSubset::nearest;
  return {{"samples", options.samples},
          {"surfaces", stochastic_surfaces()[size_t(options.surfaces)]},
          {"subset", stochastic_subsets()[size_t(options.subset)]},
          {"alpha", is_random ? Json(options.alpha) : Json()},
          {"seed", is_random ? Json(options.seed) : Json()},
          {"radius", radius ? Json(*radius) : Json()},
          {"max_reach", radius ? Json(options.max_reach) : Json()}};
}

Json outlines_document(const CaptureOptions& options, const CaptureFigures& f) {
  if (!options.outlines) return nullptr;
  const OutlineOptions& made = options.outlines->options();
  return {{"extent", made.extent},
          {"method", outline_methods()[size_t(made.method)]},
          {"angle", has_angle(made.method) ? Json(made.angle_degrees) : Json()},
          {"triangles", options.outlines->scene().faces()},
          {"triangles_of_scene", f.faces},
          {"ms", {{"build", 1e3 * options.outlines->build_seconds()}, {"count", 1e3 * f.outlines}}}};
}

Json second_view_document(const CaptureOptions& options, const CaptureFigures& f) {
  if (!f.visible) return nullptr;
  return {{"degrees", *options.second_view},
          {"nearest", f.visible->nearest},
          {"median", f.visible->median},
          {"farthest", f.visible->farthest},
          {f.second->orthographic ? "units_across" : "degrees_across", span_of(*f.second, options.width)}};
}

Json stereo_document(const CaptureOptions& options, const CaptureFigures& f) {
  if (!options.stereo) return nullptr;
  const StereoRig& rig = *options.stereo;
  return {{"interpupillary_distance", rig.interpupillary_distance},
          {"convergence", rig.convergence ? Json(*rig.convergence) : Json()},
          {"toe_in_degrees", toe_in_degrees(rig)},
          {"shift_pixels", f.shift}};
}

/// "4 samples of relevant surfaces (within 0.5 scene units), stratified, alpha 0.25"
std::string stochastic_in_words(const CaptureOptions& options, const CaptureFigures& f) {
  const StochasticOptions& map = options.stochastic;
  const std::optional<double> radius = radius_of_map(map, f);
  return fmt::format("{} samples of {} surfaces{}, {}{}", map.samples, stochastic_surfaces()[size_t(map.surfaces)],
                     radius ? fmt::format(" (within {:g} scene units)", *radius) : "",
                     stochastic_subsets()[size_t(map.subset)],
                     map.subset == StochasticSubset::nearest ? "" : fmt::format(", alpha {:g}", map.alpha));
}

/// "parallel", "converging at depth 2: images shifted by 6.9 pixels each"
std::string convergence_in_words(const StereoRig& rig, double shift) {
  if (!rig.convergence) return "parallel";
  return fmt::format("converging at depth {:g}: {}", *rig.convergence,
                     rig.toe_in ? fmt::format("each turned by {:.3g} degrees", toe_in_degrees(rig))
                                : fmt::format("images shifted by {:.3g} pixels each", shift));
}

}  // namespace

Json capture_document(const Scene& scene, const CaptureOptions& options, const CaptureFigures& f) {
  Json layers = nullptr;
  if (options.peel > 0) layers = {{"stored", options.peel}, {"mean", f.layers.mean()}, {"max", f.layers.most}};
  return {
      {"scene", scene.name},
      {"faces", f.faces},
      {"meshes", f.meshes},
      {"size", {options.width, options.height}},
      {"margin", {options.margin_x, options.margin_y}},
      {"files", f.files},
      {"layers", layers},
      {"stochastic", stochastic_document(options.stochastic, f)},
      {"outlines", outlines_document(options, f)},
      {"view2", second_view_document(options, f)},
      {"stereo", stereo_document(options, f)},
      {"ao_radius", f.ao_radius ? Json(*f.ao_radius) : Json()},
      {"rays", f.rays},
      {"rays_per_second", f.trace > 0 ? double(f.rays) / f.trace : 0},
      {"seconds",
       {{"load", f.load}, {"build", f.build}, {"trace", f.trace}, {"stochastic", f.stochastic}, {"write", f.write}}}};
}

void print_capture(const Scene& scene, const CaptureOptions& options, const CaptureFigures& f) {
  const Margin margin = {options.margin_x, options.margin_y, options.margin_x, options.margin_y};
  fmt::print("{}: {} faces in {} meshes, {}x{}{}\n", printable(scene.name), f.faces, f.meshes, options.width,
             options.height, margin.any() ? ", and a margin of " + in_words(margin) : "");
  fmt::print("{}{}\n", printable(f.camera),
             f.ao_radius ? fmt::format("; AO radius that suits: {:g} scene units", *f.ao_radius) : "");
  if (options.peel > 0)
    fmt::print("layers under a pixel: mean {:.2f}, most {}; {} stored\n", f.layers.mean(), f.layers.most, options.peel);
  if (options.stochastic.samples > 0)
    fmt::print("stochastic depth: {}; choosing them took {:.3f} s of the tracing\n", stochastic_in_words(options, f),
               f.stochastic);
  if (options.outlines)
    fmt::print("outlines: {:g} scene units away, {}; building them took {:.3f} s, counting {:.3f} s of the tracing\n",
               options.outlines->options().extent, outline_methods()[size_t(options.outlines->options().method)],
               options.outlines->build_seconds(), f.outlines);
  if (f.visible)
    fmt::print("view2: turned {:g} degrees about depth {:g}, holds depths {:g} to {:g}, {:.3g} {} across\n",
               *options.second_view, f.visible->median, f.visible->nearest, f.visible->farthest,
               span_of(*f.second, options.width), f.second->orthographic ? "scene units" : "degrees");
  if (options.stereo)
    fmt::print("stereo: eyes {:g} scene units apart, {}\n", options.stereo->interpupillary_distance,
               convergence_in_words(*options.stereo, f.shift));
  fmt::print("load {:.2f} s, build {:.2f} s, trace {:.2f} s ({:.1f} million rays per second), write {:.2f} s\n", f.load,
             f.build, f.trace, f.trace > 0 ? double(f.rays) / f.trace * 1e-6 : 0.0, f.write);
  if (f.files.size() == 1)
    fmt::print("wrote {}\n", printable(f.files.front()));
  else
    fmt::print("wrote {} files, {} to {}\n", f.files.size(), printable(f.files.front()), printable(f.files.back()));
}

}  // namespace gloam::cli
