// The program `scene_pages`: measures every built-in scene, draws it, and writes the pages that show them.
//   scene_pages ROOT    ROOT is the repository; script/update-scenes runs it
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/files.h"
#include "gloam/error.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/reference.h"
#include "gloam/scene/scene.h"
#include "gloam/visualise.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

constexpr int width = 960, height = 540, peeled_layers = 8, ao_rays = 64;
/// AO below this means geometry within the scene's ao_radius: at least one of 64 rays is blocked.
constexpr double open_ao = 0.995;

constexpr int columns = 4, tile_width = 240, least_tile_width = 160;
constexpr uintmax_t largest_picture = 350'000;  // bytes: the pictures are kept with the source

struct Figures {
  SceneRecipe recipe;
  size_t faces = 0, meshes = 0;
  double mean_layers = 0, background = 0, near_geometry = 0, ao_radius = 0;
  int most_layers = 0;
  std::vector<std::string> cameras;
};

// --- Measuring

/// The camera of the frame before: a tenth of the AO radius further left, so that there is visible motion.
Camera camera_before(Camera camera, double ao_radius) {
  const glm::dmat3& turn = camera.pose->world_to_view;
  camera.pose->position -= 0.1 * ao_radius * glm::dvec3(turn[0][0], turn[1][0], turn[2][0]);
  return camera;
}

Frame capture_all(const Tracer& tracer) {
  const Scene& scene = tracer.scene();
  CaptureOptions options;
  options.width = width;
  options.height = height;
  options.planes = capture_planes();
  options.peel = peeled_layers;
  const Camera camera = camera_for(scene.cameras.front(), width, height);
  options.views = {{"", camera, camera_before(camera, scene.ao_radius)}};
  return capture(tracer, options).frame;
}

void measure(const View& view, Figures& figures) {
  const Channel &depth = view.planes.at("depth").channels[0], &layers = view.planes.at("peel_count").channels[0],
                &ao = view.planes.at("ao").channels[0];
  long long foreground = 0, surfaces = 0, near = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (is_background(depth.at(x, y))) continue;
      ++foreground;
      surfaces += std::llround(layers.at(x, y));
      figures.most_layers = std::max(figures.most_layers, int(std::lround(layers.at(x, y))));
      near += ao.at(x, y) < open_ao;
    }
  figures.background = 1 - double(foreground) / (double(width) * height);
  if (foreground == 0) return;
  figures.mean_layers = double(surfaces) / double(foreground);
  figures.near_geometry = double(near) / double(foreground);
}

/// The contact sheet, with tiles as large as the file size limit allows; the smallest tile is kept whatever its size (foliage).
void draw(const fs::path& path, const Frame& frame, const std::string& name) {
  for (int tile = tile_width; tile >= least_tile_width; tile -= 16) {
    write_contact_sheet(path, frame, {.title = name, .tile_width = tile, .columns = columns, .colour_step = 4});
    if (fs::file_size(path) <= largest_picture) return;
  }
}

Figures figures_of(const SceneRecipe& recipe, const fs::path& pictures) {
  const Scene scene = recipe.make(ParameterValues(recipe.parameters));
  const Tracer tracer(scene);
  Frame frame = capture_all(tracer);
  AoReferenceOptions options;
  options.radius = scene.ao_radius;
  options.samples = ao_rays;
  frame.views[0].planes["ao"] = std::move(ao_reference(tracer, frame, options).frame.views[0].planes.at("ao"));
  Figures figures{.recipe = recipe, .faces = scene.faces(), .meshes = scene.meshes.size()};
  figures.ao_radius = scene.ao_radius;
  for (const SceneCamera& camera : scene.cameras) figures.cameras.push_back(camera.name);
  measure(frame.views[0], figures);
  draw(pictures / (recipe.name + ".png"), frame, recipe.name);
  return figures;
}

// --- Pages

/// 1234567 as "1 234 567".
std::string grouped(size_t n) {
  std::string digits = std::to_string(n);
  for (int i = int(digits.size()) - 3; i > 0; i -= 3) digits.insert(size_t(i), " ");
  return digits;
}

