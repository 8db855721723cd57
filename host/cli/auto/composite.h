// Flags of gloam auto --composite, some of which gloam reference composite has too.
#pragma once

#include "cli/flags/options.h"
#include "shot/whole_picture.h"

namespace gloam::cli {

void add_color_holds(CLI::App& app, std::optional<ColorHolds>& holds, const std::string& of = "");
void add_ambient(CLI::App& app, std::optional<std::array<double, 3>>& ambient, const std::string& of = "");

struct AutoCompositeFlags {
  std::string path;  ///< empty: no composite
  LightChoice light;
  void add_to(CLI::App& app);
  /// None without a composite.
  std::optional<LightChoice> asked() const { return path.empty() ? std::nullopt : std::optional(light); }
};

}  // namespace gloam::cli
