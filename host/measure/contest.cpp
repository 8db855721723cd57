#include "measure/contest.h"

#include <algorithm>
#include <limits>
#include <set>

#include "gloam/error.h"
#include "measure/effects.h"
#include "measure/schedule.h"
#include "measure/timing.h"

namespace gloam::bench {
namespace {

/// Number of settings timed in turn at the end.
constexpr size_t most_finalists = 12;
/// A setting may be within the bound after all if its time is over it by no more than this factor.
constexpr double doubt = 1.5;
/// Shares of the time, at most: for trying and timing again, and of what is left then for the finalists' rounds.
constexpr double share_of_trying = 0.7, share_of_rounds = 0.7;
/// How much longer than the longest so far the next one may take.
constexpr double margin = 1.25;

/// What a reading takes beside the device's time, seconds, before one has told.
constexpr double unknown_seconds = 0.02;

/// "medium", "medium, half": what is left out of a technique.
std::string name_and_resolution(const Variation& v) { return v.name() + (v.variant.empty() ? "" : ", " + v.variant); }

/// Place of the preset among those of the technique, which are sorted by their time.
size_t rank(const Variation& v) {
  const std::vector<Preset>& presets = source_of(*v.technique).presets;
  for (size_t i = 0; i < presets.size(); ++i) {
    if (presets[i].name == v.preset) return i;
  }
  return 0;
}

class Contest {
 public:
  Contest(const std::vector<Variation>& all, const PickOptions& options, const Trials& trials)
      : all_(all), options_(options), trials_(trials), trying_(options.limit.part(share_of_trying)) {}

  ContestResult run() {
    try_all();
    result_.tried = entries_.size();
    if (entries_.empty()) return std::move(result_);
    keep_finalists();
    time_finalists();
    choose();
    return std::move(result_);
  }

 private:
  void tell(const std::string& what, size_t done, size_t of) const {
    if (options_.progress) options_.progress(what, double(done) / double(std::max<size_t>(of, 1)));
  }

  void try_all() {
    const std::vector<size_t> first = first_looks(all_, "low");
    try_these(first);
    std::vector<FirstLook> looks;
    for (const Contestant& entry : entries_) looks.push_back({entry.choice.ms, figures(entry).error});
    const std::vector<double> distances = distances_to_front(looks);
    try_these(later_looks(all_, first, [&](const Variation& v) {
      for (size_t i = 0; i < distances.size(); ++i) {
        if (entries_[i].choice.variation.technique == v.technique) return distances[i];
      }
      return 1e3;
    }));
    do {
      time_doubtful();
    } while (reconsider());
    list_left_out();
  }

  /// What looks hopeless is set aside, until what speaks against it has been timed often enough.
  void try_these(const std::vector<size_t>& order) {
    for (const size_t i : order) {
      tell("trying " + option_of(all_[i]).label(), entries_.size() + set_aside_.size(), all_.size());
      if (!blockers_of(all_[i]).empty()) {
        set_aside_.push_back(i);
        continue;
      }
      // One is tried whatever the time, so that there is something to say.
      if (!entries_.empty() && !trying_.allows(margin * longest_try_)) {
        leave_out(all_[i], time_was_over);
        continue;
      }
      const double before = trying_.left();
      std::optional<Choice> choice = trials_.attempt(i);
      if (trying_.is_set()) longest_try_ = std::max(longest_try_, before - trying_.left());
      if (choice) entries_.push_back({i, *choice, {choice->ms}, unknown_seconds + 4e-3 * choice->ms});
    }
  }

  /// Lower presets of the technique, at the same resolution, that are too slow by their readings so far.
  std::vector<const Contestant*> blockers_of(const Variation& v) const {
    std::vector<const Contestant*> found;
    if (!options_.limit.is_set()) return found;
    const double most = most_ms();
    for (const Contestant& entry : entries_) {
      const Variation& tried = entry.choice.variation;
      const bool is_lower = tried.technique == v.technique && tried.resolution == v.resolution && rank(tried) < rank(v);
      if (is_lower && entry.choice.ms > most) found.push_back(&entry);
    }
    return found;
  }

