// The data of the sections of the generated page.
#pragma once

#include <string>
#include <vector>

#include "report/needs.h"
#include "results/joined.h"

namespace gloam::report {

struct Material {
  const std::vector<Source>& sources;
  Measurements all;                  ///< `joined`
  std::vector<ClassFront> measured;  ///< fronts of each group (`by_group`), over all settings
  std::vector<ClassFront> fronts;    ///< fronts of each group, over plain settings with one layer; may be missing
};

Material material_of(const std::vector<Source>& sources);

/// Plain settings of techniques that read one layer of depth.
std::vector<Row> plain_rows_over_one_layer(const std::vector<Row>& rows);

/// "gtao medium, half"
std::string setting_text(const std::string& technique, const std::string& preset, const std::string& variant = "");

/// Techniques in order of appearance, those over peeled layers last.
std::vector<std::string> techniques_of(const std::vector<Row>& rows);

/// Rows of one technique with its default setting: the plain rows with the preset "medium", else with the first preset.
std::vector<Row> default_rows(const std::vector<Row>& rows, const std::string& technique);

}  // namespace gloam::report
