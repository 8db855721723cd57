#include "score/scoring.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "base/lists.h"
#include "compare/plane_pairs.h"
#include "gloam/error.h"
#include "gloam/flicker.h"
#include "measure/sequence.h"
#include "run/driver.h"
#include "score/plain_image.h"

namespace gloam::score {
namespace {

/// Below this correlation with its truth an image looks inverted.
constexpr double inverted_correlation = -0.2;
/// A fit that leaves less than this share of the error says more about the convention than about the method.
constexpr double telling_share = 0.7;
/// Exponents that decode what a display's encoding (2.2, sRGB) made.
constexpr double least_gamma = 1.7, most_gamma = 2.8;

/// Sums over the frames of a target.
struct Sums {
  Figures figures;
  int frames = 0, inconsistencies = 0, own_sizes = 0;
  FlickerSums flicker;
  std::vector<FlickerMeter> meters;  ///< of each view
  std::optional<int> before;         ///< number of the frame before

  void add(const LoadedFrame& loaded, const bench::Image& image, int number, bool is_sequence) {
    const auto views = bench::metrics_of_views(image, loaded.truth.image, loaded.foreground, loaded.exposure);
    std::vector<Metrics> list;
    for (const auto& [view, metrics] : views) list.push_back(metrics);
    const Metrics all = pooled(list);
    figures.rmse += bench::rmse(image, loaded.truth.image, loaded.foreground);
    figures.bias += bench::bias(image, loaded.truth.image, loaded.foreground);
    figures.ssim += all.ssim;
    if (all.flip) figures.flip = figures.flip.value_or(0) + *all.flip;
    if (frames == 0 && views.size() > 1) figures.views = views;
    if (const auto error = bench::inconsistency(loaded.frame, image)) {
      figures.inconsistency = figures.inconsistency.value_or(0) + *error;
      ++inconsistencies;
    }
    if (is_sequence) add_flicker(loaded, image, number);
    ++frames;
  }

  void add_flicker(const LoadedFrame& loaded, const bench::Image& image, int number) {
    size_t index = 0;
    for (const View& view : loaded.frame.views) {
      const auto test = image.find(view.name), truth = loaded.truth.image.find(view.name);
      if (test == image.end() || truth == loaded.truth.image.end()) continue;
      if (meters.size() <= index) meters.emplace_back();
      FlickerMeter& meter = meters[index++];
      if (before && *before + 1 != number) meter.begin_anew();
      if (const auto pair = meter.add({test->second.clone(), truth->second.clone(), loaded.foreground.at(view.name),
                                       bench::surfaces_of_view(loaded.frame, view)}))
        flicker += *pair;
    }
    before = number;
  }

