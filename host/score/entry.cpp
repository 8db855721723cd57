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

/// An object of the entry.
class Fields : public JsonObject {
 public:
  Fields(const Json& object, std::string file, std::string place, const std::vector<std::string>& allowed)
      : JsonObject(object, std::move(file), std::move(place)) {
    if (!object.is_object())
      throw Error("{}: {} is {}, not an object such as {{\"name\": \"my method\"}}", this->file(),
                  place_or("the entry"), shown(object));
    for (const auto& [key, value] : object.items()) {
      if (!contains(allowed, key))
        throw Error("{}: no key '{}'{}; {} are allowed", this->file(), path_of(key), suggestion(key, allowed),
                    enumerate(allowed));
    }
  }

  bool has(const char* key) const { return find(key) != nullptr; }
  const Json& value(const char* key) const { return json().at(key); }

  std::string text(const char* key) const {
    if (!has(key)) return "";
    if (!value(key).is_string()) refuse(key, "a text");
    return value(key).get<std::string>();
  }

  bool truth_value(const char* key) const {
    if (!has(key)) return false;
    if (!value(key).is_boolean()) refuse(key, "true or false");
    return value(key).get<bool>();
  }

  std::optional<double> number(const char* key, double least, double most) const {
    if (!has(key)) return {};
    return number_of(value(key), key, least, most);
  }

  double number_of(const Json& given, const std::string& key, double least, double most) const {
    const bool is_number = given.is_number() && std::isfinite(given.get<double>());
    if (!is_number || given.get<double>() < least || given.get<double>() > most)
      throw Error("{}: {} is {}; a number from {:g} to {:g} is allowed", file(), path_of(key), shown(given), least,
                  most);
    return given.get<double>();
  }

  std::string word(const char* key, const std::vector<std::string>& words, const std::string& usual) const {
    if (!has(key)) return usual;
    const std::string given = text(key);
    if (!contains(words, given)) refuse(key, enumerate(words) + suggestion(given, words));
    return given;
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const {
    throw Error("{}: {} is {}; {} is allowed", file(), path_of(key), shown(json().at(key)), allowed);
  }
};

const std::vector<std::string> resolutions = {"full", "half", "quarter"};

std::optional<std::pair<double, double>> range_of(const Fields& fields) {
  if (!fields.has("range")) return {};
  const Json& given = fields.value("range");
  const bool is_pair = given.is_array() && given.size() == 2 && given[0].is_number() && given[1].is_number();
  if (!is_pair || !std::isfinite(given[0].get<double>()) || !std::isfinite(given[1].get<double>()) ||
      given[0].get<double>() >= given[1].get<double>())
    fields.refuse("range", "a list of two numbers, the stored values of 0 and of 1, such as [0, 255],");
  return std::pair(given[0].get<double>(), given[1].get<double>());
}

Convention convention_of(const Json& object, const std::string& file, const std::string& effect) {
  const Fields fields(object, file, "convention",
                      {"inverted", "exponent", "strength", "range", "resolution", "radius", "falloff"});
  Convention convention;
  convention.inverted = fields.truth_value("inverted");
  convention.exponent = fields.number("exponent", 0.01, 100).value_or(1);
  convention.strength = fields.number("strength", 0.01, 100).value_or(1);
  convention.range = range_of(fields);
  const std::string resolution = fields.word("resolution", resolutions, "full");
  convention.scale = resolution == "full" ? 1 : resolution == "half" ? 2 : 4;
  convention.radius = fields.number("radius", 1e-30, 1e30);
  convention.falloff = fields.text("falloff");
  for (const char* key : {"inverted", "strength"}) {
    if (!is_share(effect) && (convention.inverted || convention.strength != 1) && fields.has(key))
      throw Error(
          "{}: {}: the effect is '{}', which has no largest value; only planes from 0 to 1 have a {}; leave it out",
          file, fields.path_of(key), effect, key == std::string("inverted") ? "inverse" : "strength");
  }
  return convention;
}

void read_times(const Fields& fields, Entry& entry) {
  constexpr double longest = 1e9;
  if (!fields.has("time_ms")) return;
  const Json& given = fields.value("time_ms");
  if (!given.is_object()) {
    if (!given.is_number()) fields.refuse("time_ms", "a number of milliseconds, or one for each item {\"ITEM\": 2.5},");
    entry.time_ms = fields.number_of(given, "time_ms", 0, longest);
    return;
  }
  for (const auto& [item, time] : given.items())
    entry.times_ms[item] = fields.number_of(time, "time_ms." + item, 0, longest);
}

Json authors_of(const Fields& fields) {
  if (!fields.has("authors")) return nullptr;
  const Json& given = fields.value("authors");
  const auto is_text = [](const Json& each) { return each.is_string(); };
  if (!given.is_string() && !(given.is_array() && std::all_of(given.begin(), given.end(), is_text)))
    fields.refuse("authors", "a text or a list of texts");
  return given;
}

void check_name(const Fields& fields, const std::string& name) {
  if (name.empty() || name.size() > longest_name || printable(name) != name)
    throw Error("{}: name is {}; a text of 1 to {} printable characters is required: {{\"name\": \"my method\"}}",
                fields.file(), fields.has("name") ? "'" + name + "'" : "missing", longest_name);
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
  const Fields fields(
      document, path, "",
      {"name", "version", "link", "authors", "settings", "device", "time_ms", "effect", "convention", "licence"});
  Entry entry;
  entry.name = fields.text("name");
  check_name(fields, entry.name);
  entry.version = fields.text("version");
  entry.link = fields.text("link");
  entry.device = fields.text("device");
  entry.licence = fields.text("licence");
  entry.authors = authors_of(fields);
  if (fields.has("settings")) {
    if (!fields.value("settings").is_object()) fields.refuse("settings", "an object such as {\"samples\": 8}");
    entry.settings = fields.value("settings");
  }
  read_times(fields, entry);
  entry.effect = fields.word("effect", scored_effects(), "ao");
  if (fields.has("convention")) entry.convention = convention_of(fields.value("convention"), path, entry.effect);
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
