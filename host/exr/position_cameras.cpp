#include "exr/position_cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/lists.h"
#include "base/words.h"
#include "exr/position_samples.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

constexpr int rows_to_fit = 16, rows_to_check = 6;
constexpr double least_disagreement = 2;  ///< pixels: a camera file of the frame never lies this far off

/// "ViewLayer.Position" for ViewLayer.Position.X, Y and Z.
std::string layer_of(const PlaneSource& position) {
  const std::string& name = position.channels.front().name;
  const size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(0, dot);
}

std::string of_view(const std::string& view) { return view.empty() ? "" : fmt::format(" of view '{}'", view); }

/// "0.02 pixels (median), 0.1 (99 %)"
std::string residual_in_words(double median, double percentile_99) {
  return fmt::format("{:.2g} pixels (median), {:.2g} (99 %)", median, percentile_99);
}

std::string camera_in_words(const Camera& camera) {
  return fmt::format("{}fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f}", camera.orthographic ? "orthographic, " : "",
                     camera.fx, camera.fy, camera.cx, camera.cy);
}

/// A pose at the origin along an axis, which positions in camera space lead to: x to the right, and y up or down.
bool is_of_camera_space(const Camera& camera, const std::vector<PositionedPixel>& pixels) {
  double distance = 0;
  for (const PositionedPixel& pixel : pixels)
    distance += glm::distance(pixel.world, camera.pose->position) / double(pixels.size());
  const glm::dmat3& turn = camera.pose->world_to_view;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      if (std::abs(std::abs(turn[c][r]) - (c == r ? 1 : 0)) > 1e-3) return false;
  const glm::dvec3 off = camera.orthographic ? glm::dvec3(glm::dvec2(camera.pose->position), 0) : camera.pose->position;
  return turn[0][0] > 0 && glm::length(off) < 1e-3 * distance;
}

class Settling {
 public:
  Settling(ExrFile& file, FileCameras& cameras) : file_(file), cameras_(cameras) {}

  void all() {
    std::map<std::string, PositionSamples> few, many;
    for (const std::string& view : file_.names.views) {
      if (!file_.source("position", view) || is_module(view)) continue;
      if (lacks_pose(view)) {
        if (many.empty()) many = sampled(rows_to_fit);
        fit(view, many[view]);
      } else {
        if (few.empty()) few = sampled(rows_to_check);
        check(view, few[view], many);
      }
    }
    replace_strange_depth();
    drop_depth_without_camera();
  }

 private:
  /// None of the positions of a file whose positions are damaged: what needs none of them goes on.
  std::map<std::string, PositionSamples> sampled(int rows) {
    try {
      return sample_positions(file_, rows);
    } catch (const Error& error) {
      note(fmt::format("camera: the positions cannot be read: {}", error.what()));
      std::map<std::string, PositionSamples> none;
      for (const std::string& view : file_.names.views) none[view];
      return none;
    }
  }

  bool is_module(const std::string& view) const {
    const auto camera = cameras_.cameras.find(view);
    return camera != cameras_.cameras.end() && camera->second.slits;
  }

  bool lacks_pose(const std::string& view) const {
    const auto camera = cameras_.cameras.find(view);
    return camera == cameras_.cameras.end() || !camera->second.pose;
  }

  CameraFit fitted(const PositionSamples& samples) const {
    return fit_camera(samples.pixels, {file_.display, file_.pixel_aspect});
  }

  /// Whether names or Blender's header say that positions are in the world, whatever a fit finds.
  bool are_declared_world(const std::string& view) const {
    if (!file_.headers.text("BlenderMultiChannel").empty() || file_.headers.has("gloamOrigin")) return true;
    return lower(layer_of(*file_.source("position", view))).find("world") != std::string::npos;
  }

  std::string from_in_words(const std::string& view, const DepthRelation& relation) const {
    const PlaneSource* depth = file_.source("depth", view);
    const bool has_depth = depth && depth->said != DeclaredConvention::made_of_positions;
    std::string words = layer_of(*file_.source("position", view));
    if (has_depth && relation.kind != DepthRelation::neither) words += " and " + depth->channels.front().name;
    return words;
  }

  /// "; Z is planar"
  std::string depth_in_words(const std::string& view, const DepthRelation& relation) const {
    if (relation.kind != DepthRelation::planar && relation.kind != DepthRelation::along_ray) return "";
    return fmt::format("; {} is {}", file_.source("depth", view)->channels.front().name,
                       relation.kind == DepthRelation::planar ? "planar" : "along the ray");
  }

