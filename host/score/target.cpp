#include "score/target.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "compare/plane_pairs.h"
#include "exr/holdings.h"
#include "gloam/error.h"
#include "measure/document.h"
#include "measure/effects.h"
#include "measure/pictures.h"

namespace gloam::score {
namespace {

/// The value that pictures of an effect show as white.
double white_of(const LoadedFrame& loaded) {
  const View& view = bench::pictured_view(loaded.frame, {&loaded.truth.image});
  return bench::white_of(loaded.truth.image.at(view.name), view.planes.at("depth").channels[0]);
}

std::vector<std::string> planes_to_load(const FrameFile& file) {
  std::vector<std::string> planes;
  for (const char* plane : {"depth", "normal", "motion"}) {
    if (contains(file.common_planes(), plane)) planes.emplace_back(plane);
  }
  return planes;
}

}  // namespace

std::string Target::in_words(std::optional<int> frame) const {
  std::string words = name;
  if (effect != "ao") words += " (" + effect + ")";
  if (frame && is_sequence) words += fmt::format(" frame {}", *frame);
  return words;
}

std::vector<std::string> LoadedFrame::views() const {
  std::vector<std::string> names;
  for (const View& view : frame.views) names.push_back(view.name);
  return names;
}

unsigned long long LoadedFrame::bytes() const {
  unsigned long long bytes = 0;
  const auto add = [&](const Plane& plane) {
    for (const Channel& channel : plane.channels) bytes += channel.layout().bytes();
  };
  for (const View& view : frame.views) {
    for (const auto& [name, plane] : view.planes) add(plane);
  }
  for (const auto& [view, plane] : truth.image) add(plane);
  return bytes;
}

unsigned long long bytes_to_load(const TargetFrame& at, const std::string& effect, const ReadOptions& reading) {
  if (at.check) at.check();
  const FrameFile file(at.frame, reading);
  unsigned long long bytes = file.bytes_to_read(planes_to_load(file));
  ReadOptions as_stored;
  as_stored.as_stored = true;
  for (const std::string& path : at.truths) {
    const FrameFile truth(path, as_stored);
    if (contains(truth.common_planes(), effect)) bytes += truth.bytes_to_read({effect});
  }
  return bytes;
}

LoadedFrame load(const TargetFrame& at, const std::string& effect, const ReadOptions& reading,
                 std::vector<std::string>& notes) {
  if (at.check) at.check();
  LoadedFrame loaded;
  FrameFile file(at.frame, reading);
  if (!contains(file.common_planes(), "depth"))
    throw Error("{}: has no depth to tell the background by; {}", at.frame.string(), holdings(file));
  loaded.frame = file.read(planes_to_load(file));
  loaded.truth = bench::read_truth(at.truths, effect, loaded.frame, notes);
  for (auto& [view, plane] : loaded.truth.image) plane = without_confidence(std::move(plane));
  loaded.foreground = bench::foreground(loaded.frame);
  if (effect == "reflection")
    loaded.exposure = FrameFile(at.truths.front(), {}).number_attribute("gloamExposure").value_or(0);
  return loaded;
}

std::string picture_file(const Target& target, const std::string& name) {
  return fmt::format("{}/{}.png", bench::picture_folder(target.name, target.effect), bench::file_name(name));
}

std::string submitted_picture(const std::string& method) { return method + "_submitted"; }

std::string write_picture(const std::filesystem::path& folder, const Target& target, const std::string& name,
                          const LoadedFrame& loaded, const bench::Image& image) {
  const std::string path = picture_file(target, name);
  bench::make_folder_of(folder, path);
  const View& view = bench::pictured_view(loaded.frame, {&loaded.truth.image});
  const auto shown = image.find(view.name);
  if (shown == image.end()) return "";
  bench::write_grey(folder / path, shown->second, view.planes.at("depth").channels[0], white_of(loaded));
  return path;
}

report::Scene facts_of(const Target& target, const LoadedFrame& first, const std::filesystem::path& folder) {
  const std::optional<double> radius = target.radius ? target.radius : first.truth.radius;
  report::Scene facts =
      bench::scene_of(target.name, target.scene_class, target.effect, first.frame,
                      radius ? Radius{*radius, RadiusSource::truth} : default_radius(first.frame, {}));
  facts.kind = target.kind;
  facts.truth_noise = first.truth.noise;
  facts.truth_rays = first.truth.rays;
  facts.base.name = "black";
  float base = 0;
  if (contains(bench::effect_names(), target.effect)) {
    facts.base.name = bench::effect_of(target.effect).base;
    base = bench::effect_of(target.effect).base_value;
  }
  const bench::Image even = bench::even_image(first.truth.image, base);
  facts.base.rmse = bench::rmse(even, first.truth.image, first.foreground);
  facts.base.bias = bench::bias(even, first.truth.image, first.foreground);
  facts.white = white_of(first);
  if (!folder.empty()) facts.truth_image = write_picture(folder, target, "truth", first, first.truth.image);
  return facts;
}

}  // namespace gloam::score
