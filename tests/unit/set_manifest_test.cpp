// The manifest of a set of frames and truths.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "message_of.h"
#include "set/manifest.h"
#include "set/sha256.h"

namespace gloam::set_manifest_test {
namespace {

namespace fs = std::filesystem;
using namespace gloam;
using namespace gloam::sets;

const std::string digits_a = sha256_of("a"), digits_b = sha256_of("b");

Manifest example() {
  SetItem frame{
      "courtyard", "frame", "architecture", 640, 360, {}, {}, 0.5, "MIT", {{"frames/courtyard.exr", digits_a}}, {}};
  frame.truths.push_back({"ao", 1024, 0.0021, 0.046, {{"truths/courtyard_ao.exr", digits_b}}});
  frame.truths.push_back({"contact", 1, 0, {}, {{"truths/courtyard_contact.exr", digits_a}}});
  SetItem walk{"walk", "sequence", "architecture", 64, 36, {"left", "right"}, {5, 6}, 1.25, "MIT", {}, {}};
  walk.files = {{"frames/walk.0005.exr", digits_a}, {"frames/walk.0006.exr", digits_b}};
  Manifest manifest;
  manifest.set = "gloam-1";
  manifest.gloam = "0.1.0";
  manifest.commit = "0123456789ab";
  manifest.licence = "MIT";
  manifest.items = {frame, walk};
  return manifest;
}

/// The example with a piece of its text replaced.
std::string replaced(const std::string& from, const std::string& to) {
  std::string text = text_of(example());
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// The message for such a text.
std::string refused(const std::string& from, const std::string& to) {
  return test::message_of([&] { manifest_of(replaced(from, to), "m.json"); });
}

TEST(Sha256, HasThePublishedValues) {  // FIPS 180-2, appendix B
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  Sha256 in_pieces;
  in_pieces.add("a");
  in_pieces.add("bc");
  EXPECT_EQ(in_pieces.digits(), sha256_of("abc"));
}

TEST(SetManifest, IsReadAsItWasWritten) {
  const fs::path folder = fs::path(testing::TempDir()) / "set_manifest";
  fs::remove_all(folder);
  fs::create_directories(folder);
  write_manifest(folder, example());
  const Manifest read = read_manifest(folder);
  EXPECT_EQ(text_of(read), text_of(example()));
  EXPECT_EQ(read.hash, hash_of(example().items));
  EXPECT_EQ(read.items[1].frames, (std::vector<int>{5, 6}));
  EXPECT_EQ(read.items[1].views, (std::vector<std::string>{"left", "right"}));
  EXPECT_FALSE(read.seed);
  ASSERT_NE(find_item(read, "walk"), nullptr);
  EXPECT_EQ(find_item(read, "run"), nullptr);
  EXPECT_EQ(find_truth(read.items[0], "ao")->best_error, 0.046);
  EXPECT_FALSE(find_truth(read.items[0], "contact")->best_error);
  EXPECT_EQ(find_truth(read.items[1], "ao"), nullptr);
}

TEST(SetManifest, HashesDependOnFilesAndOrder) {
  const std::vector<SetItem> items = example().items;
  std::vector<SetItem> turned = {items[1], items[0]}, changed = items;
  changed[1].files[1].sha256 = digits_a;
  EXPECT_NE(hash_of(items), hash_of(turned));
  EXPECT_NE(hash_of(items), hash_of(changed));
  changed = items;
  changed[0].truths[0].best_error = 0.04;  // measured later, says nothing of the files
  EXPECT_EQ(hash_of(items), hash_of(changed));
}

TEST(SetManifest, SaysInOneLineWhatIsWrong) {
  EXPECT_EQ(test::message_of([] { read_manifest("/nowhere"); }),
            "/nowhere: there is no set: no manifest.json; gloam set make NAME -o DIR makes one");
  EXPECT_EQ(refused("\"sequence\"", "\"movie\""),
            "m.json: items[1].kind is \"movie\"; there are frame, sequence, eyes, display and hard");
  EXPECT_EQ(
      refused("frames/courtyard.exr", "../courtyard.exr"),
      "m.json: items[0].files[0].file is \"../courtyard.exr\"; it must be a path inside the set's folder, without "
      ". and ..");
  EXPECT_EQ(refused("\"rays\": 1024", "\"rays\": 10.5"),
            "m.json: items[0].truths[0].rays is 10.5; whole numbers from 0 to 2147483647 are allowed");
  EXPECT_EQ(refused("\"radius\": 0.5", "\"radius\": 0"), "m.json: items[0].radius is 0; more than 0 is allowed");
  EXPECT_EQ(refused("\"name\": \"walk\"", "\"name\": \"courtyard\""),
            "m.json: items[1].name is \"courtyard\"; an item before it has that name");
  EXPECT_EQ(refused("\"licence\"", "\"license\""), "m.json: licence is missing; it must be given");
  EXPECT_EQ(refused("\"seed\": null", "\"seed\": 3"),
            "m.json: seed is 3; a seeded part has one, and a public part null");
  EXPECT_NE(refused(digits_a, digits_b).find("the manifest was changed by hand"), std::string::npos);
  EXPECT_EQ(refused("{", "[").substr(0, 32), "m.json: not readable as JSON: pa");
}

}  // namespace

}  // namespace gloam::set_manifest_test
