#include "normalise/unwrapping.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "normalise/background.h"
#include "normalise/stored_depth.h"

namespace gloam {
namespace {

constexpr double most_of_a_vote = 20;
/// Degrees that are no chance: one good sample on a slanted surface says as much.
constexpr double least_lead_of_votes = 8;

/// By how much the normals of some samples miss, if the first pixel of their set has wrapped 0, 1, 2, ... times: sums of degrees.
struct SumOfVotes {
  int samples = 0;
  std::array<double, most_turns + 1> degrees{};

  int best() const { return int(std::min_element(degrees.begin(), degrees.end()) - degrees.begin()); }
  double least() const { return degrees[size_t(best())]; }
  /// How much worse the next best number is.
  double lead() const {
    double second = std::numeric_limits<double>::infinity();
    for (int turns = 0; turns <= most_turns; ++turns)
      if (turns != best()) second = std::min(second, degrees[size_t(turns)]);
    return second - least();
  }
};

/// Of another set's votes, whose first pixel has wrapped `more` times more.
SumOfVotes seen_from(const SumOfVotes& votes, int more) {
  SumOfVotes moved{votes.samples, {}};
  for (int turns = 0; turns <= most_turns; ++turns) {
    const int there = turns + more;
    moved.degrees[size_t(turns)] =
        there >= 0 && there <= most_turns ? votes.degrees[size_t(there)] : most_of_a_vote * votes.samples;
  }
  return moved;
}

SumOfVotes sum_of(SumOfVotes a, const SumOfVotes& b) {
  a.samples += b.samples;
  for (size_t i = 0; i < a.degrees.size(); ++i) a.degrees[i] += b.degrees[i];
  return a;
}

/// Pixels that are joined, each with how many times it has wrapped more than the first of its set.
class WrappedSets {
 public:
  WrappedSets(size_t pixels, int width, const std::vector<TurnVote>& votes)
      : parent_(pixels), turns_(pixels, 0), size_(pixels, 1) {
    std::iota(parent_.begin(), parent_.end(), uint32_t(0));
    for (const TurnVote& vote : votes)
      votes_[uint32_t(vote.y) * uint32_t(width) + uint32_t(vote.x)] = {1, vote.degrees};
  }
  /// The first pixel of a set; `turns` becomes how many times more the pixel has wrapped than that.
  uint32_t first_of(uint32_t pixel, int& turns) {
    uint32_t first = pixel;
    int sum = 0;
    while (parent_[first] != first) sum += turns_[first], first = parent_[first];
    turns = sum;
    for (int left = sum; parent_[pixel] != pixel;) {  // shorter ways from now on
      const uint32_t next = parent_[pixel];
      const int own = turns_[pixel];
      parent_[pixel] = first, turns_[pixel] = left;
      left -= own;
      pixel = next;
    }
    return first;
  }
  /// `more`: how many times more the second pixel has wrapped than the first. Sets stay apart where the normals of both say otherwise: at an edge
  /// values go on by chance.
  void join(uint32_t one, uint32_t other, int more) {
    int of_one = 0, of_other = 0;
    uint32_t a = first_of(one, of_one), b = first_of(other, of_other);
    if (a == b) return;
    int turns = of_one + more - of_other;  // of b relative to a
    if (size_[a] < size_[b]) std::swap(a, b), turns = -turns;
    if (!join_votes(a, b, turns)) return;
    parent_[b] = a, turns_[b] = turns;
    size_[a] += size_[b];
  }
  /// How many times the first pixel of a set has wrapped, if the normals tell.
  std::optional<int> told_by_votes(uint32_t first) const {
    const auto found = votes_.find(first);
    if (found == votes_.end() || found->second.lead() < least_lead_of_votes) return {};
    return found->second.best();
  }

 private:
  /// False if they contradict.
  bool join_votes(uint32_t a, uint32_t b, int turns) {
    const auto of_b = votes_.find(b);
    if (of_b == votes_.end()) return true;
    const SumOfVotes moved = seen_from(of_b->second, turns);
    const auto of_a = votes_.find(a);
    if (of_a == votes_.end()) {
      votes_[a] = moved;
    } else {
      const SumOfVotes both = sum_of(of_a->second, moved);
      const double loss = both.least() - of_a->second.least() - of_b->second.least();
      if (loss > std::max(least_lead_of_votes, double(std::min(of_a->second.samples, moved.samples)))) return false;
      of_a->second = both;
    }
    votes_.erase(b);
    return true;
  }

