// All measurements of one effect on one frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/error.h"
#include "measure/measurement.h"
#include "measure/schedule.h"

namespace gloam::bench {

class Session {
 public:
  /// All must outlive it.
  Session(Subject& subject, const MeasureOptions& options, Device& device, Measurement& result);

  /// Every setting, with all that belongs to its row.
  void measure_all();
  void measure_growth(const std::vector<const Technique*>& techniques);
  /// Captures a built-in scene with twice as many pixels each way, so that the frame itself is the middle one of three.
  void measure_scales();
  void measure_planes();
  void add_scene();

 protected:
  std::vector<const Technique*> those_measured() const;
  void tell(const std::string& what, int done, int of) const;
  void skip(const Technique& technique, const std::string& preset, const std::string& why);
  /// Skips a measurement other than the rows.
  void skip_part(const Technique& technique, const std::string& part, const Error& error);
  Skipped failure_of(const Variation& variation, const Error& error) const;
  /// Enters the variations of a technique that the frame and the device allow.
  void enter(const Technique& technique);
  /// One line for a technique if nothing of it can be measured, for one reason.
  void add_skipped(const std::vector<Skipped>& failed, bool is_all);
  std::unique_ptr<Row> empty_row(const Variation& variation) const;
  std::unique_ptr<Row> row_of(const Variation& variation);
  void add_ladder(Row& row, const Image& shipped);
  bool has_ladder(const Variation& variation) const;
  /// Draws the first view; returns the path below the folder, empty if there are to be no pictures.
  std::string picture(const std::string& name, const Image& image);
  std::string picture_of(const Variation& variation, const Image& image);

  Subject& subject_;
  const MeasureOptions& options_;
  Device& device_;
  Measurement& result_;
  std::vector<std::unique_ptr<Row>> rows_;
  std::vector<std::string> measured_, pictures_;
  std::vector<std::string> converged_;  ///< techniques whose converged errors are known
  std::optional<double> white_;         ///< what all pictures show as white
  Race race_;
  Steps steps_;
};

}  // namespace gloam::bench
