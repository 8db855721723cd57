#include "support/seen_frame.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "gloam/projection.h"

namespace gloam::test {

using glm::dvec2;
using glm::dvec3;

glm::dmat3 turned_view(double yaw, double pitch) {
  const double c = std::cos(yaw), s = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  const dvec3 right(c, 0, -s), ahead(-s * cp, sp, -c * cp), up = glm::cross(right, ahead);
  return glm::transpose(glm::dmat3(right, up, -ahead));
}

Camera known_camera() {
  Camera camera;
  camera.fx = camera.fy = 250;
  camera.cx = 160;
  camera.cy = 90;
  camera.pose = Pose{turned_view(0.4, -0.2), {3, 1.5, 7}};
  return camera;
}

double wavy_depth(const dvec2& pixel) {
  const bool is_box = pixel.x > 100 && pixel.x < 180 && pixel.y > 60 && pixel.y < 140;
  return is_box ? 3.5 + 0.002 * pixel.x : 8 + std::sin(pixel.x * 0.05) + 0.8 * std::cos(pixel.y * 0.08);
}

dvec3 world_at(const Camera& camera, const dvec2& pixel, double depth) {
  return glm::transpose(camera.pose->world_to_view) * view_ray(camera, pixel)->at(depth) + camera.pose->position;
}

std::map<std::string, std::vector<float>> SeenFrame::channels(const std::vector<std::string>& layers) const {
  std::map<std::string, std::vector<float>> values;
  const char* components[] = {".X", ".Y", ".Z"};
  const auto put = [&](const std::string& layer, const dvec3& v) {
    for (int c = 0; c < 3; ++c) values[layer + components[c]].push_back(float(v[c]));
  };
  for (int y = data.y0; y < data.y1; ++y)
    for (int x = data.x0; x < data.x1; ++x) {
      const dvec2 pixel = dvec2(x, y) + sample;
      const bool is_surface = !is_background(x, y);
      const auto world = [&](double dx, double dy) {
        const dvec2 place = pixel + dvec2(dx, dy);
        return world_at(camera, place, depth(place));
      };
      const double z = depth(pixel), length = glm::distance(world(0, 0), camera.pose->position);
      const dvec3 normal =
          glm::normalize(glm::cross(world(0, 1e-3) - world(0, -1e-3), world(1e-3, 0) - world(-1e-3, 0)));
      for (const std::string& layer : layers) {
        if (layer.ends_with("Z"))
          values[layer].push_back(is_surface ? float(stored_depth(z, length)) : 1e10f);
        else if (layer.find('N') != std::string::npos)
          put(layer, is_surface ? normal : dvec3(0.0));
        else
          put(layer, is_surface ? stored(world(0, 0)) : dvec3(background_position));
      }
    }
  return values;
}

void SeenFrame::write(const std::filesystem::path& path, const std::vector<std::string>& layers) const {
  const auto inclusive = [](const Window& w) {
    return Imath::Box2i(Imath::V2i(w.x0, w.y0), Imath::V2i(w.x1 - 1, w.y1 - 1));
  };
  Imf::Header header(inclusive(display), inclusive(data));
  header.compression() = Imf::ZIP_COMPRESSION;
  std::map<std::string, std::vector<float>> values = channels(layers);
  std::map<std::string, std::vector<half>> halves;
  Imf::FrameBuffer buffer;
  const size_t width = size_t(data.width());
  const long corner = data.x0 + long(width) * data.y0;
  for (auto& [name, floats] : values) {
    const bool as_half = is_half && name.find('P') != std::string::npos;
    if (as_half) halves[name].assign(floats.begin(), floats.end());
    const size_t size = as_half ? sizeof(half) : sizeof(float);
    char* first = as_half ? reinterpret_cast<char*>(halves[name].data()) : reinterpret_cast<char*>(floats.data());
    const Imf::PixelType type = as_half ? Imf::HALF : Imf::FLOAT;
    header.channels().insert(name, Imf::Channel(type));
    buffer.insert(name, Imf::Slice(type, first - corner * long(size), size, size * width));
  }
  change(header);
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(data.height());
}

void SeenFrame::write_camera(const std::filesystem::path& path) const {
  const glm::dmat3 turn = glm::transpose(camera.pose->world_to_view);
  nlohmann::json matrix = nlohmann::json::array();
  for (int row = 0; row < 3; ++row)
    matrix.push_back({turn[0][row], turn[1][row], turn[2][row], camera.pose->position[row]});
  matrix.push_back({0, 0, 0, 1});
  nlohmann::json document = {{"width", display.width()},
                             {"height", display.height()},
                             {"cx", camera.cx - display.x0},
                             {"cy", camera.cy - display.y0},
                             {"camera_to_world", matrix}};
  if (camera.orthographic)
    document.update({{"camera_type", "ORTHO"}, {"pixels_per_unit", camera.fx}});
  else
    document.update({{"fx", camera.fx}, {"fy", camera.fy}});
  std::ofstream(path) << document;
}

}  // namespace gloam::test
