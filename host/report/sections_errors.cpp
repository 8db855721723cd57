// Distances from the truth, and their causes.
#include "report/sections_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/lists.h"
#include "base/statistics.h"
#include "gloam/error.h"
#include "gloam/technique.h"
#include "report/comparison.h"
#include "report/markdown_text.h"
#include "technique/ambient_occlusion.h"

namespace gloam::report {
namespace {

// --- Converged

const Converged* find(const std::vector<Converged>& list, const std::string& scene, const std::string& technique) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Converged& each) {
    return each.scene == scene && each.technique == technique;
  });
  return found == list.end() ? nullptr : &*found;
}

/// A technique, and its variant over all peeled layers; either may be missing, and is then empty.
struct OverLayers {
  std::string name, given, all_layers;
  bool is_over_one_layer = false;  ///< `given` takes part in the comparison for the least error
};

/// The method whose variant over all peeled layers a technique is, else its own name. One that is not registered here, of a plugin or of
/// another version, is told by what it reads and by its name.
std::string name_of_pair(const Converged& each) {
  for (const Technique& t : registry()) {
    if (t.name == each.technique) return t.variant.layers == Layers::peeled ? t.variant.of : t.name;
  }
  const bool is_named_after = reads_peeled_layers(each.reads) && each.technique.starts_with(peeled_prefix);
  return each.technique.substr(is_named_after ? peeled_prefix.size() : 0);
}

std::vector<OverLayers> pairs_of(const std::vector<Converged>& list) {
  std::vector<OverLayers> pairs;
  for (const Converged& each : list) {
    const std::string name = name_of_pair(each);
    auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const OverLayers& p) { return p.name == name; });
    if (pair == pairs.end()) pair = pairs.insert(pairs.end(), OverLayers{.name = name});
    (reads_peeled_layers(each.reads) ? pair->all_layers : pair->given) = each.technique;
    pair->is_over_one_layer |= reads_one_layer(each.reads);
  }
  return pairs;
}

std::vector<std::string> scenes_of(const Material& material) {
  std::vector<std::string> scenes;
  const auto is_there = [&](const std::string& scene) {
    const std::vector<Converged>& list = material.all.converged;
    return std::any_of(list.begin(), list.end(), [&](const Converged& each) { return each.scene == scene; });
  };
  for (const Scene& scene : material.all.scenes) {
    if (is_there(scene.name)) add_new(scenes, scene.name);
  }
  for (const Converged& each : material.all.converged) add_new(scenes, each.scene);
  return scenes;
}

std::string side_by_side(const std::string& one, const std::string& all) {
  if (one == "-" && all == "-") return "";
  return all == "-" ? one : one + " / " + all;
}

/// Mean over the scenes; empty if one of them lacks the technique, since its mean would not compare with its neighbours'.
Number mean_of(const std::vector<Converged>& list, const std::vector<std::string>& scenes, const std::string& technique,
               Number Converged::*figure) {
  double sum = 0;
  for (const std::string& scene : scenes) {
    const Converged* each = find(list, scene, technique);
    if (!each || !(each->*figure)) return {};
    sum += *(each->*figure);
  }
  return sum / double(scenes.size());
}

std::vector<std::string> converged_row(const std::vector<Converged>& list, const std::string& scene,
                                       const std::vector<OverLayers>& pairs) {
  const auto error = [&](const std::string& technique) {
    const Converged* each = find(list, scene, technique);
    return each ? error_text(each->rmse_to_truth) : "-";
  };
  std::string least = "-";
  for (const OverLayers& pair : pairs) {
    const std::string text = pair.is_over_one_layer ? error(pair.given) : "-";
    if (text != "-" && (least == "-" || as_printed(text) < as_printed(least))) least = text;
  }
  std::vector<std::string> cells{plain_text(scene)};
  for (const OverLayers& pair : pairs) {
    const std::string given = error(pair.given);
    const bool is_least = pair.is_over_one_layer && given != "-" && given == least;
    cells.push_back(side_by_side(is_least ? "**" + given + "**" : given, error(pair.all_layers)));
  }
  return cells;
}

// --- The ladder

struct Step {
  const char* heading;
  const char* says;
  Number Ladder::*figure;
};

