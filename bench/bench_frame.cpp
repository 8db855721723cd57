#include "bench/bench_frame.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/lists.h"
#include "base/low_discrepancy.h"
#include "flags/typed.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "loggia.h"
#include "measure/measures.h"
#include "measure/native.h"

namespace gloam::bench {
namespace {

Plane& emplace(View& view, const std::string& name, const Layout& layout) {
  const PlaneKind kind = plane_kind(name);
  Plane plane{name, {}};
  for (size_t i = 0; i < kind.components.size(); ++i) plane.channels.emplace_back(layout, kind.outside);
  return view.planes.emplace(name, std::move(plane)).first->second;
}

void set3(Plane& plane, int x, int y, const glm::vec3& value) {
  for (int i = 0; i < 3; ++i) plane.channels[size_t(i)].at(x, y) = value[i];
}

void scale(Plane& plane, float factor) {
  for (Channel& channel : plane.channels) {
    for (size_t i = 0; i < channel.layout().count(); ++i) channel.data()[i] *= factor;
  }
}

void fill_with_noise(Plane& plane) {
  for (size_t c = 0; c < plane.channels.size(); ++c) {
    Channel& channel = plane.channels[c];
    const Layout& layout = channel.layout();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) {
        channel.at(x, y) = float(hash(uint32_t(layout.index(x, y) * 4 + c)) >> 8) * 0x1p-24f;
      }
    }
  }
}

View loggia_view(const Camera& camera, int width, int height) {
  using namespace analytic;
  const Scene scene = loggia_scene();
  View view;
  view.camera = camera;
  const Layout layout(width, height);
  Plane& depth = emplace(view, "depth", layout);
  Plane& normal = emplace(view, "normal", layout);
  Plane& albedo = emplace(view, "albedo", layout);
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Ray ray = camera_ray(camera, x + 0.5, y + 0.5);
      const std::optional<Hit> hit = first_hit(scene, ray);
      if (!hit) continue;
      depth.channels[0].at(x, y) = float(view_depth(camera, ray.origin + hit->distance * ray.direction));
      set3(normal, x, y, glm::vec3(camera.pose->world_to_view * hit->normal));
      set3(albedo, x, y, hit->object->albedo);
    }
  }
  return view;
}

Frame frame_of(int width, int height) {
  Frame frame;
  frame.display = frame.window = {0, 0, width, height};
  return frame;
}

void add_plane(View& view, const std::string& name) {
  if (view.find(name)) return;
  const PlaneKind kind = plane_kind(name);
  Plane plane;
  if (kind.meaning == PlaneKind::view_depth) {
    plane = view.planes.at("depth").clone();
    const std::optional<StackLayer> layer = stack_layer(name);
    if (layer) scale(plane, 1 + 0.1f * float(layer->number));
  } else if (kind.meaning == PlaneKind::unit_vector) {
    plane = view.planes.at("normal").clone();
  } else {
    fill_with_noise(emplace(view, name, view.planes.at("depth").channels[0].layout()));
    return;
  }
  plane.name = name;
  view.planes.emplace(name, std::move(plane));
}

}  // namespace

Frame loggia_frame(int width, int height) {
  Frame frame = frame_of(width, height);
  frame.views.push_back(loggia_view(analytic::loggia_camera(width, height), width, height));
  return frame;
}

Frame loggia_stereo_frame(int width, int height) {
  Frame frame = frame_of(width, height);
  for (const char* name : {"left", "right"}) {
    Camera camera = analytic::loggia_camera(width, height);
    const glm::dvec3 right = glm::transpose(camera.pose->world_to_view)[0];
    camera.pose->position += right * (name == std::string("left") ? -0.0325 : 0.0325);
    View view = loggia_view(camera, width, height);
    view.name = name;
    frame.views.push_back(std::move(view));
  }
  return frame;
}

void add_plane(Frame& frame, const std::string& name) {
  if (is_stack(name)) {
    for (int number = 0; number < most_layers; ++number) add_plane(frame, layer_name(name, number));
    return;
  }
  for (View& view : frame.views) add_plane(view, name);
}

float radius_reaching(const Frame& frame, double pixels) { return float(pixels / median_reach(frame, 1)); }

std::string size_name(const Frame& frame) { return fmt::format("{}x{}", frame.width(), frame.height()); }

void take_flags(CLI::App& flags, int& argc, char** argv) {
  flags.set_help_flag();  // Google Benchmark has one
  flags.allow_extras();
  try {
    flags.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    throw UsageError("{}", error.what());
  }
  const std::vector<std::string> others = flags.remaining();
  argc = int(std::remove_if(argv + 1, argv + argc, [&](const char* text) { return !contains(others, text); }) - argv);
}

void take_flags(int& argc, char** argv, std::vector<std::pair<int, int>>& sizes,
                const std::map<std::string, bool*>& switches) {
  CLI::App flags;
  for (const auto& [name, given] : switches) flags.add_flag(name, *given);
  const CLI::callback_t take = [&sizes](const CLI::results_t& texts) {
    sizes.clear();
    for (const std::string& text : texts) sizes.push_back(cli::parse_size(text, "--size"));
    return true;
  };
  flags.add_option("--size", take)->expected(1)->take_all()->check(cli::accepted_by(cli::parse_size, "--size"));
  take_flags(flags, argc, argv);
}

int run_program(const char* name, int argc, char** argv, int (*main)(int, char**)) {
  if (!make_openmp_wait_passively())
    std::fprintf(stderr, "%s: OMP_WAIT_POLICY=passive could not be set: threads of the native loop may spin\n", name);
  try {
    return main(argc, argv);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return error.exit_status();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace gloam::bench
