// All measurements of one effect on one frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/measurement.h"
#include "measure/schedule.h"
#include "gloam/error.h"

namespace gloam::bench {

class Session {
 public:
  /// All must outlive it.
  Session(Subject& subject, const MeasureOptions& options, Device& device, Measurement& result);

  /// Every setting, with all that belongs to its row.
  void measure_all();
  /// As much as fits in the time: the front first (docs/benchmarking.md, A minute). What is left out is listed in the result.
  /// `is_first`: as for `measure`.
  void measure_within(const TimeLimit& limit, bool is_first);

  void measure_growth(const std::vector<const Technique*>& techniques);
  /// Captures a built-in scene with twice as many pixels each way, so that the frame itself is the middle one of three.
  void measure_scales();
  void measure_planes();
  void add_scene();

 private:
  /// A setting that is measured within a time.
  struct Candidate {
    Variation variation;
    std::optional<FirstLook> look;  ///< none: not looked at, or not possible
    std::unique_ptr<Row> row;       ///< once it is in the race
    bool is_near_front = false, has_similarity = false, has_ladder = false, failed = false;
  };

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

  // Within a time.
  std::vector<Candidate> candidates();
  void look_at_all(std::vector<Candidate>& all, const TimeLimit& limit);
  bool is_possible(Candidate& candidate, std::vector<Skipped>& failed);
  void look_at(Candidate& candidate, std::vector<Skipped>& failed);
  void race(const std::vector<Candidate*>& some, const Rounds& wanted, const TimeLimit& limit, const std::string& what);
  void race_the_rest(std::vector<Candidate>& all, const TimeLimit& limit);
  void add_parts(std::vector<Candidate>& all, const TimeLimit& limit, bool near_front);
  std::vector<Candidate*> raced(std::vector<Candidate>& all, bool near_front) const;
  void add_similarities(std::vector<Candidate>& all, const TimeLimit& limit, bool near_front);
  void add_similarity(Candidate& candidate);
  double ladder_seconds(const Candidate& candidate) const;
  void measure_once(const std::vector<Candidate>& all, const TimeLimit& limit, bool is_first);
  void list_left_out(const std::vector<Candidate>& all);
  void leave_out(const Variation& variation, const std::string& what);
  /// Null: of all techniques.
  void leave_out(const Technique* technique, const std::string& what);

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
