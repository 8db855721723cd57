#include "stress/draw.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <set>

#include "base/random.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "stress/frames.h"
#include "stress/modules.h"
#include "stress/probe.h"

namespace gloam::stress {
namespace {

/// Values that files are known to hold in wrong places, and floats of any size.
float any_value(Random& random) {
  static const std::vector<float> specials = {nan,    infinity, -infinity, 0,      -0.0f,  -1,
                                              -1e38f, 1e-45f,   1e-39f,    1e-30f, 1e-20f, 1e-6f,
                                              65504,  9.9e9f,   1e38f,     1,      0.5f,   3.4e38f};
  const size_t kind = random.below(4);
  if (kind == 0) return random.pick(specials);
  if (kind == 1) return std::bit_cast<float>(uint32_t(random.next()));
  if (kind == 2) return float(random.of_any_size(1e-30, 1e10));
  return float(random.uniform(1, 2));  // a surface: some neighbours must be near each other
}

Shot any_shot(Random& random) {
  // Few sizes: a CPU recompiles for each.
  static const std::vector<std::pair<int, int>> sizes = {{1, 1}, {1, 33}, {33, 1}, {17, 13}, {80, 60}, {93, 61}};
  const auto [width, height] = random.pick(sizes);
  Shot shot =
      random.one_in(3)
          ? orthographic(width, height, random.of_any_size(1e-6, 1e8))
          : perspective(width, height, random.one_in(2) ? random.uniform(20, 120) : random.pick({1.0, 150.0, 179.0}));
  if (random.one_in(3)) {  // off its axis, and with pixels that are not square
    shot.camera.cx += random.uniform(-2, 2) * width;
    shot.camera.cy += random.uniform(-2, 2) * height;
    shot.camera.fy *= random.uniform(0.5, 2);
  }
  return shot;
}

glm::dvec3 any_position(Random& random, double size) {
  return size * glm::dvec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

Pose any_pose(Random& random) {
  Pose pose;
  pose.position = any_position(random, random.one_in(2) ? 1 : random.of_any_size(1e-3, 1e7));
  const double angle = random.one_in(2) ? 0 : random.uniform(-3, 3);
  pose.world_to_view = glm::dmat3(glm::rotate(glm::dmat4(1), angle, glm::normalize(glm::dvec3(0.2, 1, 0.1))));
  return pose;
}

/// The camera of the second view, or of the frame before: a little aside, anywhere, or with intrinsics of its own.
Camera beside(const Camera& camera, Random& random) {
  Camera other = camera;
  if (!other.pose) other.pose.emplace();
  other.pose->position += any_position(random, random.of_any_size(1e-9, 1e3));
  if (random.one_in(4)) other.pose = any_pose(random);
  if (random.one_in(4)) other.fx *= random.uniform(0.5, 2), other.cx += random.uniform(-20, 20);
  return other;
}

void fill_with_anything(Plane& plane, Random& random) {
  for (Channel& channel : plane.channels) {
    const Layout& layout = channel.layout();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) channel.at(x, y) = any_value(random);
    }
  }
}

/// Replaces one pixel in `one_of` by any value.
void sprinkle(Plane& plane, int one_of, Random& random) {
  for (Channel& channel : plane.channels) {
    const Layout& layout = channel.layout();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) {
        if (random.one_in(one_of)) channel.at(x, y) = any_value(random);
      }
    }
  }
}

/// Fills planes with noise everywhere, or here and there among the values of the room.
void spoil(Frame& frame, Random& random) {
  const bool everywhere = random.one_in(2);
  const int one_of = random.pick({3, 30, 300});
  for (View& view : frame.views) {
    for (auto& [name, plane] : view.planes) {
      if (everywhere)
        fill_with_anything(plane, random);
      else if (random.one_in(2))
        sprinkle(plane, one_of, random);
    }
  }
}

/// A value between the ends of a parameter's range, or at one of them.
double any_value_of(const Parameter& p, Random& random) {
  const double most = std::isinf(p.max) ? 1e9 : p.max, least = std::max(p.min, most * 1e-12);
  const size_t kind = random.below(4);
  const double value = kind == 0   ? p.min
                       : kind == 1 ? p.max
                       : kind == 2 ? random.uniform(p.min, most)
                                   : random.of_any_size(least, std::max(most, least));
  return std::clamp(double(float(value)), p.min, p.max);
}

/// Random values for some float parameters of the planned techniques.
Settings any_floats(const Plan& plan, Random& random) {
  Settings settings;
  std::set<std::string> seen;
  for (const PlannedPass& planned : plan.passes) {
    for (const Parameter& p : planned.technique->parameters) {
      const std::string name = planned.technique->name + "." + p.name;
      if (p.type != Parameter::Type::floating || !seen.insert(name).second || !random.one_in(4)) continue;
      settings.emplace_back(name, exact(any_value_of(p, random)));
    }
  }
  return settings;
}

