#include "report/material.h"

#include <algorithm>

#include "base/lists.h"
#include "report/markdown_text.h"

namespace gloam::report {

Material material_of(const std::vector<Source>& sources) {
  Material material{sources, joined(sources), {}, {}};
  Measurements groups = by_group(material.all, sources);
  material.measured = fronts_of_classes(groups);
  groups.rows = plain_rows_over_one_layer(groups.rows);
  material.fronts = fronts_of_classes(groups);
  return material;
}

std::vector<Row> plain_rows_over_one_layer(const std::vector<Row>& rows) {
  std::vector<Row> plain;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(plain), is_plain_over_one_layer);
  return plain;
}

std::string setting_text(const std::string& technique, const std::string& preset, const std::string& variant) {
  std::string text = technique + (preset.empty() ? "" : " " + preset);
  if (!variant.empty()) text += ", " + variant;
  return plain_text(text);
}

std::vector<std::string> techniques_of(const std::vector<Row>& rows) {
  std::vector<std::string> others, peeled;
  for (const Row& row : rows) add_new(reads_peeled_layers(row.reads) ? peeled : others, row.technique);
  others.insert(others.end(), peeled.begin(), peeled.end());
  return others;
}

std::vector<Row> default_rows(const std::vector<Row>& rows, const std::string& technique) {
  std::optional<std::string> preset;
  for (const Row& row : rows) {
    if (row.technique != technique || !row.variant.empty()) continue;
    if (!preset || row.preset == "medium") preset = row.preset;
  }
  std::vector<Row> found;
  for (const Row& row : rows) {
    if (row.technique == technique && row.variant.empty() && row.preset == preset) found.push_back(row);
  }
  return found;
}

}  // namespace gloam::report
