#include "planner/picture_model.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "technique/data_files.h"

namespace gloam {
namespace {

/// Names a table in place of the library's own.
constexpr const char* other_figures = "GLOAM_EFFECT_ERRORS";
/// Of a preset's own noise what is left where pixels are filled in from several.
constexpr double noise_left = 0.5;

/// No picture is expected to err less than by this share of the true change's mean square: the sum of what is expected may be negative.
constexpr double least_share = 0.02;

using GoTogether = std::function<bool(const std::vector<std::string>&)>;

nlohmann::json read_figures() {
  const char* path = std::getenv(other_figures);
  if (!path || !*path) return nlohmann::json::parse(data_files().at("effect_errors.json"));
  const nlohmann::json table = nlohmann::json::parse(read_text(path), nullptr, false);
  for (const char* part : {"truth", "unforeseen", "truth_uncertainty", "unreached", "with_truth", "best_over_seen",
                           "uncertainty", "presets", "resolutions"})
    if (!table.is_object() || !table.contains(part))
      throw Error("{}={} is no table of errors (no '{}'); bench/picture_fit.py makes one", other_figures, path, part);
  return table;
}

const nlohmann::json& figures() {
  static const nlohmann::json table = read_figures();
  return table;
}

size_t place_of(const std::vector<std::string>& names, const std::string& name) {
  return size_t(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Of a plane's product with itself the part that is no noise: neighbours have it too.
constexpr const char* not_noise = "not_noise";

bool is_of_effect(const std::string& name) {
  return name != hidden_light && name != hidden_even_light && name != light_not_found;
}

/// Nothing was fitted to pictures under an environment's light, or with contact shadows: such a plane is taken for true.
bool is_fitted(const std::string& name) { return !is_of_effect(name) || figures().at("with_truth").contains(name); }

/// An environment's light is in place of the ambient light, so that occlusion of that is no part of the true change.
bool is_replaced(const SeenChanges& seen, const std::string& name) {
  return (name == "ao" || name == "bounces") && contains(seen.names, "environment");
}

/// How much of a product that the look sees is in the product with the true change.
double share_in_truth(const SeenChanges& seen, const std::string& plane, const std::string& other) {
  if (!is_fitted(other)) return 1;
  if (is_replaced(seen, other) || !is_fitted(plane)) return 0;
  return figures().at("with_truth").at(plane).value(other, 0.0);
}

/// The same of the part of a plane's product with itself that is no noise.
double share_of_not_noise(const SeenChanges& seen, const std::string& plane) {
  return is_replaced(seen, plane) || !is_fitted(plane) ? 0 : figures().at("with_truth").at(plane).value(not_noise, 0.0);
}

/// The share of a change that is in the true one, pixel by pixel.
double share_of_truth(const SeenChanges& seen, const std::string& name) {
  if (!is_fitted(name)) return 1;
  return is_replaced(seen, name) ? 0 : figures().at("truth").value(name, 0.0);
}

/// How many times as much the best options change together as the look sees.
double best_over_seen(const std::string& a, const std::string& b) {
  const nlohmann::json& ratios = figures().at("best_over_seen");
  const auto found = ratios.find(std::min(a, b));
  return found == ratios.end() ? 1 : found->value(std::max(a, b), 1.0);
}

/// Mean of the square of the true change, as the look sees it.
double seen_truth(const SeenChanges& seen) {
  double square = 0;
  for (size_t i = 0; i < seen.names.size(); ++i)
    for (size_t j = 0; j < seen.names.size(); ++j)
      square += share_of_truth(seen, seen.names[i]) * share_of_truth(seen, seen.names[j]) * seen.products[i][j];
  return std::max(square, 0.0);
}

/// What an option keeps, and its noise: `fit` at the detail that the look saw.
UsedPlane fitted(const std::string& plane, const nlohmann::json& fit, double lost_when_coarser) {
  const auto at = [&](int i) {
    return fit.at(size_t(i)).get<double>() + fit.at(size_t(i) + 1).get<double>() * lost_when_coarser;
  };
  return {plane, 1 - std::clamp(at(0), 0.0, 1.0), std::max(at(2), 0.0)};
}

const nlohmann::json& row_for(const char* table, const std::string& plane) {
  const nlohmann::json& rows = figures().at(table);
  const auto found = rows.find(plane);
  return found == rows.end() ? rows.at("ao") : *found;
}

/// By how much the best planes of some effects are expected to lessen the square of the error, at most.
double most_explained(const PictureModel& model, const GoTogether& go_together) {
  double most = 0;
  for (size_t subset = 0; subset < size_t(1) << model.planes.size(); ++subset) {
    std::vector<std::string> names;
    std::vector<UsedPlane> best;
    double common = 0;
    for (size_t i = 0; i < model.planes.size(); ++i) {
      if (!(subset >> i & 1)) continue;
      names.push_back(model.planes[i]);
      best.push_back({model.planes[i]});
      common += model.with_truth[i];
    }
    if (go_together(names)) most = std::max(most, 2 * common - mean_square_change(model, best));
  }
  return most;
}

}  // namespace

double mean_square_change(const PictureModel& model, const std::vector<UsedPlane>& used) {
  double square = 0;
  for (const UsedPlane& a : used) {
    const size_t i = place_of(model.planes, a.plane);
    if (i == model.planes.size()) continue;
    square += a.noise * model.products[i][i];
    for (const UsedPlane& b : used) {
      const size_t j = place_of(model.planes, b.plane);
      if (j < model.planes.size()) square += a.kept * b.kept * model.products[i][j];
    }
  }
  return std::max(square, 0.0);
}

double ExpectedSquare::error() const { return std::sqrt(square); }

double ExpectedSquare::uncertainty() const { return square > 0 ? deviation / (2 * std::sqrt(square)) : 0; }

ExpectedSquare expected_square(const PictureModel& model, const std::vector<UsedPlane>& used) {
  double square = model.truth + mean_square_change(model, used), variance = std::pow(model.truth_uncertainty, 2);
  for (const UsedPlane& plane : used) {
    const size_t i = place_of(model.planes, plane.plane);
    if (i == model.planes.size()) continue;
    square -= 2 * plane.kept * model.with_truth[i];
    variance += std::pow(2 * plane.kept * model.uncertainty[i], 2);
  }
  return {std::max(square, least_share * model.truth), std::sqrt(variance)};
}

PictureModel model_of(const SeenChanges& seen, const GoTogether& go_together) {
  PictureModel model;
  model.truth = seen_truth(seen) * (1 + figures().at("unforeseen").get<double>());
  for (size_t i = 0; i < seen.names.size(); ++i) {
    if (!is_of_effect(seen.names[i])) continue;
    model.planes.push_back(seen.names[i]);
    std::vector<double> row;
    const double kept = seen.kept_when_coarser.at(seen.names[i]);
    double with_truth = share_of_not_noise(seen, seen.names[i]) * kept * seen.products[i][i];
    for (size_t j = 0; j < seen.names.size(); ++j) {
      with_truth += share_in_truth(seen, seen.names[i], seen.names[j]) * seen.products[i][j];
      if (is_of_effect(seen.names[j]))
        row.push_back(best_over_seen(seen.names[i], seen.names[j]) * seen.products[i][j]);
    }
    const double own = best_over_seen(seen.names[i], seen.names[i]) * seen.products[i][i];
    model.uncertainty.push_back(figures().at("uncertainty").value(seen.names[i], 0.1) * std::sqrt(own));
    model.products.push_back(std::move(row));
    model.with_truth.push_back(with_truth);
  }
  // No scene's picture comes nearer than that.
  model.truth =
      std::max(model.truth, most_explained(model, go_together) / (1 - figures().at("unreached").get<double>()));
  for (double& uncertainty : model.uncertainty) uncertainty *= std::sqrt(model.truth);
  model.truth_uncertainty = figures().at("truth_uncertainty").get<double>() * model.truth;
  return model;
}

UsedPlane plane_by(const std::string& plane, const std::string& preset, int resolution, const SeenChanges& seen) {
  const auto kept = seen.kept_when_coarser.find(plane);
  const double lost = kept == seen.kept_when_coarser.end() ? 0 : 1 - kept->second;
  const nlohmann::json& presets = row_for("presets", plane);
  UsedPlane used = fitted(plane, presets.contains(preset) ? presets.at(preset) : presets.at("medium"), lost);
  if (resolution == 1) return used;
  const UsedPlane filled = fitted(plane, row_for("resolutions", plane).at(resolution == 2 ? "half" : "quarter"), lost);
  used.kept *= filled.kept;
  used.noise = noise_left * used.noise + filled.noise;
  return used;
}

}  // namespace gloam
