#include "measure/session.h"

#include <algorithm>

#include "base/lists.h"
#include "measure/document.h"
#include "measure/pictures.h"

namespace gloam::bench {
namespace {

constexpr int growth_rounds = 5;
constexpr int most_pixels_across = 8192;  // of a frame captured at twice the size

/// An error message without the name of the technique at its start.
std::string without_name(const Technique& technique, const Error& error) {
  const std::string message = error.what(), prefix = technique.name + ": ";
  return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
}

}  // namespace

Session::Session(Subject& subject, const MeasureOptions& options, Device& device, Measurement& result)
    : subject_(subject),
      options_(options),
      device_(device),
      result_(result),
      race_(subject.frame, subject.holds, subject.radius.value, device),
      steps_(subject.frame, subject.holds, device, subject.truth, subject.truths.get(),
             foreground(subject.frame, any_makes_first_view_only(options.techniques))) {}

void Session::measure_all() {
  for (const Technique* technique : options_.techniques) enter(*technique);
  if (!rows_.empty())
    race_.run({.fewest = options_.rounds, .most = options_.rounds},
              [&](int done, int of) { tell("all plans in turn", done, of); });
  for (auto& row : rows_) result_.rows.push_back(std::move(row));
  const std::vector<std::string>& notes = race_.notes();
  result_.notes.insert(result_.notes.end(), notes.begin(), notes.end());
}

void Session::measure_growth(const std::vector<const Technique*>& techniques) {
  for (size_t i = 0; i < techniques.size(); ++i) {
    const Technique& technique = *techniques[i];
    if (!contains(measured_, technique.name)) continue;
    tell("growth of " + technique.name, int(i), int(techniques.size()));
    try {
      for (Growth& growth :
           bench::measure_growth(technique, subject_.frame, device_, {subject_.radius.value, growth_rounds})) {
        growth.scene = subject_.name;
        result_.growth.push_back(std::move(growth));
      }
    } catch (const Error& error) {
      skip_part(technique, "growth", error);
    }
  }
}

void Session::measure_scales() {
  tell("other resolutions", 0, 1);
  const int width = 2 * subject_.frame.width(), height = 2 * subject_.frame.height();
  const std::vector<const Technique*> techniques = those_measured();
  const bool is_known =
      subject_.truths && subject_.scene_class != "own" && std::max(width, height) <= most_pixels_across;
  const auto measured = [&](const Frame& largest) {
    return bench::measure_scales(techniques, largest, subject_.name, subject_.radius.value, device_,
                                 [&](const Technique& t, const Error& e) { skip_part(t, "other resolutions", e); });
  };
  const std::vector<ScaleChange> found =
      is_known ? measured(subject_.truths->captured(width, height)) : measured(subject_.frame);
  result_.scales.insert(result_.scales.end(), found.begin(), found.end());
}

void Session::measure_planes() {
  tell("bare planes", 0, 1);
  result_.planes = bench::measure_planes(those_measured(), subject_.frame.width(), subject_.frame.height(), device_,
                                         [&](const Technique& t, const Error& e) { skip_part(t, "bare planes", e); });
}

void Session::add_scene() {
  const MeasuredEffect& effect = effect_of(subject_.effect);
  const Errors base = steps_.base_errors(effect);
  report::Scene facts = scene_of(subject_.name, subject_.scene_class, subject_.effect, subject_.frame, subject_.radius);
  facts.base = {effect.base, base.rmse, base.bias};
  if (subject_.truth) {
    facts.truth_noise = subject_.truth->noise;
    facts.truth_rays = subject_.truth->rays;
    try {
      facts.truth_image = picture("truth", subject_.truth->image);
    } catch (const Error& error) {
      result_.notes.push_back(fmt::format("{}; there is no picture of the truth", error.what()));
    }
  }
  facts.white = white_.value_or(1);
  facts.peaks = race_.peaks();
  if (subject_.truths) {
    facts.made = subject_.truths->made();
    facts.reused = subject_.truths->reused();
    if (!facts.reused->empty())
      result_.notes.push_back(fmt::format("{} of an earlier run used again", enumerate(*facts.reused)));
  }
  result_.scenes.push_back(std::move(facts));
}

std::vector<const Technique*> Session::those_measured() const {
  std::vector<const Technique*> techniques;
  for (const Technique* t : options_.techniques) {
    if (contains(measured_, t->name)) techniques.push_back(t);
  }
  return techniques;
}

void Session::tell(const std::string& what, int done, int of) const {
  if (options_.progress) options_.progress(subject_.name + ": " + what, double(done) / of);
}

void Session::skip(const Technique& technique, const std::string& preset, const std::string& why) {
  result_.skipped.push_back({technique.name, preset, subject_.name, why});
}

void Session::skip_part(const Technique& technique, const std::string& part, const Error& error) {
  skip(technique, "", part + ": " + without_name(technique, error));
}

Skipped Session::failure_of(const Variation& v, const Error& error) const {
  return {v.technique->name, v.variant.empty() ? v.preset : v.name() + ", " + v.variant, subject_.name,
          without_name(*v.technique, error)};
}

void Session::enter(const Technique& technique) {
  const double radius = subject_.radius.value;
  const std::vector<Variation> variations =
      options_.rows.empty() ? variations_of(technique, radius, options_)
                            : wanted_variations(options_.rows, technique, radius, subject_.name, subject_.effect);
  if (variations.empty() && !options_.rows.empty()) return;
  if (variations.empty()) skip(technique, "", "has none of these presets");
  std::vector<Skipped> failed;
  for (size_t i = 0; i < variations.size(); ++i) {
    const Variation& v = variations[i];
    tell(fmt::format("images of {}", technique.name), int(i), int(variations.size()));
    try {
      rows_.push_back(row_of(v));
      add_new(measured_, technique.name);
    } catch (const Error& error) {
      failed.push_back(failure_of(v, error));
    }
  }
  add_skipped(failed, failed.size() == variations.size());
}

void Session::add_skipped(const std::vector<Skipped>& failed, bool is_all) {
  const auto is_like_first = [&](const Skipped& each) { return each.why == failed.front().why; };
  if (is_all && !failed.empty() && std::all_of(failed.begin(), failed.end(), is_like_first))
    result_.skipped.push_back({failed.front().technique, "", subject_.name, failed.front().why});
  else
    result_.skipped.insert(result_.skipped.end(), failed.begin(), failed.end());
}

std::unique_ptr<Row> Session::empty_row(const Variation& variation) const {
  auto row = std::make_unique<Row>();
  row->variation = variation;
  row->scene = subject_.name;
  row->effect = subject_.effect;
  row->width = subject_.frame.width();
  row->height = subject_.frame.height();
  return row;
}

bool Session::has_ladder(const Variation& variation) const {
  return options_.ladder == LadderFor::all || (options_.ladder == LadderFor::presets && variation.variant.empty());
}

void Session::add_ladder(Row& row, const Image& shipped) {
  const Technique& technique = *row.variation.technique;
  row.ladder = steps_.climb(row.variation, shipped);
  if (contains(converged_, technique.name)) return;
  const Errors converged = steps_.converged_errors(row.variation);
  converged_.push_back(technique.name);
  if (converged.rmse)
    result_.converged.push_back(
        {technique.name, subject_.name, converged.rmse, converged.bias, reads_of(technique), subject_.effect});
}

std::unique_ptr<Row> Session::row_of(const Variation& variation) {
  auto row = empty_row(variation);
  const Image shipped = steps_.shipped(variation);
  row->errors = steps_.errors(shipped);
  row->similarity = steps_.similarity(shipped);
  row->inconsistency = inconsistency(subject_.frame, shipped);
  if (has_ladder(variation)) add_ladder(*row, shipped);
  row->image = picture_of(variation, shipped);
  race_.enter(*row);  // last, since the race keeps a pointer to the row
  return row;
}

std::string Session::picture_of(const Variation& variation, const Image& image) {
  std::string name = variation.technique->name + "_" + variation.name();
  if (!variation.variant.empty()) name += "_" + variation.variant;
  return picture(name, image);
}

std::string Session::picture(const std::string& name, const Image& image) {
  if (options_.folder.empty()) return "";
  const std::string folder = picture_folder(subject_.name, subject_.effect);
  std::string path = fmt::format("{}/{}.png", folder, file_name(name));
  for (int number = 2; contains(pictures_, path); ++number)
    path = fmt::format("{}/{}_{}.png", folder, file_name(name), number);
  pictures_.push_back(path);
  make_folder_of(options_.folder, path);
  const Image* truth = subject_.truth ? &subject_.truth->image : nullptr;
  const View& view = pictured_view(subject_.frame, {&image, truth});
  const Channel& depth = view.planes.at("depth").channels[0];
  if (!white_) white_ = white_of((truth ? *truth : image).at(view.name), depth);
  write_grey(options_.folder / path, image.at(view.name), depth, *white_);
  return path;
}

}  // namespace gloam::bench
