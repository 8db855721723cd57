// Lines for people, as wide as their terminal.
#pragma once

#include <optional>
#include <string>

namespace gloam::cli {

/// The columns of a line for people: COLUMNS, else those of the terminal, also behind a pager. None where no terminal is: programs
/// find a sentence on one line.
std::optional<size_t> line_width();

/// Whether a column of text that begins there has room for its words.
bool has_room_from(size_t column);

/// The text with line breaks where it would pass the line's width: it begins in column `begin`, further lines in column `indent`.
/// Breaks nothing without a width, and no word; at least 24 columns are used.
std::string wrapped(const std::string& text, size_t begin, size_t indent);

}  // namespace gloam::cli
