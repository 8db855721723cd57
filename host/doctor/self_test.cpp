#include "doctor/self_test.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "gloam/error.h"
#include "stress/frames.h"
#include "stress/modules.h"
#include "stress/outputs.h"

namespace gloam::doctor {
namespace {

constexpr int width = 80, height = 60;
constexpr int kept_values = 61;  ///< of each channel; no divisor of the width, so that they lie in all columns
/// Values that may be further from the known ones than `tolerance` on a device that rounds otherwise: there a sample falls on the
/// neighbouring pixel now and then.
constexpr double tolerance = 1e-3, most_beyond = 0.05;

Settings settings_of(const Json& object) {
  Settings settings;
  for (const auto& [name, value] : object.items()) settings.emplace_back(name, value.get<std::string>());
  return settings;
}

SelfTest test_of(const Json& row) {
  SelfTest test{.kind = row.at("kind")};
  test.request.outputs = {row.at("technique").get<std::string>()};
  test.request.preset = row.value("preset", "");
  test.request.filter = row.value("filter", "");
  test.request.only = row.value("only", "");
  test.request.adaptive = row.value("adaptive", "");
  test.request.resolution = row.value("resolution", 1);
  test.request.temporal = row.value("temporal", false);
  if (row.contains("settings")) test.request.settings = settings_of(row.at("settings"));
  test.options.math = row.value("math", "precise") == "fast" ? Math::fast : Math::precise;
  test.options.real = row.value("real", "float") == "double" ? Real::float64 : Real::float32;
  test.of_modules = row.value("frame", "room") == "modules";
  if (row.contains("expected")) test.expected = row.at("expected");
  return test;
}

Frame frame_for(const SelfTest& test) {
  if (test.of_modules) return stress::shoot_modules(stress::flat_display(), width, height, stress::room());
  Frame frame = stress::shoot(stress::perspective(width, height), stress::room());
  for (View& view : frame.views) view.camera_before = view.camera;
  return frame;
}

Frame outputs_of(const SelfTest& test, Device& device) {
  Frame frame = frame_for(test);
  const Plan plan = stress::plan_for(test.request, frame);
  return std::move(run(plan, frame, device, test.options).frame);
}

/// One channel of a result, and what the table calls it.
struct NamedChannel {
  std::string name;  ///< "ao_raw", "second/normal.2"
  const Channel* channel;
};

std::vector<NamedChannel> channels_of(const Frame& frame) {
  std::vector<NamedChannel> all;
  for (const View& view : frame.views) {
    for (const auto& [name, plane] : view.planes) {
      for (size_t i = 0; i < plane.channels.size(); ++i) {
        const std::string of_view = frame.views.size() > 1 ? view.name + "/" + name : name;
        all.push_back({plane.channels.size() > 1 ? fmt::format("{}.{}", of_view, i) : of_view, &plane.channels[i]});
      }
    }
  }
  return all;
}

std::string bits_of(const std::vector<NamedChannel>& channels) {
  uint64_t hash = hash_of("");
  for (const NamedChannel& named : channels) {
    const Layout& layout = named.channel->layout();
    for (int y = 0; y < layout.height; ++y)
      hash =
          hash_of({reinterpret_cast<const char*>(named.channel->row(y)), size_t(layout.width) * sizeof(float)}, hash);
  }
  return fmt::format("{:016x}", hash);
}

/// Values at even distances. Infinite ones, background, become a large number: JSON has no infinity.
std::vector<double> values_of(const Channel& channel) {
  const Layout& layout = channel.layout();
  const int pixels = layout.width * layout.height, count = std::min(kept_values, pixels);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const int pixel = int((long long)(i)*pixels / count);
    const double value = channel.at(pixel % layout.width, pixel / layout.width);
    values.push_back(std::isfinite(value) ? std::round(value * 1e4) / 1e4 + 0.0 : 1e30);  // + 0: no -0
  }
  return values;
}

bool is_near(double value, double known) {
  return std::abs(value - known) <= tolerance * std::max(1.0, std::abs(known));
}

/// What is wrong with a channel; empty if nearly all of its values are near the known ones.
std::string why_wrong(const NamedChannel& named, const Json& known) {
  if (!known.contains(named.name)) return fmt::format("{} is a plane that the table lacks", named.name);
  const std::vector<double> values = values_of(*named.channel),
                            expected = known.at(named.name).get<std::vector<double>>();
  if (values.size() != expected.size())
    return fmt::format("{} has {} values, not {}", named.name, values.size(), expected.size());
  size_t beyond = 0, worst = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    beyond += !is_near(values[i], expected[i]);
    if (std::abs(values[i] - expected[i]) > std::abs(values[worst] - expected[worst])) worst = i;
  }
  if (double(beyond) <= most_beyond * double(values.size())) return "";
  return fmt::format("{} of {} values of {} are wrong, such as {:.6g} in place of {:.6g}", beyond, values.size(),
                     named.name, values[worst], expected[worst]);
}

Outcome outcome_of(const SelfTest& test, const Frame& frame, const DeviceInfo& info) {
  const std::vector<NamedChannel> channels = channels_of(frame);
  Outcome outcome;
  outcome.same_bits = bits_of(channels) == test.expected.at("bits");
  for (const NamedChannel& named : channels) {
    if (outcome.why.empty()) outcome.why = why_wrong(named, test.expected.at("values"));
  }
  const bool needs_bits = test.options.math == Math::precise && (info.rounds_correctly || info.type == "cpu");
  if (outcome.why.empty() && needs_bits && !outcome.same_bits)
    outcome.why = "values are near the known ones, but have other bits";
  outcome.held = outcome.why.empty();
  return outcome;
}

Json parsed(const std::string& table) {
  Json document = Json::parse(table, nullptr, false);
  if (!document.is_object()) throw Error("the table of self-tests is no JSON object");
  return document;
}

}  // namespace

std::vector<SelfTest> self_tests(const std::string& table) {
  const Json document = parsed(table);
  try {
    std::vector<SelfTest> tests;
    for (const Json& row : document.at("tests")) tests.push_back(test_of(row));
    return tests;
  } catch (const Json::exception& error) {
    throw Error("the table of self-tests cannot be read: {}", error.what());
  }
}

std::vector<SelfTest> self_tests(const std::string& table, const DeviceInfo& info) {
  std::vector<SelfTest> tests = self_tests(table);
  if (!info.has_double) std::erase_if(tests, [](const SelfTest& test) { return test.options.real == Real::float64; });
  return tests;
}

std::string measured_technique(const std::string& table) { return parsed(table).value("measured", ""); }

Outcome examine(const SelfTest& test, Device& device) {
  try {
    return outcome_of(test, outputs_of(test, device), device.info());
  } catch (const Error& error) {
    return {.why = error.what()};
  } catch (const Json::exception&) {
    return {.why = "the table has no figures for this test"};
  }
}

Json figures_of(const SelfTest& test, Device& device) {
  const Frame frame = outputs_of(test, device);
  const std::vector<NamedChannel> channels = channels_of(frame);
  Json values = Json::object();
  for (const NamedChannel& named : channels) values[named.name] = values_of(*named.channel);
  return {{"bits", bits_of(channels)}, {"values", values}};
}

}  // namespace gloam::doctor
