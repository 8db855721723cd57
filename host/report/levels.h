// What two runs say of a row's time, and how sure that is (docs/benchmarking.md, Two runs compared).
#pragma once

#include <set>
#include <string>
#include <vector>

namespace gloam::report {

/// The level of a row in one run: the mean over processes of the median over rounds of the logarithm of its ratio.
struct Level {
  double mean = 0;
  double by_rounds = 0;  ///< variance of one process's median, by the spread of its rounds; the mean over processes
  double squares = 0;    ///< sum over processes of the squared distance from the mean
  int processes = 0;     ///< 0: there is no level
};

/// A process with fewer rounds has no level.
constexpr size_t fewest_rounds_of_level = 5;

/// `processes`: rounds in each, one after another; empty: all in one.
Level level_of(const std::vector<double>& ratios, const std::vector<double>& processes);

/// A row's change from one run to another, as the difference of logarithms.
struct Change {
  std::string group;   ///< rows that were measured beside one another: a scene
  std::string member;  ///< rows that a change of one kernel changes together: a technique
  std::string kind;    ///< rows that the machine disturbs alike, one of each group: technique, preset and variant
  Level from = {}, to = {};
  double value = 0;      ///< of `to` minus `from`
  double error = 0;      ///< standard error
  double freedom = 1;    ///< degrees of freedom of the error
  bool differs = false;  ///< filled in by the functions below
};

/// Fills in values and errors. `changed`: members that do not count among those that show how far unchanged rows move.
void add_errors(std::vector<Change>& changes, const std::set<std::string>& changed = {});

/// Half the width of a change's interval of 95 %.
double half_width(const Change& change);

/// Marks the changes that are not 0, such that of those marked a share of `rate` is wrong on average, and where nothing changed any
/// is marked with that probability (Benjamini, Hochberg 1995).
void find_differing(std::vector<Change>& changes, double rate);

/// The mean change of each member over its rows, weighted by their errors; `group` and `kind` are empty.
std::vector<Change> means_of_members(const std::vector<Change>& changes, const std::set<std::string>& changed = {});

/// Fills in values and errors, and marks members that differ: `add_errors`, `means_of_members` and `find_differing`, once more where
/// some differ, without these among the others. Returns the members.
std::vector<Change> find_members(std::vector<Change>& changes, double rate);

/// Marks further rows of members that differ, `means`, where `rate` holds for the rows of these members (Benjamini, Bogomolov 2014).
void find_differing_of_members(std::vector<Change>& changes, const std::vector<Change>& means, double rate);

}  // namespace gloam::report