std::string table(const std::vector<Figures>& all, const std::string& page) {
  std::string text =
      "| scene | faces | meshes | layers: mean | most | background | near geometry | AO radius | cameras |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---|\n";
  for (const Figures& f : all)
    text += fmt::format("| [{0}]({1}#{0}) | {2} | {3} | {4:.2f} | {5} | {6:.1f} % | {7:.0f} % | {8:g} | {9} |\n",
                        f.recipe.name, page, grouped(f.faces), f.meshes, f.mean_layers, f.most_layers,
                        100 * f.background, 100 * f.near_geometry, f.ao_radius, fmt::join(f.cameras, ", "));
  return text;
}

std::string initial_value(const Parameter& p) {
  const ParameterValues values({p});
  return values.text(p.name);
}

std::string section(const Figures& f) {
  std::string text = fmt::format("\n## {}\n\n{}.\n\n", f.recipe.name, f.recipe.summary);
  text[text.find(f.recipe.summary)] = char(std::toupper(f.recipe.summary[0]));
  if (f.recipe.parameters.empty()) text += "It has no parameters.\n";
  for (const Parameter& p : f.recipe.parameters)
    text += fmt::format("- `--{} {}`: {} ({})\n", p.name, initial_value(p), p.help, allowed_values(p));
  text += fmt::format("\nCameras: {}.\n", enumerate(f.cameras));
  for (const ShotRecipe& shot : f.recipe.shots)
    text += fmt::format("\nMoving, `--shot {}`: {} ({} frames).\n", shot.name, shot.summary, shot.frames);
  text += fmt::format("\n![All planes of {}](images/scenes/{}.png)\n", f.recipe.name, f.recipe.name);
  return text;
}

std::string page(const std::vector<Figures>& all) {
  std::string text =
      "<!-- Written by script/update-scenes: change host/scene/built_in/ or data/scene_pages.cpp instead. -->\n"
      "# Built-in scenes\n\n"
      "Each is made by a program in `host/scene/built_in/`, the same at every run; `gloam capture NAME -o frame.exr` "
      "makes a "
      "G-buffer of it.\n\n";
  text += table(all, "");
  text += fmt::format(
      "\nMeasured from the first camera at {}x{} with the parameters' defaults. Layers: surfaces under a pixel that "
      "shows any. Near geometry: share of the pixels that show a surface where ambient occlusion within the AO radius, "
      "traced with {} rays, is below {}. Lengths are in metres. In the pictures `ao` is that ambient occlusion, and "
      "`motion` is what a camera sees that has moved to the right by a tenth of the AO radius.\n",
      width, height, ao_rays, open_ao);
  for (const Figures& f : all) text += section(f);
  return text;
}

/// Replaces the table between the markers of a page that people write.
void renew_table(const fs::path& path, const std::string& table) {
  const std::string begin = "<!-- scenes -->\n", end = "<!-- /scenes -->";
  std::string text = read_text(path);
  const size_t from = text.find(begin), to = text.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from)
    throw Error("{}: has no lines '<!-- scenes -->' and '{}' to put the table between", path.string(), end);
  text.replace(from + begin.size(), to - from - begin.size(), table);
  write_text(path, text);
}

void write_pages(const fs::path& root) {
  const fs::path pictures = root / "docs/images/scenes";
  fs::create_directories(pictures);
  std::vector<Figures> all;
  for (const SceneRecipe& recipe : builtin_scenes()) {
    all.push_back(figures_of(recipe, pictures));
    fmt::print("{}: {} faces, {} bytes of picture\n", recipe.name, all.back().faces,
               fs::file_size(pictures / (recipe.name + ".png")));
    std::fflush(stdout);
  }
  write_text(root / "docs/scenes.md", page(all));
  renew_table(root / "data/README.md", table(all, "../docs/scenes.md"));
}

}  // namespace
}  // namespace gloam

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: scene_pages ROOT\n");
    return 2;
  }
  try {
    gloam::write_pages(argv[1]);
  } catch (const gloam::Error& error) {
    fmt::print(stderr, "scene_pages: {}\n", error.what());
    return error.exit_status();
  }
}
