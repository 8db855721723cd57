#include "normalise/normals.h"

#include <cmath>
#include <cstdlib>
#include <glm/mat3x3.hpp>
#include <limits>

#include "base/srgb.h"
#include "gloam/error.h"
#include "normalise/each_row.h"

namespace gloam {

namespace {

/// Squared length below which a decoded normal is none: the middle of 8 bits is 0.004 from 0 in each component.
constexpr float most_of_none = 0.02f * 0.02f;

/// Normals from 0 to 1. A pixel that nothing was written to is 0, which would be a direction.
void decode_row(float* x, float* y, float* z, int width, bool has_curve) {
  for (int i = 0; i < width; ++i) {
    const bool is_empty = (x[i] == 0) & (y[i] == 0) & (z[i] == 0);
    if (has_curve)
      for (float* component : {x + i, y + i, z + i}) *component = float(linear_of_srgb(double(*component)));
    const float a = 2 * x[i] - 1, b = 2 * y[i] - 1, c = 2 * z[i] - 1;
    const bool is_none = is_empty | (a * a + b * b + c * c < most_of_none);
    x[i] = is_none ? 0 : a;
    y[i] = is_none ? 0 : b;
    z[i] = is_none ? 0 : c;
  }
}

void turn_row(float* x, float* y, float* z, int width, const glm::mat3& m) {
  for (int i = 0; i < width; ++i) {
    const float a = x[i], b = y[i], c = z[i];
    x[i] = m[0][0] * a + m[1][0] * b + m[2][0] * c;
    y[i] = m[0][1] * a + m[1][1] * b + m[2][1] * c;
    z[i] = m[0][2] * a + m[1][2] * b + m[2][2] * c;
  }
}

/// From components in storage to view space.
glm::mat3 turn_of(const NormalForm& form, const Camera& camera) {
  glm::dmat3 to_axes(0.0);
  for (size_t i = 0; i < 3; ++i) to_axes[int(i)][std::abs(form.axes[i]) - 1] = form.axes[i] < 0 ? -1 : 1;
  return glm::mat3(form.space == NormalSpace::world ? camera.pose->world_to_view * to_axes : to_axes);
}

}  // namespace

void bring_to_view_space(float* x, float* y, float* z, int width, const NormalForm& form, const Camera& camera) {
  if (form.range != NormalRange::signed_values) decode_row(x, y, z, width, form.range == NormalRange::srgb_values);
  if (form.space == NormalSpace::world || form.axes != plain_axes) turn_row(x, y, z, width, turn_of(form, camera));
}

void bring_to_view_space(Plane& normal, const NormalForm& form, const Camera& camera) {
  if (form == NormalForm()) return;
  const Layout& layout = normal.channels.front().layout();
  for_each_row(layout, [&](int y) {
    bring_to_view_space(normal.channels[0].row(y), normal.channels[1].row(y), normal.channels[2].row(y), layout.width,
                        form, camera);
  });
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

std::string note_on_missing_normals(long long missing) {
  if (missing <= 0) return "";
  return fmt::format("normals: {} pixel{} of the foreground {} none (zero or not finite) and read{} open", missing,
                     missing == 1 ? "" : "s", missing == 1 ? "has" : "have", missing == 1 ? "s" : "");
}

}  // namespace gloam
