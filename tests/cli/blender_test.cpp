// Ray-traced references against independent ones by Blender's Cycles: its ambient-occlusion pass, and its picture of a room in white
// light.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "cli/gloam_process.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "scene/built_in/mesh_builder.h"
#include "support/long.h"

namespace gloam::test::blender_test {
namespace {

using glm::vec3;

constexpr int width = 160, height = 90;
constexpr double radius = 0.6;

/// A floor, two walls, a table, a ball, steps and a leaning board; flat triangles.
Mesh room() {
  Mesh mesh;
  scenes::add_quad(mesh, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}, 4);
  scenes::add_quad(mesh, {-3, 0, -3}, {3, 0, -3}, {3, 3, -3}, {-3, 3, -3}, 4);
  scenes::add_quad(mesh, {-3, 0, 3}, {-3, 0, -3}, {-3, 3, -3}, {-3, 3, 3}, 4);
  scenes::add_box(mesh, {-1, 0.7f, -1.5f}, {0.6f, 0.8f, -0.5f});
  for (const float x : {-0.95f, 0.45f})
    for (const float z : {-1.45f, -0.65f}) scenes::add_box(mesh, {x, 0, z}, {x + 0.1f, 0.7f, z + 0.1f});
  for (int i = 0; i < 4; ++i)
    scenes::add_box(mesh, {1.2f + 0.3f * float(i), 0, -2.9f}, {3, 0.2f + 0.2f * float(i), -1 - 0.1f * float(i)});
  scenes::add_cylinder(mesh, {-0.2f, 0.8f, -1}, {-0.2f, 1.1f, -1}, 0.15f, 0.1f, 40);
  Mesh board;
  scenes::add_box(board, {-2, 0, -0.03f}, {-1.5f, 1.6f, 0.03f});
  scenes::append(mesh, board, scenes::moved({0, 0, -2.2f}) * scenes::turned(-0.35f, {1, 0, 0}));
  return mesh;
}

void write_obj(const fs::path& path, const Mesh& mesh) {
  std::ofstream out(path);
  out.precision(9);
  for (const vec3& p : mesh.positions) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const glm::uvec3& t : mesh.triangles) out << "f " << t.x + 1 << ' ' << t.y + 1 << ' ' << t.z + 1 << '\n';
}

void write_camera(const fs::path& path, const Camera& camera) {
  const glm::dmat3 turn = glm::transpose(camera.pose->world_to_view);
  const glm::dvec3 p = camera.pose->position;
  nlohmann::json matrix = nlohmann::json::array();
  for (int row = 0; row < 3; ++row) matrix.push_back({turn[0][row], turn[1][row], turn[2][row], p[row]});
  matrix.push_back({0, 0, 0, 1});
  std::ofstream(path) << nlohmann::json{{"width", width},           {"height", height}, {"fx", camera.fx},
                                        {"fy", camera.fy},          {"cx", camera.cx},  {"cy", camera.cy},
                                        {"camera_to_world", matrix}};
}

/// What Blender renders of the folder's scene. `kind`: "ao" or "white_light"; `plane`: the name of what is rendered.
Channel rendered(const fs::path& folder, const std::string& kind, const std::string& plane, int seed) {
  const fs::path out = folder / fmt::format("blender_{}_{}.exr", kind, seed);
  const std::string command = fmt::format(
      "blender -b --factory-startup --python-exit-code 1 -P '{}/tests/blender/render_truth.py' -- {} '{}' '{}' {} 512 "
      "{} '{}' "
      ">'{}' 2>&1",
      GLOAM_SOURCE_DIR, kind, (folder / "room.obj").string(), (folder / "view.camera.json").string(), radius, seed,
      out.string(), (folder / "blender.log").string());
  if (std::system(command.c_str()) != 0) throw Error("Blender failed: {}", slurp(folder / "blender.log"));
  ReadOptions options;
  options.as_stored = true;
  options.camera_file = (folder / "view.camera.json").string();
  return std::move(FrameFile(out, options).read({plane}).views[0].planes.at(plane).channels[0]);
}

