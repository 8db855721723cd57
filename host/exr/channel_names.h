// The planes that the channels of a file hold, by their names.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// A channel as the headers list it.
struct FileChannel {
  int part = 0;
  std::string part_view;  ///< attribute `view` of its part; "" if there is none
  std::string part_name;  ///< attribute `name` of its part
  std::string name;       ///< full name in the file
  std::string type;       ///< "half", "float" or "uint"
};

/// The eye in the name of a part, alone or beside other words: "right", "beauty.left", "depth_R"; else empty.
std::string eye_in_name(const std::string& part_name);

/// The meaning of the channel names of a file.
struct NamedPlanes {
  std::vector<std::string> views;   ///< views with channels, and views asked for; one empty name if the file names none
  std::vector<PlaneSource> planes;  ///< by view, then in the order of plane_kinds()
  std::map<std::string, std::vector<std::string>> assumed;  ///< by plane: a sentence for each choice among equals
  bool view_is_assumed = false;  ///< several views are listed, no channel names one, and the user names none
};

/// The user's choices (see ReadOptions).
struct NameOptions {
  std::vector<std::string> views;
  std::map<std::string, std::string> channels;
};

/// Pure: the same names give the same planes. Channels are taken in file order, which decides among equals.
/// Throws UsageError for a plane that does not exist, Error for a view or channel that the file does not hold.
NamedPlanes name_planes(const std::vector<FileChannel>& channels, const std::vector<std::string>& multi_view,
                        const NameOptions& options = {});

/// Throws UsageError if no plane has the name that this flag gives.
void check_plane_name(const std::string& plane, const char* flag);

}  // namespace gloam
