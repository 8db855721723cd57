// What is measured where the time is limited (docs/benchmarking.md, A minute).
#pragma once

#include "measure/session.h"

namespace gloam::bench {

class TimedSession : public Session {
 public:
  using Session::Session;

  /// As much as fits in the time: the front first (docs/benchmarking.md, A minute). What is left out is listed in the result.
  /// `is_first`: as for `measure`.
  void measure_within(const TimeLimit& limit, bool is_first);

 private:
  /// A setting that is measured within a time.
  struct Candidate {
    Variation variation;
    std::optional<FirstLook> look;  ///< none: not looked at, or not possible
    std::unique_ptr<Row> row;       ///< once it is in the race
    bool is_near_front = false, has_similarity = false, has_ladder = false, failed = false;
  };

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
};

}  // namespace gloam::bench
