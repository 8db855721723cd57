#include "report/needs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "report/markdown_text.h"

namespace gloam::report {
namespace {

enum class Kind { one_layer, further_layers, lower_resolution };
enum class Best { time, error };

struct Need {
  const char* words;
  Kind kind;
  double most;  ///< largest time, relative to the reference setting
  Best best;
};

constexpr double any = std::numeric_limits<double>::infinity();
/// All times of gloam bench are relative to HBAO+ medium.
constexpr std::array<Need, 7> needs{
    {{"least time", Kind::one_layer, any, Best::time},
     {"at most the time of HBAO+ medium", Kind::one_layer, 1, Best::error},
     {"at most 2 times that", Kind::one_layer, 2, Best::error},
     {"at most 5 times that", Kind::one_layer, 5, Best::error},
     {"nearest to the truth at any price, one layer", Kind::one_layer, any, Best::error},
     {"nearest to the truth with further layers", Kind::further_layers, any, Best::error},
     {"less than half the time of HBAO+ medium, at a lower resolution", Kind::lower_resolution, 0.49, Best::error}}};

bool is_of(Kind kind, const ClassPoint& point) {
  const bool one_layer = reads_one_layer(point.reads);
  if (kind == Kind::further_layers) return !one_layer && point.variant.empty();
  if (kind == Kind::lower_resolution) return one_layer && (point.variant == "half" || point.variant == "quarter");
  return one_layer && point.variant.empty();
}

/// Order, smaller first: by the printed figure, then by the exact one.
std::tuple<double, double, double, double> order(const ClassPoint& p, Best best) {
  const double time = as_printed(ratio_text(p.ratio)), error = as_printed(error_text(p.error));
  if (best == Best::time) return {time, error, p.ratio, p.error};
  return {error, p.ratio, p.error, 0};
}

}  // namespace

bool is_plain_over_one_layer(const Row& row) { return row.variant.empty() && reads_one_layer(row.reads); }

std::vector<Choice> choices(const ClassFront& measured) {
  std::vector<Choice> found;
  for (const Need& need : needs) {
    std::vector<ClassPoint> of_kind;
    for (const ClassPoint& point : measured.points) {
      if (is_of(need.kind, point)) of_kind.push_back(point);
    }
    if (of_kind.empty()) continue;
    Choice choice{need.words, {}};
    for (const ClassPoint& point : of_kind) {
      const bool meets = as_printed(ratio_text(point.ratio)) <= need.most;
      if (meets && (!choice.best || order(point, need.best) < order(*choice.best, need.best))) choice.best = point;
    }
    found.push_back(std::move(choice));
  }
  return found;
}

}  // namespace gloam::report
