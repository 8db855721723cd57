#include "cli/list/techniques.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "cli/flags/wrap.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/radius.h"
#include "gloam/variants.h"
#include "measure/plans.h"
#include "technique/variant_words.h"

namespace gloam::cli {

Json parameter_document(const Parameter& p) {
  Json document = {{"name", p.name}, {"type", type_name(p)}};
  const ParameterValues initial({p});
  const auto bound = [](double value) { return std::isfinite(value) ? Json(value) : Json(value > 0 ? "inf" : "-inf"); };
  const bool numeric = p.type == Parameter::Type::floating || p.type == Parameter::Type::integer;
  if (p.type == Parameter::Type::integer) {
    document["default"] = int(p.initial);
    document["min"] = int(p.min);
    document["max"] = int(p.max);
  } else if (numeric) {
    // Through float, as the kernel sees it, then in its shortest decimal form.
    document["default"] = is_radius(p) ? Json() : Json(std::stod(initial.text(p.name)));
    if (is_radius(p)) document["default_from"] = "frame";
    document["min"] = bound(p.min);
    document["max"] = bound(p.max);
  } else {
    document["default"] = p.type == Parameter::Type::boolean ? Json(p.initial != 0) : Json(initial.text(p.name));
    document["min"] = nullptr;
    document["max"] = nullptr;
  }
  document["choices"] = p.choices;
  document["unit"] = p.unit;
  document["help"] = p.help;
  return document;
}

std::string default_in_words(const Parameter& p) {
  return is_radius(p) ? "from the frame" : ParameterValues({p}).text(p.name);
}

namespace {

Json variant_document(const Variant& variant) {
  if (variant.of.empty()) return nullptr;
  return {{"of", variant.of},
          {"layers", word_for(variant.layers, layers_words)},
          {"eyes", word_for(variant.both_eyes, eyes_words)}};
}

}  // namespace

Json techniques_document(const std::vector<const Technique*>& techniques) {
  Json document = Json::array();
  for (const Technique* technique : techniques) {
    const Technique& t = *technique;
    Json parameters = Json::array();
    for (const Parameter& p : t.parameters) parameters.push_back(parameter_document(p));
    Json presets = Json::object();
    for (const Preset& preset : t.presets) {
      for (const auto& [name, value] : preset.settings) presets[preset.name][name] = value;
    }
    document.push_back({{"name", t.name},
                        {"summary", t.summary},
                        {"paper", t.paper},
                        {"reads", t.reads},
                        {"optional", t.may_read},
                        {"writes", t.writes},
                        {"then", t.then},
                        {"extras", t.extras},
                        {"parameters", parameters},
                        {"presets", presets},
                        {"default_for", t.default_for},
                        {"caution", t.caution},
                        {"variant", variant_document(t.variant)}});
  }
  return document;
}

namespace {

/// "depth, normal; where at hand: back_depth"
std::string all_reads(const Technique& t) {
  const std::string own = fmt::format("{}", fmt::join(t.reads, ", "));
  return t.may_read.empty() ? own : fmt::format("{}; where at hand: {}", own, fmt::join(t.may_read, ", "));
}

/// A group of techniques: by the planes that `gloam run` writes with them, and the number of views.
struct Group {
  std::string heading;
  std::function<bool(const Technique&)> holds;
};

bool makes(const Technique& t, const std::string& plane) {
  return !bench::is_filter(t) && contains(outputs_of(t), plane);
}

/// A technique belongs to the first group that fits; variants are listed with their methods.
const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"ambient occlusion", [](const Technique& t) { return makes(t, "ao") && !t.any_projection; }},
      {"ambient occlusion on light-field displays", [](const Technique& t) { return makes(t, "ao"); }},
      {"indirect light", [](const Technique& t) { return makes(t, "indirect"); }},
      {"ambient light", [](const Technique& t) { return makes(t, "bounces") || makes(t, "specular_occlusion"); }},
      {"reflections", [](const Technique& t) { return makes(t, "reflection"); }},
      {"masks, for --only", [](const Technique& t) { return makes(t, "mask"); }},
      {"filters, for --filter", [](const Technique& t) { return bench::is_filter(t); }},
      {"planes that others read", [](const Technique&) { return true; }}};
  return all;
}

const Group& group_of(const Technique& t) {
  return *std::find_if(groups().begin(), groups().end(), [&](const Group& group) { return group.holds(t); });
}

