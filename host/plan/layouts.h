// Memory layouts of the planes of a plan.
#pragma once

#include <map>
#include <set>
#include <string>

#include "gloam/frame.h"
#include "gloam/plan.h"

namespace gloam {

bool writes(const Pass& pass, const std::string& plane);

/// Every plane and stack that a plan's passes touch.
std::set<std::string> planes_of(const Plan& plan);

/// The planes that passes use as lists (`Binding::starts_empty`).
std::set<std::string> lists_of(const Plan& plan);

/// Number of planes of one channel that share a buffer: the layers of a stack; 1 for other planes.
size_t layers_in_buffer(const Plan& plan, const std::string& name);

/// Rows in such a buffer beyond those of its layers (`Binding::more_rows`).
size_t more_rows_in_buffer(const Plan& plan, const std::string& name);

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

/// The one scale other than the pass's own among the planes of its view that it binds; 0 if there is none. Throws Error if there
/// are two.
int other_scale(const PlannedPass& planned, const Layouts& layouts);

/// Bytes of one of a plane's buffers, and of the plane or stack.
unsigned long long bytes_of_buffer(const Plan& plan, const Layouts& layouts, const std::string& name);
unsigned long long bytes_of(const Plan& plan, const Layouts& layouts, const std::string& name);

/// Whether passes of one of two views read the other.
bool needs_two_views(const Plan& plan);

/// Whether some views are key views that others read.
bool looks_into_key_views(const Plan& plan);

/// Distance between key views in a frame of this many views; 1 if there are none.
int key_view_spacing(const Plan& plan, size_t views);

/// Number of views that are on the device together: those that read one another.
size_t views_at_once(const Plan& plan, size_t views);

}  // namespace gloam
