// Documents that tell what was assumed.
#pragma once

#include <nlohmann/json.hpp>

namespace gloam::cli {

/// An object with the notes so far as "notes", unless it has some.
nlohmann::ordered_json noted(nlohmann::ordered_json document);

}  // namespace gloam::cli
