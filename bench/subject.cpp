#include "subject.h"

#include <algorithm>
#include <cmath>

#include "fingerprint.h"
#include "gloam/capture.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/reference.h"
#include "lists.h"

namespace gloam::bench {
namespace {

constexpr const char* recipe_attribute = "gloamBench";  ///< header of the kept files: what they were made from

/// Tells scenes apart whose geometry, first camera or reach differs.
std::string digest_of(const Scene& scene) {
  const SceneCamera& camera = scene.cameras.front();
  Fingerprint print;
  print.add(scene);
  print.add(camera.pose.world_to_view);
  print.add(camera.pose.position);
  print.add(std::vector<double>{double(camera.orthographic), camera.fov_degrees, camera.width});
  return print.text();
}

/// Tells frames apart that rays start from elsewhere.
std::string digest_of(const Frame& frame) {
  Fingerprint print;
  print.add(frame);
  return print.text();
}

/// Tells contributions apart, by their values.
std::string digest_of(const std::function<double(double, double)>& contribution) {
  if (!contribution) return "none";
  constexpr int n = 16;
  Fingerprint print;
  for (int c = 1; c <= n; ++c) {
    for (int d = 0; d < n; ++d) print.add(contribution(double(c) / n, double(d) / n));
  }
  return print.text();
}

}  // namespace

Truths::Truths(std::string name, Scene scene, SceneOptions options)
    : name_(std::move(name)),
      scene_(std::move(scene)),
      options_(std::move(options)),
      radius_(options_.radius.value_or(scene_.ao_radius)),
      recipe_(digest_of(scene_)) {}

Truths::~Truths() = default;

const Tracer& Truths::tracer() {
  if (!tracer_) tracer_ = std::make_unique<Tracer>(scene_);
  return *tracer_;
}

void Truths::tell(const std::string& what, double share) const {
  if (options_.progress) options_.progress(name_ + ": " + what, share);
}

/// Notes whether a file is used again. A file that cannot be read is made anew.
bool Truths::is_there(const std::string& file, const std::string& recipe) {
  bool same = false;
  try {
    std::error_code unknown;
    const std::filesystem::path path = options_.folder / file;
    same = std::filesystem::exists(path, unknown) && FrameFile(path, {}).text_attribute(recipe_attribute) == recipe;
  } catch (const Error&) {
    same = false;
  }
  add_new(same ? reused_ : made_, file);
  return same;
}

std::filesystem::path Truths::frame_file() {
  const std::string file = name_ + ".exr";
  const std::string recipe =
      fmt::format("{} {} {}x{} layers={}", name_, recipe_, options_.width, options_.height, options_.layers);
  const std::filesystem::path path = options_.folder / file;
  if (is_there(file, recipe)) return path;
  CaptureOptions capturing;
  capturing.width = options_.width;
  capturing.height = options_.height;
  capturing.peel = options_.layers;
  capturing.views = {{"", camera_for(scene_.cameras.front(), options_.width, options_.height), {}}};
  for (const std::string& plane : capture_planes()) {
    if (plane != "motion") capturing.planes.push_back(plane);
  }
  capturing.progress = [&](int done, int of) { tell("frame", double(done) / of); };
  CaptureResult result = capture(tracer(), capturing);
  result.frame.attributes[recipe_attribute] = recipe;
  result.frame.numbers["aoRadius"] = scene_.ao_radius;
  write_frame(path, result.frame);
  return path;
}

Frame Truths::captured(int width, int height) {
  CaptureOptions capturing;
  capturing.width = width;
  capturing.height = height;
  capturing.views = {{"", camera_for(scene_.cameras.front(), width, height), {}}};
  capturing.planes = {"depth", "normal"};
  return capture(tracer(), capturing).frame;
}

const Truth& Truths::traced(const Frame& frame, const std::string& file, const Contribution& contribution,
                            const std::string& falloff) {
  const std::string recipe =
      fmt::format("{} {} frame={} {}x{} radius={} rays={} contribution={}", name_, recipe_, digest_of(frame),
                  frame.width(), frame.height(), radius_, options_.rays, digest_of(contribution));
  if (!is_there(file, recipe)) {
    AoReferenceOptions options;
    options.radius = radius_;
    options.samples = options_.rays;
    options.contribution = contribution;
    options.falloff = falloff;
    const std::string what = contribution ? fmt::format("truth with the falloff of {}", falloff) : "truth";
    options.progress = [&](double share) { tell(what, share); };
    AoReference reference = ao_reference(tracer(), frame, options);
    reference.frame.attributes[recipe_attribute] = recipe;
    write_frame(options_.folder / file, reference.frame);
  }
  return truths_.emplace(file, read_truth(options_.folder / file, frame)).first->second;
}

const Truth& Truths::truth(const Frame& frame) {
  const std::string file = name_ + "_ao_ref.exr";
  const auto known = truths_.find(file);
  return known != truths_.end() ? known->second : traced(frame, file, {}, "none");
}

const Truth& Truths::truth(const Frame& frame, const Technique& technique, const ParameterValues& values) {
  const Contribution contribution = [&](double cosine, double distance) {
    return technique.contribution(values, cosine, distance);
  };
  const std::string digest = digest_of(contribution);
  const auto known = own_truths_.find(digest);
  if (known != own_truths_.end()) return truths_.at(known->second);
  std::string file = fmt::format("{}_ao_ref_{}.exr", name_, technique.name);
  // Presets that contribute otherwise get files of their own.
  for (int number = 2; truths_.count(file) != 0; ++number)
    file = fmt::format("{}_ao_ref_{}_{}.exr", name_, technique.name, number);
  const Truth& truth = traced(frame, file, contribution, technique.name);
  own_truths_.emplace(digest, file);
  return truth;
}

Truth read_truth(const std::filesystem::path& path, const Frame& frame) {
  ReadOptions options;
  options.as_stored = true;
  FrameFile file(path, options);
  if (!contains(file.common_planes(), "ao"))
    throw Error("{}: has no plane 'ao' to measure against; it has {}", path.string(), enumerate(file.all_channels()));
  const Frame truth = file.read({"ao"});
  if (truth.width() != frame.width() || truth.height() != frame.height())
    throw Error("{} is {}x{} and the frame is {}x{}; only images of one size can be compared", path.string(),
                truth.width(), truth.height(), frame.width(), frame.height());
  Truth result;
  if (truth.views.size() == 1 && frame.views.size() == 1) {
    result.ao.emplace(frame.views[0].name, truth.views[0].planes.at("ao").clone());
  } else {
    for (const View& view : frame.views) {
      const auto same = std::find_if(truth.views.begin(), truth.views.end(),
                                     [&](const View& other) { return other.name == view.name; });
      if (same == truth.views.end())
        throw Error("{}: has no view '{}' as the frame has; --view NAME takes one view of the frame", path.string(),
                    view.name);
      result.ao.emplace(view.name, same->planes.at("ao").clone());
    }
  }
  result.noise = file.number_attribute("aoNoise");
  result.radius = file.number_attribute("aoRadius");
  return result;
}

}  // namespace gloam::bench
