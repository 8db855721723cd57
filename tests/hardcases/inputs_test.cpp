// Hard cases 1 and 7: whatever stands in the planes.
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "gloam/exr.h"
#include "gloam/planes.h"
#include "hard_case.h"

namespace gloam::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

/// What files are known to hold where they should not, and floats of any size.
float any_value(std::mt19937& random) {
  static const float specials[] = {nan,    inf,    -inf,  0,     -0.0f,  -1,    -1e38f, 1e-45f, 1e-39f,
                                   1e-30f, 1e-20f, 1e-6f, 65504, 9.9e9f, 1e38f, 1,      0.5f,   3.4e38f};
  const uint32_t draw = random();
  if (draw % 4 == 0) return specials[draw / 4 % std::size(specials)];
  if (draw % 4 == 1) return std::bit_cast<float>(uint32_t(random()));
  if (draw % 4 == 2) return std::pow(10.0f, float(draw / 4 % 400) / 10 - 30);
  return 1 + float(draw / 4 % 1000) * 1e-3f;  // a surface, so that neighbours are near each other somewhere
}

void fuzz(Frame& frame, uint32_t seed) {
  std::mt19937 random(seed);
  for (auto& [name, plane] : frame.views[0].planes) {
    for (Channel& channel : plane.channels) {
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = any_value(random);
      }
    }
  }
  normalise(frame);
}

/// All planes that the technique could ever take, all of them fuzzed.
Frame fuzzed_frame(const Technique& technique, const Shot& shot, uint32_t seed, bool with_normals) {
  Frame frame = blank(shot);
  plane_of(frame, "depth");
  for (const std::string& name : technique.reads) {
    if (is_stack(name)) continue;  // its layers are added below
    if (with_normals || name == "depth") plane_of(frame, name);
  }
  // Positions are the world's.
  if (frame.views[0].find("position")) frame.views[0].camera->pose.emplace();
  plan_for(technique, frame);  // adds what nothing makes
  fuzz(frame, seed);
  return frame;
}

/// The defaults, and one setting each: every float parameter of the technique at both ends of its range.
std::vector<Settings> extremes(const Technique& technique) {
  std::vector<Settings> all = {{}};
  for (const Parameter& p : technique.parameters) {
    if (p.type != Parameter::Type::floating) continue;
    for (const double value : {p.min, p.max})
      all.push_back({{technique.name + "." + p.name, std::isinf(value) ? "inf" : fmt::format("{}", value)}});
  }
  return all;
}

class Fuzz {
 public:
  explicit Fuzz(const Technique& technique) : technique_(technique) {}

  /// Another frame.
  void shoot(const Shot& shot, bool with_normals) { frame = fuzzed_frame(technique_, shot, ++seed_, with_normals); }
  /// Each of some settings in each of some ways, on the frame.
  void run(const std::vector<Settings>& settings, const std::vector<RunOptions>& ways) {
    for (const Settings& setting : settings) {
      for (const RunOptions& way : ways) check(setting, way);
    }
  }
  Frame frame;
  int images = 0, violations = 0;

 private:
  void check(const Settings& setting, const RunOptions& options) {
    ++images;
    const std::string wrong = violation(outputs_of(technique_, frame, setting, options));
    if (wrong.empty()) return;
    if (++violations > 5) return;
    const Camera& camera = *frame.views[0].camera;
    ADD_FAILURE() << wrong << "; seed " << seed_ << ", " << frame.width() << "x" << frame.height() << ", "
                  << (camera.orthographic ? "orthographic" : "perspective") << " fx " << camera.fx << ", "
                  << text_of(setting) << ", lanes " << options.lanes
                  << (options.math == Math::fast ? ", fast" : ", precise");
  }
  const Technique& technique_;
  uint32_t seed_ = 0;
};

