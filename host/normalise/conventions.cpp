#include "normalise/conventions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// What renderers write for "nothing here" starts at 1e10 (Blender), and no scene reaches it.
constexpr float farthest = 1e10f;
/// From here on positions leave the range of float, whatever the camera: never a surface.
constexpr float beyond_reach = 1e20f;
/// Depths that would turn denormal in any product are no depths; the bound is far below every scene's unit.
constexpr float nearest = 1e-30f;

/// `body(y)` for every row, on all cores unless the image is so small that waking them would cost more.
template <typename Body>
void for_each_row(const Layout& layout, const Body& body) {
#pragma omp parallel for if (size_t(layout.width) * size_t(layout.height) > 65536)
  for (int y = 0; y < layout.height; ++y) body(y);
}

// --- Depth

/// What is background besides infinities, NaN, 0 and what is negative. A value that the user names takes the place of
/// the rule for 1e10.
struct Background {
  float value = std::numeric_limits<float>::quiet_NaN();  ///< --background; NaN equals nothing
  float from = farthest;                                  ///< anything from here on
  float far_low = infinity, far_high = -infinity;         ///< the far plane with its rounding; empty where not known
};

Background background_of(std::optional<float> value, std::optional<double> far) {
  Background background;
  if (value) {
    background.value = *value;
    background.from = beyond_reach;
  }
  if (far && std::isfinite(*far)) {
    background.far_low = float(*far * (1 - 2e-7));  // two roundings of float
    background.far_high = float(*far * (1 + 2e-7));
  }
  return background;
}

/// Bitwise operators, so that a loop over it becomes vector instructions. NaN fails the first comparison.
inline bool is_surface(float depth, const Background& background) {
  const bool at_far = (depth >= background.far_low) & (depth <= background.far_high);
  return (depth >= nearest) & (depth < background.from) & !at_far & (depth != background.value);
}

/// Signs of the surfaces in a plane, as far as they had to be looked at.
struct Signs {
  bool positive = false, negative = false, over_one = false;
};

Signs signs_of(const Channel& depth, const Background& background) {
  Signs signs;
  const int width = depth.layout().width, height = depth.layout().height;
  for (int y = 0; y < height && !signs.over_one; ++y) {
    const float* row = depth.row(y);
    int positive = 0, negative = 0, over_one = 0;
    for (int x = 0; x < width; ++x) {
      const bool surface = is_surface(row[x], background);
      positive |= surface;
      over_one |= surface & (row[x] > 1);
      negative |= is_surface(-row[x], background) & (row[x] != background.value);
    }
    signs.positive |= positive != 0;
    signs.negative |= negative != 0;
    signs.over_one |= over_one != 0;
  }
  return signs;
}

/// How many pixels would be surfaces if they were not negative.
long long count_negative(const Channel& depth, const Background& background) {
  const int width = depth.layout().width, height = depth.layout().height;
  long long total = 0;
#pragma omp parallel for reduction(+ : total) if (size_t(width) * size_t(height) > 65536)
  for (int y = 0; y < height; ++y) {
    const float* row = depth.row(y);
    int count = 0;
    for (int x = 0; x < width; ++x) count += is_surface(-row[x], background) & (row[x] != background.value);
    total += count;
  }
  return total;
}

void clean_row(float* row, int width, float sign, const Background& background) {
  for (int x = 0; x < width; ++x) {
    const float raw = row[x], depth = sign * raw;
    const bool surface = is_surface(depth, background) & (raw != background.value);
    row[x] = surface ? depth : infinity;
  }
}

/// Planar depth: only the background and the sign change.
void clean_depth(Channel& depth, float sign, const Background& background) {
  for_each_row(depth.layout(), [&](int y) { clean_row(depth.row(y), depth.layout().width, sign, background); });
}

void ray_row(float* row, const double* squares_x, int width, double square_y) {
  for (int x = 0; x < width; ++x) {
    const float z = float(row[x] / std::sqrt(1 + square_y + squares_x[x]));
    row[x] = z >= nearest ? z : infinity;
  }
}

