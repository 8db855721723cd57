// The tools with which a hard case examines one technique, and its findings.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/technique.h"
#include "stress/outputs.h"

namespace gloam::stress {

/// How much is tried: as much as every build can afford, or everything.
enum class Extent { quick, full };

/// The technique to examine, and the means.
struct Subject {
  const Technique* technique = nullptr;
  Device* device = nullptr;
  std::vector<Device*> others = {};  ///< devices to compare with
  Extent extent = Extent::full;
  int frames = 0;                 ///< random frames; 0: as many as the extent has
  unsigned seed = 1;              ///< of random frames
  std::optional<int> trial = {};  ///< only this trial
  std::string folder = {};        ///< folder for frames and results; empty: not written
  /// Called at the start of each trial; for watchdogs and progress bars.
  std::function<void(int number, const std::string& conditions)> begins = {};
};

/// The worst value of one measured quantity.
struct Finding {
  std::string what;         ///< the quantity: "distance from open, exact normals"
  double worst = 0;         ///< NaN counts as worse than anything
  double bound = INFINITY;  ///< infinite: stated, not judged
  Place place;              ///< the worst pixel; no plane if no pixel is meant
  int trial = 0;            ///< trial in which it was found
  std::string conditions;   ///< of that trial: "tilt 35, lanes 16, fast"
  bool held() const { return worst <= bound; }
};

/// A number, and the pixel that it belongs to.
struct Measured {
  double value = 0;
  Place place = {};
  Measured(double value) : value(value) {}
  Measured(double value, Place place) : value(value), place(std::move(place)) {}
  Measured(const Difference& difference) : value(difference.max), place(difference.place) {}
};

/// A case consists of trials: a frame, settings and a way to run them, independent of one another, so that any one can be
/// repeated alone.
///
///   for (each ...) {
///     if (!probe.tries("tilt 35, lanes 16")) continue;
///     probe.measure("distance from open", ..., 1e-6);
///   }
class Probe {
 public:
  Probe(const Subject& subject, int number) : subject_(subject), number_(number) {}

  const Technique& technique() const { return *subject_.technique; }
  Device& device() const { return *subject_.device; }
  const std::vector<Device*>& others() const { return subject_.others; }
  Extent extent() const { return subject_.extent; }
  bool is_quick() const { return subject_.extent == Extent::quick; }
  unsigned seed() const { return subject_.seed; }
  /// Number of random frames to draw, by extent.
  int frames(int quick, int full) const { return subject_.frames > 0 ? subject_.frames : is_quick() ? quick : full; }

  /// Begins the next trial; returns false if only another one is wanted.
  bool tries(const std::string& conditions);
  /// Keeps the worst value of each quantity, by name; a quantity has one bound.
  void measure(const std::string& what, const Measured& measured, double bound);
  /// Measures values that their plane does not allow: 1 if there is one.
  void measure_violation(const std::string& what, const Frame& outputs);
  /// Measures the largest difference of images that should have the same bits.
  void measure_bits(const std::string& what, const Frame& outputs, const Frame& expected);
  /// Signals that a long trial is still running.
  void goes_on() const;
  /// Whether this quantity is beyond its bound.
  bool has_failed(const std::string& what) const;
  /// Notes why a part of the case does not apply to this technique: "makes no reflection".
  void passes_over(const std::string& reason);

  /// The technique's results for a frame, on the present device or on another.
  Frame outputs(Frame& frame, const Settings& settings, const RunOptions& options) const;
  Frame outputs(Frame& frame, const Settings& settings, const RunOptions& options, Device& device) const;
  /// The same, by a given plan.
  Frame outputs(const Plan& plan, const Frame& frame, const RunOptions& options) const;

  /// Each kind of mathematics with each number of lanes that the device is used with; two of these in a quick run, and if many
  /// settings or sizes are tried.
  std::vector<RunOptions> all_ways() const;
  std::vector<RunOptions> two_ways() const;
  /// `two_ways` for settings that no other case uses; in a quick run the first of the two alone, since each has to be compiled.
  std::vector<RunOptions> ways_of_rare_settings() const;
  /// The defaults; in a quick run the cheapest preset, for properties that hold for any number of samples.
  Settings usual_samples() const;

  /// The reason of a line "hard case 13, fast: reason" in the README.md of the technique's folder, or of a line for this
  /// technique, "hard case 13, fast (sd-gtao): reason". Empty if there is none.
  std::string opt_out(const std::string& part) const;

  const std::vector<Finding>& findings() const { return findings_; }
  /// Parts that the case asked for and the technique opts out of: "open: reason".
  const std::vector<std::string>& opted_out_parts() const { return opted_out_parts_; }
  const std::vector<std::string>& passed_over() const { return passed_over_; }
  int trials() const { return trial_; }
  /// Conditions of the latest trial.
  const std::string& conditions() const { return conditions_; }

 private:
  void keep(const Frame& frame, const Frame& outputs, const Plan& plan, const RunOptions& options) const;

  const Subject& subject_;
  int number_;  ///< number of the case
  int trial_ = 0;
  std::string conditions_;
  std::vector<Finding> findings_;
  std::vector<std::string> passed_over_;
  mutable std::vector<std::string> opted_out_parts_;
  mutable int kept_ = 0;
};

/// "lanes 16, fast"
std::string text_of(const RunOptions& options);
/// "exact normals", or "normals from depth" for frames without normals.
std::string normals_text(bool with_normals);
/// "perspective", "orthographic"
std::string text_of(const Camera& camera);

/// A value that is computed at its first use: trials share what they are compared with, and a trial that is repeated alone
/// computes only its own.
template <typename T>
class Lazy {
 public:
  explicit Lazy(std::function<T()> make) : make_(std::move(make)) {}
  const T& get() {
    if (!value_) value_.emplace(make_());
    return *value_;
  }

 private:
  std::function<T()> make_;
  std::optional<T> value_;
};

}  // namespace gloam::stress
