#include "base/low_discrepancy.h"

#include <cmath>

#include "shared/both/hash.h"

namespace gloam {
namespace {

uint32_t reverse_bits(uint32_t x) {
  x = __builtin_bswap32(x);
  x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
  x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
  return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
}

/// Second dimension of the Sobol sequence, bits reversed: row k of the Pascal triangle modulo 2, as xors of shifts.
uint32_t sobol_y_reversed(uint32_t i) {
  i ^= (i & 0xaaaaaaaau) >> 1;
  i ^= (i & 0xccccccccu) >> 2;
  i ^= (i & 0xf0f0f0f0u) >> 4;
  i ^= (i & 0xff00ff00u) >> 8;
  return i ^ (i & 0xffff0000u) >> 16;
}

/// Owen scrambling as a hash in which every bit depends on lower bits only (Laine and Karras 2011, constants by
/// Vegdahl 2021). Takes reversed bits, so that "lower" means "more significant".
double scramble(uint32_t reversed, uint32_t seed) {
  uint32_t x = reversed;
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverse_bits(x) * 0x1p-32;
}

}  // namespace

uint32_t hash(uint32_t value) { return hash_of(value); }

glm::dvec2 scrambled_sobol(uint32_t index, uint32_t seed) {
  return {scramble(index, hash(seed)), scramble(sobol_y_reversed(index), hash(seed ^ 0x9e3779b9u))};
}

glm::dmat3 frame_about(const glm::dvec3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {glm::dvec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), glm::dvec3(b, sign + n.y * n.y * a, -n.y), n};
}

glm::dvec3 cosine_direction(const glm::dvec2& u) {
  const double radius = std::sqrt(u.x), angle = 2 * M_PI * u.y;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - u.x)};
}

}  // namespace gloam
