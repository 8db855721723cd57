#include "cli/auto/composite.h"

namespace gloam::cli {
namespace {

std::array<double, 3> parse_radiance(const std::string& text, const std::string& flag) {
  const std::vector<std::string> words = split_list(text, flag);
  if (words.size() != 3)
    throw UsageError("{} {}: takes three numbers, for red, green and blue; write {} 0.5,0.6,0.8", flag, text, flag);
  std::array<double, 3> radiance{};
  for (size_t i = 0; i < 3; ++i) radiance[i] = parse_number(words[i], flag, Range<double>{0, 1e30});
  return radiance;
}

}  // namespace

void add_color_holds(CLI::App& app, std::optional<ColorHolds>& holds, const std::string& of) {
  add_parsed(app, "--color-holds", holds, parse_color_holds,
             of + "what colour holds beside direct light, so that nothing counts twice: of ambient, shadows, ao, "
                  "indirect, reflection, or none; default: as the file says, else ambient,shadows",
             "LIST");
}

void add_ambient(CLI::App& app, std::optional<std::array<double, 3>>& ambient, const std::string& of) {
  add_parsed(app, "--ambient", ambient, parse_radiance,
             of + "radiance of an even sky, for frames without a plane 'ambient': times albedo it is what AO darkens",
             "R,G,B");
}

void AutoCompositeFlags::add_to(CLI::App& app) {
  const Heading heading(app, "Composite");
  add_text(app, "--composite", path, "OUT.exr",
           "EXR file to write: the frame's colour with all effects, scene-linear, no light counted twice");
  add_color_holds(app, light.holds);
  add_ambient(app, light.ambient);
}

}  // namespace gloam::cli
