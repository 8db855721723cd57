// Settings of techniques: any names and values make a plan whose passes can be launched, or are refused in one line.
//
// An input is lines: the technique, then NAME=VALUE for a setting, and "--what=VALUE" for other options of a user.
#include <cmath>
#include <sstream>

#include "fuzz/promise.h"
#include "fuzz/target.h"
#include "fuzz/words.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "gloam/technique.h"

namespace gloam::fuzz {
namespace {

// --- From text to a request

void ask(PlanRequest& request, const std::string& name, const std::string& value) {
  if (name == "--preset")
    request.preset = value;
  else if (name == "--then")
    request.filter = value;
  else if (name == "--with")
    request.with.push_back(value);
  else if (name == "--outputs")
    request.only_outputs.push_back(value);
  else if (name == "--only")
    request.only = value;
  else if (name == "--elsewhere")
    request.elsewhere = value;
  else if (name == "--adaptive")
    request.adaptive = value;
  else if (name == "--resolution")
    request.resolution = value == "half" ? 2 : value == "quarter" ? 4 : 1;
  else
    request.settings.emplace_back(name, value);
}

PlanRequest request_of(const std::string& text) {
  PlanRequest request;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  request.outputs = {line};
  while (std::getline(lines, line)) {
    const size_t equals = std::min(line.find('='), line.size());
    ask(request, line.substr(0, equals), line.substr(std::min(equals + 1, line.size())));
  }
  return request;
}

// --- Properties

bool is_within(const Parameter& parameter, double value) {
  // Compared as floats, which may exceed the bound by rounding.
  return value >= double(float(parameter.min)) && value <= double(float(parameter.max));
}

/// Values keep their range, and their text reads back as the same value.
void check_values(const ParameterValues& values) {
  ParameterValues again(values.table());
  for (const Parameter& parameter : values.table()) {
    require(is_within(parameter, values.number(parameter.name)), "a value is within its range");
    again.set(parameter.name, values.text(parameter.name), "again");
    require(again.number(parameter.name) == values.number(parameter.name), "a value reads as it is written");
  }
}

void check_technique(const Technique& technique, const ParameterValues& values) {
  if (technique.samples) require(technique.samples(values) > 0, "a pixel takes a sample or more");
  if (technique.key_views) require(technique.key_views(values) >= 1, "every view or every so many is a key view");
  if (!technique.contribution) return;
  for (const double distance : {0.0, 0.5, 1.0})
    for (const double cosine : {1e-3, 0.5, 1.0})
      require(technique.contribution(values, cosine, distance) >= 0, "an occluder takes away, or nothing");
}

void check_pass(const Pass& pass) {
  require(!pass.kernel.empty() && !pass.writes.empty(), "a pass has a kernel and makes something");
  require(pass.scale >= 1 && pass.scale <= 1 << 10, "a pass has a scale that images have");
  for (const auto& [argument, numbers] : pass.tables)
    for (const float number : numbers) require(std::isfinite(number), "a table's numbers are finite");
}

void plan_everything(const std::string& text) {
  static const std::vector<std::string> available = all_plane_names(3);
  const Plan plan = make_plan(request_of(text), available, "the file has everything");
  for (const PlannedPass& planned : plan.passes) {
    check_pass(planned.pass);
    check_values(planned.values);
    check_technique(*planned.technique, planned.values);
  }
}

// --- Damage

std::string any_value(const Parameter& parameter, Random& random) {
  switch (random.below(6)) {
    case 0:
      return fmt::format("{}", odd_number(random));
    case 1:
      return std::to_string(odd_whole_number(random));
    case 2:
      return odd_word(random);
    case 3:
      return fmt::format("{}", random.one_in(2) ? parameter.min : parameter.max);
    default:
      if (parameter.type == Parameter::Type::choice) return random.pick(parameter.choices);
      if (parameter.type == Parameter::Type::boolean) return random.pick({"on", "off", "true", "0"});
      return random.one_in(2) ? std::to_string(random.between(0, 40))
                              : fmt::format("{}", random.between(0, 400) / 100.0);
  }
}

std::string any_name(Random& random) { return random.pick(registry()).name; }

std::string any_setting(const std::string& name, Random& random) {
  const auto same = [&](const Technique& t) { return t.name == name; };
  const auto found = std::find_if(registry().begin(), registry().end(), same);
  const Technique& technique = found == registry().end() || random.one_in(8) ? random.pick(registry()) : *found;
  if (technique.parameters.empty()) return "radius=1";
  const Parameter& parameter = random.pick(technique.parameters);
  const std::string prefix = random.one_in(8) ? technique.name + "." : "";
  return prefix + parameter.name + "=" + any_value(parameter, random);
}

std::string any_request(Random& random) {
  const std::string flag =
      random.pick({"--preset", "--then", "--with", "--outputs", "--only", "--elsewhere", "--adaptive", "--resolution"});
  if (flag == "--preset" || flag == "--adaptive")
    return flag + "=" + random.pick({"low", "medium", "high", "ultra", "hi"});
  if (flag == "--resolution") return flag + "=" + random.pick({"half", "quarter", "full"});
  if (flag == "--with" || flag == "--outputs") return flag + "=" + random.pick(plane_kinds()).name;
  return flag + "=" + (random.one_in(8) ? odd_word(random) : any_name(random));
}

std::string damaged(const std::string& text, Random& random) {
  const std::string name = text.substr(0, text.find('\n'));
  switch (random.below(8)) {
    case 0:
      return mutated(text);
    case 1:
      return any_name(random) + text.substr(name.size());
    case 2:
      return text + "\n" + any_request(random);
    case 3:
      return text.substr(0, text.rfind('\n'));
    default:
      return text + "\n" + any_setting(name, random);
  }
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const Technique& technique : registry()) {
    texts.push_back(technique.name);
    for (const Preset& preset : technique.presets) texts.push_back(technique.name + "\n--preset=" + preset.name);
  }
  return texts;
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  reads("", [&] { plan_everything({reinterpret_cast<const char*>(data), size}); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace gloam::fuzz;
  gloam::Random random(seed);
  return put(damaged({reinterpret_cast<const char*>(data), size}, random), data, most);
}
