#include "gloam/environment_file.h"

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/exr.h"

namespace gloam {
namespace {

/// "latlong", "cube", or empty if the file does not say.
std::string stated_kind(const FrameFile& file) {
  for (const auto& [name, text] : file.attributes()) {
    if (name == "envmap") return text;
  }
  return "";
}

void check_kind(const FrameFile& file, int width, int height) {
  const std::string kind = stated_kind(file);
  if (kind == "latlong") return;
  if (!kind.empty())
    throw Error("{}: is an environment of the kind '{}'; a lat-long one is needed, which exrenvmap -latlong makes",
                file.path().string(), kind);
  if (width != 2 * height)
    throw Error(
        "{}: is {} x {} and no lat-long environment, which is twice as wide as high or has the attribute envmap; give "
        "another file",
        file.path().string(), width, height);
}

}  // namespace

EnvironmentMap read_environment(const std::filesystem::path& path, EnvironmentAxes axes, double turn_degrees) {
  ReadOptions options;
  options.as_stored = true;
  options.only_looks = true;
  FrameFile file(path, options);
  if (!contains(file.common_planes(), "color"))
    throw Error("{}: has no colour (R, G, B), so that it is no environment", path.string());
  check_kind(file, file.window().width(), file.window().height());
  const Frame frame = file.read({"color"});
  const std::vector<Channel>& c = frame.views[0].planes.at("color").channels;
  std::vector<glm::vec3> texels;
  texels.reserve(size_t(frame.width()) * size_t(frame.height()));
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) texels.emplace_back(c[0].at(x, y), c[1].at(x, y), c[2].at(x, y));
  }
  try {
    return EnvironmentMap(frame.width(), frame.height(), std::move(texels), axes, turn_degrees);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw Error("{}: {}", path.string(), error.what());
  }
}

}  // namespace gloam

/// Techniques that light with a map read it as frames are read. Programs that link gloam::frames ask for this symbol, so that the linker
/// takes the file though no other calls it (host/CMakeLists.txt).
extern "C" const bool gloam_reads_environments = (gloam::set_environment_reader(gloam::read_environment), true);
