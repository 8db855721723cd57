// A small set of frames and truths, and images of them as another method would make them.
#pragma once

#include <cmath>
#include <functional>

#include "cli/gloam_process.h"
#include "set/content_hash.h"
#include "set/manifest.h"

namespace gloam::test {

/// An item of the set: a frame, three frames of a moving camera, a pair of eyes.
struct ScoreItem {
  std::string name, kind;
  std::vector<int> frames;
  std::vector<std::string> views, effects;
  std::string stem(int frame) const { return frames.empty() ? name : name + fmt::format(".{:04}", frame); }
  std::vector<int> numbers() const { return frames.empty() ? std::vector{1} : frames; }
};

class ScoreTest : public Cli {
 protected:
  using Change = std::function<float(float)>;

  void SetUp() override {
    Cli::SetUp();
    fs::create_directories(path("set/frames"));
    fs::create_directories(path("set/truths"));
    fs::create_directories(path("images"));
    make("room", {"capture", "gallery", "--size", "96x54"}, {"--samples", "16"});
    make("walk", {"capture", "gallery", "--size", "64x36", "--shot", "walk", "--frames", "1-3"}, {"--samples", "8"},
         ".####");
    make("pair", {"capture", "gallery", "--size", "64x36", "--stereo", "0.064"}, {"--samples", "8"});
    ok({"reference", "indirect", frame("room"), "-o", truth("room", "indirect"), "--samples", "16"});
    write_manifest();
    entry({{"name", "other"}});
  }

  const std::vector<ScoreItem> items = {{"room", "frame", {}, {}, {"ao", "indirect"}},
                                        {"walk", "sequence", {1, 2, 3}, {}, {"ao"}},
                                        {"pair", "eyes", {}, {"left", "right"}, {"ao"}}};

  std::string frame(const std::string& stem) const { return path("set/frames/" + stem + ".exr"); }
  std::string truth(const std::string& item, const std::string& effect, const std::string& number = "") const {
    return path("set/truths/" + item + "_" + effect + number + ".exr");
  }
  void entry(const nlohmann::json& document) const { std::ofstream(path("entry.json")) << document.dump(); }
  nlohmann::json document(const std::string& folder = "out") const {
    return nlohmann::json::parse(slurp(path(folder + "/bench.json")));
  }

  /// Scores the images of the set.
  Result score(const Arguments& more = {}) const {
    Arguments arguments = {"score", "--json", path("entry.json"), "--set", path("set"), "-o", path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
  Result score_images(const Arguments& more = {}) const {
    Arguments arguments = {path("images")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return score(arguments);
  }

  /// A row of the results; null if there is none.
  nlohmann::json row(const std::string& item, const std::string& technique = "other", const std::string& effect = "ao",
                     const std::string& folder = "out") const {
    const nlohmann::json all = document(folder);
    for (const nlohmann::json& each : all["results"]) {
      if (each["scene"] == item && each["technique"] == technique && each["effect"] == effect) return each;
    }
    return nullptr;
  }

  /// Writes the truth of a frame, changed, as an image.
  void write_image(const ScoreItem& item, int number, const std::string& effect, const Change& change,
                   const std::string& name = "") const {
    const std::string of_frame = item.frames.empty() ? "" : fmt::format(".{:04}", number);
    Frame image = plane_of(truth(item.name, effect, of_frame), effect);
    for (View& view : image.views) {
      for (Channel& channel : view.planes.at(effect).channels) {
        for (int y = 0; y < channel.layout().height; ++y) {
          for (int x = 0; x < channel.layout().width; ++x) channel.at(x, y) = change(channel.at(x, y));
        }
      }
    }
    write_frame(path("images/" + (name.empty() ? item.stem(number) + "_" + effect : name) + ".exr"), image);
  }

  /// The same of every frame's ambient occlusion.
  void write_all(const Change& change) const {
    for (const ScoreItem& item : items) {
      for (const int number : item.numbers()) write_image(item, number, "ao", change);
    }
  }

  static Frame plane_of(const std::string& file, const std::string& plane) {
    ReadOptions options;
    options.as_stored = true;
    Frame frame = FrameFile(file, options).read({plane});
    frame.assumed.clear();
    return frame;
  }

  void ok(const Arguments& arguments) const {
    const Result result = gloam(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
  }

  void write_manifest(const std::string& name = "test-1") const {
    sets::Manifest manifest;
    manifest.set = name;
    manifest.gloam = "0";
    manifest.commit = "0";
    manifest.licence = "CC0-1.0";
    for (const ScoreItem& item : items) manifest.items.push_back(described(item));
    manifest.hash = sets::hash_of(manifest.items);
    sets::write_manifest(path("set"), manifest);
  }

 private:
  void make(const std::string& name, Arguments capture, Arguments rays, const std::string& pattern = "") const {
    capture.insert(capture.end(), {"-o", frame(name + pattern)});
    ok(capture);
    Arguments reference = {"reference", "ao", frame(name + pattern), "-o", truth(name, "ao", pattern)};
    reference.insert(reference.end(), rays.begin(), rays.end());
    ok(reference);
  }

  sets::SetFile file(const std::string& name) const { return {name, sets::content_hash(path("set") / name)}; }

  sets::SetItem described(const ScoreItem& item) const {
    sets::SetItem made;
    made.name = item.name;
    made.kind = item.kind;
    made.scene_class = "architecture";
    made.width = item.name == "room" ? 96 : 64;
    made.height = item.name == "room" ? 54 : 36;
    made.views = item.views;
    made.frames = item.frames;
    made.radius = 0.5;
    made.licence = "CC0-1.0";
    for (const int number : item.numbers()) made.files.push_back(file("frames/" + item.stem(number) + ".exr"));
    for (const std::string& effect : item.effects) {
      sets::SetTruth truth;
      truth.effect = effect;
      truth.rays = 16;
      truth.noise = 0.01;
      for (const int number : item.numbers())
        truth.files.push_back(file("truths/" + item.name + "_" + effect +
                                   (item.frames.empty() ? "" : fmt::format(".{:04}", number)) + ".exr"));
      made.truths.push_back(truth);
    }
    return made;
  }
};

}  // namespace gloam::test
