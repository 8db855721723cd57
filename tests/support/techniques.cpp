#include "support/techniques.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>

#include "gloam/error.h"
#include "support/long.h"

namespace gloam::test {
namespace {

/// Set by tests/CMakeLists.txt for tests that need no second device.
constexpr const char* one_opencl = "GLOAM_ONE_OPENCL";

/// Must be called before the first OpenCL call of the process.
void switch_on_rusticl() {
  if (!std::getenv(one_opencl)) setenv("RUSTICL_ENABLE", "llvmpipe", 0);
}

}  // namespace

Device& device(const std::string& text) {
  switch_on_rusticl();
  // Never closed: when statics are destroyed, some OpenCL drivers are gone already.
  static auto& open = *new std::map<std::string, Device*>;
  Device*& found = open[text];
  if (!found) found = new Device(text);
  return *found;
}

bool has_device(const std::string& text) {
  if (std::getenv(one_opencl))
    throw Error("has_device: {} is set, so '{}' is not looked for; tests that need it are called *SecondDevice*",
                one_opencl, text);
  switch_on_rusticl();
  const std::vector<DeviceInfo> all = list_devices();
  return std::any_of(all.begin(), all.end(),
                     [&](const DeviceInfo& info) { return info.name.find(text) != std::string::npos; });
}

Frame outputs_of(const Technique& technique, Frame& frame, const Settings& settings, const RunOptions& options,
                 const std::string& device_name) {
  return stress::outputs_of(technique, frame, settings, options, device(device_name));
}

std::vector<std::string> unfiltered_extras(const Technique& technique) {
  std::vector<std::string> names;
  for (const Pass& pass : technique.passes(ParameterValues(technique.parameters))) {
    for (const Binding& extra : pass.extras) {
      if (!pass.writes.empty() && extra.plane == extra.argument) names.push_back(extra.plane);
    }
  }
  return names;
}

void invent_for_extras(const Technique& technique, Frame& frame) {
  for (const auto& [unused, plane] : technique.read_for_extras) {
    if (!frame.views[0].find(plane)) invent_plane(frame, plane);
  }
}

bool is_only_variant(const Technique& technique) { return !is_long_run() && !technique.variant.of.empty(); }

std::string identifier(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      text += c;
    else
      text += c == '+' ? "_plus" : "_";
  }
  return text;
}

}  // namespace gloam::test
