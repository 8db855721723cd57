// The buffers that a plan takes: which planes, how large, of how many views at the same time.
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
  int scale_of(const std::string& plane) const {
    const auto known = scales_.find(plane);
    return known == scales_.end() ? 1 : known->second;
  }

 private:
  Layout whole_;
  std::map<std::string, int> scales_;
};

/// Bytes of a plane or stack.
unsigned long long bytes_of(const Plan& plan, const Layouts& layouts, const std::string& name);

bool needs_two_views(const Plan& plan);

/// Every how many views of a plan one is a key view; 1 where all are alike.
int key_view_spacing(const Plan& plan);
/// The same of a frame of so many views.
int key_view_spacing(const Plan& plan, size_t views);

/// How many of a frame's views are on the device together.
size_t views_at_once(const Plan& plan, size_t views);

}  // namespace gloam