/// Whether the pixel and its neighbours show one flat face: at edges the two programs sometimes sample different faces.
bool is_inside_a_face(const View& view, int x, int y) {
  if (x == 0 || y == 0 || x == width - 1 || y == height - 1) return false;
  const std::vector<Channel>& n = view.planes.at("normal").channels;
  const Channel& z = view.planes.at("depth").channels[0];
  if (is_background(z.at(x, y))) return false;
  for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    double cosine = 0;
    for (size_t i = 0; i < 3; ++i) cosine += double(n[i].at(x, y)) * n[i].at(x + dx, y + dy);
    if (!(cosine > 0.999 && std::abs(z.at(x + dx, y + dy) / z.at(x, y) - 1) < 0.1)) return false;
  }
  return true;
}

class Blender : public Cli {
 protected:
  /// Captures the room, and traces a truth of it.
  void trace(const std::string& kind, const std::string& reach) const {
    const std::string obj = path("room.obj"), camera = path("view.camera.json");
    write_obj(obj, room());
    write_camera(camera, camera_for(looking_at("main", {2.2, 1.9, 2.4}, {-0.3, 0.6, -1.2}, 65), width, height));
    ASSERT_EQ(gloam({"capture", obj, "-o", path("frame.exr"), "--size", "160x90", "--camera", camera, "--planes",
                     "depth,normal,albedo"})
                  .err,
              "");
    const Result traced = gloam({"reference", kind, path("frame.exr"), "--scene", obj, "-o", path("reference.exr"),
                                 "--radius", reach, "--samples", "4096"});
    ASSERT_EQ(traced.status, 0) << traced.err;
  }

  /// Compares the traced plane with two renderings, each divided by `scale`. Pixels at edges do not count.
  void expect_agreement(const std::string& kind, const Channel& a, const Channel& b, double scale) const {
    FrameFile file(path("reference.exr"), {});
    const Frame ours = file.read({kind}), captured = FrameFile(path("frame.exr"), {}).read({"depth", "normal"});
    double ours_to_theirs = 0, theirs_to_theirs = 0, bias = 0;
    int count = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!is_inside_a_face(captured.views[0], x, y)) continue;
        const double mean = (a.at(x, y) + b.at(x, y)) / 2 / scale, half = (a.at(x, y) - b.at(x, y)) / 2 / scale;
        const double error = ours.views[0].planes.at(kind).channels[0].at(x, y) - mean;
        ours_to_theirs += error * error;
        theirs_to_theirs += half * half;
        bias += error;
        ++count;
      }
    }
    ASSERT_GT(count, width * height / 2);
    const double rmse = std::sqrt(ours_to_theirs / count), blender_noise = std::sqrt(theirs_to_theirs / count);
    const double our_noise = file.number_attribute(kind + "Noise").value();
    std::printf("%s, %d pixels: RMSE %.5f, bias %+.5f; noise of Blender %.5f, of gloam %.5f\n", kind.c_str(), count,
                rmse, bias / count, blender_noise, our_noise);
    EXPECT_LT(rmse, 1.5 * std::hypot(blender_noise, our_noise));
    EXPECT_LT(std::abs(bias / count), 1e-3);
  }
};

TEST_F(Blender, AgreesWithTheReferenceWithinTheNoise) {
  if (std::system("command -v blender >/dev/null") != 0) GTEST_SKIP() << "no blender to compare with";
  trace("ao", "0.6");
  expect_agreement("ao", rendered(folder, "ao", "ao", 1), rendered(folder, "ao", "ao", 2), 1);
}

/// Passes that are read as `plane`, whichever of the file's layers that is.
Frame pass_of(const fs::path& file, const std::string& plane, const std::string& layer = "") {
  ReadOptions options{.as_stored = true};
  if (!layer.empty()) options.channels = {{plane, layer}};
  return FrameFile(file, options).read({plane});
}

