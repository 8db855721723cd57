#include "bench/measurement.h"

#include <algorithm>

#include "base/lists.h"
#include "bench/pictures.h"
#include "gloam/error.h"

namespace gloam::bench {
namespace {

constexpr int growth_rounds = 5;
constexpr int most_pixels_across = 8192;  // of a frame captured at twice the size

/// All measurements on one frame.
class Session {
 public:
  Session(Subject& subject, const MeasureOptions& options, Device& device, Measurement& result)
      : subject_(subject),
        options_(options),
        device_(device),
        result_(result),
        race_(subject.frame, subject.holds, subject.radius.value, device),
        steps_(subject.frame, subject.holds, device, subject.truth, subject.truths.get(),
               foreground(subject.frame, any_makes_first_view_only(options.techniques))) {}

  void measure() {
    for (const Technique* technique : options_.techniques) enter(*technique);
    if (!rows_.empty()) race_.run(options_.rounds, [&](int done, int of) { tell("all plans in turn", done, of); });
    for (auto& row : rows_) result_.rows.push_back(std::move(row));
    const std::vector<std::string>& notes = race_.notes();
    result_.notes.insert(result_.notes.end(), notes.begin(), notes.end());
  }

  void measure_growth() {
    for (size_t i = 0; i < options_.growth.size(); ++i) {
      const Technique& technique = *options_.growth[i];
      if (!contains(measured_, technique.name)) continue;
      tell("growth of " + technique.name, int(i), int(options_.growth.size()));
      try {
        for (Growth& growth :
             bench::measure_growth(technique, subject_.frame, device_, {subject_.radius.value, growth_rounds}))
          result_.growth.push_back({technique.name, subject_.name, std::move(growth)});
      } catch (const Error& error) {
        skip_part(technique, "growth", error);
      }
    }
  }

  /// Captures a built-in scene with twice as many pixels each way, so that the frame itself is the middle one of three.
  void measure_scales() {
    tell("other resolutions", 0, 1);
    const int width = 2 * subject_.frame.width(), height = 2 * subject_.frame.height();
    const std::vector<const Technique*> techniques = those_measured();
    const bool is_known =
        subject_.truths && subject_.scene_class != "own" && std::max(width, height) <= most_pixels_across;
    const auto measured = [&](const Frame& largest) {
      return bench::measure_scales(techniques, largest, subject_.name, subject_.radius.value, device_,
                                   [&](const Technique& t, const Error& e) { skip_part(t, "other resolutions", e); });
    };
    const std::vector<ScaleFacts> found =
        is_known ? measured(subject_.truths->captured(width, height)) : measured(subject_.frame);
    result_.scales.insert(result_.scales.end(), found.begin(), found.end());
  }

  void measure_planes() {
    tell("bare planes", 0, 1);
    result_.planes = bench::measure_planes(those_measured(), subject_.frame.width(), subject_.frame.height(), device_,
                                           [&](const Technique& t, const Error& e) { skip_part(t, "bare planes", e); });
  }

  void add_scene() {
    SceneFacts facts{subject_.name,          subject_.scene_class,    subject_.effect,
                     subject_.frame.width(), subject_.frame.height(), subject_.radius};
    const MeasuredEffect& effect = effect_of(subject_.effect);
    facts.base = effect.base;
    facts.base_errors = steps_.base_errors(effect);
    facts.radius_pixels = median_reach(subject_.frame, subject_.radius.value);
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
      facts.traced = true;
      facts.made = subject_.truths->made();
      facts.reused = subject_.truths->reused();
      if (!facts.reused.empty())
        result_.notes.push_back(fmt::format("{} of an earlier run used again", enumerate(facts.reused)));
    }
    result_.scenes.push_back(std::move(facts));
  }

 private:
  std::vector<const Technique*> those_measured() const {
    std::vector<const Technique*> techniques;
    for (const Technique* t : options_.techniques) {
      if (contains(measured_, t->name)) techniques.push_back(t);
    }
    return techniques;
  }

  void tell(const std::string& what, int done, int of) const {
    if (options_.progress) options_.progress(subject_.name + ": " + what, double(done) / of);
  }

  void skip(const Technique& technique, const std::string& preset, const std::string& why) {
    result_.skipped.push_back({technique.name, preset, subject_.name, why});
  }

  /// Skips a measurement other than the rows.
  void skip_part(const Technique& technique, const std::string& part, const Error& error) {
    skip(technique, "", part + ": " + without_name(technique, error));
  }

  /// Enters the variations of a technique that the frame and the device allow.
  void enter(const Technique& technique) {
    const std::vector<Variation> variations = variations_of(technique, subject_.radius.value, options_);
    if (variations.empty()) skip(technique, "", "has none of these presets");
    std::vector<Skipped> failed;
    for (size_t i = 0; i < variations.size(); ++i) {
      const Variation& v = variations[i];
      tell(fmt::format("images of {}", technique.name), int(i), int(variations.size()));
      try {
        rows_.push_back(row_of(v));
        add_new(measured_, technique.name);
      } catch (const Error& error) {
        failed.push_back({technique.name, v.variant.empty() ? v.preset : v.name() + ", " + v.variant, subject_.name,
                          without_name(technique, error)});
      }
    }
    add_skipped(failed, failed.size() == variations.size());
  }