  void note(const std::string& sentence) { add_new(cameras_.notes, sentence); }

  void fit(const std::string& view, const PositionSamples& samples) {
    CameraFit found = fitted(samples);
    const std::string layer = layer_of(*file_.source("position", view));
    if (!found.why_refused.empty()) {
      note(fmt::format("camera{}: not fitted to the positions {}: {}", of_view(view), layer, found.why_refused));
      cameras_.why_not_fitted[view] = found.why_refused;
      return;
    }
    PositionFindings findings;
    findings.background = samples.background;
    findings.depth = found.camera.orthographic ? place_by_depth(found.camera, samples.pixels)
                                               : relate_depth(found.camera, samples.pixels);
    findings.camera = found.camera;
    findings.is_fitted = true;
    findings.median = found.median;
    findings.percentile_99 = found.percentile_99;
    findings.in_camera_space = is_of_camera_space(found.camera, samples.pixels) && !are_declared_world(view);
    note(fmt::format("camera{} fitted from {}: {}, residual {}{}", of_view(view), from_in_words(view, findings.depth),
                     camera_in_words(found.camera), residual_in_words(found.median, found.percentile_99),
                     what_it_tells(view, found, findings.depth, samples)));
    if (findings.in_camera_space)
      note(fmt::format("positions{}: {} is in camera space, so the camera's place in the world stays unknown",
                       of_view(view), layer));
    take(view, findings, samples);
    cameras_.positions.emplace(view, std::move(findings));
  }

  /// What else a fit found, assumed or may surprise with, as the end of its note.
  std::string what_it_tells(const std::string& view, const CameraFit& fit, const DepthRelation& relation,
                            const PositionSamples& samples) const {
    std::string words;
    const glm::dvec2 off =
        glm::dvec2(fit.camera.cx, fit.camera.cy) -
        glm::dvec2((file_.display.x0 + file_.display.x1) / 2.0, (file_.display.y0 + file_.display.y1) / 2.0);
    const bool is_half = std::abs(std::abs(off.x) - 0.5) < 0.05 && std::abs(std::abs(off.y) - 0.5) < 0.05;
    if (is_half && !fit.camera.orthographic)
      words += "; positions are those of the pixels' corners, not of their centres";
    words += depth_in_words(view, relation);
    if (fit.assumption == FitAssumption::square_pixels) words += "; square pixels are assumed";
    if (fit.assumption == FitAssumption::centred_lens)
      words += "; square pixels and a centred lens are assumed, as the positions do not tell";
    if (fit.rounding > 0.1) words += fmt::format("; the rounding of the positions makes {:.2g} of it", fit.rounding);
    const bool has_depth = std::any_of(samples.pixels.begin(), samples.pixels.end(),
                                       [](const PositionedPixel& pixel) { return std::isfinite(pixel.depth); });
    if (fit.camera.orthographic && !has_depth)
      words += "; where the camera stands along its axis is chosen, and a right-handed world assumed";
    return words;
  }

  /// Uses a fit for what nothing else gave. A pose of the header stays, and so do near and far.
  void take(const std::string& view, const PositionFindings& findings, const PositionSamples& samples) {
    std::optional<Pose> pose = findings.in_camera_space ? std::nullopt : findings.camera->pose;
    const auto known = cameras_.cameras.find(view);
    if (known != cameras_.cameras.end()) {
      Camera both = known->second;
      both.pose = findings.camera->pose;
      compare(view, both, samples, *findings.camera);
      known->second.pose = pose;
      return;
    }
    Camera camera = *findings.camera;
    camera.source = "fitted to positions";
    camera.pose = pose;
    if (const auto of_header = cameras_.poses.find(view); of_header != cameras_.poses.end()) {
      Camera both = camera;
      both.pose = of_header->second;
      compare(view, both, samples, *findings.camera);
      camera.pose = of_header->second;
    }
    camera.near = file_.options.near;
    camera.far = file_.options.far;
    cameras_.cameras.emplace(view, camera);
  }

  /// Adds a note if a known camera does not lead to the positions. Returns whether it does.
  bool compare(const std::string& view, const Camera& known, const PositionSamples& samples, const Camera& better) {
    const double error = share_below(position_errors(known, samples.pixels), 0.5);
    if (error <= disagreement(known, samples)) return true;
    note(fmt::format(
        "camera{}: {} does not fit the positions: {}; a camera fitted to them has {}{}: is it the camera of "
        "this frame?",
        of_view(view), known.source.empty() ? "it" : known.source, off_in_words(error), camera_in_words(better),
        differs_in_place(known, better)));
    return false;
  }

