#include "technique/kernel_sources.h"

#include <gtest/gtest.h>

#include <sstream>

#include "base/lists.h"

namespace gloam::kernel_sources_test {
namespace {

std::vector<std::string> kernels_of(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("kernel void ", 0) == 0) names.push_back(line.substr(12, line.find('(') - 12));
  }
  return names;
}

TEST(KernelSources, AProgramKeepsOneKernel) {
  const std::string file = flatten("gtao/gtao.cl");
  ASSERT_GT(kernels_of(file).size(), 4u);
  EXPECT_EQ(kernels_of(with_one_kernel(file, "stereo_slices")), std::vector<std::string>{"stereo_slices"});
  EXPECT_EQ(kernels_of(with_one_kernel(file, "stereo_blend")), std::vector<std::string>{"stereo_blend"});
}

TEST(KernelSources, TheStructOfParametersIsWrittenFromTheTable) {
  const ParameterList list = {"AnyParams",
                              {float_parameter("radius", 0.5, 0, 1, "", ""), bool_parameter("jitter", on, ""),
                               choice_parameter("falloff", "none", "(quadratic, none)", "")}};
  EXPECT_EQ(struct_of(list), "typedef struct {\n  float radius;\n  int jitter;\n  int falloff;\n} AnyParams;\n");
  EXPECT_EQ(struct_of({}), "");
}

TEST(KernelSources, KernelsNamedByAMacroStay) {
  const std::vector<std::string> kept = kernels_of(with_one_kernel(flatten("lightfield/lightfield.cl"), "other"));
  EXPECT_TRUE(contains(kept, "ESTIMATE_NAME"));
}

}  // namespace
}  // namespace gloam::kernel_sources_test
