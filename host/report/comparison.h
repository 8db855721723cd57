// Two results of `gloam bench`, row by row: which are faster or slower, nearer to the truth or farther from it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "results/joined.h"

namespace gloam::report {

enum class TimeVerdict { faster, slower, same, too_noisy, not_compared };
enum class ErrorVerdict { nearer, farther, same, not_compared };
const char* name_of(TimeVerdict verdict);
const char* name_of(ErrorVerdict verdict);

/// A change relative to the first run, and its interval, of 95 %: 0.05 is 5 % more.
struct RelativeChange {
  double value = 0, low = 0, high = 0;
};

/// What says that rows of two files are the same measurement.
struct RowName {
  std::string technique, preset, variant, scene, effect, size;
  auto operator<=>(const RowName&) const = default;
};

/// "gtao medium, half on courtyard"
std::string words(const RowName& name);

/// What a row takes on its device.
struct OnDevice {
  double ms = 0;      ///< the median
  std::string bound;  ///< what limits its longest pass (results/bound.h); empty: not known
};

struct ComparedRow {
  RowName name;
  OnDevice from, to;
  bool is_same_work = true;  ///< false where the radius differs
  TimeVerdict time = TimeVerdict::not_compared;
  std::optional<RelativeChange> change;  ///< of the ratio
  Number ratio_from, ratio_to;           ///< medians over all rounds
  ErrorVerdict error = ErrorVerdict::not_compared;
  Number rmse_from, rmse_to;
};

/// A technique over all of its rows, by the mean of their changes.
struct ComparedTechnique {
  std::string technique;
  size_t rows = 0;
  TimeVerdict time = TimeVerdict::not_compared;
  std::optional<RelativeChange> change;
};

struct CompareOptions {
  double rate = 0.01;                  ///< of wrong verdicts among rows that are faster or slower
  double rate_of_techniques = 0.0003;  ///< of techniques as a whole
  double rate_of_found = 0.05;         ///< of rows of techniques that are faster or slower as a whole
  double margin = 0.05;                ///< changes up to this are "same", if the interval says no more
};

/// How errors are compared.
struct ErrorTolerance {
  double relative = 0;  ///< changes up to this share of the error are "same"
  bool one_device = true;
};

struct Comparison {
  bool by_cpu = false;      ///< by what the cores spent, in place of the wall clock
  std::string reference;    ///< what ratios are to; empty: times are not compared
  Number reference_change;  ///< of HBAO+ medium over the gather floor
  Number others_change;     ///< of the median technique over HBAO+ medium
  ErrorTolerance tolerance;
  std::vector<std::string> notes;  ///< what differs between the runs, and what can still be compared: a line each
  std::vector<ComparedRow> rows;   ///< in the order of the first file
  std::vector<ComparedTechnique> techniques;
  std::vector<RowName> only_in_first, only_in_second;
  std::vector<std::pair<std::string, double>> widths;  ///< by scene: half the width of the median row's interval
  CompareOptions options;
};

/// Throws Error for results of different sets, and for a file that holds a row twice.
Comparison compare(const Source& first, const Source& second, const CompareOptions& options = {});

/// Empty for an empty list.
Number median_of(const std::vector<double>& values);

}  // namespace gloam::report
