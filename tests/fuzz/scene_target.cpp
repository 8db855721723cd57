// Scenes from files: any OBJ or glTF text is either a scene that rays can be traced through, or refused in one line.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "fuzz/json_damage.h"
#include "fuzz/memory_file.h"
#include "fuzz/promise.h"
#include "fuzz/target.h"
#include "fuzz/words.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/import.h"
#include "gloam/scene/scene.h"
#include "gloam/scene/tracer.h"

namespace gloam::fuzz {
namespace {

namespace fs = std::filesystem;

bool is_gltf(const std::string& text) { return text.starts_with("{"); }

/// assimp chooses by the ending of a name, so the file in memory gets two names.
class SceneFile {
 public:
  SceneFile() {
    std::string name = (fs::temp_directory_path() / "gloam_fuzz_XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "a folder can be made");
    folder_ = name;
    std::atexit([] { fs::remove_all(folder_); });
  }
  fs::path hold(const std::string& text) {
    const std::string& held = file_.hold(reinterpret_cast<const uint8_t*>(text.data()), text.size());
    const fs::path path = fs::path(folder_) / (is_gltf(text) ? "scene.gltf" : "scene.obj");
    std::error_code exists;
    fs::create_symlink(held, path, exists);
    return path;
  }

 private:
  MemoryFile file_;
  inline static std::string folder_;
};

void trace(const Scene& scene) {
  const Tracer tracer(scene);
  CaptureOptions options;
  options.width = 8;
  options.height = 4;
  options.planes = {"normal", "albedo", "position"};
  options.peel = 2;
  for (const SceneCamera& camera : scene.cameras) {
    options.views = {{"", camera_for(camera, options.width, options.height), {}}};
    capture(tracer, options);
  }
}

const std::vector<std::string>& words() {
  static const std::vector<std::string> names = {
      "nodes",   "mesh", "meshes",     "children",   "matrix",      "translation", "rotation",     "scale",
      "camera",  "xfov", "yfov",       "znear",      "zfar",        "perspective", "orthographic", "aspectRatio",
      "buffers", "uri",  "byteLength", "byteOffset", "bufferViews", "accessors",   "count",        "componentType",
      "indices", "mode", "material",   "materials",  "attributes",  "POSITION",    "NORMAL",       "TEXCOORD_0"};
  return names;
}

/// Replaces a word by another one of OBJ files, at any position.
std::string damaged_obj(std::string text, Random& random) {
  if (random.one_in(3)) return mutated(text);
  const std::vector<std::string> odd = {"1e20", "-1e20", "1e38", "1e39", "nan",      "inf", ".5",   "-.5", "5.",
                                        "0",    "1e-40", "-1",   "99",   "1/2/3",    "1//", "\\\n", "v",   "f",
                                        "l",    "p",     "vn",   "vt",   "usemtl a", "o b", "g c",  "x"};
  std::vector<size_t> spaces;
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == ' ') spaces.push_back(i);
  if (spaces.empty()) return text + "\nv " + random.pick(odd) + " 0 0\n";
  const size_t from = spaces[random.below(spaces.size())] + 1;
  const size_t to = std::min(text.find_first_of(" \n", from), text.size());
  return text.replace(from, to - from, random.pick(odd));
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string triangle =
      R"("buffers": [{"uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA", "byteLength": 36}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
      "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 0]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])";
  return {
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "mtllib none.mtl\no a\nv 0 0 0 1\nv 1 0 0 1\nv 1 1 0 1\nv 0 1 .5 1\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 "
      "3/1/1 4/1/1\n"
      "g b\nv 0 0 2\nf -1 -2 -3\nl 1 2\n",
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], )" + triangle +
          "}",
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, "translation": [1, 2, 3],
          "rotation": [0, 0, 0, 1], "scale": [1, 1, 2], "children": [2]}, {"camera": 0, "translation": [0, 0, 5]},
          {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1, 1, 1]}], "cameras": [{"type": "perspective",
          "perspective": {"yfov": 0.7, "znear": 0.1, "zfar": 100, "aspectRatio": 1.5}}], )" +
          triangle + "}"};
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  static SceneFile file;
  const fs::path path = file.hold({reinterpret_cast<const char*>(data), size});
  // Rays are traced through a scene known only by its name.
  reads(path.filename().string(), [&] { trace(gloam::import_scene(path)); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace gloam::fuzz;
  static const std::vector<std::string> starts = [] {
    std::vector<std::string> all;
    for (const std::string& text : seeds())
      if (is_gltf(text)) all.push_back(text);
    return all;
  }();
  gloam::Random random(seed);
  const std::string text(reinterpret_cast<const char*>(data), size);
  return put(is_gltf(text) ? damaged_json(text, starts, words(), random) : damaged_obj(text, random), data, most);
}
