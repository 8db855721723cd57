#include "measure/subject.h"

#include <algorithm>
#include <cmath>

#include "base/file_ledger.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/frame_files.h"
#include "gloam/option.h"
#include "gloam/scene/capture.h"
#include "gloam/scene/reference.h"
#include "measure/effects.h"
#include "scene/fingerprint.h"
#include "scene/reference_kinds.h"

namespace gloam::bench {
namespace {

constexpr const char* recipe_attribute = "gloamBench";  ///< header attribute of the kept files: their inputs

/// Writes a file that stays for other runs. It may have been read before, made by another recipe, but is no file that a flag names.
void write_kept(const std::filesystem::path& path, const Frame& frame) {
  writes_file("-o", path, OutputUse::grows);
  write_frame(path, frame);
}

/// Identifies a scene by geometry, first camera and reach.
std::string digest_of(const Scene& scene) {
  const SceneCamera& camera = scene.cameras.front();
  Fingerprint print;
  print.add(scene);
  print.add(camera.pose.world_to_view);
  print.add(camera.pose.position);
  print.add(std::vector<double>{double(camera.orthographic), camera.fov_degrees, camera.width});
  return print.text();
}

/// Identifies a frame by the starts of its rays.
std::string digest_of(const Frame& frame) {
  Fingerprint print;
  print.add(frame);
  return print.text();
}

/// Identifies what a frame of a sequence has besides; empty for a frame alone.
std::string digest_of(const std::optional<InSequence>& in) {
  if (!in) return "";
  Fingerprint print;
  print.add(in->camera_before.pose.world_to_view);
  print.add(in->camera_before.pose.position);
  if (in->scene_before) print.add(*in->scene_before);
  return " before=" + print.text();
}

/// Identifies a contribution by its values.
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

/// Notes whether a file is reused. A file that cannot be read is made again. Throws Error for one that a user has put there.
bool Truths::is_there(const std::string& file, const std::string& recipe) {
  const LooksAtFiles looks;
  const std::filesystem::path path = options_.folder / file;
  std::optional<std::string> made_by;
  try {
    std::error_code unknown;
    if (std::filesystem::exists(path, unknown)) made_by = FrameFile(path, {}).text_attribute(recipe_attribute);
  } catch (const Error&) {
  }
  if (made_by && made_by->empty())
    throw Error("{}: is no file that gloam bench made, and would be replaced; move it, or name another folder (-o)",
                path.string());
  const bool same = made_by == recipe;
  add_new(same ? reused_ : made_, file);
  return same;
}

std::filesystem::path Truths::frame_file() {
  const std::string file = name_ + ".exr";
  const std::string recipe =
      fmt::format("{} {} {}x{} layers={}{}{}", name_, recipe_, options_.width, options_.height, options_.layers,
                  options_.peel_light ? " with light" : "", digest_of(options_.in_sequence));
  const std::filesystem::path path = options_.folder / file;
  if (is_there(file, recipe)) return path;
  CaptureOptions capturing;
  capturing.width = options_.width;
  capturing.height = options_.height;
  capturing.peel = options_.layers;
  capturing.peel_light = options_.peel_light;
  capturing.views = {{"", camera_for(scene_.cameras.front(), options_.width, options_.height), {}}};
  capturing.planes = usual_capture_planes();
  if (options_.in_sequence) capturing.planes.push_back("motion");
  if (const auto& in = options_.in_sequence) {
    capturing.views.front().previous_camera = camera_for(in->camera_before, options_.width, options_.height);
    capturing.previous_scene = in->scene_before.get();
  }
  capturing.progress = [&](int done, int of) { tell("frame", double(done) / of); };
  CaptureResult result = capture(tracer(), capturing);
  result.frame.attributes[recipe_attribute] = recipe;
  result.frame.numbers["aoRadius"] = scene_.ao_radius;
  write_kept(path, result.frame);
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

std::string Truths::recipe_for(const Frame& frame) const {
  return fmt::format("{} {} frame={} {}x{} radius={} rays={}", name_, recipe_, digest_of(frame), frame.width(),
                     frame.height(), radius_, options_.rays);
}

const Truth& Truths::traced(const Frame& frame, const std::string& file, const std::string& plane, std::string recipe,
                            const Tracing& trace) {
  const int seed = options_.in_sequence ? options_.in_sequence->seed : 0;
  if (seed != 0) recipe += fmt::format(" seed={}", seed);
  if (!is_there(file, recipe)) {
    Reference reference = trace();
    reference.frame.attributes[recipe_attribute] = recipe;
    write_kept(options_.folder / file, reference.frame);
  }
  std::vector<std::string> none;
  return truths_.emplace(file, read_truth({(options_.folder / file).string()}, plane, frame, none)).first->second;
}

const Truth& Truths::traced_ao(const Frame& frame, const std::string& file, const Contribution& contribution,
                               const std::string& falloff) {
  return traced(frame, file, "ao", recipe_for(frame) + " contribution=" + digest_of(contribution), [&] {
    AoReferenceOptions options;
    options.radius = radius_;
    options.samples = options_.rays;
    options.seed = uint32_t(options_.in_sequence ? options_.in_sequence->seed : 0);
    options.contribution = contribution;
    options.falloff = falloff;
    const std::string what = contribution ? fmt::format("truth with the falloff of {}", falloff) : "truth";
    options.progress = [&](double share) { tell(what, share); };
    return ao_reference(tracer(), frame, options);
  });
}

const Truth& Truths::truth(const Frame& frame, const std::string& plane) {
  const std::string file = fmt::format("{}_{}_ref.exr", name_, plane);
  const auto known = truths_.find(file);
  if (known != truths_.end()) return known->second;
  if (plane == "ao") return traced_ao(frame, file, {}, "none");
  ReferenceRequest request;
  request.what = plane;
  request.samples = options_.rays;
  const ReferenceJob job = job_of(request, as_flag);
  Fingerprint surfaces;
  surfaces.add_light(scene_);
  surfaces.add_gloss(frame);
  return traced(frame, file, plane, fmt::format("{} {}={}", recipe_for(frame), plane, surfaces.text()), [&] {
    ReferenceOptions options;
    options.radius = radius_;
    options.progress = [&](double share) { tell("truth of " + plane, share); };
    return job.trace(tracer(), frame, options);
  });
}

const Truth& Truths::truth(const Frame& frame, const Technique& technique, const ParameterValues& values) {
  const Contribution contribution = [&](double cosine, double distance) {
    return technique.contribution(values, cosine, distance);
  };
  const std::string digest = digest_of(contribution);
  const auto known = own_truths_.find(digest);
  if (known != own_truths_.end()) return truths_.at(known->second);
  std::string file = fmt::format("{}_ao_ref_{}.exr", name_, technique.name);
  // Presets with another contribution get files of their own.
  for (int number = 2; truths_.count(file) != 0; ++number)
    file = fmt::format("{}_ao_ref_{}_{}.exr", name_, technique.name, number);
  const Truth& truth = traced_ao(frame, file, contribution, technique.name);
  own_truths_.emplace(digest, file);
  return truth;
}

namespace {

/// For each view of a truth's file, its view of the frame.
std::vector<std::pair<std::string, const View*>> views_for(const Frame& truth, const FrameFile& file,
                                                           const Frame& frame) {
  if (truth.views.size() == 1 && frame.views.size() == 1) return {{frame.views[0].name, &truth.views[0]}};
  std::vector<std::string> names;
  for (const View& view : frame.views) names.push_back(view.name);
  if (truth.views.size() == 1) {
    if (const auto named = view_in_name(file.path(), names)) return {{*named, &truth.views[0]}};
  }
  std::vector<std::pair<std::string, const View*>> found;
  for (const View& view : truth.views) {
    if (contains(names, view.name)) found.emplace_back(view.name, &view);
  }
  if (found.empty())
    throw Error(
        "{}: its name ends in no view of the frame ({}), and it has none of them; {} takes one view of the frame",
        file.path().string(), enumerate(names), option("view", "NAME"));
  return found;
}

FrameFile truth_file(const std::string& path) {
  ReadOptions options;
  options.as_stored = true;
  return FrameFile(path, options);
}

/// A plane in the window of a frame. Beyond its own window it goes on with its last pixels, which no figure counts (`foreground`), but which
/// those of structure look at beside the border.
Plane in_window(const Plane& plane, const Window& from, const Window& to) {
  Plane placed{plane.name, {}};
  for (const Channel& channel : plane.channels) {
    Channel& out = placed.channels.emplace_back(Layout(to.width(), to.height()));
    for (int y = 0; y < to.height(); ++y) {
      const int row = std::clamp(y + to.y0 - from.y0, 0, from.height() - 1);
      for (int x = 0; x < to.width(); ++x)
        out.at(x, y) = channel.at(std::clamp(x + to.x0 - from.x0, 0, from.width() - 1), row);
    }
  }
  return placed;
}

void add_truth(FrameFile& file, const std::string& plane, const Frame& frame, Truth& result) {
  const std::string path = file.path().string();
  const Frame truth = file.read({plane});
  const bool is_one_picture = truth.display == frame.display;  // whatever margin either has
  if (!is_one_picture && (truth.width() != frame.width() || truth.height() != frame.height()))
    throw Error("{} is {}x{} and the frame is {}x{}; only images of one size can be compared", path, truth.width(),
                truth.height(), frame.width(), frame.height());
  for (const auto& [name, view] : views_for(truth, file, frame)) {
    const Plane& values = view->planes.at(plane);
    const bool is_placed = is_one_picture && truth.window != frame.window;
    if (!result.image.emplace(name, is_placed ? in_window(values, truth.window, frame.window) : values.clone()).second)
      throw Error("{}: is a truth of view '{}', as the one before it; give one for each view", path, name);
  }
  std::optional<double> radius = file.number_attribute(plane + "Radius");
  if (!radius) radius = file.number_attribute(plane + "Length");
  if (radius && result.radius && std::abs(*radius - *result.radius) > 1e-6 * *radius)
    throw Error("{}: was made with radius {:g}, and the truth before it with {:g}", path, *radius, *result.radius);
  if (radius) result.radius = radius;
  if (const auto noise = file.number_attribute(plane + "Noise"))
    result.noise = std::max(*noise, result.noise.value_or(0));
  const std::optional<double> rays = file.number_attribute(plane + "Samples");
  if (rays) result.rays = std::min(*rays, result.rays.value_or(*rays));
}

}  // namespace

std::vector<std::string> effects_in(const std::vector<std::string>& paths) {
  std::vector<std::string> held, effects;
  for (const std::string& path : paths) {
    for (const std::string& plane : truth_file(path).common_planes()) add_new(held, plane);
  }
  for (const std::string& plane : effect_names()) {
    if (contains(held, plane)) effects.push_back(plane);
  }
  return effects;
}

Truth read_truth(const std::vector<std::string>& paths, const std::string& plane, const Frame& frame,
                 std::vector<std::string>& notes) {
  Truth result;
  for (const std::string& path : paths) {
    FrameFile file = truth_file(path);
    if (contains(file.common_planes(), plane))
      add_truth(file, plane, frame, result);
    else if (effects_in({path}).empty())
      throw Error("{}: has no plane '{}' to measure against; it has {}", path, plane, enumerate(file.all_channels()));
  }
  if (result.image.empty())
    throw Error("{}: {} no plane '{}' to measure against", enumerate(paths), paths.size() == 1 ? "has" : "have", plane);
  std::vector<std::string> known, missing;
  for (const View& view : frame.views) (result.image.count(view.name) ? known : missing).push_back(view.name);
  if (!missing.empty())
    notes.push_back(fmt::format("errors are of {} alone, as the truth has no {}; {} once for each view gives both",
                                enumerate(known), enumerate(missing), option("truth")));
  return result;
}

}  // namespace gloam::bench
