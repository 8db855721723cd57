#include "report/markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/lists.h"
#include "gloam/error.h"
#include "page/pictures.h"
#include "report/markdown_text.h"
#include "report/material.h"
#include "report/sections_choice.h"
#include "report/sections_errors.h"
#include "report/sections_sequence.h"
#include "report/sections_submitted.h"
#include "report/sections_time.h"

namespace gloam::report {
namespace {

namespace fs = std::filesystem;

// --- The head of the page

/// "a device (a CPU, 2 cores; a driver 1.0), commit 0123abc, 2026-01-31, 9 rounds, 64 rays": as far as it is known.
std::string measured_on(const Measurements& m) {
  std::string text = m.device.empty() ? "an unknown device" : m.device, with = m.cpu;
  if (m.cores) with += fmt::format("{}{:g} cores", with.empty() ? "" : ", ", *m.cores);
  if (!m.driver.empty()) with += (with.empty() ? "" : "; ") + m.driver;
  if (!with.empty()) text += " (" + with + ")";
  if (!m.commit.empty()) text += ", commit " + m.commit;
  if (!m.date.empty()) text += ", " + m.date;
  if (m.rounds) text += fmt::format(", {:g} rounds", *m.rounds);
  if (m.rays) text += fmt::format(", {:g} rays per pixel", *m.rays);
  return plain_text(text);
}

/// What the errors are to.
std::string truth_in_words(const Measurements& all) {
  const bool of_ao =
      std::all_of(all.scenes.begin(), all.scenes.end(), [](const Scene& scene) { return scene.effect == "ao"; });
  if (of_ao)
    return "RMSE of ambient occlusion against ray-traced truth: cosine-weighted rays, binary visibility within the "
           "radius, no falloff; background does not count.";
  return "RMSE of effects of light, each a plane of its own, against ray-traced truth within the radius (`gloam "
         "reference`), over all components; background does not count. The last row of a scene is what there is "
         "without a technique.";
}

std::string head(const std::vector<Source>& sources, const Measurements& all, const std::string& command) {
  std::vector<std::string> from;
  for (const Source& source : sources)
    from.push_back(fmt::format("{} (measured on {})", code(source.name), measured_on(source.measurements)));
  return "# How near to the truth\n\n" +
         paragraph(fmt::format("This page is generated from {} by {}. A change by hand is lost: measure anew "
                               "(`gloam bench`), then generate.",
                               enumerate(from), code(command))) +
         paragraph(
             truth_in_words(all) +
             " In parentheses the bias, the mean difference: + is "
             "too bright. *Time* is that of the whole plan, the filter included, over that of HBAO+ medium in the "
             "same round of the same process; such a ratio travels between machines of a kind, milliseconds do not. "
             "A *setting* is a technique with a preset:") +
         "```text\n"
         "gloam run TECHNIQUE frame.exr -o ao.exr --preset PRESET [--resolution half|quarter]\n"
         "```\n\n";
}

std::string number_text(const Number& number) { return number ? fmt::format("{:.3g}", *number) : "-"; }

std::string table_of_scenes(const Measurements& all) {
  if (all.scenes.empty()) return "";
  Table table({"scene", "class", "size", "radius", "radius in pixels", "noise of the truth"}, "llr");
  for (const Scene& scene : all.scenes) {
    const std::string size =
        scene.width && scene.height ? fmt::format("{:.0f}x{:.0f}", *scene.width, *scene.height) : "-";
    table.add({plain_text(scene.name), plain_text(scene.scene_class), size, number_text(scene.radius),
               number_text(scene.radius_pixels), error_text(scene.truth_noise)});
  }
  return table.text();
}

// --- Pictures

constexpr size_t most_sheets = 3, most_bytes = 600 * 1000;

/// Letters, digits and harmless characters only: a scene's name must not choose the folder.
std::string file_name(const std::string& scene) {
  std::string name;
  for (const char c : scene.substr(0, 80)) {
    const bool plain = std::isalnum((unsigned char)c) || std::string("+-").find(c) != std::string::npos;
    name += plain ? c : '_';
  }
  return "techniques_" + name + ".png";
}

/// "RMSE .127 (+.014), time 0.72"
std::string figures_of(const Row& row) {
  std::string text = "RMSE " + error_and_bias(row.rmse_to_truth, row.bias);
  if (row.ratio_to_hbao_plus) text += ", time " + ratio_text(row.ratio_to_hbao_plus);
  return text;
}

/// Rows of a scene with default settings over one layer, nearest to the truth first.
std::vector<Row> shown_rows(const Measurements& all, const Scene& scene) {
  std::vector<Row> rows, shown;
  for (const Row& row : all.rows) {
    if (row.scene == scene.name && is_plain_over_one_layer(row)) rows.push_back(row);
  }
  for (const std::string& technique : techniques_of(rows)) {
    const std::vector<Row> defaults = default_rows(rows, technique);
    if (!defaults.empty() && !defaults.front().image.empty()) shown.push_back(defaults.front());
  }
  std::stable_sort(shown.begin(), shown.end(), [](const Row& a, const Row& b) {
    return a.rmse_to_truth.value_or(2) < b.rmse_to_truth.value_or(2);
  });
  return shown;
}

/// The tiles of a scene, and notes on those that are missing.
struct Tiles {
  std::vector<Tile> tiles;
  size_t techniques = 0;
  std::vector<std::string> notes;
  void add(const fs::path& folder, const std::string& image, const std::string& name, const std::string& figures) {
    try {
      tiles.push_back({name, figures, stored_picture(folder, image)});
    } catch (const Error& error) {
      notes.push_back(fmt::format("{}; the page goes without this picture", error.what()));
    }
  }
};

Tiles tiles_of(const Scene& scene, const Measurements& all, const std::vector<Source>& sources) {
  Tiles found;
  if (!scene.truth_image.empty())
    found.add(folder_of(sources[scene.source]), scene.truth_image, "truth",
              scene.truth_noise ? "ray-traced, noise " + error_text(scene.truth_noise) : "ray-traced");
  const size_t before = found.tiles.size();
  for (const Row& row : shown_rows(all, scene)) {
    const std::string name = row.technique + (row.preset.empty() ? "" : " " + row.preset);
    found.add(folder_of(sources[row.source]), row.image, name, figures_of(row));
  }
  found.techniques = found.tiles.size() - before;
  return found;
}

/// A path relative to the page, for its links.
std::string link_to(const fs::path& file, const fs::path& page) {
  const fs::path from = fs::absolute(page).lexically_normal().parent_path();
  return link_target(fs::absolute(file).lexically_normal().lexically_relative(from).generic_string());
}

/// Makes sheets of the first scene of each class that has pictures.
class Sheets {
 public:
  Sheets(const Material& material, const MarkdownOptions& options, MarkdownPage& page)
      : material_(material), options_(options), page_(page) {}

