#include "sequence/auto_files.h"

#include <algorithm>

#include "base/lists.h"
#include "exr/holdings.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

bool is_of_display(const FrameFiles& files) {
  for (const FrameFile& file : files.files()) {
    for (const std::string& view : file.views()) {
      const std::optional<Camera> camera = file.camera(view);
      if (camera && camera->slits) return true;
    }
  }
  return false;
}

FrameFacts facts_of(const FrameFiles& files) {
  return {.name = files.name(),
          .planes = files.common_planes(),
          .holds = holdings(files),
          .width = files.window().width(),
          .height = files.window().height(),
          .views = files.views().size(),
          .is_of_display = is_of_display(files)};
}

std::string text_of(const FrameFiles& files, const char* attribute) {
  for (const FrameFile& file : files.files()) {
    if (std::string text = file.text_attribute(attribute); !text.empty()) return text;
  }
  return "";
}

}  // namespace

AutoFrame planned_auto(FrameFiles files, const PlanRequest& asked, const AutoPurpose& purpose,
                       const std::vector<Unfit>& unfit) {
  AutoPlan planned = plan_auto(facts_of(files), asked, purpose, unfit);
  return {std::move(planned), std::move(files)};
}

void check_has_depth(const AutoFrame& planned, const std::string& out) {
  if (out.empty() || contains(planned.files.common_planes(), "depth")) return;
  throw Error(
      "{}: has no depth, so that no effect can be computed and {} would be empty; give a frame with depth, or {} alone",
      planned.files.name(), out, option("composite"));
}

Frame read_and_judge(AutoFrame& planned, const PlanRequest& asked, const AutoPurpose& purpose) {
  Frame frame = planned.files.read(planned.planes);
  judge(planned, frame.assumed, asked, purpose);
  for (View& view : frame.views) {
    for (const Unfit& each : planned.unfit)
      if (each.plane != "color") view.planes.erase(each.plane);
  }
  return frame;
}

ColorHolds holds_of(const FrameFiles& files, std::vector<std::string>& notes) {
  const std::string stated = text_of(files, color_holds_attribute);
  if (!stated.empty()) return parse_color_holds(stated, fmt::format("{}: {}", files.name(), color_holds_attribute));
  notes.push_back(note_on_assumed_holds());
  return {};
}

}  // namespace gloam
