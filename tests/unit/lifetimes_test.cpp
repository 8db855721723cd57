// Planes that lie in the memory of others (plan/lifetimes.h), for every technique.
#include "plan/lifetimes.h"

#include <gtest/gtest.h>

#include "base/lists.h"
#include "gloam/planes.h"

namespace gloam::lifetimes_test {
namespace {

std::vector<Plan> plans_of(const Technique& technique) {
  std::vector<Plan> plans;
  for (const int resolution : {1, 2}) {
    PlanRequest request{.outputs = {technique.name}, .resolution = resolution};
    try {
      plans.push_back(make_plan(request, all_plane_names(16), ""));
    } catch (const UsageError&) {  // a technique that has no lower resolution
    }
  }
  return plans;
}

/// Reads of planes whose memory another plane has been written to since, as "PASS: PLANE".
std::vector<std::string> reads_of_others(const Plan& plan, const std::map<std::string, std::string>& shared) {
  const auto memory_of = [&](const std::string& plane) {
    const auto known = shared.find(plane);
    return known == shared.end() ? plane : known->second;
  };
  std::map<std::string, std::string> holds;  // memory -> the plane written last
  std::vector<std::string> wrong;
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& read : planned.pass.reads) {
      const auto last = holds.find(memory_of(read.plane));
      if (last != holds.end() && last->second != read.plane) wrong.push_back(planned.label() + ": " + read.plane);
    }
    for (const Binding& written : planned.pass.writes) {
      // What the pass itself reads is not yet done with.
      for (const Binding& read : planned.pass.reads) {
        if (read.plane != written.plane && memory_of(read.plane) == memory_of(written.plane))
          wrong.push_back(planned.label() + ": " + read.plane);
      }
      holds[memory_of(written.plane)] = written.plane;
    }
  }
  return wrong;
}

TEST(Lifetimes, NoPassReadsAPlaneWhoseMemoryAnotherHasTaken) {
  size_t sharing = 0;
  for (const Technique& technique : registry()) {
    for (const Plan& plan : plans_of(technique)) {
      const auto shared = shared_memory(plan, Layouts(plan, Layout(64, 48)));
      EXPECT_EQ(reads_of_others(plan, shared), std::vector<std::string>()) << technique.name;
      for (const auto& [plane, memory] : shared) {
        for (const std::string& each : {plane, memory}) {
          EXPECT_FALSE(contains(plan.outputs, each)) << technique.name << ": " << each;
          EXPECT_FALSE(contains(plan.inputs, each)) << technique.name << ": " << each;
        }
        EXPECT_EQ(plane_kind(plane).components.size(), plane_kind(memory).components.size()) << technique.name;
      }
      sharing += !shared.empty();
    }
  }
  EXPECT_GT(sharing, 0u);
}

TEST(Lifetimes, SharedMemoryIsCountedOnce) {
  for (const Technique& technique : registry()) {
    for (const Plan& plan : plans_of(technique)) {
      const Layouts layouts(plan, Layout(64, 48));
      unsigned long long all = 0, taken_over = 0;
      for (const std::string& plane : planes_of(plan)) all += bytes_of(plan, layouts, plane);
      for (const auto& [plane, memory] : shared_memory(plan, layouts)) taken_over += bytes_of(plan, layouts, plane);
      EXPECT_EQ(bytes_of_planes(plan, layouts), all - taken_over) << technique.name;
    }
  }
}

}  // namespace
}  // namespace gloam::lifetimes_test