/// Distance from the eye to planar depth, at pixel centres. +inf stays.
void ray_to_depth(Channel& depth, const Window& window, const Camera& camera) {
  const int width = depth.layout().width;
  std::vector<double> squares_x(static_cast<size_t>(width));
  for (int x = 0; x < width; ++x) {
    const double tangent = (window.x0 + x + 0.5 - camera.cx) / camera.fx;
    squares_x[size_t(x)] = tangent * tangent;
  }
  for_each_row(depth.layout(), [&](int y) {
    const double tangent = (window.y0 + y + 0.5 - camera.cy) / camera.fy;
    ray_row(depth.row(y), squares_x.data(), width, tangent * tangent);
  });
}

/// From window depth d to the reciprocal of view depth (perspective) or to view depth (orthographic): a + b d.
struct WindowDepth {
  double a, b;
  float lowest, highest;  ///< d of a surface: lowest <= d <= highest; the far value is left out
  float background;       ///< --background, NaN where none
};

void perspective_row(float* row, int width, const WindowDepth& map) {
  for (int x = 0; x < width; ++x) {
    const float d = row[x], z = float(1 / (map.a + map.b * d));
    const bool surface =
        (d >= map.lowest) & (d <= map.highest) & (d != map.background) & (z >= nearest) & (z < farthest);
    row[x] = surface ? z : infinity;
  }
}

void orthographic_row(float* row, int width, const WindowDepth& map) {
  for (int x = 0; x < width; ++x) {
    const float d = row[x], z = float(map.a + map.b * d);
    const bool surface =
        (d >= map.lowest) & (d <= map.highest) & (d != map.background) & (z >= nearest) & (z < farthest);
    row[x] = surface ? z : infinity;
  }
}

/// 0 is the near plane there, so a pixel that was never drawn can only be told by its alpha.
void mark_missing(Channel& depth, const Channel& alpha) {
  const int width = depth.layout().width;
  for_each_row(depth.layout(), [&](int y) {
    float* row = depth.row(y);
    const float* cover = alpha.row(y);
    for (int x = 0; x < width; ++x) row[x] = ((row[x] == 0) & (cover[x] == 0)) ? infinity : row[x];
  });
}

/// The map from window depth, checked: near and far are needed, and said by flags before they are by the camera.
WindowDepth window_depth(const Camera& camera, const ReadOptions& options, std::vector<std::string>& assumed) {
  const bool reversed = options.depth == DepthConvention::reversed;
  const char* name = reversed ? "reversed" : "ndc";
  const std::optional<double> near = options.near ? options.near : camera.near;
  std::optional<double> far = options.far ? options.far : camera.far;
  if (!near)
    throw Error("--depth {}: needs the distance of the near plane; give --near, or a camera that has it", name);
  if (!far && reversed && !camera.orthographic) {
    assumed.push_back("depth: the far plane taken as infinite; --far says otherwise");
    far = std::numeric_limits<double>::infinity();
  }
  if (!far) throw Error("--depth {}: needs the distance of the far plane; give --far, or a camera that has it", name);
  if (!std::isfinite(*near) || (!camera.orthographic && !(*near > 0)))
    throw Error("--depth {}: near is {:g}; expected a distance > 0", name, *near);
  if (!(*far > *near)) throw Error("--depth {}: far is {:g}; expected more than near, {:g}", name, *far, *near);
  if (camera.orthographic && !std::isfinite(*far))
    throw Error("--depth {}: far is infinite; an orthographic camera needs a finite one", name);

  const double at_near = camera.orthographic ? *near : 1 / *near, at_far = camera.orthographic ? *far : 1 / *far;
  WindowDepth map;
  map.a = reversed ? at_far : at_near;
  map.b = reversed ? at_near - at_far : at_far - at_near;
  map.lowest = reversed ? std::numeric_limits<float>::denorm_min() : 0.0f;
  map.highest = reversed ? 1.0f : std::nextafter(1.0f, 0.0f);
  map.background = options.background.value_or(std::numeric_limits<float>::quiet_NaN());
  return map;
}