std::string preset_in_words(const Preset& preset, const char* separator) {
  std::vector<std::string> settings;
  for (const auto& [name, value] : preset.settings) settings.push_back(name + "=" + value);
  return fmt::format("{}", fmt::join(settings, separator));
}

}  // namespace

namespace {

std::vector<const Technique*> methods() {
  std::vector<const Technique*> all;
  for (const Technique& t : registry())
    if (t.variant.of.empty()) all.push_back(&t);
  return all;
}

/// The variants of a method for one eye, by the word for their layers, or those for both: "stochastic peeled", "both".
/// `shown`: how a variant is shown, of the row and its word.
std::string variants_in_words(const Technique& method, bool both_eyes, const char* between,
                              const std::function<std::string(const Technique&, const std::string&)>& shown) {
  std::vector<std::string> words;
  for (const auto& [layers, value] : layers_words) {
    const Technique* variant = find_variant({method.name, value, both_eyes});
    if (!variant || variant == &method) continue;
    const std::string word = !both_eyes ? layers : value == Layers::one ? "both" : "both+" + layers;
    words.push_back(shown(*variant, word));
  }
  return fmt::format("{}", fmt::join(words, between));
}

}  // namespace

namespace {

/// " [--layers stochastic peeled, --eyes both; the default of ao]"
std::string variants_and_default(const Technique& t) {
  std::vector<std::string> facts;
  for (const bool both_eyes : {false, true}) {
    const std::string words =
        variants_in_words(t, both_eyes, " ", [](const Technique&, const std::string& word) { return word; });
    if (!words.empty()) facts.push_back((both_eyes ? "--eyes " : "--layers ") + words);
  }
  if (contains(t.default_for, "ao_raw")) facts.push_back("the default: gloam run ao");
  return facts.empty() ? "" : fmt::format(" [{}]", fmt::join(facts, "; "));
}

/// The few that most people need, with what they are for.
void print_recommended() {
  fmt::print("recommended, where\n");
  std::vector<std::vector<std::string>> rows;
  for (const Technique* t : methods())
    if (!t->recommended.empty())
      rows.push_back(
          {"* " + t->name, t->recommended + (contains(t->default_for, "ao_raw") ? "; gloam ao takes it" : "")});
  print_table(rows, 2);
}

}  // namespace

const std::string& heading_of(const Technique& technique) { return group_of(technique).heading; }

std::vector<std::string> technique_headings() {
  std::vector<std::string> headings;
  for (const Group& group : groups()) headings.push_back(group.heading);
  return headings;
}

void print_techniques() {
  print_recommended();
  size_t width = 0;
  for (const Technique* t : methods()) width = std::max(width, t->name.size());
  for (const Group& group : groups()) {
    fmt::print("\n{}\n", group.heading);
    for (const Technique* t : methods()) {
      if (&group_of(*t) != &group) continue;
      fmt::print("  {:<{}}  {}\n", t->name, width,
                 wrapped(t->summary + variants_and_default(*t), width + 4, width + 4));
    }
  }
  fmt::print("\n{}\n", wrapped("gloam list techniques NAME shows parameters, presets, variants, and what a technique "
                               "reads and writes.",
                               0, 0));
}

void print_technique(const Technique& t, const std::set<std::string>& settable) {
  fmt::print("{}\n", wrapped(t.name + ": " + t.summary, 0, 2));
  const auto fact = [](const char* name, const std::string& text) {
    if (!text.empty()) fmt::print("  {:<7} {}\n", name, wrapped(text, 10, 10));
  };
  fact("paper", t.paper);
  fact("reads", all_reads(t));
  fact("writes", fmt::format("{}", fmt::join(t.writes, ", ")));
  if (t.views > 1) fact("views", "a frame of two");
  if (!t.variant.of.empty()) fact("variant", "of " + t.variant.of + ": " + options_of(t.variant));
  for (const Technique* v : variants_of(t)) fact("variant", options_of(v->variant) + ": " + v->name);
  if (!t.then.empty()) fact("then", t.then + " (--filter chooses another, or none)");
  for (const std::string& plane : t.extras) fact("--with", plane + ": " + plane_kind(plane).help);
  if (contains(t.default_for, "ao_raw")) fact("default", "for ao: gloam run ao, plan ao and auto take it");
  fact("caution", t.caution);
  if (!t.parameters.empty()) fmt::print("\nParameters of {}:\n", t.name);
  std::vector<std::vector<std::string>> rows;
  for (const Parameter& p : t.parameters)
    rows.push_back({(settable.count(p.name) ? "  --" : "  --set ") + p.name, default_in_words(p),
                    "(" + allowed_values(p) + ")", p.help});
  print_table(rows, 4);
  if (!t.presets.empty()) fmt::print("\nPresets of {}:\n", t.name);
  for (const Preset& preset : t.presets)
    fmt::print("  --preset {:<6}  {}\n", preset.name, wrapped(preset_in_words(preset, " "), 19, 19));
}

