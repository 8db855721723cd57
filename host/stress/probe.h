// What a hard case has at hand while it looks at one technique, and what it says of it.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/technique.h"
#include "stress/outputs.h"

namespace gloam::stress {

/// How much is tried: what a build can afford each time, or all there is.
enum class Extent { quick, full };

/// What is looked at, and with what.
struct Subject {
  const Technique* technique = nullptr;
  Device* device = nullptr;
  std::vector<Device*> others = {};  ///< devices to compare with
  Extent extent = Extent::full;
  int frames = 0;                 ///< random frames; 0: as many as the extent has
  unsigned seed = 1;              ///< of random frames
  std::optional<int> trial = {};  ///< only this one
  std::string folder = {};        ///< where frames and what was made of them are written; empty: nowhere
  /// Called as each trial begins; for watchdogs and bars of progress.
  std::function<void(int number, const std::string& conditions)> begins = {};
};

/// The worst that a case has seen in one sense.
struct Finding {
  std::string what;         ///< what was measured: "distance from open, exact normals"
  double worst = 0;         ///< NaN counts as worse than anything
  double bound = INFINITY;  ///< infinite: stated, and not judged
  Place place;              ///< the worst pixel; no plane where it is none's
  int trial = 0;            ///< in which it was found
  std::string conditions;   ///< of that trial: "tilt 35, lanes 16, fast"
  bool held() const { return worst <= bound; }
};

/// A number with the pixel that it is of.
struct Measured {
  double value = 0;
  Place place = {};
  Measured(double value) : value(value) {}
  Measured(double value, Place place) : value(value), place(std::move(place)) {}
  Measured(const Difference& difference) : value(difference.max), place(difference.place) {}
};

/// A case goes through trials: a frame, settings and a way to run them, each by itself, so that any one can be made again alone.
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
  /// Random frames to draw where the extent has so many.
  int frames(int quick, int full) const { return subject_.frames > 0 ? subject_.frames : is_quick() ? quick : full; }

  /// The next trial begins; false where only another one is wanted.
  bool tries(const std::string& conditions);
  /// Keeps the worst of everything measured under the same name, which has one bound.
  void measure(const std::string& what, const Measured& measured, double bound);
  /// Values that their plane does not allow: 1 where there is one.
  void measure_violation(const std::string& what, const Frame& outputs);
  /// The largest difference of images that should have the same bits.
  void measure_bits(const std::string& what, const Frame& outputs, const Frame& expected);
  /// Tells that a trial that takes long goes on.
  void goes_on() const;
  /// Whether something measured under this name is beyond its bound.
  bool has_failed(const std::string& what) const;
  /// Why some of what the case asks is not asked of this technique: "makes no reflection".
  void passes_over(const std::string& reason);

  /// What the technique makes of the frame on the device at hand, or on another.
  Frame outputs(Frame& frame, const Settings& settings, const RunOptions& options) const;
  Frame outputs(Frame& frame, const Settings& settings, const RunOptions& options, Device& device) const;
  /// The same by a plan that is known.
  Frame outputs(const Plan& plan, const Frame& frame, const RunOptions& options) const;

  /// Each kind of mathematics on each number of lanes that the device is used with; two of these in a quick look, and where
  /// many settings or sizes are tried.
  std::vector<RunOptions> all_ways() const;
  std::vector<RunOptions> two_ways() const;
  /// The same for settings that no other case has, each of which is compiled anew: one of the two in a quick look.
  std::vector<RunOptions> ways_of_rare_settings() const;
  /// The defaults; in a quick look the cheapest preset, for properties that hold for any number of samples.
  Settings usual_samples() const;

  /// The reason of a line "hard case 13, fast: reason" in the README.md of the technique's folder, or of one that names the
  /// technique, "hard case 13, fast (sd-gtao): reason". Empty where there is none.
  std::string opt_out(const std::string& part) const;

  const std::vector<Finding>& findings() const { return findings_; }
  /// Parts that were asked for and that the technique opts out of: "open: reason".
  const std::vector<std::string>& opted_out_parts() const { return opted_out_parts_; }
  const std::vector<std::string>& passed_over() const { return passed_over_; }
  int trials() const { return trial_; }
  /// Of the trial that began last.
  const std::string& conditions() const { return conditions_; }

 private:
  void keep(const Frame& frame, const Frame& outputs, const Plan& plan, const RunOptions& options) const;

  const Subject& subject_;
  int number_;  ///< of the case
  int trial_ = 0;
  std::string conditions_;
  std::vector<Finding> findings_;
  std::vector<std::string> passed_over_;
  mutable std::vector<std::string> opted_out_parts_;
  mutable int kept_ = 0;
};

/// "lanes 16, fast"
std::string text_of(const RunOptions& options);
/// "exact normals", or "normals from depth" for frames that have none.
std::string normals_text(bool with_normals);
/// "perspective", "orthographic"
std::string text_of(const Camera& camera);

/// What is computed when it is first asked for: trials share what they are compared with, and one made alone needs only its own.
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
