// gloam.compare
#include "base/lists.h"
#include "compare/plane_pairs.h"
#include "gloam/metrics.h"
#include "python/frames.h"
#include "python/interrupts.h"
#include "python/planes.h"

namespace gloam::python {
namespace {

[[noreturn]] void refuse_plane(const std::string& which, const std::string& plane,
                               const std::vector<std::string>& planes) {
  throw Error("{}: no plane '{}'{}; it has {}", which, plane, suggestion(plane, planes), enumerate(planes));
}

PlanePair pair_named(const std::string& plane, const std::vector<std::string>& tests,
                     const std::vector<std::string>& truths) {
  if (!contains(tests, plane)) refuse_plane("test", plane, tests);
  if (contains(truths, plane)) return {plane, plane};
  for (const PlanePair& pair : result_pairs()) {
    if (pair.test == plane && contains(truths, pair.reference)) return pair;
  }
  refuse_plane("reference", plane, truths);
}

/// The planes to compare: the one asked for, else the first that both sides have, results first.
PlanePair pair_for(const HeldFrame& test, const HeldFrame& reference, const std::string& asked) {
  const std::vector<std::string> tests = common_planes(test.frame), truths = common_planes(reference.frame);
  if (!asked.empty()) return pair_named(asked, tests, truths);
  for (const PlanePair& pair : result_pairs()) {
    if (contains(tests, pair.test) && contains(truths, pair.reference)) return pair;
  }
  const std::vector<std::string> results = results_among(tests), others = results_among(truths);
  if (!results.empty() && !others.empty())
    throw Error(
        "the test has {} and the reference has {}, which cannot be compared; plane='...' compares another plane",
        enumerate(results), enumerate(others));
  for (const std::string& plane : inputs_among(tests)) {
    if (contains(truths, plane)) return {plane, plane};
  }
  throw Error("the test has {} and the reference has {}: there is no plane in common", enumerate(tests),
              enumerate(truths));
}

/// Views of the test with those of the reference: the only two, else those of one name.
std::vector<std::pair<const View*, const View*>> pair_views(const Frame& test, const Frame& reference) {
  if (test.views.size() == 1 && reference.views.size() == 1) return {{&test.views.front(), &reference.views.front()}};
  std::vector<std::pair<const View*, const View*>> pairs;
  for (const View& view : test.views) {
    for (const View& other : reference.views) {
      if (view.name == other.name) pairs.emplace_back(&view, &other);
    }
  }
  if (!pairs.empty()) return pairs;
  throw Error("the test has the views {} and the reference has {}; name them alike, or compare one view",
              enumerate(view_names(test)), enumerate(view_names(reference)));
}

const View* view_of(const Frame& frame, const std::string& name) {
  if (frame.views.size() == 1) return &frame.views.front();
  for (const View& view : frame.views) {
    if (view.name == name) return &view;
  }
  return nullptr;
}

/// The pixels with a surface, by the first frame that has a depth of the images' size.
std::optional<Mask> foreground(const std::vector<const HeldFrame*>& tellers, const std::string& view,
                               const Layout& layout) {
  for (const HeldFrame* held : tellers) {
    const View* const found = held ? view_of(held->frame, view) : nullptr;
    const Plane* const depth = found ? found->find("depth") : nullptr;
    if (!depth || depth->channels.front().layout() != layout) continue;
    Mask mask;
    mask.reserve(size_t(layout.width) * size_t(layout.height));
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) mask.push_back(!is_background(depth->channels.front().at(x, y)));
    }
    return mask;
  }
  return {};
}

/// A mask given as an array of bool or uint8.
Mask given_mask(const py::object& value, const Layout& layout) {
  if (!py::isinstance<py::array>(value)) throw Error("mask is no NumPy array; one of bool (height, width) is allowed");
  const py::array array = py::reinterpret_borrow<py::array>(value);
  if (array.dtype().itemsize() != 1 || array.ndim() != 2 || array.shape(0) != layout.height ||
      array.shape(1) != layout.width)
    throw Error("mask has the dtype {} and the shape {}; bool and ({}, {}) are allowed",
                py::cast<std::string>(py::str(array.dtype())), py::cast<std::string>(py::str(array.attr("shape"))),
                layout.height, layout.width);
  Mask mask;
  for (py::ssize_t y = 0; y < array.shape(0); ++y) {
    for (py::ssize_t x = 0; x < array.shape(1); ++x)
      mask.push_back(*static_cast<const unsigned char*>(array.data(y, x)) != 0);
  }
  return mask;
}

py::dict figures_of(const Metrics& m) {
  py::dict figures;
  figures["pixels"] = m.pixels;
  figures["mae"] = m.mae;
  figures["rmse"] = m.rmse;
  figures["bias"] = m.bias;
  figures["psnr"] = m.psnr;
  figures["max"] = m.max;
  figures["over_1_255"] = m.over_1_255;
  figures["over_0_05"] = m.over_0_05;
  figures["ssim"] = m.ssim;
  figures["gmsd"] = m.gmsd;
  if (m.flip) figures["flip"] = *m.flip;
  if (m.rse) figures["rse"] = *m.rse;
  return figures;
}

/// The exposure that is given; of a reflection's truth else what its header says.
double exposure_for(std::optional<double> given, const HeldFrame& reference, const std::string& plane) {
  if (given && !(*given >= 1e-30 && *given <= 1e30))
    throw UsageError("exposure {:g} is not allowed; a number from 1e-30 to 1e30 is", *given);
  if (given) return *given;
  const auto said = reference.frame.numbers.find("gloamExposure");
  return plane == "reflection" && said != reference.frame.numbers.end() ? said->second : 0;
}

/// `tellers`: frames that may tell the background, in the order in which they are asked.
py::dict compare_frames(const HeldFrame& test, const HeldFrame& reference, const std::string& plane,
                        const py::object& mask, const std::vector<const HeldFrame*>& tellers,
                        std::optional<double> exposure) {
  const PlanePair planes = pair_for(test, reference, plane);
  const auto views = pair_views(test.frame, reference.frame);
  const double shown_at = exposure_for(exposure, reference, planes.reference);
  const Layout layout = views.front().first->find(planes.test)->channels.front().layout();
  const std::optional<Mask> given = mask.is_none() ? std::nullopt : std::optional(given_mask(mask, layout));
  bool is_background_known = given.has_value();
  const std::vector<Metrics> metrics = without_lock([&](Interrupts& interrupts) {
    std::vector<Metrics> of_views;
    for (const auto& [left, right] : views) {
      interrupts.poll();
      const std::optional<Mask> known = given ? given : foreground(tellers, left->name, layout);
      is_background_known = is_background_known || known;
      const Mask counted = known ? *known : Mask(size_t(layout.width) * size_t(layout.height), 1);
      of_views.push_back(compare(without_confidence(left->find(planes.test)->clone()),
                                 without_confidence(right->find(planes.reference)->clone()), counted, shown_at));
    }
    return of_views;
  });
  py::dict figures = figures_of(pooled(metrics));
  figures["plane"] = planes.test;
  figures["truth_plane"] = planes.reference;
  if (shown_at > 0) figures["exposure"] = shown_at;
  if (views.size() > 1) {
    py::dict of_views;
    for (size_t i = 0; i < views.size(); ++i) of_views[py::str(views[i].first->name)] = figures_of(metrics[i]);
    figures["views"] = of_views;
  }
  figures["background_is_known"] = is_background_known;
  return figures;
}

}  // namespace

void add_compare(py::module_& module) { module.def("compare", &compare_frames); }

}  // namespace gloam::python