TEST_P(HardCase, Row01AnyInput) {
  SKIP_WHERE_OPTED_OUT(1);
  Fuzz fuzz(technique());
  for (const auto& [width, height] : {std::pair(1, 1), {1, 33}, {33, 1}, {17, 13}, {93, 61}}) {
    for (const bool with_normals : {true, false}) {
      for (const Shot& shot :
           {perspective(width, height), perspective(width, height, 179), perspective(width, height, 1),
            orthographic(width, height, 8), orthographic(width, height, 1e-6), orthographic(width, height, 1e8)}) {
        fuzz.shoot(shot, with_normals);
        fuzz.run({few_samples(technique())}, two_ways());
      }
    }
  }
  for (const bool with_normals : {true, false}) {
    for (const Shot& shot : usual_shots()) {
      fuzz.shoot(shot, with_normals);
      fuzz.run(extremes(technique()), all_ways());
      fuzz.run(variants(technique(), fuzz.frame), two_ways());
    }
  }
  report(1, fmt::format("share of {} fuzzed images with a value out of its range", fuzz.images),
         double(fuzz.violations) / fuzz.images, 0);
}

void set_normals(Frame& frame, const std::function<float(float, int, int)>& change) {
  for (Channel& channel : plane_of(frame, "normal").channels) {
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = change(channel.at(x, y), x, y);
    }
  }
  normalise(frame);
}

TEST_P(HardCase, Row07Normals) {
  SKIP_WHERE_OPTED_OUT(7);
  const std::vector<std::pair<const char*, std::function<float(float, int, int)>>> changes = {
      {"zero", [](float, int, int) { return 0.0f; }},
      {"NaN", [](float, int, int) { return nan; }},
      {"NaN and zero here and there",
       [](float n, int x, int y) { return (x + y) % 3 == 0   ? nan
                                          : (x * y) % 5 == 0 ? 0
                                                             : n; }},
      {"facing away", [](float n, int, int) { return -n; }},
      {"infinite", [](float n, int, int) { return n * inf; }}};
  for (const int lanes : usual_lanes(device())) {
    const RunOptions options{.lanes = lanes};
    for (const auto& [what, change] : changes) {
      Frame frame = shoot(perspective(80, 60), room());
      set_normals(frame, change);
      EXPECT_EQ(violation(outputs_of(technique(), frame, {}, options)), "") << what;
    }
    if (!opt_out(technique(), 7, "any length").empty()) continue;
    Frame unit = shoot(perspective(80, 60), room());
    const Frame expected = outputs_of(technique(), unit, {}, options);
    double worst = 0;
    // The mean instead of the largest where the technique says why a pixel may differ.
    const bool by_mean = !opt_out(technique(), 7, "lengths").empty();
    for (const float length : {1000.0f, 1e-20f, 0.5f, 1e18f}) {
      Frame frame = shoot(perspective(80, 60), room());
      set_normals(frame, [&](float n, int, int) { return n * length; });
      const Difference d = difference(outputs_of(technique(), frame, {}, options), expected);
      worst = std::max(worst, by_mean ? d.mean : d.max);
    }
    // A normal that went through another length comes back to within two roundings of each component.
    report(7, fmt::format("normals of any length against unit ones, lanes {}", lanes), worst, 1e-5);
  }
}

/// In an image of one pixel every sample is the point itself.
TEST_P(HardCase, Row07SampleOnThePointItself) {
  SKIP_WHERE_OPTED_OUT(7);
  double worst = 0;
  for (const Shot& shot : {perspective(1, 1), orthographic(1, 1, 1)}) {
    for (const RunOptions& way : two_ways()) {
      Frame frame = shoot(shot, tilted_plane(2, 0.5, 1));
      const Plan plan = plan_for(technique(), frame, few_samples(technique()));
      const Frame out = run(plan, frame, device(), way).frame;
      EXPECT_EQ(violation(out), "");
      worst = std::max(worst, worst_distance_from_open(plan, out));
    }
  }
  report(7, "distance from open with nothing but the point itself", worst, 0);
}

}  // namespace
}  // namespace gloam::test
