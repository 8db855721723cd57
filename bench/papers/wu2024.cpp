#include "papers/wu2024.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "base/lists.h"
#include "gloam/metrics.h"
#include "gloam/scene/reflection_reference.h"
#include "papers/eyes.h"
#include "papers/study.h"
#include "papers/timed_table.h"

namespace gloam::bench {
namespace {

constexpr double eyes_apart = 0.065;
constexpr int divisor = 2;  ///< of the size of images that rays are traced for
/// Shares of the reflected light that one of the eyes shows, from which on it counts as well shown, or below which as hardly shown.
constexpr double well_shown = 0.9, hardly_shown = 0.1;
constexpr double all_shown = 2;  ///< above any share, including its rounding

/// The paper's figures of a scene: SSIM of left and right, and milliseconds.
struct OfThePaper {
  std::array<double, 2> plain_ssim, stereo_ssim;
  double plain_traversal, stereo_traversal, plain_filter, stereo_filter, plain_total, stereo_total;
};

struct Subject {
  StandIn stand_in;
  OfThePaper paper;
};

constexpr std::array<Subject, 3> subjects = {
    {{{"gallery", "Pica"}, {{0.373, 0.393}, {0.423, 0.447}, 2.06, 2.72, 0.75, 1.03, 2.81, 3.75}},
     {{"lounge", "Room"}, {{0.364, 0.353}, {0.393, 0.382}, 1.92, 2.65, 0.94, 1.04, 2.86, 3.69}},
     {{"banquet", "Wine"}, {{0.274, 0.268}, {0.295, 0.296}, 3.61, 5.24, 0.85, 1.22, 4.46, 6.46}}}};

std::string name_of(const Subject& s) { return fmt::format("{} for {}", s.stand_in.scene, s.stand_in.of); }

Asked plain() { return {.technique = "sssr", .settings = {}, .plane = "reflection"}; }
Asked stereo() { return {.technique = "stereo-ssr", .settings = {}, .plane = "reflection"}; }

struct Named {
  std::string name;
  Asked asked;
};

// --- Errors

/// A reflection of each eye, and its truth.
struct Truth {
  Image image;
  double exposure = 0;
};

Plane without_confidence(const Plane& plane) {
  Plane out = plane.clone();
  out.channels.pop_back();
  return out;
}

/// A plane as a screen shows it, without sRGB.
Plane shown(const Plane& plane, double exposure) {
  Plane out = without_confidence(plane);
  for (Channel& channel : out.channels) {
    for (int y = 0; y < channel.layout().height; ++y) {
      for (int x = 0; x < channel.layout().width; ++x)
        channel.at(x, y) = std::min(channel.at(x, y) * float(exposure), 1.0f);
    }
  }
  return out;
}

Metrics metrics_of(const Stage& s, const Image& test, const Truth& truth, const std::string& view) {
  return compare(without_confidence(test.at(view)), without_confidence(truth.image.at(view)), s.surfaces.at(view),
                 truth.exposure);
}

Truth traced(Study& study, const Stage& s, const std::string& scene) {
  ReflectionReferenceOptions options{.samples = study.options().rays};
  options.progress = [&](double share) { study.tell(fmt::format("rays of {}", scene), share); };
  Reference reference = reflection_reference(*s.tracer, s.frame, options);
  const double exposure = reference.frame.numbers.at("gloamExposure");
  return {image_of(std::move(reference.frame), "reflection"), exposure};
}

/// Excess or lack of light for each eye: an error that is equal in both eyes is no inconsistency, and changes with the viewing
/// direction are in the truth too.
Image errors_of(const Image& test, const Truth& truth) {
  Image errors;
  for (const auto& [view, plane] : test) {
    Plane error = shown(plane, truth.exposure);
    const Plane expected = shown(truth.image.at(view), truth.exposure);
    for (size_t c = 0; c < error.channels.size(); ++c) {
      Channel& out = error.channels[c];
      for (int y = 0; y < out.layout().height; ++y) {
        for (int x = 0; x < out.layout().width; ++x) out.at(x, y) -= expected.channels[c].at(x, y);
      }
    }
    errors.emplace(view, std::move(error));
  }
  return errors;
}

/// Surfaces of a view for which either eye shows a share from `low` to below `high` of the reflected light.
Mask where_shown(const Stage& s, const Truth& truth, const std::string& view, double low, double high) {
  Mask mask = s.surfaces.at(view);
  const Channel& shown = truth.image.at(view).channels[3];
  for (int y = 0; y < s.frame.height(); ++y) {
    for (int x = 0; x < s.frame.width(); ++x) {
      const double share = double(shown.at(x, y));
      if (share < low || share >= high) mask[size_t(y) * size_t(s.frame.width()) + size_t(x)] = 0;
    }
  }
  return mask;
}

/// Difference between the errors of the two eyes.
struct Disagreement {
  double everywhere = 0;  ///< where both eyes see the surface
  double shown = 0;       ///< of these, where `well_shown` of the reflection is shown
};

Disagreement disagreement(const Stage& s, const Image& test, const Truth& truth) {
  const StereoInconsistency of_eyes = inconsistency(s, errors_of(test, truth));
  Disagreement result{in_hundred_thousandths(of_eyes.both), 0};
  double sum = 0, count = 0;
  for (size_t eye = 0; eye < 2; ++eye) {
    const Mask mask = where_shown(s, truth, s.frame.views[eye].name, well_shown, all_shown);
    const StereoErrors& errors = of_eyes.views[eye];
    for (size_t i = 0; i < mask.size(); ++i) {
      if (!mask[i] || errors.pixels[i] != StereoPixel::counted) continue;
      sum += double(errors.error.at(int(i % size_t(s.frame.width())), int(i / size_t(s.frame.width()))));
      ++count;
    }
  }
  if (count > 0) result.shown = 1e5 * sum / count;
  return result;
}

void state_errors(Study& study, const Stage& s, const Subject& subject, const Truth& truth) {
  const std::string table = "Table 2: ";
  const Image a = study.images(s, plain()), b = study.images(s, stereo());
  for (size_t eye = 0; eye < 2; ++eye) {
    const std::string& view = s.frame.views[eye].name;
    const std::string row = fmt::format("{}, {}", name_of(subject), view);
    const Metrics of_plain = metrics_of(s, a, truth, view), of_stereo = metrics_of(s, b, truth, view);
    const auto add = [&](const std::string& what, const std::string& unit, double one, double other) {
      study.fact(table + what, row, "sssr", one, unit);
      study.fact(table + what, row, "stereo-ssr", other, unit);
    };
    add("SSIM to the truth", "SSIM", of_plain.ssim, of_stereo.ssim);
    study.fact(table + "SSIM to the truth", row, "paper: SSSR", subject.paper.plain_ssim[eye], "SSIM");
    study.fact(table + "SSIM to the truth", row, "paper: ours", subject.paper.stereo_ssim[eye], "SSIM");
    add("FLIP to the truth", "FLIP", of_plain.flip.value(), of_stereo.flip.value());
    add("GMSD to the truth", "GMSD", of_plain.gmsd, of_stereo.gmsd);
    add("RMSE to the truth", "RMSE", of_plain.rmse, of_stereo.rmse);
    const Plane expected = shown(truth.image.at(view), truth.exposure);
    const auto error_shown = [&](const Image& image) {
      return compare(shown(image.at(view), truth.exposure), expected, s.surfaces.at(view)).rmse;
    };
    add("RMSE to the truth, of what a screen shows", "RMSE", error_shown(a), error_shown(b));
  }
}

/// Figure 10 and section 5.3: more samples do not replace the modules; the effect of each module.
void state_modules(Study& study, const Stage& s, const Subject& subject, const Truth& truth) {
  const std::vector<Named> all = {{"sssr", plain()},
                                  {"sssr, 2 rays (equal samples)", with(plain(), "rays", "2")},
                                  {"stereo-ssr", stereo()},
                                  {"without traversal", with(stereo(), "traversal", "mono")},
                                  {"without fade", with(stereo(), "fade", "mono")},
                                  {"without reprojection", with(stereo(), "reprojection", "off")}};
  const std::string figure = fmt::format("Figures 10 to 14: {}, ", name_of(subject));
  for (const Named& named : all) {
    const Image image = study.images(s, named.asked);
    for (const View& view : s.frame.views) {
      const Metrics m = metrics_of(s, image, truth, view.name);
      study.fact(figure + "SSIM", named.name, view.name, m.ssim, "SSIM");
      study.fact(figure + "RSE", named.name, view.name, m.rse.value(), "RSE");
    }
    const Disagreement eyes = disagreement(s, image, truth);
    const std::string apart = figure + "how far the errors of both eyes are apart";
    study.fact(apart, named.name, "where both see the surface", eyes.everywhere, inconsistency_unit);
    study.fact(apart, named.name, "where 90 % of the reflection is shown too", eyes.shown, inconsistency_unit);
  }
}

/// Section 5.4: rays that leave both images, or pass behind what both show.
void state_failures(Study& study, const Stage& s, const Subject& subject, const Truth& truth) {
  const std::string figure = "Section 5.4: what neither image shows";
  const Image image = study.images(s, stereo());
  for (const View& view : s.frame.views) {
    const std::string row = fmt::format("{}, {}", name_of(subject), view.name);
    const auto state = [&](const std::string& where, double low, double high) {
      const Mask mask = where_shown(s, truth, view.name, low, high);
      const double share = pixels_of(mask) / std::max(pixels_of(s.surfaces.at(view.name)), 1.0);
      study.fact(figure + ": pixels", row, where, share, "share");
      if (share == 0) return;
      const Metrics m = compare(without_confidence(image.at(view.name)), without_confidence(truth.image.at(view.name)),
                                mask, truth.exposure);
      study.fact(figure + ": RMSE", row, where, m.rmse, "RMSE");
      study.fact(figure + ": bias", row, where, m.bias, "bias");
    };
    state("over 90 % shown", well_shown, all_shown);
    state("between", hardly_shown, well_shown);
    state("below 10 % shown", 0, hardly_shown);
  }
}

void draw(Study& study, const Stage& s, const Subject& subject, const Truth& truth) {
  std::vector<Panel> panels;
  const auto add = [&](const std::string& what, const Image& image) {
    for (const View& view : s.frame.views)
      panels.push_back({fmt::format("{}, {}", what, view.name), shown(image.at(view.name), truth.exposure)});
  };
  add("sssr", study.images(s, plain()));
  add("stereo-ssr", study.images(s, stereo()));
  add(fmt::format("truth, {} rays", study.options().rays), truth.image);
  study.picture("Figures 1 and 9: what is reflected",
                fmt::format("{}, at the exposure of the truth.", name_of(subject)),
                fmt::format("figure_9_{}.png", subject.stand_in.scene), panels, 2);
}

// --- Times

void table_3(Study& study) {
  for (const Subject& subject : subjects) {
    study.tell(fmt::format("capturing {}", subject.stand_in.scene));
    const Stage s =
        study.timed_stage({.scene = subject.stand_in.scene, .eyes_apart = eyes_apart, .with_materials = true});
    const OfThePaper& p = subject.paper;
    const auto is_filter = passes_named({"resolve"});
    std::vector<Entry> entries;
    const auto add = [&](const std::string& what, double plain_ms, double stereo_ms,
                         const std::function<bool(const std::string&)>& counts) {
      entries.push_back({"sssr", what, plain(), &s, plain_ms, true, counts});
      entries.push_back({"stereo-ssr", what, stereo(), &s, stereo_ms, false, counts});
    };
    add("traversal", p.plain_traversal, p.stereo_traversal, std::not_fn(is_filter));
    add("spatial filter", p.plain_filter, p.stereo_filter, is_filter);
    add("total", p.plain_total, p.stereo_total, [](const std::string&) { return true; });
    measure(study, {.name = "Table 3: " + name_of(subject), .base = "sssr", .parts_name = {}}, entries);
    measure(study, {.name = "Equal samples and marching: time", .base = "sssr", .parts_name = {}},
            {{"sssr", name_of(subject), plain(), &s, {}, true},
             {"sssr, 2 rays", name_of(subject), with(plain(), "rays", "2"), &s},
             {"sssr, cells know the nearest depth alone", name_of(subject), with(plain(), "cells", "min"), &s},
             {"sssr, pixel by pixel", name_of(subject), with(plain(), "march", "linear"), &s}});
  }
}

PaperResult remake_wu(Device& device, const PaperOptions& options) {
  Study study(device, options);
  study.result.notes = {
      "Built-in scenes stand for the paper's. Two eyes 0.065 apart, one ray per pixel, 21 pixels share rays (radius 2 "
      "without "
      "corners).",
      fmt::format(
          "The truth has two bounces and {} rays per pixel. SSIM, FLIP and GMSD are taken at the exposure that it "
          "states, through sRGB.",
          options.rays),
      "FLIP and GMSD stand in for LPIPS and DISTS, which need the weights of networks that are not part of this "
      "project.",
      "The paper's user study cannot be repeated here. In its place: by how much the errors of the two eyes differ "
      "where "
      "both see the same surface.",
      "Traversal is everything up to what a ray sees; the spatial filter is `resolve`, with the other eye's rays."};
  table_3(study);
  for (const Subject& subject : subjects) {
    study.tell(fmt::format("table 2: {}", subject.stand_in.scene));
    const Stage s =
        study.small_stage({.scene = subject.stand_in.scene, .eyes_apart = eyes_apart, .with_materials = true}, divisor);
    const Truth truth = traced(study, s, subject.stand_in.scene);
    state_errors(study, s, subject, truth);
    state_modules(study, s, subject, truth);
    state_failures(study, s, subject, truth);
    draw(study, s, subject, truth);
  }
  return std::move(study.result);
}

}  // namespace

Paper wu2024() { return {"wu2024", "Stereo-consistent Screen Space Reflection (Wu, Xu, Wang 2024)", 1024, remake_wu}; }

}  // namespace gloam::bench
