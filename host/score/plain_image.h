// Images of a submission brought to gloam's convention: at the frame's size, open is 1 and closed is 0.
#pragma once

#include <string>
#include <vector>

#include "measure/measures.h"
#include "score/entry.h"
#include "score/stored_image.h"

namespace gloam::score {

/// Undoes the convention that an entry states, in place. `file`: for messages.
void undo(const Convention& convention, const std::string& effect, StoredImage& stored);

/// Throws Error, naming the file, unless the image has the frame's size divided by the scale, rounded up or down.
void check_size(int width, int height, int scale, const Layout& frame, const std::string& file);

/// An image of a lower resolution at the frame's size: between the centres of its pixels, linearly. Values that are not finite and
/// pixels that cover no surface do not count.
bench::Image enlarged(const bench::Image& image, int scale, const Layout& frame, const bench::Foreground& foreground);

/// The mean of a truth's surfaces under each pixel of a lower resolution, and where there is one.
struct Reduced {
  bench::Image image;
  bench::Foreground foreground;
};
Reduced reduced_truth(const bench::Image& truth, const bench::Foreground& foreground, int scale, const Layout& small);

/// Clamps a plane from 0 to 1 on the foreground, and returns how many pixels that changed. Throws Error, naming the file, where so many
/// are outside that the range has another meaning.
long long clamp_shares(bench::Image& image, const bench::Foreground& foreground, const std::string& file);

}  // namespace gloam::score
