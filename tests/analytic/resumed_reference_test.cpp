// Every kind of reference goes on after an interruption with the same bits, and takes over nothing from another computation.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <stdexcept>

#include "gloam/scene/bounces_reference.h"
#include "gloam/scene/contact_reference.h"
#include "gloam/scene/environment_reference.h"
#include "gloam/scene/indirect_reference.h"
#include "gloam/scene/reflection_reference.h"
#include "gloam/scene/specular_occlusion_reference.h"
#include "support/traced_scene.h"

namespace gloam::test::resumed_reference_test {
using gloam::Scene;
namespace {

using glm::vec3;

/// Sets what all options have.
template <typename Options>
Options with(const ReferenceOptions& common, Options options = {}) {
  if constexpr (requires { options.radius; }) options.radius = common.radius;
  options.samples = common.samples;
  options.seed = common.seed;
  options.checkpoint = common.checkpoint;
  options.checkpoint_seconds = common.checkpoint_seconds;
  options.progress = common.progress;
  return options;
}

EnvironmentMap sky(float red) { return EnvironmentMap(8, 4, std::vector<vec3>(32, vec3(red, 1, 1))); }

struct Kind {
  const char* plane;
  std::function<Reference(const Tracer&, const Frame&, const ReferenceOptions&)> trace;
  std::function<Reference(const Tracer&, const Frame&, const ReferenceOptions&)>
      other;  ///< with another option of its own
};

std::vector<Kind> kinds() {
  using F = const Frame&;
  using T = const Tracer&;
  using O = const ReferenceOptions&;
  const auto contact = [](double angle) {
    return [angle](T tracer, F frame, O common) {
      ContactReferenceOptions options = with<ContactReferenceOptions>(common);
      options.light_angle = angle;
      return contact_reference(tracer, frame, options);
    };
  };
  const auto bounces = [](int most) {
    return [most](T tracer, F frame, O common) {
      BouncesReferenceOptions options = with<BouncesReferenceOptions>(common);
      options.bounces = most;
      return bounces_reference(tracer, frame, options);
    };
  };
  const auto environment = [](float red) {
    return [map = sky(red)](T tracer, F frame, O common) { return environment_reference(tracer, frame, map, common); };
  };
  return {{"bounces", bounces(128), bounces(2)},
          {"contact", contact(30), contact(20)},
          {"environment", environment(1), environment(2)},
          {"indirect", indirect_reference, {}},
          {"specular_occlusion", specular_occlusion_reference, {}},
          {"reflection",
           [](T tracer, F frame, O common) {
             return reflection_reference(tracer, frame, with<ReflectionReferenceOptions>(common));
           },
           {}}};
}

bool same_values(const Reference& a, const Reference& b, const std::string& plane) {
  for (const std::string& name : {plane, plane + "_noise"}) {
    const std::vector<Channel>&one = a.frame.views[0].planes.at(name).channels,
          &two = b.frame.views[0].planes.at(name).channels;
    for (size_t i = 0; i < one.size(); ++i) {
      for (int y = 0; y < a.frame.height(); ++y) {
        for (int x = 0; x < a.frame.width(); ++x) {
          if (one[i].at(x, y) != two[i].at(x, y)) return false;
        }
      }
    }
  }
  return true;
}

TEST(ResumedReference, EveryKindEndsWithTheSameBits) {
  const Scene scene = corner_of_meshes();
  const Tracer tracer(scene);
  const Frame frame = frame_of(tracer, 32, 18);
  std::string folder = (std::filesystem::temp_directory_path() / "gloam-resumed-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  for (const Kind& kind : kinds()) {
    ReferenceOptions options{.radius = 0.8, .samples = 64};
    const Reference whole = kind.trace(tracer, frame, options);
    EXPECT_GT(whole.noise, 0) << kind.plane;
    options.checkpoint = folder + "/" + kind.plane + ".exr.partial";
    options.checkpoint_seconds = 0;
    options.progress = [](double share) {
      if (share > 0.5) throw std::runtime_error("interrupted");
    };
    EXPECT_THROW(kind.trace(tracer, frame, options), std::runtime_error) << kind.plane;
    ASSERT_TRUE(std::filesystem::exists(options.checkpoint)) << kind.plane;
    options.progress = {};
    options.checkpoint_seconds = 1e9;  // the checkpoint stays as it is
    const auto resumed_share = [&](const auto& trace, const ReferenceOptions& changed) {
      return trace(tracer, frame, changed).resumed_share;
    };
    ReferenceOptions changed = options;
    changed.seed = 1;
    EXPECT_EQ(resumed_share(kind.trace, changed), 0) << kind.plane;
    changed = options;
    changed.samples = 96;
    EXPECT_EQ(resumed_share(kind.trace, changed), 0) << kind.plane;
    changed = options;
    changed.radius = 0.7;
    if (kind.plane != std::string("reflection")) {
      EXPECT_EQ(resumed_share(kind.trace, changed), 0) << kind.plane;
    }
    if (kind.other) {
      EXPECT_EQ(resumed_share(kind.other, options), 0) << kind.plane;
    }
    const Reference resumed = kind.trace(tracer, frame, options);
    EXPECT_GE(resumed.resumed_share, 0.4) << kind.plane;
    EXPECT_TRUE(same_values(whole, resumed, kind.plane)) << kind.plane;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace gloam::test::resumed_reference_test
