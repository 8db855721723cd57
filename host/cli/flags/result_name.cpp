#include "cli/flags/result_name.h"

#include <filesystem>

#include "base/file_ledger.h"
#include "exr/writers.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "shot/outputs.h"

namespace gloam::cli {
namespace {

/// Whether a file is a result that got its name from this very frame, by an earlier call.
bool is_own_result(const std::filesystem::path& path, const std::string& frame) {
  const LooksAtFiles looks;
  try {
    const FrameFile file(path, {.only_looks = true, .as_stored = true});
    return file.text_attribute(named_by_gloam) == frame_seen_from(frame, path.string());
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::string name_beside(const FrameArguments& frame, const std::string& command, const std::string& what) {
  const std::filesystem::path path(frame.frame);
  std::error_code unknown;
  if (frame.has_pattern())
    throw UsageError("{}: the results of a shot have no name; give one, such as -o '{}.####.exr'", command, what);
  if (std::filesystem::is_directory(path, unknown))
    throw Error("{}: is a folder; {}", path.string(), advice_on_folder(path));
  if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown))
    throw UsageError("{}: the result has no name; give one, such as -o {}.exr", command, what);
  const std::filesystem::path out = path.parent_path() / fmt::format("{}_{}.exr", path.stem().string(), what);
  if (std::filesystem::exists(std::filesystem::symlink_status(out, unknown)) && !is_own_result(out, frame.frame))
    throw Error("{} is there, and is not the result of an earlier call on this frame; name the result with -o OUT.exr",
                out.string());
  return out.string();
}

}  // namespace gloam::cli