std::string window_to_depth(Channel& depth, const Channel* alpha, const Camera& camera, const ReadOptions& options,
                            std::vector<std::string>& assumed) {
  const bool reversed = options.depth == DepthConvention::reversed;
  const WindowDepth map = window_depth(camera, options, assumed);
  if (alpha && !reversed) mark_missing(depth, *alpha);
  for_each_row(depth.layout(), [&](int y) {
    const auto convert = camera.orthographic ? orthographic_row : perspective_row;
    convert(depth.row(y), depth.layout().width, map);
  });
  return reversed ? "reversed" : "ndc";
}

// --- Normal space

/// A normal of the file beside the one that depth tells, both unit, the latter in view space.
struct NormalPair {
  glm::dvec3 given, from_depth;
};

glm::dvec3 view_position(const Channel& depth, const Window& window, const Camera& camera, int x, int y) {
  const std::optional<ViewRay> ray = view_ray(camera, {window.x0 + x + 0.5, window.y0 + y + 0.5});
  return ray ? ray->at(depth.at(x, y)) : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
}

/// The step of the surface from a pixel towards +x or +y, to whichever neighbour is nearer in depth; none where both
/// are background or across a depth edge.
std::optional<glm::dvec3> surface_step(const Channel& depth, const Window& window, const Camera& camera, int x, int y,
                                       int dx, int dy) {
  const int width = depth.layout().width, height = depth.layout().height;
  const float here = depth.at(x, y);
  float smallest = 0.1f * here;  // a larger jump from pixel to pixel is taken for an edge
  int side = 0;
  for (int s : {-1, 1}) {
    const int nx = x + s * dx, ny = y + s * dy;
    if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
    const float jump = std::abs(depth.at(nx, ny) - here);  // infinite towards background
    if (jump < smallest) smallest = jump, side = s;
  }
  if (side == 0) return {};
  const glm::dvec3 from = view_position(depth, window, camera, x, y);
  return double(side) * (view_position(depth, window, camera, x + side * dx, y + side * dy) - from);
}

std::optional<glm::dvec3> normal_from_depth(const Channel& depth, const Window& window, const Camera& camera, int x,
                                            int y) {
  const auto right = surface_step(depth, window, camera, x, y, 1, 0);
  const auto down = surface_step(depth, window, camera, x, y, 0, 1);
  if (!right || !down) return {};
  const glm::dvec3 normal = glm::cross(*down, *right);  // towards the eye: y runs down in the image, up in space
  const double length = glm::length(normal);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return normal / length;
}

uint32_t hash(uint32_t h) {  // lowbias32 (Wellons 2018)
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ (h >> 16);
}

/// Mean cosine between the given normals, as view and as world space, and those from depth.
struct Agreement {
  double view = 0, world = 0;
  double best() const { return std::max(view, world); }
};

Agreement agreement_of(const std::vector<NormalPair>& pairs, const std::optional<Pose>& pose, bool decode) {
  Agreement sum;
  for (const NormalPair& pair : pairs) {
    const glm::dvec3 given = decode ? 2.0 * pair.given - 1.0 : pair.given;
    const double length = glm::length(given);
    if (!(length > 0)) continue;
    sum.view += glm::dot(given, pair.from_depth) / length;
    if (pose) sum.world += glm::dot(pose->world_to_view * given, pair.from_depth) / length;
  }
  const double count = double(pairs.size());
  return {sum.view / count, pose ? sum.world / count : -1};
}

bool all_in_unit_cube(const std::vector<NormalPair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [](const NormalPair& pair) {
    const glm::dvec3 n = pair.given;
    return std::min({n.x, n.y, n.z}) >= 0 && std::max({n.x, n.y, n.z}) <= 1;
  });
}

