// The colour maps of the page, as OpenCV has them: the same as in gloam's pictures.
#pragma once

#include <nlohmann/json.hpp>

namespace gloam::viewer {

/// Name -> 256 colours, from the least to the greatest value, as text of six hexadecimal digits each.
nlohmann::ordered_json colour_tables();

}  // namespace gloam::viewer
