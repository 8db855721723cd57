#include "measure/timed_session.h"

#include <algorithm>
#include <map>

#include "base/elapsed.h"
#include "base/lists.h"
#include "base/statistics.h"
#include "gloam/run.h"
#include "measure/naive.h"

namespace gloam::bench {
namespace {

constexpr int fewest_timed_rounds = 6, most_timed_rounds = 30;
constexpr int rounds_of_others = 3;     // enough to place a setting, too few for an interval
constexpr double narrow = 0.02;         ///< half the width of a ratio's interval, relative to it
constexpr double share_of_looks = 0.5;  ///< of the time, at most, for one run of each setting
constexpr double share_of_front = 0.6;  ///< of what is left then, at most, for rounds of settings near the front
constexpr double share_of_rest = 0.7;   ///< of what is left then, at most, for rounds of all others
constexpr size_t batch = 4;             ///< settings that share one run of the baselines
constexpr int floor_rounds = 5;
constexpr double quick_ms = 60;  ///< runs that are shorter are repeated, since the first run finds cold caches

double megapixels(const Frame& frame) { return 1e-6 * frame.width() * frame.height() * double(frame.views.size()); }

}  // namespace

std::vector<TimedSession::Candidate> TimedSession::candidates() {
  std::vector<Candidate> all;
  for (const Technique* technique : options_.techniques) {
    const std::vector<Variation> variations = variations_of(*technique, subject_.radius.value, options_);
    if (variations.empty()) skip(*technique, "", "has none of these presets");
    for (const Variation& each : variations) {
      all.emplace_back();
      all.back().variation = each;
    }
  }
  return all;
}

bool TimedSession::is_possible(Candidate& candidate, std::vector<Skipped>& failed) try {
  whole_plan(candidate.variation, planes_of(subject_.frame), subject_.holds);
  return true;
} catch (const Error& error) {
  candidate.failed = true;
  failed.push_back(failure_of(candidate.variation, error));
  return false;
}

void TimedSession::look_at(Candidate& candidate, std::vector<Skipped>& failed) try {
  const Variation& v = candidate.variation;
  const Plan plan = whole_plan(v, planes_of(subject_.frame), subject_.holds);
  RunOptions options = v.run_options();
  options.repeat = 1;
  RunResult result = gloam::run(plan, subject_.frame, device_, options);
  double ms = result.total_ms.back();
  if (ms < quick_ms) {
    options.repeat = 2;
    result = gloam::run(plan, subject_.frame, device_, options);
    ms = *std::min_element(result.total_ms.begin(), result.total_ms.end());
  }
  const Image image =
      v.storage == Storage::float16 ? steps_.shipped(v) : image_of(std::move(result.frame), subject_.effect);
  candidate.look = {ms, steps_.errors(image).rmse};
} catch (const Error& error) {
  candidate.failed = true;
  failed.push_back(failure_of(candidate.variation, error));
}

void TimedSession::look_at_all(std::vector<Candidate>& all, const TimeLimit& limit) {
  std::vector<Variation> variations;
  for (const Candidate& c : all) variations.push_back(c.variation);
  std::map<std::string, std::vector<Skipped>> failed;
  const std::vector<size_t> first = first_looks(variations, "medium");
  Expected look(0.1);
  size_t done = 0;
  const auto look_at_those = [&](const std::vector<size_t>& order) {
    for (const size_t i : order) {
      const std::string& name = variations[i].technique->name;
      tell(fmt::format("one run of each setting ({})", name), int(done++), int(all.size()));
      if (!is_possible(all[i], failed[name])) continue;  // known without a run
      if (!look.done_within(limit, [&] { look_at(all[i], failed[name]); })) return;
    }
  };
  look_at_those(first);
  std::vector<FirstLook> looks;
  std::vector<size_t> looked_at;
  for (const size_t i : first) {
    if (!all[i].look) continue;
    looks.push_back(*all[i].look);
    looked_at.push_back(i);
  }
  const std::vector<double> distances = distances_to_front(looks);
  look_at_those(later_looks(variations, first, [&](const Variation& v) {
    for (size_t k = 0; k < looked_at.size(); ++k) {
      if (variations[looked_at[k]].technique == v.technique) return distances[k];
    }
    return 1e3;  // its first setting was not possible
  }));
  for (const Technique* technique : options_.techniques) {
    const auto is_of_it = [&](const Candidate& c) { return c.variation.technique == technique; };
    add_skipped(failed[technique->name],
                size_t(std::count_if(all.begin(), all.end(), is_of_it)) == failed[technique->name].size());
  }
}

void TimedSession::race(const std::vector<Candidate*>& some, const Rounds& wanted, const TimeLimit& limit,
                        const std::string& what) {
  std::vector<Candidate*> entered;
  for (Candidate* c : some) {
    if (limit.is_over()) break;
    try {
      auto row = empty_row(c->variation);
      const Image shipped = steps_.shipped(c->variation);
      row->errors = steps_.errors(shipped);
      row->image = picture_of(c->variation, shipped);
      race_.enter(*row, false);
      c->row = std::move(row);
      entered.push_back(c);
      add_new(measured_, c->variation.technique->name);
    } catch (const Error& error) {
      c->failed = true;
      result_.skipped.push_back(failure_of(c->variation, error));
    }
  }
  if (entered.empty()) return;
  Rounds rounds = wanted;
  if (options_.fixed_rounds) rounds = {.fewest = options_.rounds, .most = options_.rounds};
  rounds.is_over = [&] { return limit.is_over(); };
  race_.run(
      rounds, [&](int done, int of) { tell(what, done, of); }, false);
}

void TimedSession::race_the_rest(std::vector<Candidate>& all, const TimeLimit& limit) {
  std::vector<FirstLook> looks;
  std::vector<Candidate*> rest;
  for (Candidate& c : all) {
    if (!c.look || c.row || c.failed) continue;
    rest.push_back(&c);
    looks.push_back(*c.look);
  }
  // Among all that were looked at, not among the rest alone.
  const size_t count = looks.size();
  for (const Candidate& c : all) {
    if (c.look && c.row) looks.push_back(*c.look);
  }
  const std::vector<double> distances = distances_to_front(looks);
  std::vector<size_t> order(count);
  for (size_t i = 0; i < count; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return distances[a] < distances[b]; });
  const double baselines_ms = 3 * (looks.empty() ? 0 : median([&] {
                                std::vector<double> ms;
                                for (const FirstLook& look : looks) ms.push_back(look.ms);
                                return ms;
                              }()));
  const int rounds = options_.fixed_rounds ? options_.rounds : rounds_of_others;
  for (size_t first = 0; first < count; first += batch) {
    std::vector<Candidate*> some;
    double ms = baselines_ms;
    for (size_t i = first; i < std::min(first + batch, count); ++i) {
      some.push_back(rest[order[i]]);
      ms += 2 * rest[order[i]]->look->ms;  // short ones run twice
    }
    if (!limit.allows(1e-3 * ms * (rounds + 2))) return;
    race(some, {.fewest = rounds_of_others, .most = rounds_of_others}, limit,
         fmt::format("rounds of {} more settings", count - first));
  }
}

