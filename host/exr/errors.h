// Errors about an EXR file, which name the file.
#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "gloam/error.h"

namespace gloam {

/// OpenEXR's message on one line, without the file's name, which the caller puts before it.
std::string cause(const std::exception& error, const std::filesystem::path& path);

/// Runs work that calls OpenEXR. Any exception of it becomes an Error of one line that names the file.
template <typename Work>
auto guarded(const std::filesystem::path& path, Work&& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error("{}: not enough memory to read it", path.string());
  } catch (const std::exception& error) {
    throw Error("{}: truncated or corrupted EXR ({}); render or copy it again", path.string(), cause(error, path));
  }
}

/// Adds the file's name to an error about the file's contents.
template <typename Work>
auto named(const std::filesystem::path& path, Work&& work) {
  try {
    return work();
  } catch (const UsageError& error) {
    throw UsageError("{}: {}", path.string(), error.what());
  } catch (const Error& error) {
    throw Error("{}: {}", path.string(), error.what());
  }
}

}  // namespace gloam