/// What a plan's kernels are compiled with.
std::vector<Defines> defines_of(const Plan& plan) {
  std::vector<Defines> all;
  for (const PlannedPass& planned : plan.passes) all.push_back(planned.pass.defines);
  return all;
}

/// The settings, and those of `more` with which no kernel has to be compiled again: a float may switch a part of a kernel off.
Settings with_same_kernels(const Technique& technique, Frame& frame, Settings settings, const Settings& more) {
  const std::vector<Defines> defines = defines_of(plan_for(technique, frame, settings));
  for (const auto& one : more) {
    const Settings both = settings + Settings{one};
    if (defines_of(plan_for(technique, frame, both)) == defines) settings = both;
  }
  return settings;
}

/// Settings and a way to run them. A quick run compiles the cheapest preset for both ways and, for one of them each, two settings
/// that the seed determines: a choice, and floats that may switch parts of kernels off.
void draw_quick_settings(Draw& drawn, const Technique& technique, const std::vector<RunOptions>& ways, uint32_t seed,
                         Random& random) {
  const size_t rare = random.below(8);
  Settings settings = few_samples(technique);
  if (rare < ways.size()) {
    Random of_seed(seed, ~uint32_t(rare));
    settings = of_seed.pick(variants(technique, drawn.frame));
    settings = settings + any_floats(plan_for(technique, drawn.frame, settings), of_seed);
  }
  const Settings floats = any_floats(plan_for(technique, drawn.frame, settings), random);
  drawn.settings = with_same_kernels(technique, drawn.frame, settings, floats);
  drawn.options = ways[rare < ways.size() ? rare : random.below(ways.size())];
}

void draw_settings(Draw& drawn, const Technique& technique, const std::vector<RunOptions>& ways, Random& random) {
  if (random.one_in(3)) drawn.settings = random.pick(variants(technique, drawn.frame));
  drawn.settings = drawn.settings + any_floats(plan_for(technique, drawn.frame, drawn.settings), random);
  drawn.options = random.pick(ways);
}

}  // namespace

std::string Draw::text() const {
  const Camera& camera = *frame.views[0].camera;
  return fmt::format("{}x{}, {} fx {:.4g}, {}{}, {}", frame.width(), frame.height(), stress::text_of(camera), camera.fx,
                     frame.views.size() > 1 ? fmt::format("{} views, ", frame.views.size()) : "",
                     stress::text_of(settings), stress::text_of(options));
}

/// The room, seen by any camera or, if the technique takes them, by the modules of a display.
Frame any_view(const Technique& technique, Random& random) {
  if (technique.any_projection && random.one_in(3)) {
    static const std::vector<std::pair<int, int>> sizes = {{17, 13}, {33, 1}, {80, 60}};
    const auto [width, height] = random.pick(sizes);
    return shoot_modules(random.pick(display_cases()).display, width, height, room());
  }
  return shoot(any_shot(random), room(), !random.one_in(3));
}

Draw draw(const Technique& technique, const Device& device, Extent extent, uint32_t seed, uint32_t number) {
  Random random(seed, number);
  Draw drawn{any_view(technique, random), few_samples(technique), {}};
  View& first = drawn.frame.views[0];
  const bool is_module = first.camera->slits != nullptr;
  for (const std::string& name : technique.reads) {
    if (is_stack(name) || name == "normal") continue;
    for (View& view : drawn.frame.views) plane_of(view, Layout(drawn.frame.width(), drawn.frame.height()), name);
  }
  // Positions are in world space, so the camera needs a pose.
  if (!is_module && (random.one_in(2) || first.find("position"))) first.camera->pose = any_pose(random);
  const std::vector<RunOptions> ways = two_ways(device);
  if (extent == Extent::quick)
    draw_quick_settings(drawn, technique, ways, seed, random);
  else
    draw_settings(drawn, technique, ways, random);
  for (size_t i = 1; i < drawn.frame.views.size() && !is_module; ++i)
    drawn.frame.views[i].camera = beside(*drawn.frame.views[0].camera, random);
  if (random.one_in(2) && !is_module) {
    for (View& view : drawn.frame.views) view.camera_before = beside(*view.camera, random);
  }
  spoil(drawn.frame, random);
  normalise(drawn.frame);
  drawn.options.seed = random.between(0, 999);
  return drawn;
}

Draw clone(const Draw& draw) { return {clone(draw.frame), draw.settings, draw.options}; }

