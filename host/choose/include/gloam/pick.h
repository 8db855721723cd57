// gloam pick as a library call: the setting to use on a frame, by measurement on the device at hand.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "gloam/exr.h"
#include "gloam/goal.h"
#include "gloam/radius.h"

namespace gloam {

struct PickRequest {
  Goal goal;                ///< time on the device, the filter included, or a bound on the figure that decides
  std::string by = "rmse";  ///< the figure: "rmse" to the truth, "ssim" (1 - SSIM) or "flip"
  std::vector<std::string> techniques;  ///< these only; empty: all that make the truth's effect
  /// Files, one for all views or one each; none: traced where the frame shows a built-in scene, else a converged estimate stands in.
  std::vector<std::string> truths;
  std::optional<double> radius;  ///< scene units; none: the truth's, else the scene's own, else made from the frame
  int rays = 256;                ///< per pixel, for a truth that is traced
  int rounds = 9;                ///< each times every finalist once, in turn
  std::optional<double> seconds = 60;  ///< for everything but tracing; none: every setting is tried
  ReadOptions reading;                 ///< of the frame
  std::function<void(const std::string& what, double share_done)> progress;  ///< may be empty
};

struct PickedSetting {
  std::string technique, preset, resolution;  ///< "gtao", "medium", "half"; "default" without presets
  double ms = 0;                              ///< median of the rounds, the filter included
  double rmse = 0;                            ///< to the truth
  std::optional<double> ssim, flip;           ///< where they were measured
};

struct PickResult {
  std::vector<PickedSetting> finalists;  ///< sorted by time
  size_t best = 0;                       ///< of the finalists
  std::string why;                       ///< why it is the best, in a sentence
  std::string not_tried;                 ///< what was not tried, and why, in a sentence; empty: nothing
  std::string error_to;                  ///< what errors are to: "the truth", or its stand-in
  bool has_truth = true;                 ///< it is no stand-in
  Radius radius;                         ///< of all settings
  std::vector<std::string> notes;        ///< a sentence each
  std::string json;  ///< as `gloam pick --json` writes it, without "command", "memory_bytes" and the radius in pixels
};

/// Measures presets of the techniques at full and half resolution on a frame of one file, and picks one. Throws UsageError for a request that
/// makes no sense, Error that names the nearest miss if nothing is within the bound, and what reading and running throw.
PickResult pick_setting(const std::string& frame, const PickRequest& request, Device& device);

}  // namespace gloam
