// Bad input: one line that names the thing, the right exit status, nothing half written, no crash.
#include <sys/resource.h>
#include <sys/stat.h>

#include <thread>

#include "cli/gloam_process.h"

namespace gloam::test::bad_input_test {
namespace {

void expect_refused(const Result& result, int status, const std::vector<std::string>& words) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_EQ(result.err.rfind("gloam: ", 0), 0u) << result.err;
  EXPECT_TRUE(result.out.empty()) << result.out;
  for (const std::string& word : words)
    EXPECT_NE(result.err.find(word), std::string::npos) << "'" << word << "' is not in: " << result.err;
}

TEST_F(Cli, WrongUsage) {
  const std::string out = path("ao.exr");
  expect_refused(gloam({"rnu", "hbao+", loggia}), 2, {"'rnu'", "did you mean 'run'"});
  expect_refused(gloam({"run", "hbaos", loggia, "-o", out}), 2, {"'hbaos'", "did you mean 'hbao"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--radus", "1"}), 2, {"--radus", "did you mean '--radius'"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--radius", "-1"}), 2,
                 {"radius", "-1", "0 to inf", "scene units"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--radius", "nan"}), 2, {"radius", "nan"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--directions", "2.5"}), 2,
                 {"directions", "2.5", "a whole number from 1 to 32"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--falloff", "cubic"}), 2, {"cubic", "quadratic, none"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--set", "raduis=1"}), 2,
                 {"raduis", "did you mean 'radius'"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--preset", "hihg"}), 2, {"hihg", "did you mean 'high'"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--lanes", "3"}), 2, {"--lanes", "1, 4, 8 and 16"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--fov", "180"}), 2, {"--fov", "180", "1 to 179"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--repeat", "0"}), 2, {"--repeat", "0"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--outputs", "oa"}), 2, {"'oa'", "did you mean 'ao'"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--plane", "depth"}), 2, {"--plane", "PLANE=CHANNELS"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--plane", "foo=Z"}), 2,
                 {"--plane foo", "depth, normal, color", "bent_normal"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", out, "--compression", "dwaa"}), 2, {"dwaa", "zip"});
  expect_refused(gloam({"plan", "oa", loggia}), 2, {"'oa'", "did you mean 'ao'"});
  expect_refused(gloam({"list", "device"}), 2, {"device", "did you mean 'devices'"});
  expect_refused(gloam({"list"}), 2, {"what is listed is missing", "techniques"});
  expect_refused(gloam({"list", "--kernel", "gtao/estimat"}), 2, {"'gtao/estimat'", "did you mean 'gtao/estimate'"});
  expect_refused(gloam({"list", "--kernel", "gtoa/estimate"}), 2, {"'gtoa'", "did you mean 'gtao'"});
  expect_refused(gloam({"list", "--kernel", "temporal/x"}), 2, {"'temporal/x'", "temporal/accumulate"});
  expect_refused(gloam({"compare", loggia, loggia_truth, "-o", path("d.jpg")}), 2, {".png"});
  const Result far = gloam({"compare", loggia, loggia_truth, "--tol", "1"});
  expect_refused(far, 2, {"no flag '--tol'"});
  EXPECT_EQ(far.err.find("did you mean"), std::string::npos) << far.err;
  EXPECT_TRUE(files().empty());
}

TEST_F(Cli, NamesSpeltAnotherWayAreSuggested) {
  const std::string out = path("ao.exr");
  const auto run = [&](const Arguments& more) {
    Arguments arguments = {"run", "hbao+", loggia, "-o", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  };
  for (const char* name : {"hbaoplus", "hbao_plus", "HBAO+", "hbao-plus", "HBAOPlus"})
    expect_refused(gloam({"run", name, loggia, "-o", out}), 2, {"did you mean 'hbao+'"});
  expect_refused(gloam({"run", "stereoao", loggia, "-o", out}), 2, {"did you mean 'stereo-ao'"});
  expect_refused(gloam({"run", "dp_hbao_plus", loggia, "-o", out}), 2, {"did you mean 'dp-hbao+'"});
  expect_refused(gloam({"plan", "bentnormal", loggia}), 2, {"did you mean 'bent_normal'"});
  expect_refused(run({"--set", "maxreach=1"}), 2, {"did you mean 'max_reach'"});
  expect_refused(run({"--preset", "HIGH"}), 2, {"did you mean 'high'"});
  expect_refused(gloam({"capture", "Colonade", "-o", out}), 2, {"did you mean 'colonnade'"});
}

TEST_F(Cli, FramesAreWrittenUnderTheNamesOfFrames) {
  for (const char* name : {"ao.png", "ao", "-"}) {
    const std::string out = std::string(name) == "-" ? name : path(name).string();
    if (std::string(name) != "ao.png")  // a picture
      expect_refused(gloam({"run", "hbao+", loggia, "-o", out}), 2, {"-o " + out, ".exr"});
    expect_refused(gloam({"reference", "ao", loggia, "--scene", "plane", "-o", out}), 2, {"-o " + out, ".exr"});
    expect_refused(gloam({"capture", "plane", "-o", out, "--size", "8x8"}), 2, {"-o " + out, ".exr"});
  }
  EXPECT_FALSE(fs::exists("-"));
  EXPECT_TRUE(files().empty());
}

TEST_F(Cli, EmptyArgumentsAndNumbersThatAreNone) {
  expect_refused(gloam({"run", "hbao+", loggia, "-o", ""}), 2, {"empty", "'-o'"});
  expect_refused(gloam({"info", loggia, "--json", ""}), 2, {"empty", "'--json'"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--seed", "abc"}), 2, {"--seed abc", "0 to"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--seed", "-1"}), 2, {"--seed -1", "0 to"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--repeat", "1.5"}), 2, {"--repeat 1.5", "1 to"});
}

TEST_F(Cli, FiltersThatDoNotFit) {
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--filter", "normals"}), 2,
                 {"normals", "bilateral, gaussian, stereo-bilateral and none"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--filter", "hbao+"}), 2,
                 {"hbao+", "bilateral, gaussian, stereo-bilateral and none"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--filter", "foo"}), 2,
                 {"--filter foo", "bilateral, gaussian, stereo-bilateral and none"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--filter", "bilatral"}), 2,
                 {"--filter bilatral", "did you mean 'bilateral'"});
  expect_refused(gloam({"run", "normals", loggia, "-o", path("n.exr"), "--filter", "bilateral"}), 2,
                 {"bilateral", "only none"});
}

TEST_F(Cli, OutputsThatAreInputsOrEachOther) {
  fs::copy_file(loggia, path("frame.exr"));
  fs::create_symlink(path("frame.exr"), path("link.exr"));
  const std::string frame = path("frame.exr"), before = slurp(frame);
  expect_refused(gloam({"run", "hbao+", frame, "-o", frame}), 2, {"-o", "also the frame"});
  expect_refused(gloam({"run", "hbao+", frame, "-o", path("link.exr")}), 2, {"also the frame"});
  expect_refused(gloam({"run", "hbao+", frame, "-o", path("a.exr"), "--json", frame}), 2, {"--json", "also the frame"});
  expect_refused(gloam({"run", "hbao+", frame, "-o", path("a.exr"), "--json", path("a.exr")}), 2,
                 {"--json", "also -o"});
  expect_refused(gloam({"info", frame, "--json", frame}), 2, {"also the frame"});
  expect_refused(gloam({"compare", frame, frame, "-o", path("d.png"), "--json", path("./d.png")}), 2, {"also -o"});
  EXPECT_EQ(slurp(frame), before);
  EXPECT_EQ(files(), (Arguments{"frame.exr", "link.exr"}));
}

TEST_F(Cli, NothingIsWrittenWhereOneOutputCannotBe) {
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--json", path("no/run.json")}), 1,
                 {"--json", "no/run.json"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--picture", path("no/ao.png")}), 1,
                 {"--picture", "no/ao.png"});
  fs::create_directory(path("folder.exr"));
  for (const char* json : {"/dev/full", "/dev/null", "folder.exr"}) {
    const std::string name = json[0] == '/' ? json : path(json).string();
    expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--json", name}), 1, {"--json " + name});
    expect_refused(gloam({"capture", "plane", "--size", "8x8", "-o", path("p.exr"), "--json", name}), 1, {name});
  }
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("folder.exr")}), 1, {"-o", "folder.exr", "it is a folder"});
  EXPECT_EQ(files(), Arguments{"folder.exr"});
}

TEST_F(Cli, WhatIsCompleteIsSaidWhereTheFiguresFail) {
  const std::string out = path("ao.exr");
  const std::string command = std::string(GLOAM_BINARY) + " run hbao+ " + loggia + " -o " + out + " --json -";
  EXPECT_EQ(WEXITSTATUS(std::system((command + " >/dev/full 2>" + path("said").string()).c_str())), 1);
  EXPECT_EQ(slurp(path("said")), "gloam: standard output: cannot be written; " + out + " is complete\n");
  EXPECT_EQ(FrameFile(out, {}).all_channels(), (Arguments{"AO", "Y"}));
}

TEST_F(Cli, ControlBytesNeverReachTheTerminal) {
  const Result result = gloam({"info", path("no\nsuch\x1b[31m.exr")});
  expect_refused(result, 1, {"\\x1b"});
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
}

TEST_F(Cli, ClosedStreams) {
  const std::string command = std::string(GLOAM_BINARY) + " ";
  EXPECT_EQ(WEXITSTATUS(std::system((command + "info /none.exr 2>&-").c_str())), 1);
  EXPECT_EQ(WEXITSTATUS(std::system((command + "info /none.exr 2>/dev/full").c_str())), 1);
  EXPECT_EQ(WEXITSTATUS(std::system((command + "info " + loggia + " >/dev/full 2>/dev/null").c_str())), 1);
  EXPECT_EQ(WEXITSTATUS(std::system((command + "info " + loggia + " --json - >/dev/full 2>/dev/null").c_str())), 1);
  // More than a buffer holds: the write that fails is not the last one.
  EXPECT_EQ(WEXITSTATUS(std::system((command + "list techniques --json - >/dev/full 2>/dev/null").c_str())), 1);
}

TEST_F(Cli, WithoutAHomeADeviceIsStillFound) {
  const Result result = gloam({"run", "hbao+", loggia, "-o", path("ao.exr")},
                              {{"HOME", loggia + "/none"}, {"XDG_CACHE_HOME", ""}, {"POCL_CACHE_DIR", ""}});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(Cli, FilesThatCannotBeRead) {
  const std::string out = path("ao.exr");
  expect_refused(gloam({"info", path("none.exr")}), 1, {"none.exr"});
  expect_refused(gloam({"info", folder.string()}), 1, {folder.string()});
  std::ofstream(path("text.exr")) << "this is no EXR file";
  expect_refused(gloam({"info", path("text.exr")}), 1, {"text.exr", "not an EXR"});
  std::ofstream(path("empty.exr")).flush();
  expect_refused(gloam({"info", path("empty.exr")}), 1, {"empty.exr", "not an EXR"});
  const std::string whole = slurp(loggia);
  std::ofstream(path("cut.exr"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  expect_refused(gloam({"run", "hbao+", path("cut.exr"), "-o", out}), 1, {"cut.exr", "truncated"});
  std::string spoiled = whole;
  for (size_t i = spoiled.size() / 2; i < spoiled.size() / 2 + 4000; ++i) spoiled[i] = char(i * 37);
  std::ofstream(path("spoiled.exr"), std::ios::binary) << spoiled;
  expect_refused(gloam({"run", "hbao+", path("spoiled.exr"), "-o", out}), 1, {"spoiled.exr", "corrupted"});
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Cli, DamageInChannelsThatServeAsNoPlaneIsFound) {
  // Compressible values: others are stored uncompressed, and any bits are a float.
  Frame frame = small_frame(256, 256, {"mystery"});
  Channel& channel = frame.views[0].planes["mystery"].channels[0];
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) channel.at(x, y) = float(x + y);
  }
  write_frame(path("whole.exr"), frame);
  EXPECT_EQ(gloam({"info", path("whole.exr")}).status, 0);
  std::string spoiled = slurp(path("whole.exr"));
  for (size_t i = spoiled.size() / 2; i < spoiled.size() / 2 + 400; ++i) spoiled[i] = char(i * 37);
  std::ofstream(path("spoiled.exr"), std::ios::binary) << spoiled;
  expect_refused(gloam({"info", path("spoiled.exr")}), 1, {"spoiled.exr", "corrupted"});
}

TEST_F(Cli, AHeaderThatClaimsTooMuch) {
  std::string bytes = slurp(loggia);
  const std::string key("dataWindow\0box2i\0", 17);
  const size_t at = bytes.find(key);
  ASSERT_NE(at, std::string::npos);
  const int32_t window[4] = {0, 0, 99999, 99999};
  bytes.replace(at + key.size() + 4, sizeof window, reinterpret_cast<const char*>(window), sizeof window);
  std::ofstream(path("huge.exr"), std::ios::binary) << bytes;
  expect_refused(gloam({"info", path("huge.exr")}), 1, {"huge.exr", "100000 x 100000", "2^28"});
}

TEST_F(Cli, MissingPlanesAreReportedAtOnce) {
  write_frame(path("beauty.exr"), small_frame(32, 24, {"color"}));
  expect_refused(gloam({"run", "hbao+", path("beauty.exr"), "-o", path("ao.exr")}), 1,
                 {"hbao+: needs 'depth'", "has only B, G, R", "docs/gbuffer.md"});
  write_frame(path("ao_only.exr"), small_frame(32, 24, {"ao"}));
  expect_refused(gloam({"plan", "normals,hbao+", path("ao_only.exr")}), 1, {"'depth'"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--plane", "depth=Zdepth"}), 1,
                 {"Zdepth", "it has"});
}

TEST_F(Cli, ViewsAndSizesThatDoNotMatch) {
  write_frame(path("small.exr"), small_frame(16, 16, {"ao"}));
  expect_refused(gloam({"compare", path("small.exr"), loggia_truth}), 1, {"16x16", "480x270"});
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--view", "left"}), 1,
                 {"--view left", "names no views"});
  write_frame(path("color.exr"), small_frame(16, 16, {"color"}));
  expect_refused(gloam({"compare", path("small.exr"), path("color.exr")}), 1, {"no plane in common"});
}

TEST_F(Cli, DevicesThatAreNotThere) {
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--device", "voodoo"}), 1,
                 {"voodoo", "there are", "gloam list devices"});
  expect_refused(gloam({"list", "devices"}, {{"OCL_ICD_VENDORS", "/nonexistent"}}), 1,
                 {"no OpenCL platform", "pocl-opencl-icd"});
  EXPECT_TRUE(files().empty());
}

TEST_F(Cli, DoubleWhereTheDeviceHasNone) {
  const std::map<std::string, std::string> with_rusticl = {{"RUSTICL_ENABLE", "llvmpipe"}};
  if (gloam({"list", "devices"}, with_rusticl).out.find("llvmpipe") == std::string::npos)
    GTEST_SKIP() << "no Rusticl device";
  expect_refused(
      gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--device", "llvmpipe", "--real", "double"}, with_rusticl),
      1, {"no double precision"});
}

TEST_F(Cli, OutOfDeviceMemory) {
  // PoCL takes its memory, in GiB, from the environment: 7000 x 7000 pixels in seven channels do not fit into one.
  if (gloam({"list", "devices"}).out.find("Portable") == std::string::npos) GTEST_SKIP() << "no PoCL device";
  write_frame(path("large.exr"), small_frame(7000, 7000, {"depth"}));
  expect_refused(gloam({"run", "hbao+", path("large.exr"), "-o", path("ao.exr"), "--device", "portable"},
                       {{"POCL_MEMORY_LIMIT", "1"}}),
                 1, {"7000x7000", "MiB", "--device"});
  EXPECT_EQ(files(), Arguments{"large.exr"});
}

TEST_F(Cli, OutputsThatCannotBeWritten) {
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("no/such/folder/ao.exr")}), 1, {"no/such/folder"});
  std::ofstream(path("file")) << "x";
  expect_refused(gloam({"run", "hbao+", loggia, "-o", path("file/ao.exr")}), 1, {"file/ao.exr"});
  expect_refused(gloam({"compare", loggia_truth, loggia_truth, "-o", path("no/difference.png")}), 1,
                 {"no/difference.png"});
  EXPECT_EQ(files(), Arguments{"file"});
}

