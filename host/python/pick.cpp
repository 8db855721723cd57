// gloam.pick
#include "gloam/pick.h"

#include "python/bindings.h"
#include "python/interrupts.h"
#include "python/requests.h"

namespace gloam::python {
namespace {

template <typename Value>
void take(const py::dict& words, const char* name, Value& value) {
  if (!words[name].is_none()) value = py::cast<Value>(words[name]);
}

PickRequest pick_request(const py::dict& words, const py::dict& reading) {
  PickRequest request{.reading = read_options(reading)};
  request.goal = goal_of(words);
  request.radius = py::cast<std::optional<double>>(words["radius"]);
  request.seconds = py::cast<std::optional<double>>(words["seconds"]);
  request.truths = py::cast<std::vector<std::string>>(words["truths"]);
  take(words, "by", request.by);
  take(words, "techniques", request.techniques);
  take(words, "rays", request.rays);
  take(words, "rounds", request.rounds);
  return request;
}

/// The result's JSON, the radius with where it comes from, and the notes.
py::tuple pick_on(const std::string& frame, const py::dict& words, const py::dict& reading,
                  const std::shared_ptr<Device>& device) {
  PickRequest request = pick_request(words, reading);
  const PickResult result = without_lock([&](Interrupts& interrupts) {
    request.progress = [&](const std::string&, double) { interrupts.poll(); };
    return pick_setting(frame, request, *device);
  });
  return py::make_tuple(text_of(result.json), result.radius.value, name_of(result.radius.from), texts_of(result.notes));
}

}  // namespace

void add_pick(py::module_& module) { module.def("pick", &pick_on); }

}  // namespace gloam::python