void TimedSession::add_similarity(Candidate& candidate) {
  const Image shipped = steps_.shipped(candidate.variation);
  candidate.row->similarity = steps_.similarity(shipped);
  candidate.row->inconsistency = inconsistency(subject_.frame, shipped);
}

/// By the number of samples of the converged settings, and of double, which takes about eight times as long.
double TimedSession::ladder_seconds(const Candidate& candidate) const {
  const Technique& technique = *candidate.variation.technique;
  const Technique& source = source_of(technique);
  const double ms = candidate.look ? candidate.look->ms : 100;
  if (!source.samples) return 1e-3 * 50 * ms;
  double factor = 100;
  try {
    const auto samples = [&](const Settings& settings) {
      const Plan plan = unfiltered_plan(candidate.variation, planes_of(subject_.frame), subject_.holds, settings);
      const ParameterValues* values = values_of(plan, source.name);
      return values ? double(source.samples(*values)) : 1.0;
    };
    factor = samples(converged_settings(technique)) / std::max(1.0, samples({}));
  } catch (const Error&) {
    // The ladder itself will say why.
  }
  const double layers = over_all_layers(technique) ? 2.5 : 1;  // T1 over peeled layers
  return 1e-3 * ms * (layers * factor + 20) + 2;
}

std::vector<TimedSession::Candidate*> TimedSession::raced(std::vector<Candidate>& all, bool near_front) const {
  std::vector<Candidate*> some;
  for (Candidate& c : all) {
    if (c.row && c.is_near_front == near_front) some.push_back(&c);
  }
  return some;
}

void TimedSession::add_similarities(std::vector<Candidate>& all, const TimeLimit& limit, bool near_front) {
  if (!subject_.truth) return;
  const std::vector<Candidate*> some = raced(all, near_front);
  Expected similarity(2 * megapixels(subject_.frame));
  for (size_t i = 0; i < some.size(); ++i) {
    tell("SSIM and FLIP", int(i), int(some.size()));
    Candidate& c = *some[i];
    c.has_similarity = similarity.done_within(limit, [&] { add_similarity(c); });
  }
}

