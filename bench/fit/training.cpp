#include "fit/training.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/random.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/planes.h"
#include "gloam/radius.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/reference.h"
#include "scene/random_camera.h"

namespace gloam::bench {
namespace {

/// As many as estimates usually read.
constexpr int peeled_layers = 6, stochastic_depths = 4;

/// Throws Error for a frame that shows next to no surface.
std::vector<glm::ivec2> pixels_of_surfaces(const Frame& frame, int count) {
  const Channel& depth = frame.views[0].planes.at("depth").channels[0];
  std::vector<glm::ivec2> pixels;
  Random random(1);
  constexpr int most_trials = 1000;  // for each pixel
  for (int trial = 0; int(pixels.size()) < count; ++trial) {
    if (trial == most_trials * count) throw Error("a frame for fitting shows next to no surface");
    const glm::ivec2 pixel(int(random.below(size_t(frame.width()))), int(random.below(size_t(frame.height()))));
    if (!is_background(depth.at(pixel.x, pixel.y))) pixels.push_back(pixel);
  }
  return pixels;
}

/// The frame for tracing: everything but these pixels is background, for which no ray is traced.
Frame only_at(const std::vector<glm::ivec2>& pixels, const Frame& frame) {
  Frame copy = without_planes(frame);
  const View& view = frame.views[0];
  copy.views[0].planes["normal"] = view.planes.at("normal").clone();
  Plane& depth = copy.views[0].planes["depth"] = view.planes.at("depth").clone();
  for (int y = 0; y < frame.height(); ++y)
    std::fill_n(depth.channels[0].row(y), frame.width(), std::numeric_limits<float>::infinity());
  for (const glm::ivec2& p : pixels) depth.channels[0].at(p.x, p.y) = view.planes.at("depth").channels[0].at(p.x, p.y);
  return copy;
}

/// What a camera at random shows, and a radius at random. None if it sees too little, or stands too near to a surface.
std::optional<TrainingFrame> shot_at_random(const Tracer& tracer, const TrainingOptions& options, Random& random) {
  const std::optional<SceneCamera> camera = random_camera(tracer, random);
  if (!camera) return {};
  CaptureOptions capturing;
  capturing.width = options.width;
  capturing.height = options.height;
  capturing.planes = {"depth", "normal"};
  if (options.with_layers) {
    capturing.planes.push_back("back_depth");
    capturing.peel = peeled_layers;
    capturing.stochastic.samples = stochastic_depths;
  }
  capturing.views = {{"", camera_for(*camera, options.width, options.height), {}}};
  TrainingFrame training{0, capture(tracer, capturing).frame, {}};
  const auto pixels = pixels_at_median_depth(training.frame);
  if (!pixels) return {};
  training.radius = random.of_any_size(options.least_pixels, options.most_pixels) / *pixels;
  const Channel& depth = training.frame.views[0].planes.at("depth").channels[0];
  if (!shows_enough(surface_shares(depth, training.radius))) return {};
  return training;
}

uint64_t number_of(const std::string& name) {
  uint64_t number = 0;
  for (const char c : name) number = number * 31 + uint64_t(c);
  return number;
}

TrainingFrame made(const TrainingScene& scene, const Tracer& tracer, const TrainingOptions& options, int number) {
  constexpr int most_trials = 200;
  Random random(options.seed, number_of(scene.name) * 1000 + uint64_t(number));
  for (int trial = 0; trial < most_trials; ++trial) {
    std::optional<TrainingFrame> training = shot_at_random(tracer, options, random);
    if (!training) continue;
    AoReferenceOptions tracing;
    tracing.radius = training->radius;
    tracing.samples = options.rays;
    training->pixels = pixels_of_surfaces(training->frame, options.pixels);
    AoReference truth = ao_reference(tracer, only_at(training->pixels, training->frame), tracing);
    training->frame.views[0].planes["ao"] = truth.frame.views[0].planes.at("ao").clone();
    training->frame.numbers["aoRadius"] = training->radius;
    return std::move(*training);
  }
  throw Error("{}: none of {} random cameras sees enough of it", scene.name, most_trials);
}

/// Two files of one name in different folders get different names.
std::string name_for_files(const TrainingScene& scene) {
  if (scene.kind != "own") return scene.name;
  return fmt::format("{}-{:016x}", std::filesystem::path(scene.name).stem().string(), number_of(scene.name));
}

TrainingFrame read(const std::filesystem::path& file, int pixels) {
  FrameFile kept(file, {});
  std::vector<std::string> planes;
  for (const std::string& plane : kept.common_planes()) {
    if (plane != "peel_count") planes.push_back(plane);
  }
  TrainingFrame training{kept.number_attribute("aoRadius").value_or(0), kept.read(planes), {}};
  if (training.radius <= 0) throw Error("{}: has no aoRadius: not a frame made for fitting", file.string());
  training.pixels = pixels_of_surfaces(training.frame, pixels);
  return training;
}

}  // namespace

std::vector<TrainingFrame> training_frames(const TrainingScene& wanted, const TrainingOptions& options) {
  std::vector<TrainingFrame> frames;
  std::optional<Scene> scene;
  std::optional<Tracer> tracer;
  for (int number = 0; number < options.frames; ++number) {
    const std::filesystem::path file =
        options.folder / fmt::format("{}.seed{}.rays{}{}.{:02}.exr", name_for_files(wanted), options.seed, options.rays,
                                     options.with_layers ? ".layers" : "", number);
    if (!std::filesystem::exists(file)) {
      if (!tracer) tracer.emplace(scene.emplace(load_scene(wanted.name, {})));
      if (scene->cameras.empty())
        throw Error("{}: has no camera to begin with; frames for fitting are made around a scene's own cameras",
                    wanted.name);
      if (options.progress) options.progress(file.string());
      write_frame(file, made(wanted, *tracer, options, number).frame);
    }
    // As stored, so that the first run reads the same bits as later ones.
    frames.push_back(read(file, options.pixels));
  }
  return frames;
}

}  // namespace gloam::bench
