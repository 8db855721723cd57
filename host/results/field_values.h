// How a value of each type is read from bench.json, written, and called in its description.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "results/fields.h"
#include "technique/ambient_occlusion.h"

namespace gloam::report {

inline void get(std::string& value, const JsonObject& o, const std::string& key, unsigned rules) {
  value = rules & needed ? o.text(key) : o.text_if(key);
}
inline void get(double& value, const JsonObject& o, const std::string& key, unsigned rules) {
  value = rules & needed ? o.number(key) : o.number_if(key).value_or(value);
}
inline void get(Number& value, const JsonObject& o, const std::string& key, unsigned) { value = o.number_if(key); }
inline void get(bool& value, const JsonObject& o, const std::string& key, unsigned) { value = o.flag_if(key); }
inline void get(std::vector<double>& value, const JsonObject& o, const std::string& key, unsigned) {
  value = o.numbers_if(key);
}
inline void get(std::vector<std::string>& value, const JsonObject& o, const std::string& key, unsigned) {
  value = o.texts_if(key).value_or(value);
}
inline void get(Json& value, const JsonObject& o, const std::string& key, unsigned) {
  if (const Json* found = o.find(key); found && found->is_object()) value = *found;
}
template <typename Thing>
void get(std::vector<Thing>& value, const JsonObject& o, const std::string& key, unsigned rules) {
  for (const JsonObject& each : rules& needed ? o.objects(key) : o.objects_if(key)) value.push_back(read<Thing>(each));
}
template <typename Thing>
void get(std::optional<Thing>& value, const JsonObject& o, const std::string& key, unsigned rules) {
  if (o.find(key)) get(value.emplace(), o, key, rules);
}
template <typename Thing>
void get(Thing& value, const JsonObject& o, const std::string& key, unsigned rules) {
  if (rules & needed || o.find(key)) value = read<Thing>(o.object(key));
}

template <typename Thing>
bool is_empty(const Thing& value) {
  if constexpr (std::is_same_v<Thing, double>)
    return !std::isfinite(value);
  else if constexpr (requires { value.has_value(); })
    return !value;
  else if constexpr (std::is_same_v<Thing, Json>)
    return value.is_null();
  else if constexpr (requires { value.empty(); })
    return value.empty();
  return false;
}

template <typename Thing>
Json put(const Thing& value, unsigned rules) {
  if constexpr (requires { fields(&value); })
    return json_of(value);
  else if constexpr (std::is_same_v<Thing, double>)
    return is_empty(value) ? Json() : rules & whole ? Json(int64_t(value)) : Json(value);
  else
    return value;
}
template <typename Thing>
Json put(const std::optional<Thing>& value, unsigned rules) {
  return value ? put(*value, rules) : Json();
}
template <typename Thing>
Json put(const std::vector<Thing>& value, unsigned rules) {
  Json list = Json::array();
  for (const Thing& each : value) list.push_back(put(each, rules));
  return list;
}

template <typename Thing>
std::string type_of(const Thing* value, unsigned rules) {
  if constexpr (std::is_same_v<Thing, double>)
    return rules & whole ? "whole number" : "number";
  else if constexpr (std::is_same_v<Thing, std::string>)
    return "text";
  else if constexpr (std::is_same_v<Thing, bool>)
    return "true or false";
  else if constexpr (requires { value->has_value(); })
    return type_of(static_cast<const typename Thing::value_type*>(nullptr), rules);
  else if constexpr (std::is_same_v<Thing, Json> || requires { fields(value); })
    return "object";
  else
    return "list of " + type_of(static_cast<const typename Thing::value_type*>(nullptr), rules) + "s";
}

template <typename Thing, typename Value>
Field<Thing> field(const char* key, Value Thing::*member, unsigned rules, const char* meaning, const char* unit = "") {
  const bool is_optional = requires(Value value) { value.has_value(); };
  return {key,
          type_of(static_cast<const Value*>(nullptr), rules),
          rules,
          is_optional || (rules & null_if_empty) != 0,
          meaning,
          unit,
          [=](Thing& thing, const JsonObject& o) { get(thing.*member, o, key, rules); },
          [=](const Thing& thing) {
            const Value& value = thing.*member;
            if ((rules & left_out) && is_empty(value)) return Json(Json::value_t::discarded);
            return (rules & null_if_empty) && is_empty(value) ? Json() : put(value, rules);
          }};
}

// --- Fields that are not a member each.

/// Width and height.
template <typename Thing>
Field<Thing> size_field() {
  const auto read = [](Thing& thing, const JsonObject& o) {
    const std::vector<double> size = o.numbers_if("size");
    if (o.find("size") && size.size() != 2) o.refuse("size", "a list of width and height is needed");
    if (!size.empty()) thing.width = size[0], thing.height = size[1];
  };
  const auto write = [](const Thing& thing) { return Json{put(thing.width, whole), put(thing.height, whole)}; };
  return {"size", "list of whole numbers", may_lack, false, "width and height", "pixels", read, write};
}

/// For files that do not state what a technique reads.
inline std::vector<std::string> depths_by_name(const std::string& technique) {
  if (technique.starts_with(peeled_prefix)) return {"depth", "peel"};
  if (technique.starts_with(stochastic_prefix)) return {"depth", "stochastic"};
  return {"depth"};
}

/// The inputs of a technique, after its name; not written of a method that is no technique.
template <typename Thing>
Field<Thing> reads_field(const char* key, const char* type, const char* meaning,
                         void (*read)(Thing&, const JsonObject&), Json (*write)(const Reads&)) {
  return {key, type, may_lack, false, meaning, "", read, [=](const Thing& thing) {
            if constexpr (requires { thing.submitted; }) {
              if (!thing.submitted.is_null()) return Json(Json::value_t::discarded);
            }
            return write(thing.reads);
          }};
}
template <typename Thing>
Field<Thing> depths_field() {
  return reads_field<Thing>(
      "depths", "list of texts",
      "depth planes that the technique reads; `peel` and `stochastic` are layers behind the depth",
      [](Thing& thing, const JsonObject& o) {
        thing.reads.depths = o.texts_if("depths").value_or(depths_by_name(thing.technique));
      },
      [](const Reads& reads) { return Json(reads.depths); });
}
template <typename Thing>
Field<Thing> views_field() {
  return reads_field<Thing>(
      "views", "whole number", "views that the technique needs",
      [](Thing& thing, const JsonObject& o) {
        thing.reads.views = int(std::clamp(o.number_if("views").value_or(1), 0.0, 1e9));
      },
      [](const Reads& reads) { return Json(reads.views); });
}

/// Of a submitted row what its authors state, which is no measurement: it is written, and not read.
inline Field<Row> row_time_field() {
  Field<Row> times = field("ms", &Row::ms, needed, "of the whole plan, the filter included");
  const auto read = times.read;
  const auto write = times.write;
  times.read = [read](Row& row, const JsonObject& o) {
    const Json* submitted = o.find("submitted");
    if (!submitted || !submitted->is_object()) read(row, o);
  };
  times.write = [write](const Row& row) { return row.submitted.is_null() || row.ms.median > 0 ? write(row) : Json(); };
  return times;
}

/// The rounds of a ratio, and their interval.
inline void add_rounds(Fields<Row>& all, const std::string& ratio, RoundRatios Row::*rounds) {
  const auto add = [&](const std::string& key, std::vector<double> RoundRatios::*member, unsigned rules,
                       const std::string& meaning, bool is_of_cpu) {
    all.push_back({key, "list of numbers", rules | of_frames, (rules & null_if_empty) != 0, meaning, "",
                   [=](Row& row, const JsonObject& o) { row.*rounds.*member = o.numbers_if(key); },
                   [=](const Row& row) {
                     const std::vector<double>& values = row.*rounds.*member;
                     if (is_of_cpu && (row.*rounds).cpu.empty()) return Json(Json::value_t::discarded);
                     return (rules & null_if_empty) && values.empty() ? Json() : Json(values);
                   }});
  };
  add(ratio + "_interval", &RoundRatios::ms_interval, null_if_empty, "of the median ratio, 95 %", false);
  add(ratio + "_rounds", &RoundRatios::ms, may_lack, "the ratio in each round", false);
  add("cpu_" + ratio + "_interval", &RoundRatios::cpu_interval, null_if_empty | left_out,
      "the same of what the cores spent", true);
  add("cpu_" + ratio + "_rounds", &RoundRatios::cpu, left_out, "the same of what the cores spent", true);
}

}  // namespace gloam::report
