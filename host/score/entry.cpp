#include "score/entry.h"

#include <cmath>

#include "base/files.h"
#include "base/json_object.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/technique.h"
#include "measure/effects.h"

namespace gloam::score {
namespace {

constexpr size_t longest_name = 60;

const std::vector<std::string> resolutions = {"full", "half", "quarter"};

std::optional<std::pair<double, double>> range_of(const JsonObject& fields) {
  if (!fields.find("range")) return {};
  const Json& given = *fields.find("range");
  const bool is_pair = given.is_array() && given.size() == 2 && given[0].is_number() && given[1].is_number();
  if (!is_pair || !std::isfinite(given[0].get<double>()) || !std::isfinite(given[1].get<double>()) ||
      given[0].get<double>() >= given[1].get<double>())
    fields.refuse("range", "a list of two numbers, the stored values of 0 and of 1, such as [0, 255], is allowed");
  return std::pair(given[0].get<double>(), given[1].get<double>());
}

Convention convention_of(const JsonObject& fields, const std::string& effect) {
  fields.check_keys({"inverted", "exponent", "strength", "range", "resolution", "radius", "falloff"});
  Convention convention;
  convention.inverted = fields.flag_if("inverted");
  convention.exponent = fields.number_if("exponent", 0.01, 100).value_or(1);
  convention.strength = fields.number_if("strength", 0.01, 100).value_or(1);
  convention.range = range_of(fields);
  const std::string resolution = fields.word_if("resolution", resolutions, "full");
  convention.scale = resolution == "full" ? 1 : resolution == "half" ? 2 : 4;
  convention.radius = fields.number_if("radius", 1e-30, 1e30);
  convention.falloff = fields.text_if("falloff");
  for (const char* key : {"inverted", "strength"}) {
    if (!is_share(effect) && (convention.inverted || convention.strength != 1) && fields.find(key))
      throw Error(
          "{}: {}: the effect is '{}', which has no largest value; only planes from 0 to 1 have a {}; leave it out",
          fields.file(), fields.path_of(key), effect, key == std::string("inverted") ? "inverse" : "strength");
  }
  return convention;
}

void read_times(const JsonObject& fields, Entry& entry) {
  constexpr double longest = 1e9;
  const Json* given = fields.find("time_ms");
  if (given && !given->is_object() && !given->is_number())
    fields.refuse("time_ms", "a number of milliseconds, or one for each item {\"ITEM\": 2.5}, is allowed");
  if (given && given->is_object()) {
    const JsonObject times = fields.object("time_ms");
    for (const auto& [item, time] : given->items())
      entry.times_ms[item] = times.number_if(item, 0, longest).value_or(0);
  } else {
    entry.time_ms = fields.number_if("time_ms", 0, longest);
  }
}

Json authors_of(const JsonObject& fields) {
  if (!fields.find("authors")) return nullptr;
  const Json& given = *fields.find("authors");
  const auto is_text = [](const Json& each) { return each.is_string(); };
  if (!given.is_string() && !(given.is_array() && std::all_of(given.begin(), given.end(), is_text)))
    fields.refuse("authors", "a text or a list of texts is allowed");
  return given;
}

void check_name(const JsonObject& fields, const std::string& name) {
  if (name.empty() || name.size() > longest_name || printable(name) != name)
    throw Error("{}: name is {}; a text of 1 to {} printable characters is required: {{\"name\": \"my method\"}}",
                fields.file(), fields.find("name") ? "'" + name + "'" : "missing", longest_name);
  if (contains(technique_names(), name))
    throw Error("{}: name is '{}', a technique of gloam itself; name the method apart from it, such as 'my {}'",
                fields.file(), name, name);
}

}  // namespace

std::optional<double> Entry::stated_time(const std::string& item) const {
  const auto own = times_ms.find(item);
  return own != times_ms.end() ? own->second : time_ms;
}

std::vector<std::string> scored_effects() {
  std::vector<std::string> effects = bench::effect_names();
  add_new(effects, "reflection");
  return effects;
}

bool is_share(const std::string& effect) { return plane_kind(effect).meaning == PlaneKind::unit_interval; }

Entry read_entry(const std::filesystem::path& file) { return entry_of(read_text(file), file.string()); }

Entry entry_of(const std::string& text, const std::string& path) {
  const Json document = json_of_text(text, path);
  const JsonObject fields(document, {.name = path, .document = "the entry"});
  fields.check_keys(
      {"name", "version", "link", "authors", "settings", "device", "time_ms", "effect", "convention", "licence"});
  Entry entry;
  entry.name = fields.text_if("name");
  check_name(fields, entry.name);
  entry.version = fields.text_if("version");
  entry.link = fields.text_if("link");
  entry.device = fields.text_if("device");
  entry.licence = fields.text_if("licence");
  entry.authors = authors_of(fields);
  if (const Json* settings = fields.find("settings")) {
    if (!settings->is_object()) fields.refuse("settings", "an object such as {\"samples\": 8} is allowed");
    entry.settings = *settings;
  }
  read_times(fields, entry);
  entry.effect = fields.word_if("effect", scored_effects(), "ao");
  entry.convention = convention_of(fields.object_if("convention"), entry.effect);
  return entry;
}

Json document_of(const Convention& convention) {
  Json range = nullptr;
  if (convention.range) range = Json::array({convention.range->first, convention.range->second});
  return {{"inverted", convention.inverted},
          {"exponent", convention.exponent},
          {"strength", convention.strength},
          {"range", range},
          {"resolution", resolutions[convention.scale == 1   ? 0
                                     : convention.scale == 2 ? 1
                                                             : 2]},
          {"radius", or_null(convention.radius)},
          {"falloff", or_null(convention.falloff)}};
}

}  // namespace gloam::score