  std::vector<uint32_t> parent_;
  std::vector<int> turns_;
  std::vector<uint32_t> size_;
  std::unordered_map<uint32_t, SumOfVotes> votes_;  ///< by the first pixel of a set
};

struct Joint {
  float uneven;
  uint32_t one, other;
};

/// Of two that go on as evenly the smaller step comes first: hair is all edges.
constexpr double share_of_step = 0.5;

/// How unevenly values go on from one pixel to the next: the step between them beside the steps before and behind, all of them wrapped.
/// Across an edge it is as large as chance has it.
float unevenness(double before, double one, double other, double behind) {
  const double step = modulo_16_bits(other - one);
  double most = share_of_step * std::abs(step);
  for (const double beside : {modulo_16_bits(one - before), modulo_16_bits(behind - other)})
    most = std::max(most, std::isfinite(beside) ? std::abs(step - beside) : range_of_16_bits / 2);
  return float(most);
}

/// All neighbours, those whose values go on most evenly first. Source: Herraez, Burton, Lalor and Gdeisat, "Fast two-dimensional
/// phase-unwrapping algorithm based on sorting by reliability following a noncontinuous path", Applied Optics 41 (2002).
std::vector<Joint> joints_of(const Channel& depth) {
  const Layout& layout = depth.layout();
  const auto at = [&](int x, int y) {
    const bool is_inside = x >= 0 && y >= 0 && x < layout.width && y < layout.height;
    return is_inside && is_no_mark(depth.row(y)[x]) ? double(depth.row(y)[x]) : std::numeric_limits<double>::infinity();
  };
  std::vector<Joint> joints;
  const auto add = [&](int x, int y, int to_x, int to_y) {
    const double one = at(x, y), other = at(x + to_x, y + to_y);
    if (!std::isfinite(one) || !std::isfinite(other)) return;
    joints.push_back({unevenness(at(x - to_x, y - to_y), one, other, at(x + 2 * to_x, y + 2 * to_y)),
                      uint32_t(y) * uint32_t(layout.width) + uint32_t(x),
                      uint32_t(y + to_y) * uint32_t(layout.width) + uint32_t(x + to_x)});
  };
  for (int y = 0; y < layout.height; ++y)
    for (int x = 0; x < layout.width; ++x) {
      add(x, y, 1, 0);
      add(x, y, 0, 1);
    }
  std::stable_sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) { return a.uneven < b.uneven; });
  return joints;
}

/// The fewest wraps that a share of a set's pixels have: single ones may be noise.
int turns_of_nearest(const std::map<int, long long>& counts) {
  constexpr double least_share = 0.005;
  long long all = 0;
  for (const auto& [turns, count] : counts) all += count;
  for (const auto& [turns, count] : counts)
    if (double(count) >= least_share * double(all)) return turns;
  return 0;
}

}  // namespace

double modulo_16_bits(double difference) {
  return difference - range_of_16_bits * std::round(difference / range_of_16_bits);
}

double share_of_wrapped(const std::vector<TurnVote>& votes) {
  constexpr double well = 3, not_badly = 4, least_share = 0.02, least_share_of_plain = 0.5;
  double wrapped = 0, plain = 0;
  for (const TurnVote& vote : votes) {
    const double best = *std::min_element(vote.degrees.begin(), vote.degrees.end());
    plain += vote.degrees[0] < not_badly;
    wrapped += best < well && vote.degrees[0] - best > least_lead_of_votes;
  }
  const double all = double(votes.size());
  return wrapped >= least_share * all && plain >= least_share_of_plain * all && all > 0 ? wrapped / all : 0;
}

void unwrap(Channel& depth, const VoteOnTurns& vote) {
  mark_share(depth, 0);
  const int width = depth.layout().width, height = depth.layout().height;
  const auto at = [&](uint32_t pixel) -> float& { return depth.row(int(pixel) / width)[int(pixel) % width]; };
  for (int y = 0; y < height; ++y)
    for (float* value = depth.row(y); value != depth.row(y) + width; ++value)
      if (*value < 0 && is_no_mark(*value)) *value += float(range_of_16_bits);
  WrappedSets sets(size_t(width) * size_t(height), width, vote ? vote(depth) : std::vector<TurnVote>());
  for (const Joint& joint : joints_of(depth)) {
    const double difference = double(at(joint.other)) - double(at(joint.one));
    sets.join(joint.one, joint.other, -int(std::lround((difference - modulo_16_bits(difference)) / range_of_16_bits)));
  }
  std::vector<int> turns(size_t(width) * size_t(height), 0);
  std::map<uint32_t, std::map<int, long long>>
      pixels;  // by the first of the set, and how often they wrap more than that
  for (uint32_t pixel = 0; pixel < turns.size(); ++pixel) {
    const uint32_t first = sets.first_of(pixel, turns[pixel]);
    ++pixels[first][turns[pixel]];
  }
  std::map<uint32_t, int> none;
  for (const auto& [first, counts] : pixels) {
    const std::optional<int> told = sets.told_by_votes(first);
    none[first] = told ? -*told : turns_of_nearest(counts);
  }
  for (uint32_t pixel = 0; pixel < turns.size(); ++pixel) {
    int unused = 0;
    const int by = std::max(0, turns[pixel] - none[sets.first_of(pixel, unused)]);
    if (is_no_mark(at(pixel))) at(pixel) += float(range_of_16_bits * by);
  }
}

}  // namespace gloam
