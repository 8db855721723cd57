// The parts of the generated page. Each is Markdown with its heading, or empty if nothing was measured for it.
#pragma once

#include <string>
#include <vector>

#include "report/joined.h"
#include "report/needs.h"

namespace gloam::report {

/// The data of the sections.
struct Material {
  const std::vector<Source>& sources;
  Measurements all;                  ///< `joined`
  std::vector<ClassFront> measured;  ///< fronts of each group (`by_group`), over all settings
  std::vector<ClassFront> fronts;    ///< fronts of each group, over plain settings with one layer; may be missing
};

Material material_of(const std::vector<Source>& sources);

std::string needs_section(const Material& material);
std::string fronts_section(const Material& material);
std::string scenes_section(const Material& material);
/// Presets that take more time than a smaller preset and are farther from the truth.
std::string presets_section(const Material& material);
std::string converged_section(const Material& material);
std::string ladder_section(const Material& material);
std::string floor_section(const Material& material);
std::string scales_section(const Material& material);
std::string planes_section(const Material& material);
std::string others_section(const Material& material);

// --- Functions that several sections use

/// "gtao medium, half"
std::string setting_text(const std::string& technique, const std::string& preset, const std::string& variant = "");

/// Techniques in order of appearance, those over peeled layers last.
std::vector<std::string> techniques_of(const std::vector<Row>& rows);

/// Rows of one technique with its default setting: the plain rows with the preset "medium", else with the first preset.
std::vector<Row> default_rows(const std::vector<Row>& rows, const std::string& technique);

}  // namespace gloam::report
