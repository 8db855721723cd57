// Planes that a renderer may have filled with one value: a reflectance of 1 for any surface, a roughness of 0 that no material gave.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "exr/file.h"
#include "gloam/frame.h"

namespace gloam {

/// Counts foreground pixels in which all components of a plane are exactly a value.
struct FilledPixels {
  float value = 0;
  long long filled = 0, surfaces = 0;
  /// `depth`: after `to_view_depth`, the whole image; `plane`: its rows from `first_row` on.
  void add(const Plane& plane, const Channel& depth, int first_row);
  /// Share of the foreground; 0 if there is none.
  double share() const { return surfaces > 0 ? double(filled) / double(surfaces) : 0; }
};

/// What is counted in one view of a file, in planes that the file alone chose: a user who names a channel means it.
class Fills {
 public:
  Fills(const ExrFile& file, const std::string& view);

  /// The planes to count.
  std::vector<std::string> planes() const;
  /// Counts the view's rows from `first_row` on. `depth`: the whole image.
  void add(const View& rows, const Channel& depth, int first_row);
  /// Adds a note for each plane that is unfit (frame/unfit.h).
  void note(Frame& frame) const;

 private:
  std::map<std::string, FilledPixels> counts_;  ///< by plane
};

/// Counts the whole view, and adds the notes. A view without depth tells nothing.
void note_fills(const ExrFile& file, const View& view, Frame& frame);

}  // namespace gloam
