// How the planes of a plan lie in memory.
#pragma once

#include <map>
#include <set>
#include <string>

#include "gloam/frame.h"
#include "gloam/plan.h"

namespace gloam {

/// Every plane and stack that a plan's passes touch.
std::set<std::string> planes_of(const Plan& plan);

/// Planes of one channel each that lie in one buffer: the layers of a stack; 1 for all else.
size_t layers_in_buffer(const Plan& plan, const std::string& name);

/// The layouts of a plan's planes on an image.
class Layouts {
 public:
  Layouts(const Plan& plan, const Layout& whole) : whole_(whole), scales_(plane_scales(plan)) {}
  Layout of(const std::string& plane) const { return reduced(whole_, scale_of(plane)); }
  /// Pixels of the image per pixel of the plane, along each axis.
  int scale_of(const std::string& plane) const;

 private:
  Layout whole_;
  std::map<std::string, int> scales_;
};

/// The one scale beside the pass's own among the planes that the pass binds of its view; 0 where there is none. Throws Error
/// where there are two.
int other_scale(const PlannedPass& planned, const Layouts& layouts);

/// Bytes of a plane or stack.
unsigned long long bytes_of(const Plan& plan, const Layouts& layouts, const std::string& name);

/// Whether passes look from one of two views into the other.
bool needs_two_views(const Plan& plan);

/// Whether some views are key views that others look into.
bool looks_into_key_views(const Plan& plan);

/// Every how many views of a frame of so many one is a key view; 1 where all are alike.
int key_view_spacing(const Plan& plan, size_t views);

/// How many of a frame's views are on the device together: those that look into one another.
size_t views_at_once(const Plan& plan, size_t views);

}  // namespace gloam