  /// A setting that takes longer cannot win.
  double most_ms() const {
    if (options_.goal.ms) return *options_.goal.ms * doubt;
    double most = std::numeric_limits<double>::infinity();
    for (const Contestant& entry : entries_)
      if (is_in(entry)) most = std::min(most, entry.choice.ms * doubt);
    return most;
  }

  /// Whether a shorter time could make it win.
  bool could_win(const Contestant& entry) const {
    if (options_.goal.error) return is_in(entry);
    if (is_in(entry)) return false;  // it is a contender as it is
    return std::none_of(entries_.begin(), entries_.end(), [&](const Contestant& other) {
      return is_in(other) && figures(other).error <= figures(entry).error;
    });
  }

  std::vector<Contestant*> doubtful() {
    std::set<const Contestant*> blockers;
    for (const size_t i : set_aside_)
      for (const Contestant* blocker : blockers_of(all_[i])) blockers.insert(blocker);
    std::vector<Contestant*> found;
    for (Contestant& entry : entries_) {
      if (entry.readings.size() < enough_readings && (could_win(entry) || blockers.count(&entry) > 0))
        found.push_back(&entry);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Contestant* a, const Contestant* b) { return a->choice.ms < b->choice.ms; });
    return found;
  }

  /// Rounds of one reading each, the fastest first.
  void time_doubtful() {
    for (size_t round = 1; round < enough_readings; ++round) {
      const std::vector<Contestant*> some = doubtful();
      for (size_t i = 0; i < some.size(); ++i) {
        tell("timing again", i, some.size());
        if (trying_.allows(margin * some[i]->seconds)) read(*some[i]);
      }
    }
  }

  void read(Contestant& entry) {
    const double before = options_.limit.left();
    entry.readings.push_back(trials_.time(entry.index));
    if (options_.limit.is_set()) entry.seconds = before - options_.limit.left();
    entry.choice.ms = *std::min_element(entry.readings.begin(), entry.readings.end());
  }

  /// Tries what was set aside and is not hopeless any more; whether there was any.
  bool reconsider() {
    std::vector<size_t> back, aside;
    for (const size_t i : set_aside_) (blockers_of(all_[i]).empty() ? back : aside).push_back(i);
    set_aside_ = std::move(aside);
    const size_t before = entries_.size();
    try_these(back);
    return entries_.size() > before;
  }

  void list_left_out() {
    for (const size_t i : set_aside_) {
      const std::vector<const Contestant*> blockers = blockers_of(all_[i]);
      const auto sure = std::find_if(blockers.begin(), blockers.end(), [](const Contestant* blocker) {
        return blocker->readings.size() >= enough_readings;
      });
      leave_out(all_[i], sure == blockers.end()
                             ? time_was_over
                             : fmt::format("{} takes {:.2g} ms already", option_of((*sure)->choice.variation).label(),
                                           (*sure)->choice.ms));
    }
    for (const Contestant& entry : entries_) {
      if (!is_in(entry) && could_win(entry) && entry.readings.size() < enough_readings)
        leave_out(entry.choice.variation, time_was_over);
    }
  }

  void leave_out(const Variation& v, const std::string& why) {
    result_.left_out.push_back({v.technique->name, name_and_resolution(v), "", why});
  }

  void keep_finalists() {
    std::vector<Choice> choices;
    for (const Contestant& entry : entries_) choices.push_back(entry.choice);
    const std::vector<size_t> finalists = finalists_of(choices, options_);
    const std::set<size_t> are_kept(finalists.begin(), finalists.end());
    std::vector<Contestant> kept;
    for (const size_t i : finalists) kept.push_back(entries_[i]);
    for (size_t i = 0; i < entries_.size(); ++i)
      if (are_kept.count(i) == 0) result_.others.push_back(entries_[i]);
    entries_ = std::move(kept);
  }

