#include "run/own_folder.h"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <deque>

#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Name of a user, or the number of one without a name.
std::string name_of_user(uid_t user) {
  const passwd* found = getpwuid(user);
  return found ? found->pw_name : fmt::format("number {}", user);
}

/// Whether a user can be trusted with what is run here: root, and who owns the root of the file system, can replace everything anyway.
bool is_trusted(uid_t owner) {
  static const uid_t owner_of_root = [] {
    struct stat about {};
    return ::stat("/", &about) == 0 ? about.st_uid : 0;
  }();
  return owner == 0 || owner == geteuid() || owner == owner_of_root;
}

/// Whether a group has this user alone: many systems give each user such a group, and let it write.
bool is_private_group(gid_t number) {
  const passwd* user = getpwuid(geteuid());
  if (!user || user->pw_gid != number) return false;
  const std::string name = user->pw_name;
  const group* found = getgrgid(number);
  if (!found || name != found->gr_name) return false;
  for (char** member = found->gr_mem; *member; ++member) {
    if (name != *member) return false;
  }
  return true;
}

bool has_access_list(const fs::path& folder) {
  return ::lgetxattr(folder.c_str(), "system.posix_acl_access", nullptr, 0) > 0;
}

bool others_may_write(const fs::path& folder, const struct stat& about) {
  if (about.st_mode & S_IWOTH) return true;
  if (!(about.st_mode & S_IWGRP)) return false;
  return has_access_list(folder) || !is_private_group(about.st_gid);
}

/// A folder on the way may be one where all make files, if only their owners can rename them (/tmp).
std::string why_not_ours(const fs::path& folder, const struct stat& about, bool is_last) {
  const std::string name = folder.string();
  if (is_last && about.st_uid != geteuid())
    return fmt::format("{} belongs to user {}", name, name_of_user(about.st_uid));
  if (!is_trusted(about.st_uid)) return fmt::format("{} belongs to user {}", name, name_of_user(about.st_uid));
  const bool keeps_files_of_others = !is_last && (about.st_mode & S_ISVTX);
  if (others_may_write(folder, about) && !keeps_files_of_others)
    return fmt::format("{} can be written by others (mode {:o})", name, about.st_mode & 07777);
  return "";
}

}  // namespace

std::string why_not_ours(const fs::path& folder) {
  constexpr int most_links = 40;  // Linux follows as many
  std::error_code failed;
  const fs::path whole = fs::absolute(folder, failed);
  std::deque<fs::path> left(whole.begin(), whole.end());
  fs::path at;
  for (int links = 0; !left.empty();) {
    const fs::path part = left.front();
    left.pop_front();
    if (part.empty() || part == ".") continue;
    if (part == "..") {
      at = at.parent_path();
      continue;
    }
    const fs::path next = at / part;
    struct stat about {};
    if (::lstat(next.c_str(), &about) != 0) {
      if (errno != ENOENT) return next.string() + " cannot be looked at";
      // A name above a missing one leads elsewhere once that is made.
      const bool leads_back = std::find(left.begin(), left.end(), fs::path("..")) != left.end();
      return leads_back ? next.string() + " is missing, and the name leads back out of it" : "";
    }
    if (S_ISLNK(about.st_mode)) {
      if (!is_trusted(about.st_uid))
        return fmt::format("the link {} belongs to user {}", next.string(), name_of_user(about.st_uid));
      if (++links > most_links) return next.string() + " leads nowhere";
      const fs::path target = fs::read_symlink(next, failed);
      left.insert(left.begin(), target.begin(), target.end());
      if (target.is_absolute()) at.clear();
      continue;
    }
    const bool is_last =
        std::all_of(left.begin(), left.end(), [](const fs::path& more) { return more.empty() || more == "."; });
    if (std::string why = why_not_ours(next, about, is_last); !why.empty()) return why;
    at = next;
  }
  return "";
}

std::string why_not_ours_once_made(const fs::path& folder) {
  std::string why = why_not_ours(folder);
  if (!why.empty() || fs::exists(folder)) return why;
  // In a folder that all users may write into, another one may make it before a driver does.
  fs::path there = fs::absolute(folder);
  while (there.has_relative_path() && !fs::exists(there)) there = there.parent_path();
  struct stat about {};
  if (::stat(there.c_str(), &about) == 0 && (about.st_mode & S_ISVTX)) make_own_folder(folder);
  return why_not_ours(folder);
}

bool make_own_folder(const fs::path& folder) {
  std::error_code unknown;
  if (fs::is_directory(folder, unknown)) return true;
  const fs::path above = folder.parent_path();
  if (!above.empty() && above != folder && !make_own_folder(above)) return false;
  return ::mkdir(folder.c_str(), 0700) == 0 || fs::is_directory(folder, unknown);
}

}  // namespace gloam
