// What gloam says of a camera, as JSON and in words.
#pragma once

#include <string>

#include "cli/options.h"

namespace gloam::cli {

/// The camera of a view whose image has this display window.
Json camera_document(const Camera& camera, const Window& display);

/// The same in one line.
std::string camera_line(const Json& camera);

}  // namespace gloam::cli