  static std::string off_in_words(double error) {
    return std::isfinite(error) ? fmt::format("they lie {:.3g} pixels off (median)", error)
                                : std::string("most lie behind the camera");
  }

  static std::string differs_in_place(const Camera& known, const Camera& better) {
    const glm::dvec3 p = better.pose->position;
    if (!known.pose || glm::distance(known.pose->position, p) <= 1e-3 * (1 + glm::length(p))) return "";
    return fmt::format(" and stands at ({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
  }

  static double disagreement(const Camera& camera, const PositionSamples& samples) {
    return std::max(least_disagreement, 2 * allowed_error(camera, samples.pixels));
  }

  void check(const std::string& view, const PositionSamples& few, std::map<std::string, PositionSamples>& many) {
    if (few.pixels.empty()) return;
    const Camera& known = cameras_.cameras.at(view);
    const std::vector<double> errors = position_errors(known, few.pixels);
    PositionFindings findings;
    findings.background = few.background;
    findings.camera = known;
    findings.median = share_below(errors, 0.5);
    findings.percentile_99 = share_below(errors, 0.99);
    findings.agrees = findings.median <= disagreement(known, few);
    if (findings.agrees && !known.orthographic) findings.depth = relate_depth(known, few.pixels);
    if (!findings.agrees) explain(view, findings, many);
    cameras_.positions.emplace(view, std::move(findings));
  }

  /// Says what a camera would look like that positions lead to, if they lead to any.
  void explain(const std::string& view, PositionFindings& findings, std::map<std::string, PositionSamples>& many) {
    if (many.empty()) many = sampled(rows_to_fit);
    const PositionSamples& samples = many[view];
    const CameraFit better = fitted(samples);
    const Camera& known = cameras_.cameras.at(view);
    if (!better.why_refused.empty()) {
      note(fmt::format("camera{}: {} does not fit the positions, and no other camera does: {}", of_view(view),
                       known.source, off_in_words(findings.median)));
      return;
    }
    if (is_of_camera_space(better.camera, samples.pixels) && !are_declared_world(view)) {
      findings.in_camera_space = true;
      findings.camera = better.camera;
      findings.median = better.median;
      findings.percentile_99 = better.percentile_99;
      note(fmt::format("positions{}: {} is in camera space and not used", of_view(view),
                       layer_of(*file_.source("position", view))));
      Camera here = known;
      here.pose = better.camera.pose;
      compare(view, here, samples, better.camera);
      return;
    }
    compare(view, known, samples, better.camera);
  }

  /// A depth of which nothing is stated, and that fits the positions in no way, gives way to one that is made of them: a grey has no lengths.
  void replace_strange_depth() {
    const ReadOptions& options = file_.options;
    const bool is_stated = states_anything(options.stated_depth()) || options.channels.contains("depth") ||
                           options.plane_files.contains("depth") || file_.headers.has("gloamOrigin");
    if (is_stated || options.unconverted || (options.as_stored && !options.only_looks)) return;
    for (PlaneSource& depth : file_.names.planes) {
      const auto found = cameras_.positions.find(depth.view);
      if (depth.plane != "depth" || depth.said != DeclaredConvention::nothing || found == cameras_.positions.end() ||
          found->second.depth.kind != DepthRelation::neither)
        continue;
      const std::string name = depth.channels.front().name;
      note(fmt::format(
          "depth{}: made from the positions, since '{}' is neither their planar distance nor their distance "
          "along the ray; {} reads it all the same",
          of_view(depth.view), name, channels_option("depth", name)));
      depth = {"depth", depth.view, file_.source("position", depth.view)->channels,
               DeclaredConvention::made_of_positions};
    }
  }

  /// A view whose depth was to be made from positions has none where nothing tells the pose.
  void drop_depth_without_camera() {
    std::erase_if(file_.names.planes, [&](const PlaneSource& source) {
      return source.said == DeclaredConvention::made_of_positions && !cameras_.positions.contains(source.view);
    });
  }

  ExrFile& file_;
  FileCameras& cameras_;
};

}  // namespace

bool has_positions(const ExrFile& file) {
  return std::any_of(file.names.planes.begin(), file.names.planes.end(), [](const PlaneSource& source) {
    return source.plane == "position" && source.channels.size() == 3;
  });
}

void settle_by_positions(ExrFile& file, FileCameras& cameras) { Settling(file, cameras).all(); }

}  // namespace gloam
