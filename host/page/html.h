// What the self-contained pages share that gloam writes: filling a template, data in a page, style and script.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace gloam::page {

/// Texts by the names of their places.
using Parts = std::map<std::string, std::string>;

/// The style and the scripts that pages share, by file name: files of host/page/, embedded at build time.
const Parts& shared_parts();

/// The template with each "@@name@@" replaced. The inserted text is not searched again: it may hold anything. Throws
/// std::out_of_range for a name without a text.
std::string filled(const std::string& page, const Parts& parts);

/// JSON for a script element: no text in it can end the element. Bytes that are not UTF-8 are replaced.
std::string script_text(const nlohmann::ordered_json& data);

/// Bytes as base64, padded.
std::string base64(std::string_view bytes);

}  // namespace gloam::page
