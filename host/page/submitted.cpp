#include "page/submitted.h"

#include <fmt/format.h>

#include <cmath>

#include "base/json_text.h"

namespace gloam::report {
namespace {

const Json nothing = nullptr;

const Json& at(const Json& object, const char* key) {
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

std::string text_at(const Json& object, const char* key) {
  const Json& value = at(object, key);
  return value.is_string() ? value.get<std::string>() : "";
}

Number number_at(const Json& object, const char* key) {
  const Json& value = at(object, key);
  return value.is_number() && std::isfinite(value.get<double>()) ? Number(value.get<double>()) : Number();
}

std::string authors_of(const Json& submitted) {
  const Json& authors = at(submitted, "authors");
  if (authors.is_string()) return authors.get<std::string>();
  std::string text;
  if (!authors.is_array()) return text;
  for (const Json& each : authors) {
    if (each.is_string()) text += (text.empty() ? "" : ", ") + each.get<std::string>();
  }
  return text;
}

/// "inverted, exponent 2.2, half resolution"; empty for plain images.
std::string convention_of(const Json& convention) {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  if (at(convention, "inverted") == Json(true)) add("inverted");
  for (const char* key : {"exponent", "strength"}) {
    if (const Number value = number_at(convention, key); value && *value != 1) add(fmt::format("{} {:g}", key, *value));
  }
  if (const Json& range = at(convention, "range");
      range.is_array() && range.size() == 2 && range[0].is_number() && range[1].is_number())
    add(fmt::format("range {:g} to {:g}", range[0].get<double>(), range[1].get<double>()));
  if (const std::string resolution = text_at(convention, "resolution"); !resolution.empty() && resolution != "full")
    add(resolution + " resolution");
  if (const Number radius = number_at(convention, "radius")) add(fmt::format("radius {:g}", *radius));
  if (const std::string falloff = text_at(convention, "falloff"); !falloff.empty()) add("falloff " + falloff);
  return text;
}

}  // namespace

SubmittedFacts facts_of(const Json& submitted) {
  SubmittedFacts facts;
  facts.version = text_at(submitted, "version");
  facts.device = text_at(submitted, "device");
  facts.authors = authors_of(submitted);
  facts.convention = convention_of(at(submitted, "convention"));
  // A link of another kind could run a script.
  const std::string link = text_at(submitted, "link");
  if (link.starts_with("https://") || link.starts_with("http://")) facts.link = link;
  facts.stated_ms = number_at(submitted, "time_ms");
  const Json &fit = at(submitted, "fit"), &whole = at(submitted, "whole");
  facts.fit_rmse = number_at(fit, "rmse_to_truth");
  facts.fit_ssim = number_at(fit, "ssim");
  facts.fit_flip = number_at(fit, "flip");
  facts.fit_exponent = number_at(fit, "exponent");
  facts.fit_strength = number_at(fit, "strength");
  facts.fit_scale = number_at(fit, "scale");
  facts.whole_ms = number_at(at(whole, "ms"), "median");
  facts.whole_gloam_ms = number_at(at(whole, "gloam_ms"), "median");
  facts.whole_ratio = number_at(whole, "ratio");
  return facts;
}

Json submitted_row(const Row& row, Json on_page) {
  const SubmittedFacts facts = facts_of(row.submitted);
  on_page["ms"] = {{"median", nullptr}, {"min", nullptr}, {"max", nullptr}};
  on_page["submitted"] = {{"version", facts.version},
                          {"link", facts.link},
                          {"device", facts.device},
                          {"authors", facts.authors},
                          {"convention", facts.convention},
                          {"stated_ms", or_null(facts.stated_ms)},
                          {"fit_rmse", or_null(facts.fit_rmse)},
                          {"fit_exponent", or_null(facts.fit_exponent)},
                          {"fit_strength", or_null(facts.fit_strength)},
                          {"fit_scale", or_null(facts.fit_scale)},
                          {"whole_ms", or_null(facts.whole_ms)},
                          {"whole_gloam_ms", or_null(facts.whole_gloam_ms)},
                          {"whole_ratio", or_null(facts.whole_ratio)}};
  return on_page;
}

}  // namespace gloam::report