namespace {

/// "more samples ..." as a sentence.
std::string sentence(std::string text) {
  text[0] = char(std::toupper((unsigned char)text[0]));
  return text + ".";
}

/// The anchor of a heading in rendered Markdown: letters, digits and hyphens.
std::string anchor(const std::string& heading) {
  std::string text;
  for (const char c : heading) {
    if (std::isalnum((unsigned char)c) || c == '-' || c == '_') text += char(std::tolower((unsigned char)c));
  }
  return text;
}

/// Anchors of headings in their order. A repeated anchor gets a number: hbao, and hbao-1 for hbao+.
std::vector<std::string> anchors_of(const std::vector<std::string>& headings) {
  std::vector<std::string> anchors;
  for (const std::string& heading : headings) {
    std::string unique = anchor(heading);
    for (int number = 1; contains(anchors, unique); ++number) unique = fmt::format("{}-{}", anchor(heading), number);
    anchors.push_back(unique);
  }
  return anchors;
}

/// "ao_raw; --with: bent_normal, cone"
std::string all_writes(const Technique& t) {
  const std::string own = fmt::format("{}", fmt::join(t.writes, ", "));
  return t.extras.empty() ? own : fmt::format("{}; `--with`: {}", own, fmt::join(t.extras, ", "));
}

void print_extras_markdown(const Technique& t) {
  if (t.extras.empty()) return;
  std::vector<std::string> extras;
  for (const std::string& plane : t.extras) extras.push_back(fmt::format("`{}` ({})", plane, plane_kind(plane).help));
  fmt::print("\nMade where `--with` asks for it: {}.\n", enumerate(extras));
}

/// The section of one technique.
void print_section(const Technique& t) {
  fmt::print("\n## `{}`\n\n{}.{}\n", t.name, t.summary, t.paper.empty() ? "" : " Source: " + t.paper + ".");
  if (!t.then.empty()) fmt::print("Followed by `{}` unless `--filter` says otherwise.\n", t.then);
  if (!t.variant.of.empty()) fmt::print("The same as `{} {}`.\n", t.variant.of, options_of(t.variant));
  if (t.views > 1)
    fmt::print("Needs a frame of two views{}.\n", makes_first_view_only(t) ? "; it works on the first" : "");
  print_extras_markdown(t);
  if (!t.parameters.empty()) fmt::print("\n| parameter | default | allowed | meaning |\n|---|---|---|---|\n");
  for (const Parameter& p : t.parameters) {
    fmt::print("| `{}` | {} | {} | {} |\n", p.name, default_in_words(p), allowed_values(p), p.help);
  }
  for (const Preset& preset : t.presets) {
    fmt::print("{}Preset `{}`: {}.\n", &preset == &t.presets.front() ? "\n" : "", preset.name,
               preset_in_words(preset, ", "));
  }
  if (!t.caution.empty()) fmt::print("{}\n", sentence(t.caution));
}

}  // namespace

void print_techniques_markdown() {
  fmt::print(
      "# Techniques\n\nWritten by `gloam list techniques --markdown` from the folders of `kernels/`; do not edit.\n\n");
  fmt::print(
      "`--layers` and `--eyes` choose a method's variants: over stochastic or peeled layers of depth, or for both of "
      "two eyes.\n"
      "`gloam run gtao F.exr --layers peeled` is `gloam run dp-gtao F.exr`.\n\n"
      "| technique | what it does | `--layers stochastic`, `peeled` | `--eyes both` | reads | writes "
      "|\n|---|---|---|---|---|---|\n");
  const std::vector<std::string> names = technique_names(), anchors = anchors_of(names);
  const auto link = [&](const Technique& t, const std::string&) {
    return fmt::format("[`{}`](#{})", t.name, anchors[size_t(&t - registry().data())]);
  };
  for (const Technique* t : methods()) {
    fmt::print("| {} | {} | {} | {} | {} | {} |\n", link(*t, ""), t->summary, variants_in_words(*t, false, ", ", link),
               variants_in_words(*t, true, ", ", link), all_reads(*t), all_writes(*t));
  }
  for (const Technique& t : registry()) print_section(t);
}

}  // namespace gloam::cli
