#include "set/item_making.h"

#include <algorithm>

#include "base/file_ledger.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "scene/reference_kinds.h"
#include "set/content_hash.h"
#include "set/hard_frames.h"

namespace gloam::sets {
namespace {

constexpr const char* identity_name = "gloamSet";

/// A frame takes about as long as so many rays of a truth for each pixel.
constexpr double rays_of_frame = 60;

double pixels_of(const ItemRecipe& item) { return double(item.width) * item.height; }

/// Rays for each truth are its own, so that noise does not stand still in a sequence.
uint32_t seed_of(int frame) { return uint32_t(frame); }

}  // namespace

double work_in(const ItemRecipe& item) {
  double rays = rays_of_frame;
  for (const TruthRecipe& truth : item.truths) rays += std::max(truth.rays, 1);
  return rays * pixels_of(item) * double(std::max<size_t>(item.frames.size(), 1));
}

ItemMaker::ItemMaker(const Recipe& recipe, const ItemRecipe& item, const std::filesystem::path& folder,
                     Progress progress)
    : recipe_(recipe), item_(item), folder_(folder), progress_(std::move(progress)), scene_(item) {}

void ItemMaker::tell(const std::string& what, double share) const {
  progress_(item_.name + ": " + what, std::min(share, 1.0));
}

/// The hash of a file that stays; empty if it must be made.
std::string ItemMaker::kept_hash(const std::string& file, const std::string& identity) {
  const LooksAtFiles looks;
  try {
    std::error_code unknown;
    const std::filesystem::path path = folder_ / file;
    if (!std::filesystem::exists(path, unknown)) return "";
    if (FrameFile(path, {}).text_attribute(identity_name) != identity) return "";
    const std::string hash = content_hash(path);
    const auto frozen = recipe_.hashes.find(file);
    if (frozen != recipe_.hashes.end() && frozen->second != hash) return "";
    ++kept_;
    return hash;
  } catch (const Error&) {  // damaged: made again
    return "";
  }
}

SetFile ItemMaker::frame_file(size_t i) {
  const std::string file = frame_files(item_)[i], identity = identity_of(recipe_, item_);
  if (const std::string hash = kept_hash(file, identity); !hash.empty()) return {file, hash};
  const double before = done_, work = rays_of_frame * pixels_of(item_) / work_in(item_);
  Frame frame = scene_.capture_frame(
      number(i), recipe_.layers, [&](int done, int of) { tell("frame", before + work * double(done) / double(of)); });
  frame.attributes[identity_name] = identity;
  write_frame(folder_ / file, frame);
  ++made_;
  return {file, content_hash(folder_ / file)};
}

void ItemMaker::trace(size_t i, const TruthRecipe& truth, const std::filesystem::path& file,
                      const std::string& identity) {
  ReferenceRequest request;
  request.what = truth.effect;
  request.samples = truth.rays;
  const ReferenceJob job = job_of(request, as_flag);
  FrameFile frame(folder_ / frame_files(item_)[i], {});
  std::vector<std::string> planes;
  for (const std::string& plane : job.reads) {
    if (contains(frame.common_planes(), plane)) planes.push_back(plane);
  }
  ReferenceOptions options;
  options.radius = item_.radius;
  options.seed = seed_of(number(i));
  options.checkpoint = file.parent_path() / ("." + file.stem().string() + ".unfinished.exr");
  const double before = done_, work = truth.rays * pixels_of(item_) / work_in(item_);
  options.progress = [&](double share) { tell(truth.effect, before + work * share); };
  Reference reference = job.trace(scene_.tracer(number(i)), frame.read(planes), options);
  reference.frame.attributes[identity_name] = identity;
  write_frame(file, reference.frame);
  std::error_code none;
  std::filesystem::remove(options.checkpoint, none);
}

SetFile ItemMaker::truth_file(size_t i, const TruthRecipe& truth) {
  const std::string file = truth_files(item_, truth.effect)[i],
                    identity = fmt::format("{} {} {} rays", identity_of(recipe_, item_), truth.effect, truth.rays);
  if (const std::string hash = kept_hash(file, identity); !hash.empty()) return {file, hash};
  trace(i, truth, folder_ / file, identity);
  ++made_;
  return {file, content_hash(folder_ / file)};
}

SetTruth ItemMaker::made_truth(const TruthRecipe& truth) {
  SetTruth made{truth.effect, truth.rays, 0, truth.best_error, {}};
  for (size_t i = 0; i < frame_files(item_).size(); ++i) {
    made.files.push_back(truth_file(i, truth));
    const FrameFile file(folder_ / made.files.back().file, {});
    made.noise = std::max(made.noise, file.number_attribute(truth.effect + "Noise").value_or(0));
    if (const auto rays = file.number_attribute(truth.effect + "Samples")) made.rays = int(*rays);
    done_ += truth.rays * pixels_of(item_) / work_in(item_);
  }
  return made;
}

/// Frame and truth come from one closed form.
void ItemMaker::make_hard(SetItem& item) {
  const std::string identity = identity_of(recipe_, item_);
  const std::string frame_name = frame_files(item_)[0], truth_name = truth_files(item_, "ao")[0];
  const int kept_before = kept_;
  std::string of_frame = kept_hash(frame_name, identity);
  std::string of_truth = of_frame.empty() ? "" : kept_hash(truth_name, identity);
  if (of_truth.empty()) {
    kept_ = kept_before;
    HardFrame made = hard_frame(item_.hard, item_.width, item_.height, item_.radius);
    made.frame.numbers["aoRadius"] = made.truth.numbers["aoRadius"] = item_.radius;
    made.truth.numbers["aoNoise"] = 0;
    made.truth.attributes["aoDefinition"] =
        "closed form of the cosine-weighted share of directions in which nothing is "
        "nearer than aoRadius";
    made.frame.attributes[identity_name] = made.truth.attributes[identity_name] = identity;
    write_frame(folder_ / frame_name, made.frame);
    write_frame(folder_ / truth_name, made.truth);
    made_ += 2;
    of_frame = content_hash(folder_ / frame_name);
    of_truth = content_hash(folder_ / truth_name);
  }
  item.files = {{frame_name, of_frame}};
  item.truths = {{"ao", 0, 0, {}, {{truth_name, of_truth}}}};
  if (!item_.truths.empty()) item.truths[0].best_error = item_.truths[0].best_error;
}

SetItem ItemMaker::make() {
  SetItem item{item_.name, item_.kind, class_of(item_), item_.width, item_.height};
  item.frames = item_.frames;
  item.radius = item_.radius;
  item.licence = recipe_.licence;
  if (item_.kind == "hard") {
    make_hard(item);
    return item;
  }
  for (size_t i = 0; i < frame_files(item_).size(); ++i) {
    item.files.push_back(frame_file(i));
    done_ += rays_of_frame * pixels_of(item_) / work_in(item_);
  }
  const std::vector<std::string> views = FrameFile(folder_ / item.files[0].file, {}).views();
  if (views.size() > 1) item.views = views;
  for (const TruthRecipe& truth : item_.truths) item.truths.push_back(made_truth(truth));
  return item;
}

}  // namespace gloam::sets
