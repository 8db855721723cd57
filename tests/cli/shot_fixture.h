// Small shots for tests, and what gloam says of them.
#pragma once

#include <vector>

#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test {

class ShotTest : public Cli {
 protected:
  std::string file(const std::string& name) const { return path(name).string(); }
  static std::string numbered(const std::string& stem, int frame) { return fmt::format("{}.{:04}.exr", stem, frame); }

  /// A step in a floor, which lies elsewhere in each frame.
  static Frame frame_of(int number, int width = 64, int height = 48) {
    Frame frame = small_frame(width, height);
    Channel& depth = frame.views[0].planes.at("depth").channels[0];
    for (int y = 8; y < height - 8; ++y)
      for (int x = 5 + number % 20; x < 25 + number % 20; ++x)
        depth.at(x, y) *= 0.7f + 0.01f * float((x * 7 + y * 3) % 5);
    return frame;
  }

  void make_shot(const std::vector<int>& frames, const std::string& stem = "shot") const {
    for (const int number : frames) write_frame(path(numbered(stem, number)), frame_of(number));
  }

  /// An eye that walks through the gallery, from x = 0 on, frames 1 to `frames` of shot.####.exr.
  void walk(int frames, double step, int width, int height) const {
    const auto key = [](double x) {
      return fmt::format(R"({{"camera_to_world": [[1,0,0,{}],[0,1,0,1.6],[0,0,1,2],[0,0,0,1]]}})", x);
    };
    std::ofstream(path("path.json")) << fmt::format(
        R"({{"width": 320, "height": 180, "fx": 220, "fy": 220, "cx": 160, "cy": 90, "frames": {}, "path": [{}, {}]}})",
        frames, key(0), key(step * (frames - 1)));
    ASSERT_EQ(gloam({"capture", "gallery", "-o", path("shot.exr"), "--size", fmt::format("{}x{}", width, height),
                     "--camera-path", path("path.json"), "--planes", "depth,normal,color,roughness,reflectance,motion"})
                  .status,
              0);
  }
  void renumber(int from, int to) const { fs::rename(path(numbered("shot", from)), path(numbered("shot", to))); }

  /// A run on shot.####.exr. The radius is given, since each frame would make its own.
  Arguments run_of(const Arguments& more, const std::string& technique = "hbao+") const {
    Arguments all = {"run", technique, file("shot.####.exr"), "-o", file("ao.####.exr"), "--radius", "0.5"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Result run(const Arguments& more = {}) const { return gloam(run_of(more)); }

  /// The lines of a document in JSON lines; the last one is the summary.
  static std::vector<nlohmann::json> lines_of(const std::string& text) {
    std::vector<nlohmann::json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }

  std::map<std::string, std::string> contents(const std::string& begin = "ao.") const {
    std::map<std::string, std::string> all;
    for (const std::string& name : files())
      if (name.rfind(begin, 0) == 0) all[name] = slurp(path(name));
    return all;
  }

  void expect_refused(const Arguments& arguments, int status, const std::vector<std::string>& says) const {
    const std::vector<std::string> before = files();
    const Result result = gloam(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_EQ(result.lines_of_error(), 1) << result.err;
    for (const std::string& words : says) EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before) << "a refused command leaves nothing behind";
  }
};

}  // namespace gloam::test