  /// One line for a technique if nothing of it can be measured, for one reason.
  void add_skipped(const std::vector<Skipped>& failed, bool is_all) {
    const auto is_like_first = [&](const Skipped& each) { return each.why == failed.front().why; };
    if (is_all && !failed.empty() && std::all_of(failed.begin(), failed.end(), is_like_first))
      result_.skipped.push_back({failed.front().technique, "", subject_.name, failed.front().why});
    else
      result_.skipped.insert(result_.skipped.end(), failed.begin(), failed.end());
  }

  std::unique_ptr<Row> row_of(const Variation& variation) {
    auto row = std::make_unique<Row>();
    row->variation = variation;
    row->scene = subject_.name;
    row->effect = subject_.effect;
    row->width = subject_.frame.width();
    row->height = subject_.frame.height();
    const Image shipped = steps_.shipped(variation);
    row->errors = steps_.errors(shipped);
    row->similarity = steps_.similarity(shipped);
    row->inconsistency = inconsistency(subject_.frame, shipped);
    const bool with_ladder =
        options_.ladder == LadderFor::all || (options_.ladder == LadderFor::presets && variation.variant.empty());
    if (with_ladder) row->ladder = steps_.climb(variation, shipped);
    std::string name = variation.technique->name + "_" + variation.name();
    if (!variation.variant.empty()) name += "_" + variation.variant;
    row->image = picture(name, shipped);
    Errors converged;
    if (with_ladder && !contains(measured_, variation.technique->name)) converged = steps_.converged_errors(variation);
    race_.enter(*row);  // last, since the race keeps a pointer to the row
    if (converged.rmse) result_.converged.push_back({variation.technique, subject_.name, subject_.effect, converged});
    return row;
  }

  /// Draws the first view; returns the path below the folder, empty if there are to be no pictures.
  std::string picture(const std::string& name, const Image& image) {
    if (options_.folder.empty()) return "";
    const std::string of_effect = subject_.effect == "ao" ? "" : "_" + subject_.effect;
    const std::string folder = "images/" + file_name(subject_.name + of_effect);
    std::string path = fmt::format("{}/{}.png", folder, file_name(name));
    for (int number = 2; contains(pictures_, path); ++number)
      path = fmt::format("{}/{}_{}.png", folder, file_name(name), number);
    pictures_.push_back(path);
    std::error_code error;
    std::filesystem::create_directories(options_.folder / folder, error);
    if (error) throw Error("{}: cannot be made ({})", (options_.folder / folder).string(), error.message());
    // The first view that image and truth share: the truth may have one view.
    const auto is_known = [&](const View& v) {
      return image.count(v.name) && (!subject_.truth || subject_.truth->image.count(v.name));
    };
    const auto& views = subject_.frame.views;
    const auto known = std::find_if(views.begin(), views.end(), is_known);
    const View& view = known == views.end() ? views.front() : *known;
    const Channel& depth = view.planes.at("depth").channels[0];
    if (!white_) white_ = white_of((subject_.truth ? subject_.truth->image : image).at(view.name), depth);
    write_grey(options_.folder / path, image.at(view.name), depth, *white_);
    return path;
  }

  /// An error message without the name of the technique at its start.
  static std::string without_name(const Technique& technique, const Error& error) {
    const std::string message = error.what(), prefix = technique.name + ": ";
    return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
  }

  Subject& subject_;
  const MeasureOptions& options_;
  Device& device_;
  Measurement& result_;
  std::vector<std::unique_ptr<Row>> rows_;
  std::vector<std::string> measured_, pictures_;
  std::optional<double> white_;  ///< what all pictures show as white
  Race race_;
  Steps steps_;
};

}  // namespace

std::vector<std::string> presets_of(const Technique& technique, const MeasureOptions& options) {
  std::vector<std::string> names;
  for (const Preset& preset : source_of(technique).presets) {
    if (options.presets.empty() || contains(options.presets, preset.name)) names.push_back(preset.name);
  }
  if (source_of(technique).presets.empty() && options.presets.empty()) names.push_back("");
  return names;
}

bool in_short(const Technique& technique, const MeasureOptions& options) {
  return !options.layers_in_full && reads_layers(technique);
}

std::vector<Variation> variations_of(const Technique& technique, double radius, const MeasureOptions& options) {
  const std::vector<std::string> presets = presets_of(technique, options);
  std::vector<Variation> all;
  if (in_short(technique, options) && !presets.empty()) return {{&technique, base_preset(presets), radius}};
  for (const std::string& preset : presets) all.push_back({&technique, preset, radius});
  if (presets.empty()) return all;
  const Variation base{&technique, base_preset(presets), radius};
  for (const std::string& name : options.variants) all.push_back(with_variant(base, name));
  for (Variation& each : swept(base, options.sweeps)) all.push_back(std::move(each));
  return all;
}

MeasureOptions for_effect(const MeasureOptions& options, const std::string& plane) {
  MeasureOptions of_effect = options;
  const auto is_of_another = [&](const Technique* t) { return measured_plane(*t) != plane; };
  std::erase_if(of_effect.techniques, is_of_another);
  std::erase_if(of_effect.growth, is_of_another);
  if (plane != "ao") of_effect.checks = false;
  return of_effect;
}

void measure(Subject& subject, const MeasureOptions& options, bool is_first, Device& device, Measurement& result) {
  Session session(subject, options, device, result);
  session.measure();
  if (is_first) session.measure_growth();
  if (options.checks) session.measure_scales();
  if (options.checks && is_first) session.measure_planes();
  session.add_scene();
}

}  // namespace gloam::bench
