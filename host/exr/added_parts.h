// Parts that gloam adds to a copy of a file of others.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <string>

namespace gloam {

/// "gloam.ao", or "gloam.ao.left" for one of several views.
std::string added_part_name(const std::string& content, const std::string& view);

/// Whether a part was added: its attributes then describe its own channels, and not those of the file around it.
bool is_added_part(const Imf::Header& header);

/// Whether it was added for this content, in any view.
bool is_added_for(const Imf::Header& header, const std::string& content);

}  // namespace gloam
