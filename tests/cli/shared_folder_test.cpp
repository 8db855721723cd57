// Processes with the same number, as in containers and on machines with a shared folder, write into one folder.
#include <sys/stat.h>

#include <thread>

#include "cli/gloam_process.h"

namespace gloam::test::shared_folder_test {
namespace {

using SharedFolder = Cli;

TEST_F(SharedFolder, EachOfManyProcessesWithOneNumberWritesItsOwnImages) {
  const std::string script = std::string("GLOAM='") + program + "' '" + GLOAM_SOURCE_DIR +
                             "/script/shared-folder' 12 > '" + path("out").string() + "' 2>&1";
  const int status = std::system(script.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << slurp(path("out"));
  EXPECT_EQ(WEXITSTATUS(status), 0) << slurp(path("out"));
  EXPECT_EQ(slurp(path("out")), "96 right, 0 failed, 0 missing, 0 wrong or half, 0 files left over\n");
}

TEST_F(SharedFolder, AReplacedImageKeepsItsPermissions) {
  ASSERT_EQ(gloam({"capture", "plane", "--size", "16x9", "-o", path("a.exr"), "--picture", path("a.png")}).status, 0);
  for (const char* name : {"a.exr", "a.png"}) fs::permissions(path(name), fs::perms(0600));
  ASSERT_EQ(gloam({"capture", "plane", "--size", "16x9", "-o", path("a.exr"), "--picture", path("a.png")}).status, 0);
  for (const char* name : {"a.exr", "a.png"}) EXPECT_EQ(fs::status(path(name)).permissions(), fs::perms(0600)) << name;
}

TEST_F(SharedFolder, ALinkToNothingIsWrittenThrough) {
  fs::create_symlink("real.exr", path("link.exr"));
  ASSERT_EQ(gloam({"capture", "plane", "--size", "16x9", "-o", path("link.exr")}).status, 0);
  EXPECT_TRUE(fs::is_symlink(path("link.exr")));
  EXPECT_TRUE(fs::is_regular_file(path("real.exr")));
}

TEST_F(SharedFolder, APictureThatDoesNotFitOnTheDiskNamesTheCause) {
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{16384, before.rlim_max};
  signal(SIGXFSZ, SIG_IGN);  // inherited: the write fails instead
  setrlimit(RLIMIT_FSIZE, &tight);
  const Result result = gloam({"compare", loggia_truth, loggia_truth, "-o", path("difference.png")});
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "gloam: " + path("difference.png").string() + ": cannot write: File too large\n");
  EXPECT_EQ(files(), Arguments{});
}

}  // namespace
}  // namespace gloam::test::shared_folder_test
