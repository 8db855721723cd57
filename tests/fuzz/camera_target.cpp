// Camera JSON: any text gives cameras that can be worked with, or is refused in one line.
#include "camera/camera_json.h"
#include "fuzz/cameras.h"
#include "fuzz/json_damage.h"
#include "fuzz/memory_file.h"
#include "fuzz/promise.h"
#include "fuzz/target.h"

namespace gloam::fuzz {
namespace {

constexpr Window display{-3, 2, 93, 56};

void read_as_file(const std::string& path) {
  std::vector<std::string> assumed;
  for (const auto& [name, camera] : read_camera_file(path, display, assumed)) check_camera(camera);
  for (const std::string& sentence : assumed) require_one_line(sentence);
}

void read_as_path(const std::string& path) {
  std::vector<std::string> assumed;
  for (const Camera& camera : read_camera_path(path, display, assumed)) check_camera(camera);
}

const std::string pose = R"("camera_to_world": [[1, 0, 0, 3], [0, 0.6, 0.8, 1e6], [0, -0.8, 0.6, -2], [0, 0, 0, 1]])";

const std::vector<std::string>& words() {
  static const std::vector<std::string> names = {"views",
                                                 "view",
                                                 "path",
                                                 "frames",
                                                 "modules",
                                                 "camera_type",
                                                 "fx",
                                                 "fy",
                                                 "cx",
                                                 "cy",
                                                 "near",
                                                 "far",
                                                 "width",
                                                 "height",
                                                 "unit",
                                                 "ORTHO",
                                                 "PERSP",
                                                 "pixels_per_unit",
                                                 "projection_gl",
                                                 "camera_to_world",
                                                 "world_to_camera",
                                                 "left",
                                                 "right",
                                                 "mono",
                                                 "stereo",
                                                 ""};
  return names;
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string pixels = R"("fx": 80, "fy": 80.5, "cx": 48, "cy": 27, "near": 0.05, "far": 60)";
  const std::string projection =
      R"("projection_gl": [[1.6, 0, 0.1, 0], [0, 2.9, 0, 0], [0, 0, -1.01, -0.2], [0, 0, -1, 0]])";
  const std::string orthographic =
      R"("camera_type": "ORTHO", "pixels_per_unit": 12, "cx": 48, "cy": 27, "width": 192, "height": 108)";
  const std::string parallel = R"("projection_gl": [[0.2, 0, 0, 0], [0, 0.4, 0, 0.5], [0, 0, -0.1, 0], [0, 0, 0, 1]])";
  const std::string world_to_camera =
      R"("world_to_camera": [[0.8, 0, 0.6, 1], [0, 1, 0, 2], [-0.6, 0, 0.8, 3], [0, 0, 0, 1]])";
  return {
      "{" + pixels + ", " + pose + "}",
      "{" + projection + ", " + world_to_camera + "}",
      "{" + orthographic + ", " + pose + "}",
      "{" + parallel + ", " + world_to_camera + "}",
      R"({"views": [{"view": "mono", )" + pixels + ", " + pose + "}]}",
      R"({"views": [{"view": "left", )" + pose + R"(}, {"view": "right", )" + world_to_camera + "}], " + pixels + "}",
      R"({"path": [{)" + pose + "}, {" + world_to_camera + "}], \"frames\": 5, " + pixels + "}",
      R"({"path": [{)" + pose + "}, {" + world_to_camera + "}, {" + pose + "}], " + parallel + "}",
      R"({"modules": {"count": 3}})",
      R"({"fx": NaN, "fy": -Infinity, "cx": Infinity})",
      R"([1, 2, {"a": "\u00e9\n"}])"};
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  static MemoryFile file;
  const std::string& path = file.hold(data, size);
  reads(path, [&] { read_as_file(path); });
  reads(path, [&] { read_as_path(path); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace gloam::fuzz;
  static const std::vector<std::string> starts = seeds();
  gloam::Random random(seed);
  return put(damaged_json({reinterpret_cast<const char*>(data), size}, starts, words(), random), data, most);
}