  /// The section; empty if there are no pictures.
  std::string section() {
    std::string links;
    std::vector<std::string> classes;
    for (const Scene& scene : material_.all.scenes) {
      if (classes.size() == most_sheets) break;
      if (contains(classes, scene.scene_class)) continue;
      const std::string link = link_of(scene);
      if (link.empty()) continue;
      links += link;
      classes.push_back(scene.scene_class);
    }
    if (links.empty()) {
      page_.notes.push_back("no picture that bench.json names could be read; the page goes without pictures");
      return "";
    }
    return "## Pictures\n\n" +
           paragraph(
               "The truth and the default setting of each technique over one layer, nearest to the truth first: "
               "RMSE (bias) and time as above. One scene of each class.") +
           links;
  }

 private:
  std::string link_of(const Scene& scene) {
    const fs::path path = options_.pictures / file_name(scene.name);
    const Tiles found = tiles_of(scene, material_.all, material_.sources);
    std::error_code unknown;
    if (found.techniques > 0) {
      page_.notes.insert(page_.notes.end(), found.notes.begin(), found.notes.end());
      page_.pictures.push_back(
          {path, sheet_png((scene.effect == "ao" ? "Ambient occlusion: " : "Effect of light: ") + scene.name,
                           about(scene), found.tiles, most_bytes)});
    } else if (fs::is_regular_file(path, unknown)) {
      // The old sheet is kept, so that a page can be generated again from a bench.json alone.
      page_.notes.push_back(fmt::format("{}: its pictures are not beside bench.json; kept as it is", path.string()));
    } else {
      return "";
    }
    return fmt::format("![{}: the truth and the techniques]({})\n\n", plain_text(scene.name),
                       link_to(path, options_.page));
  }

  static std::string about(const Scene& scene) {
    const std::string size =
        scene.width && scene.height ? fmt::format("Measured at {:.0f}x{:.0f}. ", *scene.width, *scene.height) : "";
    return size + "RMSE to the truth (bias), time over HBAO+ medium; nearest first; hatched: no surface.";
  }

  const Material& material_;
  const MarkdownOptions& options_;
  MarkdownPage& page_;
};

}  // namespace

MarkdownPage make_markdown(const std::vector<Source>& sources, const MarkdownOptions& options) {
  const Material material = material_of(sources);
  MarkdownPage page;
  page.text = head(sources, material.all, options.command) + table_of_scenes(material.all);
  for (const auto section :
       {needs_section, fronts_section, scenes_section, presets_section, converged_section, ladder_section,
        sequence_section, submitted_section, floor_section, scales_section, planes_section, others_section})
    page.text += section(material);
  if (!options.pictures.empty()) page.text += Sheets(material, options, page).section();
  while (page.text.ends_with("\n\n")) page.text.pop_back();
  for (const ClassFront& group : material.measured) page.groups.push_back({group.name, group.scenes, choices(group)});
  return page;
}

}  // namespace gloam::report
