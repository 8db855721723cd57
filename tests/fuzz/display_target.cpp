// Display JSON: any text is a light-field display that can be written and read again, or is refused in one line.
#include <algorithm>
#include <fstream>
#include <iterator>

#include "fuzz/cameras.h"
#include "fuzz/json_damage.h"
#include "fuzz/promise.h"
#include "fuzz/target.h"
#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/light_field.h"

namespace gloam::fuzz {
namespace {

constexpr const char* name = "display.json";
constexpr Window window{-3, 2, 93, 56};

bool same(const LightFieldDisplay& a, const LightFieldDisplay& b) {
  const auto same_module = [](const OpticalModule& m, const OpticalModule& n) {
    return m.position == n.position && m.yaw == n.yaw && m.pitch == n.pitch;
  };
  const bool same_world = a.world.has_value() == b.world.has_value() &&
                          (!a.world || (a.world->linear == b.world->linear && a.world->origin == b.world->origin));
  return same_world && a.name == b.name && a.width == b.width && a.height == b.height &&
         a.observer_distance == b.observer_distance && a.observer_height == b.observer_height &&
         a.screen_width == b.screen_width && a.screen_height == b.screen_height && a.screen_radius == b.screen_radius &&
         std::equal(a.modules.begin(), a.modules.end(), b.modules.begin(), b.modules.end(), same_module);
}

/// The first few modules show as much as thousands.
void check_cameras(LightFieldDisplay display) {
  display.modules.resize(std::min<size_t>(display.modules.size(), 4));
  reads(printable(display.name), [&] {
    for (const auto& [module, camera] : module_cameras(display, window)) check_camera(camera);
  });
}

void read_everything(const std::string& text) {
  const LightFieldDisplay display = display_from_text(text, name);
  require(is_display_text(text), "what is read as a display is one");
  require(same(display_from_text(text_of(display), "again"), display), "a display is written as it is read");
  check_cameras(display);
}

std::string slurp(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::vector<std::string>& words() {
  static const std::vector<std::string> names = {"name",
                                                 "unit",
                                                 "observer",
                                                 "distance",
                                                 "height",
                                                 "screen",
                                                 "width",
                                                 "radius",
                                                 "modules",
                                                 "resolution",
                                                 "count",
                                                 "line",
                                                 "from",
                                                 "to",
                                                 "arc",
                                                 "centre",
                                                 "angle",
                                                 "facing",
                                                 "ahead",
                                                 "middle",
                                                 "list",
                                                 "position",
                                                 "yaw",
                                                 "pitch",
                                                 "physical",
                                                 "world",
                                                 "size",
                                                 "right",
                                                 "up",
                                                 "linear",
                                                 "origin",
                                                 "world_to_physical",
                                                 "region_of_interest",
                                                 ""};
  return names;
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string folder = GLOAM_SOURCE_DIR "/data/displays/";
  const std::string most =
      R"({"name": "d", "observer": {"distance": 3, "height": 0.1}, "screen": {"width": 1.6, "height": 1.2},)";
  const std::string modules =
      R"("modules": {"resolution": [8, 6], "count": 3, "line": {"from": [-0.3, 0, -1.5], "to": [0.3, 0, -1.5]}})";
  const std::string arc =
      R"("modules": {"resolution": [8, 6], "count": 3, "facing": "middle", "arc": {"centre": [0, 0, 0], "radius": 2, "angle": 30}})";
  const std::string list =
      R"("modules": {"resolution": [8, 6], "list": [{"position": [0, 0, -1]}, {"position": [0.2, 0, -1], "yaw": 5, "pitch": -3}]})";
  const std::string boxes =
      R"("region_of_interest": {"physical": {"size": [2, 1, 1]}, "world": {"centre": [3, 2, 1], "size": [4, 3, 2], "right": [0, 0, 1], "up": [0, 1, 0]}})";
  const std::string matrix =
      R"("world_to_physical": {"linear": [[2, 0, 0.1], [0, 2, 0], [0, 0, 1]], "origin": [1e6, 2, 3]})";
  const std::string curved = R"({"observer": {"distance": 3}, "screen": {"width": 1.6, "height": 1.2, "radius": 2},)";
  return {slurp(folder + "small.json"),
          slurp(folder + "convex.json"),
          slurp(folder + "eighty.json"),
          most + modules + "," + boxes + "}",
          most + list + "," + matrix + "}",
          curved + arc + "," + matrix + "}",
          most + arc + "," + boxes + "}",
          R"({"modules": {}})",
          "[]"};
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  const std::string text(reinterpret_cast<const char*>(data), size);
  reads(name, [&] { read_everything(text); });
  (void)gloam::is_display_text(text);
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace gloam::fuzz;
  static const std::vector<std::string> starts = seeds();
  gloam::Random random(seed);
  return put(damaged_json({reinterpret_cast<const char*>(data), size}, starts, words(), random), data, most);
}
