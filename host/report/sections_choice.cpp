// Choosing a setting: needs, fronts, and every figure of each scene.
#include "report/sections_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/lists.h"
#include "gloam/error.h"
#include "report/markdown_text.h"

namespace gloam::report {
namespace {

std::string setting_of(const ClassPoint& p) { return setting_text(p.technique, p.preset, p.variant); }

std::string names(const std::vector<std::string>& scenes) {
  std::vector<std::string> shown;
  for (const std::string& scene : scenes) shown.push_back(plain_text(scene));
  return enumerate(shown);
}

std::string over_scenes(const ClassFront& group) {
  return group.scenes.size() == 1 ? fmt::format("Over one scene, {}.", names(group.scenes))
                                  : fmt::format("Over {} scenes: {}.", group.scenes.size(), names(group.scenes));
}

std::string left_out(const ClassFront& group) {
  if (group.left_out == 0) return "";
  return fmt::format(" Left out: {} setting{} measured on some of the scenes only, whose mean would be over others.",
                     group.left_out, group.left_out == 1 ? "" : "s");
}

/// The settings of all groups side by side: a row per need.
std::string overview(const std::vector<ClassFront>& groups) {
  std::vector<std::string> heading{"need"}, needs;
  for (const ClassFront& group : groups) {
    heading.push_back(plain_text(group.name));
    for (const Choice& choice : choices(group)) add_new(needs, choice.need);
  }
  Table table(heading, "l");
  for (const std::string& need : needs) {
    std::vector<std::string> cells{need};
    for (const ClassFront& group : groups) {
      const std::vector<Choice> of_group = choices(group);
      const auto found =
          std::find_if(of_group.begin(), of_group.end(), [&](const Choice& c) { return c.need == need; });
      cells.push_back(found != of_group.end() && found->best ? setting_of(*found->best) : "-");
    }
    table.add(cells);
  }
  return table.text();
}

/// A table for each effect that has several groups.
std::string overviews(const Material& material) {
  std::vector<std::string> effects;
  for (const ClassFront& group : material.measured) add_new(effects, group.effect);
  std::string text;
  for (const std::string& effect : effects) {
    std::vector<ClassFront> groups;
    std::copy_if(material.measured.begin(), material.measured.end(), std::back_inserter(groups),
                 [&](const ClassFront& group) { return group.effect == effect; });
    if (groups.size() > 1) text += overview(groups) + (effects.size() > 1 ? "\n" : "");
  }
  return text;
}

std::string needs_of_group(const ClassFront& group) {
  Table table({"need", "setting", "RMSE (bias)", "time"}, "llr");
  for (const Choice& choice : choices(group)) {
    if (choice.best)
      table.add({choice.need, setting_of(*choice.best), error_and_bias(choice.best->error, choice.best->bias),
                 ratio_text(choice.best->ratio)});
    else
      table.add({choice.need, "none of those measured", "-", "-"});
  }
  return fmt::format("### {}\n\n", plain_text(group.name)) + paragraph(over_scenes(group) + left_out(group)) +
         table.text();
}

std::string front_of_group(const ClassFront& group) {
  Table table({"setting", "RMSE (bias)", "time", "on the fronts of"}, "lr");
  std::vector<std::string> elsewhere;
  for (const ClassPoint& p : group.points) {
    if (p.on_front)
      table.add({setting_of(p), error_and_bias(p.error, p.bias), ratio_text(p.ratio),
                 fmt::format("{} of {}", p.fronts.size(), group.scenes.size())});
    else if (!p.fronts.empty())
      elsewhere.push_back(fmt::format("{} ({})", setting_of(p), names(p.fronts)));
  }
  std::string text = fmt::format("### The front: {}\n\n", plain_text(group.name)) + table.text();
  if (!elsewhere.empty())
    text += paragraph(fmt::format("On the front of single scenes, but not of their mean: {}.", enumerate(elsewhere)));
  return text;
}

/// Column headings: presets in order of appearance.
std::vector<std::string> presets_of(const std::vector<Row>& rows) {
  std::vector<std::string> presets;
  for (const Row& row : rows) {
    if (row.variant.empty()) add_new(presets, row.preset);
  }
  return presets;
}

/// "\* .127 (+.014), 0.72, 12"
std::string cell_of(const Row& row, bool on_front) {
  const std::string time =
      row.ratio_to_hbao_plus ? ratio_text(row.ratio_to_hbao_plus) : ratio_text(row.ms.median) + " ms";
  return fmt::format("{}{}, {}{}", on_front ? "\\* " : "", error_and_bias(row.rmse_to_truth, row.bias), time,
                     row.samples ? fmt::format(", {:g}", *row.samples) : "");
}

std::string table_of_scene(const Material& material, const Scene& scene) {
  std::vector<Row> rows;
  for (const Row& row : material.all.rows) {
    if (row.scene == scene.name && row.variant.empty()) rows.push_back(row);
  }
  const std::vector<Row> plain = plain_rows_over_one_layer(rows);
  std::vector<std::string> front;
  for (const size_t i : front_of_scene(plain, scene.name).plain)
    front.push_back(plain[i].technique + "\n" + plain[i].preset);
  const std::vector<std::string> presets = presets_of(rows);
  std::vector<std::string> heading{"technique"};
  for (const std::string& preset : presets) heading.push_back(plain_text(preset));
  Table table(heading, "lr");
  for (const std::string& technique : techniques_of(rows)) {
    std::vector<std::string> cells{plain_text(technique)};
    for (const std::string& preset : presets) {
      const auto found = std::find_if(
          rows.begin(), rows.end(), [&](const Row& row) { return row.technique == technique && row.preset == preset; });
      cells.push_back(found == rows.end() ? "" : cell_of(*found, contains(front, technique + "\n" + preset)));
    }
    table.add(cells);
  }
  if (table.empty()) return "";
  if (scene.base.rmse) {
    std::vector<std::string> cells(heading.size());
    cells[0] = plain_text(scene.base.name) + ", no technique";
    cells[1] = error_and_bias(scene.base.rmse, scene.base.bias);
    table.add(cells);
  }
  return table.text();
}

/// A preset and the next larger one, which is farther from the truth on some scenes.
struct WorsePreset {
  std::string technique, smaller, larger;
  std::vector<std::string> on;  ///< scenes, with both errors
  size_t of = 0;                ///< scenes that have both presets
};

const Row* find_row(const std::vector<Row>& rows, const std::string& technique, const std::string& preset,
                    const std::string& scene) {
  for (const Row& row : rows) {
    if (row.technique == technique && row.preset == preset && row.scene == scene && row.variant.empty()) return &row;
  }
  return nullptr;
}

WorsePreset compared_presets(const Material& material, const std::string& technique, const std::string& smaller,
                             const std::string& larger) {
  WorsePreset found{technique, smaller, larger, {}, 0};
  for (const Scene& scene : material.all.scenes) {
    const Row* less = find_row(material.all.rows, technique, smaller, scene.name);
    const Row* more = find_row(material.all.rows, technique, larger, scene.name);
    if (!less || !more || !less->rmse_to_truth || !more->rmse_to_truth) continue;
    ++found.of;
    const std::string before = error_text(less->rmse_to_truth), after = error_text(more->rmse_to_truth);
    if (as_printed(after) > as_printed(before))
      found.on.push_back(fmt::format("{} {} to {}", plain_text(scene.name), before, after));
  }
  return found;
}

}  // namespace

std::string needs_section(const Material& material) {
  if (material.measured.empty()) return "";
  std::string text = "## Which technique for which need\n\n";
  text += paragraph(
      "Take the row that says what you need, in the class of scenes that yours are like. Figures are means over the "
      "scenes of the class. The setting is chosen by them alone, from the Pareto front of the presets that see one "
      "layer, the depth buffer that every renderer has: of settings with the same RMSE, as printed, the fastest. Two "
      "rows stand beside that front. Further layers, peeled or stochastic, or a second view, are what a renderer has "
      "to make first, and that is not in the time. At a lower resolution every 2nd (half) or 4th pixel (quarter) each "
      "way is estimated and filtered, then "
      "upsampled.");
  text += overviews(material);
  for (const ClassFront& group : material.measured) text += needs_of_group(group);
  return text;
}

std::string fronts_section(const Material& material) {
  if (material.fronts.empty()) return "";
  std::string text = "## The fronts\n\n";
  text += paragraph(
      "A setting is on the Pareto front when no other preset over one layer is as fast and as near to the truth and "
      "better in one of the two. These are the fronts of the means, fastest first. The last column says on how many "
      "of the scenes' own fronts the setting is: one that is on few of them may be here by accident of a scene.");
  for (const ClassFront& group : material.fronts) text += front_of_group(group);
  return text;
}

std::string scenes_section(const Material& material) {
  std::string tables;
  for (const Scene& scene : material.all.scenes) {
    const std::string table = table_of_scene(material, scene);
    if (!table.empty()) tables += fmt::format("### {}\n\n", plain_text(scene.name)) + table;
  }
  if (tables.empty()) return "";
  return "## Scene by scene\n\n" +
         paragraph(
             "A row is a technique, a column a preset. In a cell: RMSE (bias), time, samples per pixel where the "
             "technique says how many it takes. With `*` the setting is on the scene's front, of which techniques "
             "over further layers are no part.") +
         tables;
}

std::string presets_section(const Material& material) {
  Table table({"technique", "from", "to", "farther from the truth on", "of scenes"}, "llllr");
  const std::vector<std::string> presets = presets_of(material.all.rows);
  for (const std::string& technique : techniques_of(material.all.rows)) {
    for (size_t i = 1; i < presets.size(); ++i) {
      const WorsePreset found = compared_presets(material, technique, presets[i - 1], presets[i]);
      if (found.on.empty()) continue;
      table.add({plain_text(technique), plain_text(found.smaller), plain_text(found.larger),
                 fmt::format("{}", fmt::join(found.on, ", ")), fmt::format("{} of {}", found.on.size(), found.of)});
    }
  }
  if (table.empty()) return "";
  return "## Presets that get worse\n\n" +
         paragraph(
             "A larger preset takes more samples and more time, and is not always nearer to the truth: of occluders "
             "without a back, more samples find more. RMSE of a preset and of the next larger one, where the larger "
             "one is farther.") +
         table.text();
}

}  // namespace gloam::report