  void time_finalists() {
    const TimeLimit timing = options_.limit.part(share_of_rounds);
    const auto seconds_of_round = [&] {
      double sum = 0;
      for (const Contestant& entry : entries_) sum += margin * entry.seconds;
      return sum;
    };
    // The first are the most likely ones.
    while (entries_.size() > 2 && !timing.allows(double(enough_readings) * seconds_of_round())) {
      result_.others.push_back(entries_.back());
      entries_.pop_back();
    }
    std::vector<Contender> contenders;
    for (Contestant& entry : entries_) {
      contenders.push_back({option_of(entry.choice.variation).label(), [this, &entry] {
                              read(entry);
                              return entry.readings.back();
                            }});
    }
    const Rounds rounds{.fewest = options_.rounds, .most = options_.rounds, .is_over = [&] {
                          return !timing.allows(seconds_of_round());
                        }};
    const std::vector<Series> times =
        interleaved(contenders, rounds, {}, [&](int done, int of) { tell("timing", size_t(done), size_t(of)); });
    for (size_t i = 0; i < entries_.size(); ++i) {
      // Fewer rounds than that tell too little by themselves.
      const bool is_enough = times[i].size() >= enough_readings || options_.rounds < int(enough_readings);
      entries_[i].choice.ms = median(is_enough ? times[i] : entries_[i].readings);
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const Contestant& a, const Contestant& b) { return a.choice.ms < b.choice.ms; });
    result_.finalists = std::move(entries_);
  }

  void choose() {
    std::vector<Figures> all;
    for (const Contestant& entry : result_.finalists) all.push_back(figures(entry));
    result_.best = best_within(all, options_.goal);
  }

  Figures figures(const Contestant& entry) const { return figures_of(entry.choice, options_.by); }
  bool is_in(const Contestant& entry) const { return is_within(figures(entry), options_.goal); }

  const std::vector<Variation>& all_;
  const PickOptions& options_;
  const Trials& trials_;
  const TimeLimit trying_;
  std::vector<Contestant> entries_;
  std::vector<size_t> set_aside_;
  double longest_try_ = 0;  ///< seconds
  ContestResult result_;
};

}  // namespace

const Choices<PickBy> pick_figures = {
    {"rmse", PickBy::rmse}, {"ssim", PickBy::ssim}, {"flip", PickBy::flip}, {"flicker", PickBy::flicker}};

const char* name_of(PickBy by) {
  if (by == PickBy::flicker) return "flicker";
  return by == PickBy::ssim ? "SSIM" : by == PickBy::flip ? "FLIP" : "RMSE";
}

const char* name_of_error(PickBy by) { return by == PickBy::ssim ? "1 - SSIM" : name_of(by); }

Figures figures_of(const Choice& choice, PickBy by) {
  if (by == PickBy::ssim) return {choice.ms, 1 - choice.ssim.value_or(0)};
  return {choice.ms, by == PickBy::flip ? choice.flip.value_or(1) : choice.rmse};
}

std::vector<size_t> finalists_of(const std::vector<Choice>& tries, const PickOptions& options) {
  std::vector<Figures> all;
  for (const Choice& tried : tries) all.push_back(figures_of(tried, options.by));
  const auto better_first = [&](size_t a, size_t b) { return is_better(all[a], all[b], options.goal); };
  std::vector<size_t> within, doubtful;
  for (size_t i = 0; i < all.size(); ++i) {
    if (is_within(all[i], options.goal))
      within.push_back(i);
    else if (options.goal.ms && all[i].ms <= *options.goal.ms * doubt)
      doubtful.push_back(i);
  }
  std::sort(within.begin(), within.end(), better_first);
  const auto rest = within.begin() + std::min(within.size(), most_finalists / 2);
  doubtful.insert(doubtful.end(), rest, within.end());
  within.erase(rest, within.end());
  std::sort(doubtful.begin(), doubtful.end(), better_first);
  // At least one, to tell how far the bound is missed.
  const size_t nearest = nearest_miss(all, options.goal);
  std::vector<size_t> finalists = {nearest};
  for (const std::vector<size_t>* some : {&within, &doubtful}) {
    for (const size_t i : *some) {
      if (i != nearest && finalists.size() < most_finalists) finalists.push_back(i);
    }
  }
  return finalists;
}

ContestResult hold_contest(const std::vector<Variation>& all, const PickOptions& options, const Trials& trials) {
  return Contest(all, options, trials).run();
}

}  // namespace gloam::bench
