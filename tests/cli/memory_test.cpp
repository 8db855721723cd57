// A command's memory is estimated beforehand, refused if it is too much, and close to the actual peak.
#include "gloam_process.h"

namespace gloam::test::memory_test {
namespace {

class Memory : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    large = path("large.exr"), out = path("out.exr"), document = path("figures.json");
    const std::vector<std::string> planes = {"depth",      "normal",      "color",    "alpha", "albedo", "roughness",
                                             "back_depth", "reflectance", "instance", "ao",    "ao_raw"};
    Frame frame = small_frame(size, size, planes);
    for (const char* name : {"albedo", "reflectance"}) {
      Plane& plane = frame.views[0].planes[name];
      while (plane.channels.size() < 3) plane.channels.emplace_back(Layout(size, size), 0.5f);
    }
    write_frame(large, frame);
    planes_bytes = 0;
    for (const auto& [name, plane] : frame.views[0].planes)
      planes_bytes += plane.channels.size() * Layout(size, size).bytes();
  }

  /// Runs gloam, and measures its peak memory.
  double peak_of(const Arguments& arguments) {
    const pid_t child = start(arguments);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    EXPECT_EQ(status, 0) << slurp(path("stderr"));
    return double(usage.ru_maxrss) * 1024;
  }

  static constexpr int size = 2048;
  std::string large, out, document;
  double planes_bytes = 0;
};

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(Memory, IsAboutWhatWasPlanned) {
  const std::vector<Arguments> commands = {
      {"run", "hbao+", large, "-o", out},
      {"run", "gtao", large, "-o", out, "--resolution", "half"},
      {"auto", large, "-o", out, "--mask", "always"},
      {"info", large},
      {"compare", large, large, "--what", "ao"},
  };
  for (Arguments arguments : commands) {
    arguments.insert(arguments.end(), {"--json", document});
    const double peak = peak_of(arguments);
    const double planned = nlohmann::json::parse(slurp(document)).at("memory_bytes").get<double>();
    RecordProperty(arguments[0] + arguments[1], std::to_string(planned / peak));
    EXPECT_GT(planned, peak / 1.5) << arguments[0] << " " << arguments[1];
    EXPECT_LT(planned, peak * 2) << arguments[0] << " " << arguments[1];
  }
}

TEST_F(Memory, FiguresTakeNoMoreThanTheDepthAndSomeRows) {
  const double depth = double(Layout(size, size).bytes()), fixed = 96 << 20;
  EXPECT_LT(peak_of({"info", large}), depth + fixed);
  EXPECT_GT(planes_bytes, 2 * (depth + fixed));
}
#endif

TEST_F(Memory, MoreThanTheLimitIsRefusedBeforeDecoding) {
  const std::vector<Arguments> commands = {
      {"run", "hbao+", large, "-o", out},
      {"auto", large, "-o", out},
      {"info", large},
      {"compare", large, large},
      {"plan", "ao", large},
      {"pick", large, "--budget", "20ms", "--truth", large},
      {"bench", "-o", path("bench"), "--frame", large},
  };
  for (Arguments arguments : commands) {
    arguments.insert(arguments.end(), {"--limit-memory", "16M"});
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, 1) << arguments[0] << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find("would take about"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("--limit-memory 16M allows 16 MiB"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("large.exr"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(out)) << arguments[0];
  }
  EXPECT_EQ(gloam({"info", large, "--limit-memory", "1.5G"}).status, 0);
}

TEST_F(Memory, LimitIsASize) {
  for (const char* size : {"16", "M", "-4G", "4X", "0G", "nanG", "1e99G", "512K"}) {
    const Result result = gloam({"info", large, "--limit-memory", size});
    EXPECT_EQ(result.status, 2) << size << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    EXPECT_NE(result.err.find("a size such as 4G or 512M is"), std::string::npos) << result.err;
  }
}

TEST_F(Memory, PlanTellsIt) {
  const Result words = gloam({"plan", "ao", large});
  EXPECT_NE(words.out.find("memory    about "), std::string::npos) << words.out;
  EXPECT_GT(gloam({"plan", "ao", large, "--json", "-"}).json().at("memory_bytes").get<double>(), planes_bytes / 8);
}

/// Rows are worked on by the thread that reads them: a pool of threads that wait for the next ones would take the cores from those that
/// decode them. A stack that no system grants ends the command where it starts a thread of OpenMP.
TEST_F(Memory, RowsAreWorkedOnByOneThread) {
  write_frame(path("rows.exr"), small_frame(1024, 512, {"color", "normal"}));
  const Result result = gloam({"info", path("rows.exr"), "--normal-space", "view"},
                              {{"OMP_NUM_THREADS", "4"}, {"OMP_STACKSIZE", "200000G"}});
  EXPECT_EQ(result.status, 0) << result.err;
}

}  // namespace
}  // namespace gloam::test::memory_test
