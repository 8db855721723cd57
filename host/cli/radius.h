// How commands choose and tell the radius of ambient occlusion.
#pragma once

#include "cli/options.h"
#include "gloam/radius.h"

namespace gloam::cli {

/// What the header says about the radius that suits a frame (`aoRadius`, scene units); none where it says nothing. A value that
/// is none is noted and passed over.
std::optional<double> stated_radius(const FrameFile& file);
std::optional<double> stated_radius(const FrameFiles& files);

/// The radius that a command works with on a frame: its line for people, its part of the document. Notes what is wrong with
/// it on this frame (`warning_about`).
class RadiusReport {
 public:
  RadiusReport(const Radius& radius, const Frame& frame, std::optional<double> cap);
  /// Adds "radius", "radius_from" and "radius_pixels"; null where no surface is shown, "inf" for an infinite one.
  void add_to(Json& document) const;
  void print() const { fmt::print("{}\n", words_); }
  const std::string& words() const { return words_; }

 private:
  Radius radius_;
  std::optional<double> pixels_;
  std::string words_;
};

/// Gives the radius of a request that has none, and makes its plan anew. None where the plan has no radius.
std::optional<RadiusReport> settle_radius(PlanRequest& request, Plan& plan, const Frame& frame,
                                          std::optional<double> stated, const std::vector<std::string>& available,
                                          const std::string& holds);

}  // namespace gloam::cli