/// Own floors near the front, and ladders.
void TimedSession::add_parts(std::vector<Candidate>& all, const TimeLimit& limit, bool near_front) {
  const std::vector<Candidate*> some = raced(all, near_front);
  for (size_t i = 0; i < some.size() && near_front; ++i) {
    tell("gathers alone", int(i), int(some.size()));
    Candidate& c = *some[i];
    Expected floor(2 + 1e-3 * 2 * (floor_rounds + 2) * c.look->ms);
    floor.done_within(limit, [&] { race_.add_floor(*c.row, floor_rounds); });
  }
  for (size_t i = 0; i < some.size(); ++i) {
    Candidate& c = *some[i];
    if (!has_ladder(c.variation) || !limit.allows(ladder_seconds(c))) continue;
    tell("where the error of " + c.variation.technique->name + " comes from", int(i), int(some.size()));
    add_ladder(*c.row, steps_.shipped(c.variation));
    c.has_ladder = true;
  }
}

void TimedSession::measure_once(const std::vector<Candidate>& all, const TimeLimit& limit, bool is_first) {
  double ms = 0;
  std::map<const Technique*, double> ms_of;  // with a middle preset
  for (const Technique* technique : those_measured()) {
    double of_it = 0;
    for (const Candidate& c : all) {
      if (c.variation.technique == technique && c.look && (of_it == 0 || c.variation.preset == "medium"))
        of_it = c.look->ms;
    }
    ms += of_it;
    ms_of[technique] = of_it;
  }
  const double compiling = 0.5 * double(those_measured().size());
  if (options_.checks && limit.allows(1e-3 * 20 * ms + compiling))
    measure_scales();
  else if (options_.checks)
    leave_out(nullptr, "other resolutions");
  if (options_.checks && is_first) {
    if (limit.allows(1e-3 * 90 * ms + compiling))
      measure_planes();
    else
      leave_out(nullptr, "bare planes");
  }
  for (const Technique* technique : options_.growth) {
    if (!is_first || !ms_of.count(technique)) continue;
    if (limit.allows(1e-3 * 100 * ms_of[technique] + 4))
      measure_growth({technique});
    else
      leave_out(technique, "growth");
  }
}

void TimedSession::leave_out(const Technique* technique, const std::string& what) {
  result_.left_out.push_back({technique ? technique->name : "", "", "", subject_.name, subject_.effect, what});
}

void TimedSession::leave_out(const Variation& v, const std::string& what) {
  result_.left_out.push_back({v.technique->name, v.name(), v.variant, subject_.name, subject_.effect, what});
}

void TimedSession::list_left_out(const std::vector<Candidate>& all) {
  for (const Candidate& c : all) {
    if (c.failed) continue;
    if (!c.look) {
      leave_out(c.variation, "everything");
    } else if (!c.row) {
      leave_out(c.variation, "rounds");
    } else {
      if (subject_.truth && !c.has_similarity) leave_out(c.variation, "SSIM and FLIP");
      if (!c.row->gathers) leave_out(c.variation, "own floor");
      if (has_ladder(c.variation) && !c.has_ladder) leave_out(c.variation, "ladder");
    }
  }
  for (const NaiveKernel& kernel : naive_kernels()) {
    if (contains(measured_, kernel.technique)) leave_out(&find_technique(kernel.technique), "naive kernels");
  }
}

void TimedSession::measure_within(const TimeLimit& limit, bool is_first) {
  std::vector<Candidate> all = candidates();
  look_at_all(all, limit.part(share_of_looks));
  std::vector<FirstLook> looks;
  std::vector<Candidate*> looked_at, front;
  for (Candidate& c : all) {
    if (!c.look) continue;
    looks.push_back(*c.look);
    looked_at.push_back(&c);
  }
  const std::vector<double> distances = distances_to_front(looks);
  for (size_t i = 0; i < looks.size(); ++i) {
    looked_at[i]->is_near_front = looks[i].error && distances[i] * near_front_share <= 1;
    if (looked_at[i]->is_near_front) front.push_back(looked_at[i]);
  }
  race(front, {.fewest = fewest_timed_rounds, .most = most_timed_rounds, .narrow = narrow}, limit.part(share_of_front),
       fmt::format("rounds of {} settings near the front", front.size()));
  add_similarities(all, limit, true);
  race_the_rest(all, limit.part(share_of_rest));
  add_parts(all, limit, true);
  add_similarities(all, limit, false);
  add_parts(all, limit, false);
  measure_once(all, limit, is_first);
  list_left_out(all);
  for (Candidate& c : all) {
    if (c.row) result_.rows.push_back(std::move(c.row));
  }
  const std::vector<std::string>& notes = race_.notes();
  result_.notes.insert(result_.notes.end(), notes.begin(), notes.end());
}

}  // namespace gloam::bench
