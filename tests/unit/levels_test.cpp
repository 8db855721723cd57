// Changes between two runs: their errors, and which differ, on simulated runs whose truth is known.
#include "report/levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "report/student.h"

namespace gloam::test::levels_test {
namespace {

using namespace gloam::report;

TEST(Student, HasTheValuesOfTables) {
  EXPECT_NEAR(two_sided(2.776445, 4), 0.05, 1e-6);
  EXPECT_NEAR(two_sided(1, 1), 0.5, 1e-12);
  EXPECT_NEAR(two_sided(3.169273, 10), 0.01, 1e-7);
  EXPECT_NEAR(two_sided(0, 7), 1, 1e-12);
  EXPECT_NEAR(two_sided_limit(0.05, 10), 2.228139, 1e-5);
  EXPECT_NEAR(two_sided_limit(0.001, 30), 3.645959, 1e-5);
}

TEST(LevelOf, IsTheMeanOverProcessesOfTheirMedians) {
  const Level level = level_of({1, 1, 1, 1, 100, 4, 4, 4, 4, 4}, {5, 5});
  EXPECT_EQ(level.processes, 2);
  EXPECT_NEAR(level.mean, std::log(2), 1e-12);
  EXPECT_NEAR(level.squares, 2 * std::pow(std::log(2), 2), 1e-12);
  EXPECT_EQ(level.by_rounds, 0);
}

TEST(LevelOf, NeedsRounds) {
  EXPECT_EQ(level_of({1, 1, 1, 1}, {}).processes, 0);
  EXPECT_EQ(level_of({1, 1, 1, 1, 1}, {}).processes, 1);
  EXPECT_EQ(level_of({1, 1, 1, 1, 1, 1, 1, 1}, {5, 3}).processes, 0);
}

double normal(Random& random) {
  const double u = random.uniform(0x1p-53, 1), angle = random.uniform(0, 6.283185307179586);
  return std::sqrt(-2 * std::log(u)) * std::cos(angle);
}

constexpr int members = 12, kinds = 6, groups = 3, rounds = 9;

/// One run, as a busy machine measures it: in each process and scene, memory is slower by some amount, which half of the kinds feel.
/// `slow`: by how much the first member is slower.
std::vector<Level> run(Random& random, int processes, double slow) {
  std::vector<std::vector<double>> ratios(size_t(groups * members * kinds));
  for (int process = 0; process < processes; ++process) {
    size_t row = 0;
    for (int group = 0; group < groups; ++group) {
      const double memory = 0.1 * std::fabs(normal(random));
      for (int member = 0; member < members; ++member) {
        for (int kind = 0; kind < kinds; ++kind) {
          const double felt = kind % 2 == 0 ? 0.05 : random.uniform(0.5, 1.5), own = 0.005 * normal(random);
          for (int round = 0; round < rounds; ++round)
            ratios[row].push_back((member == 0 ? slow : 1) * std::exp(felt * memory + own + 0.02 * normal(random)));
          ++row;
        }
      }
    }
  }
  std::vector<Level> levels;
  for (const auto& each : ratios) levels.push_back(level_of(each, std::vector<double>(size_t(processes), rounds)));
  return levels;
}

std::vector<Change> changes_between(const std::vector<Level>& from, const std::vector<Level>& to) {
  std::vector<Change> changes;
  for (int group = 0; group < groups; ++group) {
    for (int member = 0; member < members; ++member) {
      for (int kind = 0; kind < kinds; ++kind) {
        const std::string name = "technique " + std::to_string(member);
        const size_t row = changes.size();
        changes.push_back({"scene " + std::to_string(group), name, name + std::to_string(kind), from[row], to[row]});
      }
    }
  }
  add_errors(changes);
  return changes;
}

struct Found {
  int right = 0, wrong = 0, members = 0, wrong_members = 0;
};

Found found_in(Random& random, int processes, double slow) {
  std::vector<Change> changes = changes_between(run(random, processes, 1), run(random, processes, slow));
  const std::vector<Change> means = find_members(changes, 0.001);
  find_differing(changes, 0.01);
  find_differing_of_members(changes, means, 0.05);
  Found found;
  for (const Change& c : changes) (c.member == "technique 0" && slow != 1 ? found.right : found.wrong) += c.differs;
  for (const Change& c : means)
    (c.member == "technique 0" && slow != 1 ? found.members : found.wrong_members) += c.differs;
  return found;
}

TEST(Changes, OfOneBuildDoNotDiffer) {
  Random random(34);
  for (int processes = 1; processes <= 3; ++processes) {
    int wrong = 0, wrong_members = 0;
    constexpr int tries = 30;
    for (int i = 0; i < tries; ++i) {
      const Found found = found_in(random, processes, 1);
      wrong += found.wrong > 0;
      wrong_members += found.wrong_members > 0;
    }
    EXPECT_LE(wrong, 1) << processes;  // of 30 comparisons with 216 rows; a rate of 1 % is 0.3
    EXPECT_LE(wrong_members, 1) << processes;
  }
}

TEST(Changes, OfAKernelThatIsFivePercentSlowerAreFound) {
  Random random(35);
  constexpr int tries = 20;
  int found_members = 0, rows = 0, wrong = 0;
  for (int i = 0; i < tries; ++i) {
    const Found found = found_in(random, 3, 1.05);
    found_members += found.members;
    rows += found.right;
    wrong += found.wrong;
  }
  EXPECT_GE(found_members, tries - 1);
  EXPECT_GE(rows, tries * groups * kinds / 4);  // the half that does not feel memory is found nearly always
  EXPECT_LE(wrong, 3);
}

TEST(Changes, OfOneMemberLeaveTheOthersAsSureAsBefore) {
  Random random(37);
  std::vector<Change> calm = changes_between(run(random, 3, 1), run(random, 3, 1));
  const double before = half_width(calm.back());
  std::vector<Change> changes = changes_between(run(random, 3, 1), run(random, 3, 3));
  const std::vector<Change> means = find_members(changes, 0.001);
  EXPECT_TRUE(means.front().differs);
  EXPECT_LT(half_width(changes.back()), 3 * before);
  EXPECT_LT(half_width(means.back()), 0.1);
}

TEST(Changes, HaveIntervalsThatHoldTheTruth) {
  Random random(36);
  int held = 0, all = 0;
  for (int i = 0; i < 10; ++i) {
    for (const Change& c : changes_between(run(random, 3, 1), run(random, 3, 1))) {
      held += std::fabs(c.value) <= half_width(c);
      ++all;
    }
  }
  EXPECT_GT(double(held) / all, 0.93);
}

}  // namespace
}  // namespace gloam::test::levels_test