void decode_normals(Plane& normal) {
  for (Channel& channel : normal.channels) {
    const int width = channel.layout().width;
    for_each_row(channel.layout(), [&](int y) {
      float* row = channel.row(y);
      for (int x = 0; x < width; ++x) row[x] = 2 * row[x] - 1;
    });
  }
}

void rotate_row(float* x, float* y, float* z, int width, const glm::mat3& m) {
  for (int i = 0; i < width; ++i) {
    const float a = x[i], b = y[i], c = z[i];
    x[i] = m[0][0] * a + m[1][0] * b + m[2][0] * c;
    y[i] = m[0][1] * a + m[1][1] * b + m[2][1] * c;
    z[i] = m[0][2] * a + m[1][2] * b + m[2][2] * c;
  }
}

// --- The door

/// `depth`, where given, tells the background.
void unit_row(float* x, float* y, float* z, const float* depth, int width) {
  for (int i = 0; i < width; ++i) {
    const double a = x[i], b = y[i], c = z[i];
    const double square = a * a + b * b + c * c;  // in double no float overflows or vanishes
    const double inverse = 1 / std::sqrt(square);
    // Those that are unit to a rounding stay as they are, so that a second pass changes no bit.
    const double unit = std::abs(square - 1) < 3e-7 ? 1.0 : inverse;
    const bool usable = (square > 0) & (square < std::numeric_limits<double>::infinity());
    const bool keep = usable & (depth ? depth[i] < infinity : true);
    x[i] = keep ? float(a * unit) : 0.0f;
    y[i] = keep ? float(b * unit) : 0.0f;
    z[i] = keep ? float(c * unit) : 0.0f;
  }
}

void make_unit(Plane& plane, const Plane* depth) {
  const Layout& layout = plane.channels[0].layout();
  for_each_row(layout, [&](int y) {
    unit_row(plane.channels[0].row(y), plane.channels[1].row(y), plane.channels[2].row(y),
             depth ? depth->channels[0].row(y) : nullptr, layout.width);
  });
}

void clamp_row(float* row, int width, float unknown) {
  for (int x = 0; x < width; ++x) {
    const float value = row[x] == row[x] ? row[x] : unknown, positive = value > 0 ? value : 0.0f;
    row[x] = positive < 1 ? positive : 1.0f;
  }
}

void finite_row(float* row, int width) {
  for (int x = 0; x < width; ++x) row[x] = std::abs(row[x]) < infinity ? row[x] : 0.0f;
}

/// To 0..1; NaN becomes what lies outside the image: open for AO, rough, black for albedo.
void clamp_channel(Channel& channel, float unknown) {
  for_each_row(channel.layout(), [&](int y) { clamp_row(channel.row(y), channel.layout().width, unknown); });
}

void make_finite(Channel& channel) {
  for_each_row(channel.layout(), [&](int y) { finite_row(channel.row(y), channel.layout().width); });
}

void clean_plane(Plane& plane, const PlaneKind& kind, const Plane* depth, const Background& background) {
  if (kind.meaning == PlaneKind::unit_vector && plane.channels.size() == 3) {
    make_unit(plane, depth);
    return;
  }
  for (Channel& channel : plane.channels) {
    if (kind.meaning == PlaneKind::view_depth)
      clean_depth(channel, 1, background);
    else if (kind.meaning == PlaneKind::unit_interval)
      clamp_channel(channel, kind.outside);
    else
      make_finite(channel);
  }
}

Background background_of(const View& view, std::optional<float> value) {
  return background_of(value, view.camera ? view.camera->far : std::nullopt);
}

Plane* depth_of(View& view) {
  const auto found = view.planes.find("depth");
  return found == view.planes.end() || found->second.channels.empty() ? nullptr : &found->second;
}