// Blender's colour is the sum of its passes, so what a composite leaves alone and what it darkens are all but what glossy surfaces mirror. Of
// glass a part is in no pass of Blender 3.4, so the sum is compared where nothing mirrors, and through glass only where it is whole.
TEST_F(Blender, ItsColourIsTheSumOfThePassesThatAreRead) {
  if (std::system("command -v blender >/dev/null") != 0) GTEST_SKIP() << "no blender to compare with";
  const std::string command = fmt::format(
      "blender -b --factory-startup --python-exit-code 1 -P '{}/tests/blender/render_passes.py' -- '{}' >'{}' 2>&1",
      GLOAM_SOURCE_DIR, folder.string(), path("blender.log").string());
  ASSERT_EQ(std::system(command.c_str()), 0) << slurp(path("blender.log"));
  const fs::path file = path("passes.exr");
  const Result run = gloam({"run", "hbao+", file, "-o", path("ao.exr"), "--float", "--radius", "1", "--composite",
                            path("c.exr"), "--into", path("copy.exr")});
  ASSERT_EQ(run.status, 0) << run.err;
  std::vector<Frame> added;
  for (const char* plane : {"emission", "backdrop", "volume", "transmission"}) added.push_back(pass_of(file, plane));
  const Frame colour = pass_of(file, "color"), made = pass_of(path("c.exr"), "color"),
              ao = pass_of(path("ao.exr"), "ao"), albedo = pass_of(file, "albedo"),
              illumination = pass_of(file, "illumination"), mirrors = pass_of(file, "reflectance"),
              &glass = added.back();
  double worst = 0, least = 0, worst_made = 0, change = 0;
  int compared = 0, behind_glass = 0;
  for (size_t i = 0; i < 3; ++i) {
    const auto at = [i](const Frame& frame, int x, int y) {
      return double(frame.views[0].planes.begin()->second.channels[i].at(x, y));
    };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double diffuse = at(albedo, x, y) * at(illumination, x, y);
        const double open = ao.views[0].find("ao")->channels[0].at(x, y);
        double left = at(colour, x, y) - diffuse;
        for (const Frame& each : added) left -= at(each, x, y);
        least = std::min(least, left);
        worst_made = std::max(worst_made, std::abs(at(colour, x, y) - diffuse * (1 - open) - at(made, x, y)));
        change = std::max(change, diffuse * (1 - open));
        behind_glass += at(glass, x, y) > 0.05 && std::abs(left) < 1e-5;
        if (at(mirrors, x, y) > 0) continue;
        worst = std::max(worst, std::abs(left));
        ++compared;
      }
  }
  EXPECT_GT(compared, 3 * width * height / 2);
  EXPECT_GT(behind_glass, 20);
  EXPECT_GT(least, -1e-5);
  EXPECT_LT(worst, 1e-5);
  EXPECT_LT(worst_made, 1e-5);
  EXPECT_GT(change, 0.05);
  for (const fs::path& name : {file, path("copy.exr")})
    EXPECT_EQ(gloam({"info", name, "--json", "-"}).json()["cryptomattes"], nlohmann::json({"ViewLayer.CryptoObject"}));
  // Of a transparent film, Env is written all the same.
  const Result film = gloam({"run", "hbao+", path("film.exr"), "--radius", "1", "--composite", path("film_c.exr")});
  ASSERT_EQ(film.status, 0) << film.err;
  EXPECT_NE(film.err.find("backdrop: is more than the colour"), std::string::npos) << film.err;
  EXPECT_NE(film.err.find("emission (ViewLayer.Emit), volume"), std::string::npos) << film.err;
}

// A white sky over diffuse surfaces: the picture is the albedo times what arrives after all reflections.
TEST_F(Blender, AgreesWithBouncesWithinTheNoise) {
  ONLY_IN_LONG_RUN();
  if (std::system("command -v blender >/dev/null") != 0) GTEST_SKIP() << "no blender to compare with";
  trace("bounces", "inf");
  const Frame captured = FrameFile(path("frame.exr"), {}).read({"albedo"});
  const double albedo = captured.views[0].planes.at("albedo").channels[0].at(width / 2, height / 2);
  ASSERT_NEAR(albedo, 0.6, 1e-6) << "as render_truth.py has it";
  expect_agreement("bounces", rendered(folder, "white_light", "color", 1), rendered(folder, "white_light", "color", 2),
                   albedo);
}

}  // namespace
}  // namespace gloam::test::blender_test
