#include "shot/planned_frame.h"

#include <algorithm>

#include "base/lists.h"
#include "exr/holdings.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "sequence/plan_files.h"
#include "shot/memory.h"

namespace gloam {
namespace {

/// Planes of the list that every view of the frame still has, or will have.
std::vector<std::string> planes_left(const Frame& frame, const std::vector<std::string>& planes, bool expects_history) {
  std::vector<std::string> left;
  for (const std::string& plane : planes) {
    const bool everywhere =
        std::all_of(frame.views.begin(), frame.views.end(), [&](const View& view) { return view.find(plane); });
    if (everywhere || (expects_history && is_of_history(plane))) left.push_back(plane);
  }
  return left;
}

/// The radius of a map of relevant surfaces in a file, where its header says it.
std::optional<double> radius_of_map(const FrameFile& file) {
  const std::optional<double> captured = file.number_attribute("gloamStochasticRadius");
  return captured ? captured : radius_of_relevant(file.text_attribute("gloamParameters"));
}

}  // namespace

void plan_again(PlannedFrame& planned, bool carries_depth) {
  planned.plan = plan_for_files(planned.files, planned.request);
  planned.planes = planned.plan.inputs;
  if (carries_depth && contains(planned.files.common_planes(), "depth")) add_new(planned.planes, "depth");
}

PlannedFrame planned_frame(FrameFiles files, const PlanRequest& request, bool carries_depth) {
  PlannedFrame planned{std::move(files), request, {}, {}, {}};
  if (request.temporal && !planned.files.history()) planned.files.expect_history();
  plan_again(planned, carries_depth);
  return planned;
}

void keep_first_output(PlannedFrame& planned, bool carries_depth) {
  PlanRequest& request = planned.request;
  if (!request.only_outputs.empty()) return;
  request.only_outputs = {planned.plan.outputs.front()};
  add_new(request.only_outputs, request.with);
  plan_again(planned, carries_depth);
}

unsigned long long bytes_of_colour(const PlannedFrame& planned) {
  return planned.colour ? bytes_to_read(planned.colour->files, planned.colour->planes) : 0;
}

std::optional<Radius> settle(PlannedFrame& planned, const Frame& frame, std::vector<std::string>& notes) {
  const std::vector<std::string> left = planes_left(frame, planned.plan.inputs, planned.request.temporal);
  const std::string holds = holdings(planned.files);
  // If a plane turned out to be unusable (normals in the space of an unknown camera), make it instead.
  const bool is_all_left = left.size() == planned.plan.inputs.size();
  if (!is_all_left) planned.plan = make_plan(planned.request, left, holds);
  const std::optional<Radius> radius =
      settle_radius(planned.request, planned.plan, frame, stated_radius(planned.files.files().front(), notes),
                    is_all_left ? planned.files.common_planes() : left, holds);
  // Of maps that the plan makes, notes_about_views says it.
  if (const std::optional<double> of_map = radius_of_map(planned.files.files().front())) {
    if (const std::string warning = warning_about_map(planned.plan, of_map); !warning.empty()) notes.push_back(warning);
  }
  return radius;
}

std::vector<std::string> warning_about_history(const Frame& frame, const Frame& result, const std::string& who) {
  if (!knows_where_surfaces_were(frame))
    return {
        fmt::format("{}: neither a plane 'motion' nor the camera's pose tells where surfaces were in the frame before, "
                    "so that each "
                    "frame is computed by itself; give the camera of each frame ({})",
                    option("temporal"), option("camera"))};
  if (!goes_on_from_before(result)) return {who + "; accumulation begins anew"};
  return {};
}

void carry_over(Frame& from, Frame& to, const Carried& carried) {
  std::vector<std::string> planes;
  if (carried.depth) planes.push_back("depth");
  if (carried.depth && from.views.size() == 2) planes.push_back("normal");
  for (View& view : to.views) {
    if (!carried.cameras) view.camera.reset();
    std::map<std::string, Plane>& given = from.view(view.name).planes;
    for (const std::string& plane : planes) {
      if (!view.find(plane) && given.count(plane)) view.planes[plane] = std::move(given[plane]);
    }
  }
}

}  // namespace gloam