/// Everything but the depth itself, which tells the background of the normals.
void tidy_view(View& view, const Background& background, bool as_stored) {
  const Plane* depth = depth_of(view);
  for (auto& [name, plane] : view.planes) {
    const PlaneKind kind = plane_kind(name);
    if (&plane != depth && (!as_stored || kind.meaning == PlaneKind::view_depth))
      clean_plane(plane, kind, depth, background);
    for (Channel& channel : plane.channels) channel.fill_padding(kind.outside);
  }
}

}  // namespace

std::string to_view_depth(Channel& depth, const Channel* alpha, const Window& window, const Camera& camera,
                          const ReadOptions& options, std::vector<std::string>& assumed) {
  if (camera.slits && options.depth != DepthConvention::automatic && options.depth != DepthConvention::z)
    throw UsageError("--depth ray, ndc and reversed are of cameras with one eye; the depth of a display's module is z");
  if (options.depth == DepthConvention::ndc || options.depth == DepthConvention::reversed)
    return window_to_depth(depth, alpha, camera, options, assumed);

  const Background background = background_of(options.background, options.far ? options.far : camera.far);
  const Signs signs = signs_of(depth, background);
  const bool negative = signs.negative && !signs.positive;
  if (const long long count = negative ? 0 : count_negative(depth, background); count > 0)
    assumed.push_back(fmt::format("depth: {} negative value{} among positive ones taken as background", count,
                                  count == 1 ? "" : "s"));
  clean_depth(depth, negative ? -1.0f : 1.0f, background);
  if (negative) assumed.push_back("depth: all of it is negative, taken as the z of a camera that looks along -z");
  if (options.depth == DepthConvention::ray) {
    if (!camera.orthographic) ray_to_depth(depth, window, camera);
    return "ray";
  }
  if (negative) return "negative z";
  if (options.depth == DepthConvention::automatic)
    assumed.push_back(fmt::format("depth: taken as planar distance along the viewing axis{}; --depth says otherwise",
                                  signs.positive && !signs.over_one ? ", though all of it lies in 0..1" : ""));
  return "z";
}

/// One at a random place in each cell of a lattice: the same ones every time.
NormalSamples::NormalSamples(const Layout& image) {
  const int width = image.width, height = image.height;
  const int cell = std::max(1, int(std::sqrt(double(width) * height / 4096)));
  for (int cell_y = 0; cell_y < height; cell_y += cell)
    for (int cell_x = 0; cell_x < width; cell_x += cell) {
      const uint32_t random = hash(uint32_t(cell_y) * 65537u + uint32_t(cell_x));
      samples_.push_back({std::min(width - 1, cell_x + int(random % uint32_t(cell))),
                          std::min(height - 1, cell_y + int(random / 65536u % uint32_t(cell))),
                          glm::dvec3(std::numeric_limits<double>::quiet_NaN())});
    }
}

void NormalSamples::take(const Plane& normal, int first_row) {
  const int rows = normal.channels.front().layout().height;
  for (Sample& sample : samples_) {
    const int y = sample.y - first_row;
    if (y < 0 || y >= rows) continue;
    for (int c : {0, 1, 2}) sample.normal[c] = normal.channels[size_t(c)].at(sample.x, y);
  }
}