constexpr std::array<Step, 8> steps{
    {{"model",
      "the integral of the technique's own contribution and falloff, traced, against the truth: what the method "
      "chooses to compute instead",
      &Ladder::t0w},
     {"screen",
      "the converged technique over all peeled layers against that (against the truth where the technique has no "
      "model of its own): what estimating on the screen costs",
      &Ladder::t1},
     {"hidden", "the converged technique on the layers that it is given against all layers: geometry that is hidden",
      &Ladder::t2},
     {"screen and hidden",
      "the converged technique against the truth, or the technique's own contribution, where there is no form over all "
      "layers",
      &Ladder::t12},
     {"noise", "its own number of samples against the converged image, unfiltered", &Ladder::t3},
     {"filter", "the filter on the converged image: what it blurs away", &Ladder::t4_bias},
     {"noise left", "samples and filter against the filter on the converged image", &Ladder::t4_noise},
     {"rounding", "float and fast mathematics, as it is shipped, against double", &Ladder::t5}}};

// --- Scales and planes

std::string steps_of(const ScaleChange& change) {
  return fmt::format("{}, {} to {}", plain_text(change.scene), plain_text(change.from), plain_text(change.to));
}

/// "tilt 80 degrees, direction 45, perspective, pixel (3, 0)": as far as it is known.
std::string position_in_words(const PlaneReading& reading) {
  std::vector<std::string> parts;
  if (reading.tilt) parts.push_back(fmt::format("tilt {:g}", *reading.tilt));
  if (reading.direction) parts.push_back(fmt::format("direction {:g}", *reading.direction));
  if (!reading.camera.empty()) parts.push_back(plain_text(reading.camera));
  if (reading.x && reading.y) parts.push_back(fmt::format("pixel ({:g}, {:g})", *reading.x, *reading.y));
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

/// Values below this are bold: shading becomes visible.
constexpr double open = 0.99;

std::string openness(double least) {
  std::string digits = fmt::format("{:.4f}", least);
  if (digits.starts_with("0.")) digits = digits.substr(1);
  return least < open ? "**" + digits + "**" : digits;
}

const PlaneReading* least_of(const std::vector<PlaneReading>& readings, const std::string& technique,
                             const std::string& plane) {
  const PlaneReading* least = nullptr;
  for (const PlaneReading& each : readings) {
    if (each.technique == technique && each.plane == plane && (!least || each.least < least->least)) least = &each;
  }
  return least;
}

}  // namespace

namespace {

/// The table of one effect.
std::string converged_table(const Material& material, const std::string& effect) {
  std::vector<Converged> list;
  std::vector<std::string> scenes;
  for (const Converged& each : material.all.converged) {
    if (each.effect == effect) list.push_back(each);
  }
  for (const std::string& scene : scenes_of(material)) {
    if (std::any_of(list.begin(), list.end(), [&](const Converged& each) { return each.scene == scene; }))
      scenes.push_back(scene);
  }
  const std::vector<OverLayers> pairs = pairs_of(list);
  std::vector<std::string> heading{"scene"}, means{"mean"}, biases{"bias, mean"};
  for (const OverLayers& pair : pairs) {
    heading.push_back(plain_text(pair.name));
    means.push_back(side_by_side(error_text(mean_of(list, scenes, pair.given, &Converged::rmse_to_truth)),
                                 error_text(mean_of(list, scenes, pair.all_layers, &Converged::rmse_to_truth))));
    biases.push_back(side_by_side(bias_text(mean_of(list, scenes, pair.given, &Converged::bias)),
                                  bias_text(mean_of(list, scenes, pair.all_layers, &Converged::bias))));
  }
  Table table(heading, "lr");
  for (const std::string& scene : scenes) table.add(converged_row(list, scene, pairs));
  if (scenes.size() > 1) {
    table.add(means);
    table.add(biases);
  }
  return table.text();
}

/// Those that any row has a figure of; all but the one for techniques without a form over layers, which few results hold.
std::vector<Step> steps_in(const std::vector<Row>& rows) {
  std::vector<Step> found;
  for (const Step& step : steps) {
    const bool is_there =
        std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return (row.ladder.*step.figure).has_value(); });
    if (is_there || step.figure != &Ladder::t12) found.push_back(step);
  }
  return found;
}

}  // namespace

