// The channels of a file by view and layer.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "exr/channel_names.h"

namespace gloam::channel_names {

/// A channel with its view taken out of its name.
struct Entry {
  const FileChannel* file;
  std::string view;   ///< "": the name states no view
  bool named;         ///< the file states the view, by the part or by the name
  std::string layer;  ///< dotted path without view and component
  std::string component;
  std::string plain() const { return layer.empty() ? component : layer + "." + component; }
};

std::vector<Entry> entries_of(const std::vector<FileChannel>& channels, const std::vector<std::string>& multi_view);

/// Views in file order; one empty name if the file names none.
std::vector<std::string> views_of(const std::vector<Entry>& entries, const std::vector<std::string>& multi_view);

/// Channels of one layer of one part.
struct Layer {
  int part;
  bool shared;         ///< belongs to a part that names no view, while the file has views
  std::string path;    ///< as in the file
  std::string name;    ///< canonical form of the path's last piece, or of the part's name if the path is empty
  std::string prefix;  ///< path without its last piece: Blender's view layer
  std::map<std::string, const FileChannel*> components;  ///< by lower-case name
};

/// Layers of a view, in file order.
std::vector<Layer> layers_of(const std::vector<Entry>& entries, const std::string& view);

}  // namespace gloam::channel_names
