#include "cli/flags/composite_flags.h"

#include "cli/flags/options.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

constexpr const char* composite_heading = "Composite";

std::array<double, 3> parse_tint(const std::string& text, const std::string& flag) {
  const std::vector<std::string> words = split_list(text, flag);
  if (words.size() != 3)
    throw UsageError("{} {}: takes three numbers from 0 to 1, for red, green and blue; write {} 0.1,0.05,0", flag, text,
                     flag);
  std::array<double, 3> tint{};
  for (size_t i = 0; i < 3; ++i) tint[i] = parse_number(words[i], flag, Range<double>{0, 1});
  return tint;
}

}  // namespace

void CompositeFlags::add_to(CLI::App& app) {
  const Heading heading(app, composite_heading);
  CLI::Option* composite =
      add_text(app, "--composite", path, "OUT.exr",
               "EXR file to write: colour times AO, or colour plus reflection, scene-linear; the name of --into "
               "puts it there");
  add_number(app, "--composite-strength", strength, {0.0, 1000.0}, "of the effect in the composite; default 1")
      ->needs(composite);
  add_parsed(app, "--tint", tint, parse_tint, "factor on the colour where nothing is open; default 0,0,0: black",
             "R,G,B")
      ->needs(composite);
}

Compositing CompositeFlags::how() const { return {strength, tint.value_or(Compositing{}.tint)}; }

}  // namespace gloam::cli
