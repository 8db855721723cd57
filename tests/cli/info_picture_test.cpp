// gloam info --picture: the contact sheet of a file.
#include "cli/gloam_process.h"

namespace gloam::test::info_picture_test {
namespace {

TEST_F(Cli, InfoDrawsAllPlanes) {
  const Result plain = gloam({"info", loggia});
  const Result result = gloam({"info", loggia, "--picture", path("planes.png")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, plain.out + "wrote " + path("planes.png").string() + "\n");
  EXPECT_EQ(png_size(path("planes.png")), std::pair(1026, 766));  // two by two tiles of 480 x 270
}

TEST_F(Cli, InfoPictureLeavesTheJsonAsItIs) {
  const Result plain = gloam({"info", loggia, "--json", "-"});
  const Result result = gloam({"info", loggia, "--picture", path("planes.png"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.findings(), plain.findings());
  EXPECT_EQ(files(), std::vector<std::string>{"planes.png"});
}

TEST_F(Cli, InfoPictureIsAPngAndNoOtherFile) {
  const Result jpeg = gloam({"info", loggia, "--picture", path("planes.jpg")});
  EXPECT_EQ(jpeg.status, 2);
  EXPECT_EQ(jpeg.lines_of_error(), 1) << jpeg.err;
  EXPECT_NE(jpeg.err.find("name it with .png"), std::string::npos) << jpeg.err;
  EXPECT_EQ(gloam({"info", loggia, "--picture", path("x.png"), "--json", path("x.png")}).status, 2);
  fs::copy_file(loggia, path("frame.png"));
  EXPECT_EQ(gloam({"info", path("frame.png"), "--picture", path("frame.png")}).status, 2);
  EXPECT_EQ(gloam({"info", loggia, "--picture", path("missing/x.png")}).status, 1);
  EXPECT_EQ(files(), std::vector<std::string>{"frame.png"});
}

TEST_F(Cli, InfoPictureNeedsAPlane) {
  write_frame(path("odd.exr"), small_frame(8, 8, {"something_else"}));
  ASSERT_EQ(gloam({"info", path("odd.exr")}).status, 0);
  const Result result = gloam({"info", path("odd.exr"), "--picture", path("planes.png")});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(files(), std::vector<std::string>{"odd.exr"});
}

}  // namespace
}  // namespace gloam::test::info_picture_test
