#include "measure/native.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__)
#define GLOAM_X86 1
#include <immintrin.h>
#endif

namespace gloam::bench {

/// Data that all rows share.
struct Job {
  PixelCamera camera;
  float radius, bias, max_pixels, inverse_square, strength;
  const float *depth, *normal_x, *normal_y, *normal_z;  ///< pixel (0, 0)
  float* ao;
};

namespace {

constexpr float pi = 3.14159265f;
constexpr float step_cosine = 0.70710678f, step_sine = 0.70710678f;  ///< from one direction to the next
static_assert(directions == 8);
#define GLOAM_UNROLL _Pragma("GCC unroll 4")

// native_loop.h holds the loop once, in terms of types and functions that each namespace here defines: F and I are vectors of
// floats and of 32-bit integers. GCC and Clang provide + - * on both.

namespace scalar {
using F = float;
using I = int32_t;
using U = uint32_t;
constexpr int width = 1;
inline F all(float v) { return v; }
inline F iota() { return 0; }
inline U iota_u() { return 0; }
inline F load(const float* p) { return *p; }
inline void store(float* p, F v) { *p = v; }
inline F gather(const float* p, I i) { return p[i]; }
inline F larger(F a, F b) { return a > b ? a : b; }
inline F smaller(F a, F b) { return a < b ? a : b; }
inline I larger_i(I a, I b) { return std::max(a, b); }
inline I smaller_i(I a, I b) { return std::min(a, b); }
inline I plus(I a, I b) { return a + b; }
inline U plus(U a, int b) { return a + U(b); }
inline I times(I a, I b) { return a * b; }
inline F fma(F a, F b, F c) { return a * b + c; }
inline F fms(F a, F b, F c) { return a * b - c; }
inline F fnma(F a, F b, F c) { return c - a * b; }
inline F inverse_sqrt(F x) { return 1 / std::sqrt(x); }
inline I truncated(F x) { return I(x); }
inline F converted(I i) { return F(i); }
inline F random(U h) { return F(h >> 8) * 0x1p-24f; }
inline bool all_infinite(F x) { return x == INFINITY; }
inline F smallest(F x) { return x; }
inline F where_infinite(F x, F yes, F no) { return x == INFINITY ? yes : no; }
#include "measure/native_loop.h"
}  // namespace scalar

#ifdef GLOAM_X86
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace avx2 {
using F = __m256;
using I = __m256i;
using U = __m256i;
constexpr int width = 8;
inline F all(float v) { return _mm256_set1_ps(v); }
inline I all_i(int v) { return _mm256_set1_epi32(v); }
inline I iota_u() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
inline F iota() { return _mm256_cvtepi32_ps(iota_u()); }
inline F load(const float* p) { return _mm256_loadu_ps(p); }
inline void store(float* p, F v) { _mm256_storeu_ps(p, v); }
inline F gather(const float* p, I i) { return _mm256_i32gather_ps(p, i, 4); }
inline F larger(F a, F b) { return _mm256_max_ps(a, b); }
inline F smaller(F a, F b) { return _mm256_min_ps(a, b); }
inline I larger_i(I a, int b) { return _mm256_max_epi32(a, all_i(b)); }
inline I smaller_i(I a, int b) { return _mm256_min_epi32(a, all_i(b)); }
inline F fma(F a, F b, F c) { return _mm256_fmadd_ps(a, b, c); }
inline F fms(F a, F b, F c) { return _mm256_fmsub_ps(a, b, c); }
inline F fnma(F a, F b, F c) { return _mm256_fnmadd_ps(a, b, c); }
// A 12-bit guess and one Newton step.
inline F inverse_sqrt(F x) {
  const F y = _mm256_rsqrt_ps(x);
  return y * fnma(all(0.5f) * x * y, y, all(1.5f));
}
inline I truncated(F x) { return _mm256_cvttps_epi32(x); }
inline F converted(I i) { return _mm256_cvtepi32_ps(i); }
inline I plus(I a, I b) { return _mm256_add_epi32(a, b); }
inline I plus(I a, int b) { return plus(a, all_i(b)); }
inline I times(I a, int b) { return _mm256_mullo_epi32(a, all_i(b)); }
inline F random(U h) { return _mm256_cvtepi32_ps(_mm256_srli_epi32(h, 8)) * all(0x1p-24f); }
inline F infinite(F x) { return _mm256_cmp_ps(x, all(INFINITY), _CMP_EQ_OQ); }
inline bool all_infinite(F x) { return _mm256_movemask_ps(infinite(x)) == 0xff; }
inline float smallest(F x) {
  __m128 m = _mm_min_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1));
  m = _mm_min_ps(m, _mm_movehl_ps(m, m));
  return _mm_cvtss_f32(_mm_min_ss(m, _mm_shuffle_ps(m, m, 1)));
}
inline F where_infinite(F x, F yes, F no) { return _mm256_blendv_ps(no, yes, infinite(x)); }
#include "measure/native_loop.h"
}  // namespace avx2
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,fma")
namespace avx512 {
using F = __m512;
using I = __m512i;
using U = __m512i;
constexpr int width = 16;
inline F all(float v) { return _mm512_set1_ps(v); }
inline I all_i(int v) { return _mm512_set1_epi32(v); }
inline I iota_u() { return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }
inline F iota() { return _mm512_cvtepi32_ps(iota_u()); }
inline F load(const float* p) { return _mm512_loadu_ps(p); }
inline void store(float* p, F v) { _mm512_storeu_ps(p, v); }
inline F gather(const float* p, I i) { return _mm512_i32gather_ps(i, p, 4); }
inline F larger(F a, F b) { return _mm512_max_ps(a, b); }
inline F smaller(F a, F b) { return _mm512_min_ps(a, b); }
inline I larger_i(I a, int b) { return _mm512_max_epi32(a, all_i(b)); }
inline I smaller_i(I a, int b) { return _mm512_min_epi32(a, all_i(b)); }
inline F fma(F a, F b, F c) { return _mm512_fmadd_ps(a, b, c); }
inline F fms(F a, F b, F c) { return _mm512_fmsub_ps(a, b, c); }
inline F fnma(F a, F b, F c) { return _mm512_fnmadd_ps(a, b, c); }
// A 14-bit guess and one Newton step.
inline F inverse_sqrt(F x) {
  const F y = _mm512_rsqrt14_ps(x);
  return y * fnma(all(0.5f) * x * y, y, all(1.5f));
}
inline I truncated(F x) { return _mm512_cvttps_epi32(x); }
inline F converted(I i) { return _mm512_cvtepi32_ps(i); }
inline I plus(I a, I b) { return _mm512_add_epi32(a, b); }
inline I plus(I a, int b) { return plus(a, all_i(b)); }
inline I times(I a, int b) { return _mm512_mullo_epi32(a, all_i(b)); }
inline F random(U h) { return _mm512_cvtepi32_ps(_mm512_srli_epi32(h, 8)) * all(0x1p-24f); }
inline __mmask16 infinite(F x) { return _mm512_cmp_ps_mask(x, all(INFINITY), _CMP_EQ_OQ); }
inline bool all_infinite(F x) { return infinite(x) == 0xffff; }
inline float smallest(F x) { return _mm512_reduce_min_ps(x); }
inline F where_infinite(F x, F yes, F no) { return _mm512_mask_blend_ps(infinite(x), no, yes); }
#include "measure/native_loop.h"
}  // namespace avx512
#pragma GCC pop_options
#endif

