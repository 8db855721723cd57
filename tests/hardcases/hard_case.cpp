#include "hard_case.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "gloam/files.h"
#include "gloam/planes.h"

namespace gloam::test {

void HardCase::report(int row, const std::string& what, double worst, double bound) {
  const std::string line =
      fmt::format("hard case {}  {}  worst {:.3g}  bound {:.3g}  ({})", row, technique().name, worst, bound, what);
  std::printf("%s\n", line.c_str());
  RecordProperty(identifier(what), fmt::format("{:.3g} of {:.3g}", worst, bound));
  EXPECT_LE(worst, bound) << line;
}

std::string opt_out(const Technique& technique, int row, const std::string& part) {
  const auto readme = std::filesystem::path(GLOAM_SOURCE_DIR) / "kernels" /
                      std::filesystem::path(technique.source).parent_path() / "README.md";
  if (!std::filesystem::exists(readme)) return "";
  const std::string which = fmt::format("hard case {}{}", row, part.empty() ? "" : ", " + part);
  const std::string all = which + ": ", one = fmt::format("{} ({}): ", which, technique.name);
  std::istringstream lines(read_text(readme));
  for (std::string line; std::getline(lines, line);) {
    for (const std::string& start : {all, one}) {
      if (line.starts_with(start)) return line.substr(start.size());
    }
  }
  return "";
}

std::vector<Settings> variants(const Technique& technique, Frame& frame) {
  const Settings few = few_samples(technique);
  std::vector<Settings> all = {{}};
  std::vector<std::string> seen;
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    for (const Parameter& p : planned.technique->parameters) {
      if (p.type != Parameter::Type::choice && p.type != Parameter::Type::boolean) continue;
      const std::string name = planned.technique->name + "." + p.name;
      if (std::find(seen.begin(), seen.end(), name) != seen.end()) continue;
      seen.push_back(name);
      for (int value = int(p.min); value <= int(p.max); ++value) {
        if (value == int(planned.values.number(p.name))) continue;
        const std::string text = p.type == Parameter::Type::boolean ? (value ? "on" : "off") : p.choices[size_t(value)];
        all.push_back(few + Settings{{name, text}});
      }
    }
  }
  return all;
}

std::vector<RunOptions> all_ways() {
  std::vector<RunOptions> all;
  for (const int lanes : usual_lanes(device())) {
    for (const Math math : {Math::precise, Math::fast}) all.push_back({.math = math, .lanes = lanes});
  }
  return all;
}

std::vector<RunOptions> two_ways() {
  return {{.math = Math::fast, .lanes = usual_lanes(device()).back()}, {.math = Math::precise, .lanes = 1}};
}

std::vector<Shot> usual_shots() { return {perspective(80, 60), orthographic(80, 60, 4)}; }

std::vector<Shot> odd_shots() { return {perspective(93, 61), orthographic(93, 61, 4)}; }

std::string text_of(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) text += (text.empty() ? "" : ", ") + name + " = " + value;
  return text.empty() ? "defaults" : text;
}

Settings operator+(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double worst_distance_from_open(const Plan& plan, const Frame& outputs) {
  double worst = 0;
  for (const std::string& name : unit_interval_outputs(plan)) {
    const Channel& values = outputs.views[0].find(name)->channels[0];
    const float open = plane_kind(name).outside;
    for (int y = 0; y < outputs.height(); ++y) {
      for (int x = 0; x < outputs.width(); ++x) {
        const double distance = std::abs(double(values.at(x, y)) - open);
        worst = std::isfinite(distance) ? std::max(worst, distance) : INFINITY;
      }
    }
  }
  return worst;
}

namespace {

std::string name_of(const testing::TestParamInfo<std::string>& info) { return identifier(info.param); }

}  // namespace

INSTANTIATE_TEST_SUITE_P(All, HardCase, testing::ValuesIn(technique_names()), name_of);

}  // namespace gloam::test