NormalForm NormalSamples::form(const Channel& depth, const Window& window, const Camera& camera,
                               std::vector<std::string>& assumed) const {
  std::vector<NormalPair> pairs;
  for (const Sample& sample : samples_) {
    if (is_background(depth.at(sample.x, sample.y))) continue;
    const double length = glm::length(sample.normal);
    if (!(length > 0) || !std::isfinite(length)) continue;
    if (const auto estimate = normal_from_depth(depth, window, camera, sample.x, sample.y))
      pairs.push_back({sample.normal, *estimate});
  }
  if (pairs.empty()) {
    assumed.push_back("normals: taken as view space, as no pixel lets depth tell; --normal-space says otherwise");
    return {NormalSpace::view};
  }
  Agreement agreement = agreement_of(pairs, camera.pose, false);
  const Agreement decoded = agreement_of(pairs, camera.pose, true);
  const bool encoded = all_in_unit_cube(pairs) && decoded.best() > agreement.best();
  if (encoded) agreement = decoded;
  const std::string taken = encoded ? "decoded from 0..1 and taken" : "taken";
  if (!camera.pose) {
    // Normals of the view's own space agree with depth wherever the camera stands, measured to 0.94 and more; those of
    // a world that the camera looks at nearly straight still reach 0.86.
    if (agreement.view < 0.9) {
      assumed.push_back(fmt::format("normals: taken as world space: as view space they agree with depth only to {:.2f}",
                                    agreement.view));
      return {NormalSpace::world, encoded};
    }
    assumed.push_back(fmt::format("normals: {} as view space: they agree with depth to {:.2f}", taken, agreement.view));
    return {NormalSpace::view, encoded};
  }
  const bool world = agreement.world > agreement.view;
  assumed.push_back(fmt::format(
      "normals: {} as {} space: they agree with depth to {:.2f}, as {} space to {:.2f}; --normal-space says otherwise",
      taken, world ? "world" : "view", agreement.best(), world ? "view" : "world",
      world ? agreement.view : agreement.world));
  return {world ? NormalSpace::world : NormalSpace::view, encoded};
}

NormalSpace detect_normal_space(Plane& normal, const Channel& depth, const Window& window, const Camera& camera,
                                std::vector<std::string>& assumed) {
  NormalSamples samples(normal.channels.front().layout());
  samples.take(normal, 0);
  const NormalForm form = samples.form(depth, window, camera, assumed);
  if (form.is_encoded) decode_normals(normal);
  return form.space;
}

void bring_to_view_space(Plane& normal, const NormalForm& form, const Camera& camera) {
  if (form.is_encoded) decode_normals(normal);
  if (form.space == NormalSpace::world) to_view_space(normal, *camera.pose);
}

long long count_missing_normals(const Plane& normal, const Channel& depth, int first_row) {
  const int width = depth.layout().width, height = normal.channels.front().layout().height;
  long long total = 0;
#pragma omp parallel for reduction(+ : total) if (size_t(width) * size_t(height) > 65536)
  for (int y = 0; y < height; ++y) {
    const float *x = normal.channels[0].row(y), *up = normal.channels[1].row(y), *z = normal.channels[2].row(y);
    const float* row = depth.row(first_row + y);
    int count = 0;
    for (int i = 0; i < width; ++i) {
      const double a = x[i], b = up[i], c = z[i], square = a * a + b * b + c * c;
      const bool usable = (square > 0) & (square < std::numeric_limits<double>::infinity());
      count += (row[i] < infinity) & !usable;
    }
    total += count;
  }
  return total;
}

void Ones::add(const Plane& plane, const Channel& depth, int first_row) {
  const Layout& layout = plane.channels.front().layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      if (is_background(depth.at(x, first_row + y))) continue;
      ++surfaces;
      ones +=
          std::all_of(plane.channels.begin(), plane.channels.end(), [&](const Channel& c) { return c.at(x, y) == 1; });
    }
  }
}

void to_view_space(Plane& normal, const Pose& pose) {
  const glm::mat3 m(pose.world_to_view);
  for_each_row(normal.channels[0].layout(), [&](int y) {
    rotate_row(normal.channels[0].row(y), normal.channels[1].row(y), normal.channels[2].row(y),
               normal.channels[0].layout().width, m);
  });
}

void tidy(Frame& frame, std::optional<float> background, bool as_stored) {
  for (View& view : frame.views) tidy_view(view, background_of(view, background), as_stored);
}

void normalise(Frame& frame, std::optional<float> background) {
  for (View& view : frame.views) {
    if (Plane* depth = depth_of(view)) clean_depth(depth->channels[0], 1, background_of(view, background));
  }
  tidy(frame, background);
}

}  // namespace gloam