template <bool tuned>
RowLoop row_function(Instructions instructions) {
#ifdef GLOAM_X86
  if (instructions == Instructions::avx512) return avx512::row<tuned>;
  if (instructions == Instructions::avx2) return avx2::row<tuned>;
#endif
  return scalar::row<tuned>;
}

}  // namespace

bool make_openmp_wait_passively() {
  if (std::getenv("OMP_WAIT_POLICY")) return true;
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  if (arguments.empty()) return false;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv.data());
  return false;
}

Instructions widest_instructions() {
#ifdef GLOAM_X86
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return Instructions::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Instructions::avx2;
#endif
  return Instructions::scalar;
}

const char* name_of(Instructions instructions) {
  return instructions == Instructions::avx512 ? "avx512" : instructions == Instructions::avx2 ? "avx2" : "scalar";
}

Native::Native(const Frame& frame, const HbaoPlusParams& params, Instructions instructions, bool tuned)
    : view_(frame.views[0]),
      camera_(pixel_camera(frame)),
      params_(params),
      row_(tuned ? row_function<true>(instructions) : row_function<false>(instructions)),
      result_(Layout(frame.width(), frame.height()), 0.0f) {}

double Native::run() {
  const std::vector<Channel>& normal = view_.planes.at("normal").channels;
  const Job job{camera_,
                params_.radius,
                params_.bias,
                params_.max_reach * float(camera_.width),
                1 / (params_.radius * params_.radius),
                params_.strength,
                view_.planes.at("depth").channels[0].row(0),
                normal[0].row(0),
                normal[1].row(0),
                normal[2].row(0),
                result_.row(0)};
  const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for schedule(dynamic, 8)
  for (int y = 0; y < job.camera.height; ++y) row_(job, y);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace gloam::bench
