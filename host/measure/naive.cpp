#include "measure/naive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gloam::bench {
namespace {

/// Laid out like `Settings` in naive.cl.
struct NaiveSettings {
  float radius, max_pixels;
  float bias, strength;
  float distance, one_minus_cosine;
  int directions, steps, columns, rows;
};

/// 0 if the technique has no such parameter.
double number_of(const ParameterValues& values, const char* name) { return values.has(name) ? values.number(name) : 0; }
NaiveSettings settings_of(const PlannedPass& planned, int width) {
  const auto number = [&](const char* name) { return number_of(planned.values, name); };
  return {.radius = float(number("radius")),
          .max_pixels = float(number("max_reach") * width),
          .bias = float(number("bias")),
          .strength = float(number("strength")),
          .distance = float(number("depth_tolerance") * number("radius")),
          .one_minus_cosine = float(1 - std::cos(number("normal_tolerance"))),
          .directions = int(number("directions")),
          .steps = int(number("steps")),
          .columns = define_of(planned.pass, "COLUMNS"),
          .rows = define_of(planned.pass, "ROWS")};
}

/// The settings of a pass's kernels, one after another: a separable filter is two.
std::vector<NaiveSettings> kernels_of(const PlannedPass& planned, int width) {
  NaiveSettings first = settings_of(planned, width), second = first;
  if (define_of(planned.pass, "SEPARABLE") == 0) return {first};
  first.rows = second.columns = 0;
  return {first, second};
}

std::string options(const NaiveSettings& settings, Counts counts) {
  std::string text = "-cl-std=CL1.2 -cl-mad-enable -cl-no-signed-zeros";
  if (counts == Counts::unrolled)
    text += fmt::format(" -D UNROLLED -D DIRECTIONS={} -D STEPS={} -D COLUMNS={} -D ROWS={}", settings.directions,
                        settings.steps, settings.columns, settings.rows);
  return text;
}

}  // namespace

int define_of(const Pass& pass, const std::string& name) {
  for (const auto& [defined, value] : pass.defines) {
    if (defined == name) return value;
  }
  return 0;
}

const std::vector<NaiveKernel>& naive_kernels() {
  // The estimates clamp to the border and have no options. Tolerance of GTAO: an arc's mass in slice.h is off by up to 1.5e-3.
  static const std::vector<NaiveKernel> kernels = {
      {.technique = "hbao+",
       .text = naive_hbao_plus_cl,
       .kernel = "naive_hbao_plus",
       .samples = directions * steps,
       .tolerance = 1e-4,
       .knows = {{"outside", "border"}, {"jitter", "on"}, {"power", "1"}, {"falloff", "quadratic"}}},
      {.technique = "gtao",
       .text = naive_gtao_cl,
       .kernel = "naive_gtao",
       .samples = 18,
       .tolerance = 1e-3,
       .knows = {{"outside", "border"}, {"jitter", "on"}, {"fade", "0"}, {"thickness_heuristic", "0"}}},
      {.technique = "bilateral", .text = naive_bilateral_cl, .kernel = "naive_bilateral", .filters = true},
  };
  return kernels;
}

std::vector<KernelText> naive_texts() {
  std::vector<KernelText> texts;
  const NaiveSettings any{.directions = 4, .steps = 4, .columns = 4, .rows = 4};
  for (const NaiveKernel& naive : naive_kernels()) {
    for (const Counts counts : {Counts::at_run_time, Counts::unrolled})
      texts.push_back({std::string(naive_cl) + naive.text, options(any, counts), naive.kernel});
  }
  return texts;
}

const NaiveKernel* naive_kernel_for(const PlannedPass& planned) {
  const auto computes_the_same = [&](const NaiveKernel& kernel) {
    const Technique& technique = *planned.technique;
    if (kernel.technique != technique.name) return false;
    if (kernel.samples != 0 && technique.samples(planned.values) != kernel.samples) return false;
    return std::all_of(kernel.knows.begin(), kernel.knows.end(),
                       [&](const auto& setting) { return planned.values.text(setting.first) == setting.second; });
  };
  const std::vector<NaiveKernel>& all = naive_kernels();
  const auto found = std::find_if(all.begin(), all.end(), computes_the_same);
  return found == all.end() ? nullptr : &*found;
}

bool has_naive(const Plan& plan) {
  return std::all_of(plan.passes.begin(), plan.passes.end(),
                     [](const PlannedPass& planned) { return naive_kernel_for(planned) != nullptr; });
}

Naive::Naive(const Plan& plan, const Frame& frame, DevicePlanes& planes, Device& device, Counts counts)
    : device_(device), planes_(planes) {
  const PixelCamera camera = pixel_camera(frame);
  global_ = cl::NDRange(size_t(camera.width), size_t(camera.height));
  const size_t between = plan.passes.size();  // number of a plane for what a filter makes along rows
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    const NaiveKernel& naive = *naive_kernel_for(plan.passes[i]);
    const std::vector<NaiveSettings> all = kernels_of(plan.passes[i], camera.width);
    Pass& pass = passes_.emplace_back();
    for (size_t k = 0; k < all.size(); ++k) {
      cl::Kernel& kernel = pass.kernels.emplace_back(
          build(device, std::string(naive_cl) + naive.text, options(all[k], counts), naive.kernel));
      kernel.setArg(0, camera);
      kernel.setArg(1, all[k]);
      kernel.setArg(2, planes.depth);
      kernel.setArg(3, planes.normal_x);
      kernel.setArg(4, planes.normal_y);
      kernel.setArg(5, planes.normal_z);
      kernel.setArg(6, planes.result(k + 1 < all.size() ? between : i).buffer);
      if (naive.filters) kernel.setArg(7, planes.result(k > 0 ? between : i - 1).buffer);
      launch(device, kernel, global_);
    }
  }
}

double Naive::run() {
  double sum = 0;
  for (Pass& pass : passes_) {
    double ms = 0;
    for (cl::Kernel& kernel : pass.kernels) ms += launch(device_, kernel, global_);
    sum += pass.ms.emplace_back(ms);
  }
  return sum;
}

}  // namespace gloam::bench
