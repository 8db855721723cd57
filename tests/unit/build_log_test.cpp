// What is told of a kernel that does not build.
#include "run/build_log.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "run/kept_folders.h"

namespace gloam::build_log_test {
namespace {

TEST(BuildLog, TheFirstErrorHasFileAndLine) {
  EXPECT_EQ(first_error("gtao/gtao.cl:3:1: warning: unused\n"
                        "shared/lanes/params.h:23:19: error: variadic macros not supported in OpenCL\n"
                        "gtao/gtao.cl:9:1: error: later\n"),
            "shared/lanes/params.h:23: variadic macros not supported in OpenCL");
  EXPECT_EQ(first_error("error: /tmp/pocl/tempfile.cl:7:3: error: unknown type name 'Params'"),
            "/tmp/pocl/tempfile.cl:7: unknown type name 'Params'");
  EXPECT_EQ(first_error("ptxas fatal   : Unresolved extern function\nError: building failed\n"),
            "Error: building failed");
  EXPECT_EQ(first_error("\n  \nout of memory\n"), "out of memory");
  EXPECT_NE(first_error(""), "");
}

TEST(BuildLog, AFailureIsOneShortLineThatNamesTheWholeLog) {
  std::string log;
  for (int line = 1; line < 400; ++line)
    log += "gtao/gtao.cl:" + std::to_string(line) + ":1: error: " + std::string(200, 'x') + "\n";
  const std::string told = build_failure("Platform: Device", "gtao_estimate", "-D LANES=1", log);
  EXPECT_LE(told.size(), 300u);
  EXPECT_EQ(told.find('\n'), std::string::npos);
  for (const char* part : {"Platform: Device", "gtao_estimate", "gtao/gtao.cl:1"})
    EXPECT_NE(told.find(part), std::string::npos) << told;
  const std::string file = cache_folder().folder / "build-logs/gtao_estimate.log";
  EXPECT_NE(told.find(file), std::string::npos) << told;
  std::stringstream written;
  written << std::ifstream(file).rdbuf();
  EXPECT_NE(written.str().find(log), std::string::npos);
}

TEST(BuildLog, LongNamesLeaveRoomForTheError) {
  const std::string told =
      build_failure(std::string(500, 'd'), "kernel", "", "a.cl:1:1: error: " + std::string(5000, 'x'));
  EXPECT_LE(told.size(), 300u);
  EXPECT_NE(told.find("a.cl:1: xxxxxxxxxx"), std::string::npos);
}

}  // namespace
}  // namespace gloam::build_log_test