std::string converged_section(const Material& material) {
  std::vector<std::string> effects;
  for (const Converged& each : material.all.converged) add_new(effects, each.effect);
  if (effects.empty()) return "";
  std::string tables;
  for (const std::string& effect : effects) {
    if (effects.size() > 1) tables += fmt::format("### {}\n\n", plain_text(effect));
    tables += converged_table(material, effect);
  }
  return "## Converged\n\n" +
         paragraph(
             "RMSE to the truth with so many samples that more change nothing, unfiltered: what no time buys. Two "
             "figures are one layer / all peeled layers of the same technique; their difference is what hidden "
             "surfaces are worth. The least over one layer is bold; what looks at stochastic depths or at a second "
             "view "
             "has a column of its own.") +
         tables;
}

std::string ladder_section(const Material& material) {
  const std::vector<Step> shown = steps_in(material.all.rows);
  std::vector<std::string> heading{"setting"};
  for (const Step& step : shown) heading.push_back(step.heading);
  heading.push_back("in all");
  Table table(heading, "lr");
  for (const std::string& technique : techniques_of(material.all.rows)) {
    const std::vector<Row> rows = default_rows(material.all.rows, technique);
    std::vector<std::string> cells{setting_text(technique, rows.empty() ? "" : rows.front().preset)};
    bool known = false;
    for (const Step& step : shown) {
      std::vector<double> values;
      for (const Row& row : rows) {
        if (const Number& value = row.ladder.*step.figure) values.push_back(*value);
      }
      known |= !values.empty();
      cells.push_back(error_text(median_of(values)));
    }
    std::vector<double> totals;
    for (const Row& row : rows) {
      if (row.rmse_to_truth) totals.push_back(*row.rmse_to_truth);
    }
    cells.push_back(error_text(median_of(totals)));
    if (known) table.add(cells);
  }
  if (table.empty()) return "";
  std::string text = "## Where the errors come from\n\n";
  text += paragraph(
      "Each column is the RMSE between two images that differ in one thing; medians over the scenes. They do not add "
      "up; the last column is the whole way to the truth.");
  for (const Step& step : shown) text += list_item(fmt::format("*{}*: {}.", step.heading, step.says));
  return text + "\n" + table.text();
}

std::string scales_section(const Material& material) {
  const std::vector<ScaleChange>& scales = material.all.scales;
  Table table({"technique", "largest mean change", "where", "median of the mean absolute difference"}, "lrlr");
  std::vector<std::string> techniques;
  for (const ScaleChange& each : scales) add_new(techniques, each.technique);
  for (const std::string& technique : techniques) {
    const ScaleChange* largest = nullptr;
    std::vector<double> differences;
    for (const ScaleChange& each : scales) {
      if (each.technique != technique) continue;
      if (each.mae) differences.push_back(*each.mae);
      if (each.mean_change && (!largest || std::abs(*each.mean_change) > std::abs(*largest->mean_change)))
        largest = &each;
    }
    if (!largest && differences.empty()) continue;
    table.add({plain_text(technique), largest ? bias_text(largest->mean_change) : "-",
               largest ? steps_of(*largest) : "", error_text(median_of(differences))});
  }
  if (table.empty()) return "";
  return "## Does the look change with the resolution?\n\n" +
         paragraph(
             "The same view at two sizes: by how much the mean of the image changes at most, over scenes and steps "
             "(+ is brighter at the second size), and how far pixels are apart.") +
         table.text();
}

std::string planes_section(const Material& material) {
  const std::vector<PlaneReading>& readings = material.all.planes;
  if (readings.empty()) return "";
  std::vector<std::string> techniques, planes, heading{"technique"};
  std::string alignment = "l";
  for (const PlaneReading& each : readings) {
    add_new(techniques, each.technique);
    add_new(planes, each.plane);
  }
  for (const std::string& plane : planes) {
    heading.insert(heading.end(), {"least " + code(plane), "where"});
    alignment += "rl";
  }
  Table table(heading, alignment);
  for (const std::string& technique : techniques) {
    std::vector<std::string> cells{plain_text(technique)};
    for (const std::string& plane : planes) {
      const PlaneReading* least = least_of(readings, technique, plane);
      cells.insert(cells.end(), {least ? openness(least->least) : "", least ? position_in_words(*least) : ""});
    }
    table.add(cells);
  }
  return "## Does a plane read open?\n\n" +
         paragraph(fmt::format(
             "Nothing stands above a plane, so every pixel of it should be 1, however it is tilted to the camera. The "
             "least value over all planes that were tried, and where (tilt and direction in degrees); below {:g} it "
             "is bold.",
             open)) +
         table.text();
}

}  // namespace gloam::report
