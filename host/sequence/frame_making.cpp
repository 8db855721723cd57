#include "sequence/frame_making.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/hash.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "technique/kernel_sources.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

uint64_t hash_of_kernels() {
  uint64_t hash = hash_of("");
  for (const auto& [name, text] : kernel_sources()) hash = hash_of(text, hash_of(name, hash));
  return hash;
}

std::string identity_of(const fs::path& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) throw Error("{}: cannot read: {}", file.string(), std::strerror(errno));
  return fmt::format("{}, {} bytes, {}.{:09}", file.filename().string(), about.st_size, about.st_mtim.tv_sec,
                     about.st_mtim.tv_nsec);
}

/// All that a camera does to an image, with all digits.
std::string in_words(const Camera& camera) {
  std::string words = fmt::format("{} {} {} {} {} {} {} ", camera.orthographic, camera.fx, camera.fy, camera.cx,
                                  camera.cy, camera.near.value_or(0), camera.far.value_or(0));
  if (const TwoSlits* slits = camera.slits.get())
    words += fmt::format("{} {} {} {} ", *slits->display, slits->module.x, slits->module.y, slits->module.z);
  if (!camera.pose) return words;
  const glm::dvec3& at = camera.pose->position;
  words += fmt::format("{} {} {}", at.x, at.y, at.z);
  for (int column = 0; column < 3; ++column) {
    const glm::dvec3& axis = camera.pose->world_to_view[column];
    words += fmt::format(" {} {} {}", axis.x, axis.y, axis.z);
  }
  return words;
}

/// Decodes all channels, as they were stored.
void decode_all(FrameFile& file) {
  std::vector<std::string> planes;
  for (const PlaneSource& source : file.planes()) planes.push_back(source.plane);
  file.read(planes);
  file.verify();
}

}  // namespace

std::string version_with_kernels(const std::string& version) {
  static const uint64_t kernels = hash_of_kernels();
  return fmt::format("{} kernels {:016x}", version, kernels);
}

std::string with_hash_of_file(const std::string& setting) {
  const size_t equals = setting.find('=');
  const std::string file = equals == std::string::npos ? "" : setting.substr(equals + 1);
  std::error_code unknown;
  if (!fs::is_regular_file(file, unknown)) return setting;
  return fmt::format("{} ({:016x})", setting, hash_of(read_text(file)));
}

std::string identity_of(const FrameFiles& files) {
  std::string identity;
  uint64_t cameras = hash_of("");
  for (const FrameFile& file : files.files()) {
    for (const fs::path& part : file.parts_in_files()) identity += identity_of(part) + "; ";
    for (const std::string& view : file.views()) {
      const std::optional<Camera> camera = file.camera(view);
      cameras = hash_of(camera ? in_words(*camera) : "none", cameras);
    }
  }
  return fmt::format("{}cameras {:016x}", identity, cameras);
}

std::map<std::string, std::string> attributes_of(const FrameMaking& making) {
  return {{"gloamVersion", making.version}, {"gloamSettings", making.settings}, {"gloamInput", making.input}};
}

std::string why_again(const fs::path& path, const FrameMaking& making, const std::string& added) {
  std::error_code unknown;
  if (!fs::exists(path, unknown)) return "it is not there";
  const LooksAtFiles looks;
  try {
    FrameFile file(path, {.only_looks = true, .as_stored = true});
    const std::map<std::string, std::string> wanted = attributes_of(making);
    const auto said = [&](const char* name) {
      return added.empty() ? file.text_attribute(name) : file.text_attribute_of_added(added, name);
    };
    const auto differs = [&](const char* name) { return said(name) != wanted.at(name); };
    if (said("gloamSettings").empty()) return "it was not made by a run on a sequence";
    if (differs("gloamVersion")) return "it was made by another version";
    if (differs("gloamSettings")) return "it was made with other settings";
    if (differs("gloamInput")) return "its input has changed";
    decode_all(file);
  } catch (const Error&) {
    return "it is damaged";
  }
  return "";
}

}  // namespace gloam
