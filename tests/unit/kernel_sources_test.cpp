#include "technique/kernel_sources.h"

#include <gtest/gtest.h>

#include <sstream>

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

TEST(KernelSources, LinesKeepTheirNumbersWhereKernelsAreDropped) {
  const std::string text =
      "#line 1 \"a.cl\"\nint first;\nkernel void one(ARGUMENTS) {\n  if (1) {\n  }\n}\nint last;\n"
      "kernel void two(ARGUMENTS) {\n}\n";
  EXPECT_EQ(with_one_kernel(text, "two"),
            "#line 1 \"a.cl\"\nint first;\n#line 6 \"a.cl\"\nint last;\nkernel void two(ARGUMENTS) {\n}\n");
  EXPECT_EQ(kernels_of(with_one_kernel("kernel void two(int own) {\n}\n", "two")), std::vector<std::string>());
}

TEST(KernelSources, TheStructOfParametersIsWrittenFromTheTable) {
  const ParameterList list = {float_parameter("radius", 0.5, 0, 1, "", ""), bool_parameter("jitter", on, ""),
                              choice_parameter("falloff", "none", "(quadratic, none)", "")};
  EXPECT_EQ(struct_of(list), "typedef struct {\n  float radius;\n  int jitter;\n  int falloff;\n} Params;\n");
  EXPECT_EQ(struct_of({}), "");
}

}  // namespace
}  // namespace gloam::kernel_sources_test
