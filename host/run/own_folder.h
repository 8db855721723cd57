// Folders that hold code which is run: only those that nobody else can write into.
#pragma once

#include <filesystem>
#include <string>

namespace gloam {

/// Why somebody else could put files into a folder, or put another in its place: who owns it and who may write, of the folder, of those
/// around it, and of links on the way. Empty: only this user and root can. What is missing at the end of the path does not count: it is
/// made by `make_own_folder`.
std::string why_not_ours(const std::filesystem::path& folder);

/// The same. Where a folder is missing and all users may write into the one around it, makes it first, so that nobody else can.
std::string why_not_ours_once_made(const std::filesystem::path& folder);

/// Makes the missing folders of a path so that nobody else may write there. False if one cannot be made, or is no folder.
bool make_own_folder(const std::filesystem::path& folder);

}  // namespace gloam