namespace {

/// The part of a frame from column x0 and row y0 on.
Frame part_of(const Frame& frame, int x0, int y0, int width, int height) {
  Frame part = clone(frame);
  part.window = part.display = {0, 0, width, height};
  for (View& view : part.views) {
    for (std::optional<Camera>* camera : {&view.camera, &view.camera_before}) {
      if (*camera) (*camera)->cx -= x0, (*camera)->cy -= y0;
    }
    for (auto& [name, plane] : view.planes) {
      for (Channel& channel : plane.channels) {
        Channel smaller(Layout(width, height), plane_kind(name).outside);
        for (int y = 0; y < height; ++y) std::copy_n(channel.row(y0 + y) + x0, width, smaller.row(y));
        channel = std::move(smaller);
      }
    }
  }
  return part;
}

/// Values that are easy for any technique: a wall before the eye.
float calm_value(const std::string& plane, size_t component) {
  const PlaneKind::Meaning meaning = plane_kind(plane).meaning;
  if (meaning == PlaneKind::view_depth) return 1;
  return meaning == PlaneKind::unit_vector && component == 2 ? 1 : 0;
}

void calm(Plane& plane, int x0, int y0, int x1, int y1) {
  for (size_t i = 0; i < plane.channels.size(); ++i) {
    for (int y = y0; y < y1; ++y)
      std::fill(plane.channels[i].row(y) + x0, plane.channels[i].row(y) + x1, calm_value(plane.name, i));
  }
}

class Shrinking {
 public:
  Shrinking(Draw failing, const std::function<bool(const Draw&)>& fails) : best_(std::move(failing)), fails_(fails) {}
  Draw result() {
    while (tried_ < most && (settings() | options() | size() | planes())) continue;
    pixels();
    return std::move(best_);
  }

 private:
  static constexpr int most = 400;  ///< limits the time: a new size or choice compiles again

  bool keep(Draw candidate) {
    if (++tried_ > most || !fails_(candidate)) return false;
    best_ = std::move(candidate);
    return true;
  }
  bool settings() {
    bool smaller = false;
    for (size_t i = best_.settings.size(); i-- > 0;) {
      Draw without = clone(best_);
      without.settings.erase(without.settings.begin() + long(i));
      smaller |= keep(std::move(without));
    }
    return smaller;
  }
  bool options() {
    const RunOptions simplest{.math = Math::precise, .lanes = 1};
    if (best_.options.lanes == 1 && best_.options.math == Math::precise && best_.options.seed == 0) return false;
    Draw simpler = clone(best_);
    simpler.options = simplest;
    return keep(std::move(simpler));
  }
  bool size() {
    const int w = best_.frame.width(), h = best_.frame.height(), left = w / 2, upper = h / 2;
    bool smaller = false;
    if (w > 1) smaller = cut(0, 0, left, h) || cut(left, 0, w - left, h);
    if (h > 1 && !smaller) smaller = cut(0, 0, w, upper) || cut(0, upper, w, h - upper);
    return smaller;
  }
  bool cut(int x0, int y0, int width, int height) {
    Draw part = clone(best_);
    part.frame = part_of(best_.frame, x0, y0, width, height);
    return keep(std::move(part));
  }
  bool planes() {
    bool smaller = false;
    for (size_t view = 0; view < best_.frame.views.size(); ++view) {
      for (const auto& [name, plane] : best_.frame.views[view].planes) {
        if (calmed_.insert({view, name}).second &&
            keep_calm(view, name, 0, 0, best_.frame.width(), best_.frame.height())) {
          return true;
        }
      }
    }
    return smaller;
  }
  bool keep_calm(size_t view, const std::string& name, int x0, int y0, int x1, int y1) {
    Draw calmer = clone(best_);
    calm(calmer.frame.views[view].planes.at(name), x0, y0, x1, y1);
    if (same_bits(calmer.frame, best_.frame)) return false;
    return keep(std::move(calmer));
  }
  /// Replaces rows, then single pixels, by calm values.
  void pixels() {
    for (size_t view = 0; view < best_.frame.views.size(); ++view) {
      std::vector<std::string> names;
      for (const auto& [name, plane] : best_.frame.views[view].planes) names.push_back(name);
      for (const std::string& name : names) {
        for (int y = 0; y < best_.frame.height() && tried_ < most; ++y) {
          if (keep_calm(view, name, 0, y, best_.frame.width(), y + 1)) continue;
          for (int x = 0; x < best_.frame.width() && tried_ < most; ++x) keep_calm(view, name, x, y, x + 1, y + 1);
        }
      }
    }
  }

  Draw best_;
  const std::function<bool(const Draw&)>& fails_;
  std::set<std::pair<size_t, std::string>> calmed_;
  int tried_ = 0;
};

}  // namespace

Draw shrunk(Draw failing, const std::function<bool(const Draw&)>& fails) {
  return Shrinking(std::move(failing), fails).result();
}

}  // namespace gloam::stress
