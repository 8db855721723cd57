#pragma once

#include <functional>
#include <string>

#include "gloam/error.h"

namespace gloam::test {

/// The message of the error that `work` throws.
inline std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace gloam::test