  Figures means() const {
    Figures mean = figures;
    mean.rmse /= frames;
    mean.bias /= frames;
    mean.ssim /= frames;
    if (mean.flip) *mean.flip /= frames;
    if (mean.inconsistency) *mean.inconsistency /= inconsistencies;
    if (mean.rmse_at_own_size) *mean.rmse_at_own_size /= own_sizes;
    mean.flicker = flicker.flicker();
    return mean;
  }
};

/// The files' names, for messages.
std::string names_of(const std::vector<SubmittedFile>& files) {
  std::vector<std::string> names;
  for (const SubmittedFile& file : files) names.push_back(file.path.string());
  return enumerate(names);
}

/// A few names, and how many more there are.
std::string few_of(const std::vector<std::string>& names) {
  constexpr size_t most = 6;
  if (names.size() <= most) return enumerate(names);
  return fmt::format("{} and {} more", fmt::join(names.begin(), names.begin() + most, ", "), names.size() - most);
}

}  // namespace

struct Scoring::Walked {
  Sums sums;
  std::vector<int> frames, missing;
  std::optional<report::Scene> scene;
  std::string picture;
};

bench::Image Scoring::plain_image(const Target& target, const LoadedFrame& loaded,
                                  const std::vector<SubmittedFile>& files, std::optional<double>& rmse_at_own_size) {
  const std::vector<std::string> views = loaded.views();
  const Layout layout(loaded.frame.width(), loaded.frame.height());
  const int scale = entry_.convention.scale;
  bench::Image image;
  for (const SubmittedFile& file : files) {
    const std::string path = file.path.string();
    const bool is_of_all = file.view.empty();
    const auto check = [&](int width, int height, unsigned long long bytes) {
      check_size(width, height, scale, layout, path);
      afford(path, bytes + loaded.bytes());
    };
    StoredImage stored =
        read_stored({file.path, target.effect, is_of_all ? views : std::vector{file.view}, options_.images, check});
    undo(entry_.convention, target.effect, stored);
    if (scale > 1) {
      const Layout small(stored.width, stored.height);
      const Reduced truth = reduced_truth(loaded.truth.image, loaded.foreground, scale, small);
      rmse_at_own_size = bench::rmse(stored.image, truth.image, truth.foreground);
      stored.image = enlarged(stored.image, scale, layout, loaded.foreground);
    }
    if (is_share(target.effect)) {
      if (const long long clamped = clamp_shares(stored.image, loaded.foreground, path))
        notes_.push_back(fmt::format("{}: {} pixels beyond 0 to 1 are clamped", path, clamped));
    }
    for (auto& [view, plane] : stored.image) image.insert_or_assign(view, std::move(plane));
  }
  std::vector<std::string> missing;
  for (const auto& [view, plane] : loaded.truth.image) {
    if (!image.count(view)) missing.push_back(view);
  }
  if (!missing.empty())
    throw Error("{}: no image of view {}; {}_VIEW_{}.exr names one", names_of(files), enumerate(missing), target.name,
                target.effect);
  return image;
}

void Scoring::afford(const std::string& file, unsigned long long bytes) const {
  if (options_.afford) options_.afford(file, bytes);
}

void Scoring::note_radius(const Target& target, const LoadedFrame& loaded) {
  const std::optional<double> truth = loaded.truth.radius ? loaded.truth.radius : target.radius;
  const Convention& c = entry_.convention;
  if (c.radius && truth && std::abs(*c.radius - *truth) > 1e-3 * *truth)
    add_new(notes_,
            fmt::format("{}: the method's radius is {:g} and the truth's {:g}: the truth of another radius is another "
                        "integral, and part of the error is this difference",
                        target.in_words(), *c.radius, *truth));
  if (!c.falloff.empty() && c.falloff != "none")
    add_new(notes_,
            fmt::format("the method's falloff is '{}' and the truths have none: part of the error is this difference",
                        c.falloff));
}

void Scoring::add_to_fit(const Target& target, const TargetFrame& at, const LoadedFrame& loaded,
                         const bench::Image& image) {
  FitSums sums(is_share(target.effect));
  sums.add(image, loaded.truth.image, loaded.foreground);
  if (is_share(target.effect) && sums.correlation().value_or(0) < inverted_correlation)
    inverted_[target.effect].push_back(target.in_words(at.number));
  const auto known = fits_.find(target.effect);
  if (known == fits_.end())
    fits_.emplace(target.effect, std::move(sums));
  else
    known->second += sums;
}

std::optional<Scoring::Walked> Scoring::walk(const Target& target, const FilesOf& files_of, const Transform& transform,
                                             bool is_first) {
  Walked walked;
  for (const TargetFrame& at : target.frames) {
    const auto leave_out = [&](const std::string& why) {
      walked.missing.push_back(at.number);
      if (is_first) left_out_.push_back({target.in_words(at.number), why});
    };
    try {
      afford(at.frame.string(), bytes_to_load(at, target.effect, options_.frames));
      LoadedFrame loaded = load(at, target.effect, options_.frames, notes_);
      std::optional<double> own;
      const bench::Image plain = plain_image(target, loaded, files_of(target, at), own);
      const bench::Image image = transform ? transform(plain) : bench::Image();
      const bench::Image& shown = transform ? image : plain;
      if (is_first && !walked.scene) {
        note_radius(target, loaded);
        auto facts = facts_of(target, loaded, options_.folder);
        if (!options_.folder.empty())
          walked.picture = write_picture(options_.folder, target, submitted_picture(entry_.name), loaded, shown);
        walked.scene = std::move(facts);
      }
      walked.sums.add(loaded, shown, at.number, target.is_sequence);
      if (own) {
        walked.sums.figures.rmse_at_own_size = walked.sums.figures.rmse_at_own_size.value_or(0) + *own;
        ++walked.sums.own_sizes;
      }
      walked.frames.push_back(at.number);
      if (is_first) add_to_fit(target, at, loaded, plain);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      leave_out(error.what());
    } catch (const std::bad_alloc&) {
      leave_out("memory ran out" + memory_limit());
    }
  }
  if (walked.frames.empty()) return {};
  return walked;
}

std::optional<Scored> Scoring::score(const Target& target, const FilesOf& files_of) {
  std::optional<Walked> walked = walk(target, files_of, {}, true);
  if (!walked) return {};
  return Scored{target, walked->sums.means(), walked->frames, walked->missing, *walked->scene, walked->picture};
}

std::optional<BestFit> Scoring::best_fit(const std::string& effect) const {
  const auto sums = fits_.find(effect);
  return sums == fits_.end() ? std::nullopt : sums->second.best();
}

std::optional<Figures> Scoring::score_fitted(const Target& target, const FilesOf& files_of, const BestFit& fit) {
  const bool is_of_shares = is_share(target.effect);
  const auto walked = walk(
      target, files_of, [&](const bench::Image& image) { return fitted(image, fit, is_of_shares); }, false);
  if (!walked) return {};
  return walked->sums.means();
}

std::vector<std::string> Scoring::doubts() const {
  std::vector<std::string> lines;
  for (const auto& [effect, items] : inverted_)
    lines.push_back(
        fmt::format("{} of {} looks inverted (dark where the truth is bright); if 1 is closed, state \"inverted\": "
                    "{} in the entry's convention; scored as stated",
                    effect, few_of(items), entry_.convention.inverted ? "false" : "true"));
  for (const auto& [effect, sums] : fits_) {
    const std::optional<BestFit> best = sums.best();
    if (!best || best->rmse > telling_share * sums.rmse() || inverted_.count(effect)) continue;
    if (is_share(effect) && best->exponent >= least_gamma && best->exponent <= most_gamma)
      lines.push_back(
          fmt::format("{} looks encoded for a display: to the power of {:.2f} its RMSE is {:.4f} and not {:.4f}; if it "
                      "is, state \"exponent\": {:.3f} in the entry's convention; scored as stated",
                      effect, best->exponent, best->rmse, sums.rmse(), entry_.convention.exponent / best->exponent));
    if (!is_share(effect) && (best->scale < 0.02 || best->scale > 50))
      lines.push_back(
          fmt::format("{} looks scaled: times {:.3g} its RMSE is {:.4g} and not {:.4g}; \"range\" in the entry's "
                      "convention states the stored values of 0 and 1; scored as stated",
                      effect, best->scale, best->rmse, sums.rmse()));
  }
  return lines;
}

}  // namespace gloam::score