TEST_F(Cli, AFullDiskLeavesTheOldFile) {
  write_frame(path("frame.exr"), small_frame(1000, 1000, {"depth"}));
  std::ofstream(path("ao.exr")) << "what was there";
  // A limit on the size of files fails writes like a full disk. The driver's own files stay below it, the 12 MB of the output do
  // not.
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{8000000, before.rlim_max};
  signal(SIGXFSZ, SIG_IGN);  // inherited: the write fails instead
  setrlimit(RLIMIT_FSIZE, &tight);
  const Result result = gloam({"run", "hbao+", path("frame.exr"), "-o", path("ao.exr"), "--compression", "none",
                               "--float", "--outputs", "ao,ao_raw", "--keep-depth"});
  setrlimit(RLIMIT_FSIZE, &before);
  expect_refused(result, 1, {"ao.exr"});
  EXPECT_EQ(slurp(path("ao.exr")), "what was there");
  EXPECT_EQ(files(), (Arguments{"ao.exr", "frame.exr"}));
}

TEST_F(Cli, CtrlCLeavesNothing) {
  const pid_t child = start({"run", "hbao+", loggia, "-o", path("ao.exr"), "--repeat", "10000"});
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  kill(child, SIGINT);
  const Result result = finish(child);
  expect_refused(result, 130, {"interrupted"});
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace gloam::test::bad_input_test
