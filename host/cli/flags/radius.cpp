#include "cli/flags/radius.h"

#include <cmath>

#include "gloam/error.h"
#include "sequence/plan_files.h"

namespace gloam::cli {
namespace {

Json number_or_inf(double value) { return std::isfinite(value) ? Json(value) : Json("inf"); }

}  // namespace

std::optional<double> stated_radius(const FrameFile& file) {
  std::vector<std::string> notes;
  const std::optional<double> stated = gloam::stated_radius(file, notes);
  note(notes);
  return stated;
}

std::optional<double> stated_radius(const FrameFiles& files) { return stated_radius(files.files().front()); }

RadiusReport::RadiusReport(const Radius& radius, const Frame& frame, std::optional<double> cap)
    : radius_(radius), words_(in_words(radius, frame)) {
  if (const std::optional<double> per_unit = pixels_at_median_depth(frame)) pixels_ = radius.value * *per_unit;
  if (const std::string warning = warning_about(radius, frame, cap); !warning.empty()) note({warning});
}

void RadiusReport::add_to(Json& document) const {
  document["radius"] = number_or_inf(radius_.value);
  document["radius_from"] = name_of(radius_.from);
  document["radius_pixels"] = pixels_ ? number_or_inf(*pixels_) : Json();
}

std::optional<RadiusReport> report_on(const std::optional<Radius>& radius, const Frame& frame, const Plan& plan) {
  return radius ? std::optional(RadiusReport(*radius, frame, cap_of(plan))) : std::nullopt;
}

}  // namespace gloam::cli
