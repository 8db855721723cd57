// The radius of ambient occlusion: how commands choose and report it.
#pragma once

#include "cli/flags/options.h"
#include "gloam/radius.h"

namespace gloam::cli {

/// The radius that suits a frame, by its header (`aoRadius`, scene units); none if the header lacks it. A value that is not a valid
/// radius is noted and ignored.
std::optional<double> stated_radius(const FrameFile& file);
std::optional<double> stated_radius(const FrameFiles& files);

/// The radius that a command uses for a frame: a line for people, and a part of the document. Adds a note if the radius does not
/// suit the frame (`warning_about`).
class RadiusReport {
 public:
  RadiusReport(const Radius& radius, const Frame& frame, std::optional<double> cap);
  /// Adds "radius", "radius_from" and "radius_pixels"; null if no surface is visible, "inf" for an infinite radius.
  void add_to(Json& document) const;
  void print() const { fmt::print("{}\n", words_); }
  const std::string& words() const { return words_; }

 private:
  Radius radius_;
  std::optional<double> pixels_;
  std::string words_;
};

/// A report on the radius of a plan, if it has one.
std::optional<RadiusReport> report_on(const std::optional<Radius>& radius, const Frame& frame, const Plan& plan);

}  // namespace gloam::cli
