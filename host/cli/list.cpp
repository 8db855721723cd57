// gloam list techniques|devices|metrics|scenes|cases
#include <memory>

#include "cli/options.h"
#include "gloam/device.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/radius.h"
#include "gloam/scene/scene.h"
#include "stress/case.h"

namespace gloam::cli {
namespace {

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

/// The default of a parameter for people.
std::string default_in_words(const Parameter& p) {
  return is_radius(p) ? "from the frame" : ParameterValues({p}).text(p.name);
}

Json techniques_document() {
  Json document = Json::array();
  for (const Technique& t : registry()) {
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
                        {"optional", Json::array()},
                        {"writes", t.writes},
                        {"then", t.then},
                        {"extras", t.extras},
                        {"parameters", parameters},
                        {"presets", presets},
                        {"default_for", t.default_for},
                        {"caution", t.caution}});
  }
  return document;
}

void print_techniques() {
  for (const Technique& t : registry()) {
    fmt::print("{}: {}\n", t.name, t.summary);
    if (!t.paper.empty()) fmt::print("  paper   {}\n", t.paper);
    fmt::print("  reads   {}\n  writes  {}\n", fmt::join(t.reads, ", "), fmt::join(t.writes, ", "));
    if (!t.then.empty()) fmt::print("  then    {}\n", t.then);
    for (const std::string& plane : t.extras) fmt::print("  --with  {}: {}\n", plane, plane_kind(plane).help);
    for (const Parameter& p : t.parameters) {
      fmt::print("  {} = {}  ({}) {}\n", p.name, default_in_words(p), allowed_values(p), p.help);
    }
    for (const Preset& preset : t.presets) {
      std::vector<std::string> settings;
      for (const auto& [name, value] : preset.settings) settings.push_back(name + "=" + value);
      fmt::print("  preset {}: {}\n", preset.name, fmt::join(settings, " "));
    }
    if (!t.caution.empty()) fmt::print("  caution {}\n", t.caution);
    if (contains(t.default_for, "ao_raw")) fmt::print("  default for ao: gloam run ao, plan ao and auto take it\n");
    fmt::print("\n");
  }
}

/// "more samples ..." as a sentence.
std::string sentence(std::string text) {
  text[0] = char(std::toupper((unsigned char)text[0]));
  return text + ".";
}

/// How a page that shows Markdown spells the anchor of a heading: letters, digits and hyphens.
std::string anchor(const std::string& heading) {
  std::string text;
  for (const char c : heading) {
    if (std::isalnum((unsigned char)c) || c == '-' || c == '_') text += char(std::tolower((unsigned char)c));
  }
  return text;
}

/// Anchors of headings in their order. One that is taken is numbered: hbao, and hbao-1 for hbao+.
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

/// docs/techniques.md: one section per technique.
void print_techniques_markdown() {
  fmt::print(
      "# Techniques\n\nWritten by `gloam list techniques --markdown` from the folders of `kernels/`; do not edit.\n\n");
  fmt::print("| technique | what it does | reads | writes |\n|---|---|---|---|\n");
  const std::vector<std::string> names = technique_names(), anchors = anchors_of(names);
  for (size_t i = 0; i < names.size(); ++i) {
    const Technique& t = registry()[i];
    fmt::print("| [`{}`](#{}) | {} | {} | {} |\n", t.name, anchors[i], t.summary, fmt::join(t.reads, ", "),
               all_writes(t));
  }
  for (const Technique& t : registry()) {
    fmt::print("\n## `{}`\n\n{}.{}\n", t.name, t.summary, t.paper.empty() ? "" : " Source: " + t.paper + ".");
    if (!t.then.empty()) fmt::print("Followed by `{}` unless `--filter` says otherwise.\n", t.then);
    if (t.views > 1)
      fmt::print("Needs a frame of two views{}.\n", makes_first_view_only(t) ? "; it works on the first" : "");
    print_extras_markdown(t);
    if (!t.parameters.empty()) fmt::print("\n| parameter | default | allowed | meaning |\n|---|---|---|---|\n");
    for (const Parameter& p : t.parameters) {
      fmt::print("| `{}` | {} | {} | {} |\n", p.name, default_in_words(p), allowed_values(p), p.help);
    }
    for (const Preset& preset : t.presets) {
      std::vector<std::string> settings;
      for (const auto& [name, value] : preset.settings) settings.push_back(name + "=" + value);
      fmt::print("{}Preset `{}`: {}.\n", &preset == &t.presets.front() ? "\n" : "", preset.name,
                 fmt::join(settings, ", "));
    }
    if (!t.caution.empty()) fmt::print("{}\n", sentence(t.caution));
  }
}

void list_techniques(const JsonFlag& json, bool markdown) {
  json.write(techniques_document());
  if (json.only_json()) return;
  if (markdown)
    print_techniques_markdown();
  else
    print_techniques();
}

void list_devices_command(const JsonFlag& json) {
  Json document = Json::array();
  std::vector<std::vector<std::string>> rows = {{"platform", "device", "type", "double", "lanes", "memory"}};
  for (const DeviceInfo& d : list_devices()) {
    document.push_back({{"platform", d.platform},
                        {"device", d.name},
                        {"type", d.type},
                        {"lanes", d.lanes},
                        {"double", d.has_double},
                        {"memory", d.memory}});
    rows.push_back({d.platform, d.name, d.type, d.has_double ? "yes" : "no", std::to_string(d.lanes),
                    fmt::format("{} MiB", d.memory >> 20)});
  }
  json.write(document);
  if (!json.only_json()) print_table(rows, 4);
}

void list_scenes(const JsonFlag& json) {
  Json document = Json::array();
  for (const SceneRecipe& recipe : builtin_scenes()) {
    Json parameters = Json::array();
    for (const Parameter& p : recipe.parameters) parameters.push_back(parameter_document(p));
    document.push_back(
        {{"name", recipe.name}, {"class", recipe.kind}, {"summary", recipe.summary}, {"parameters", parameters}});
  }
  json.write(document);
  if (json.only_json()) return;
  std::vector<std::vector<std::string>> rows;
  for (const SceneRecipe& recipe : builtin_scenes()) {
    rows.push_back({recipe.name, recipe.kind, recipe.summary});
    const ParameterValues initial(recipe.parameters);
    for (const Parameter& p : recipe.parameters) {
      rows.push_back({"", "", fmt::format("--{} {}  ({}) {}", p.name, default_in_words(p), allowed_values(p), p.help)});
    }
  }
  print_table(rows, 3);
}

void list_metrics(const JsonFlag& json) {
  const std::vector<std::pair<std::string, std::string>> metrics = {
      {"pixels", "pixels that count: foreground in both"},
      {"mae", "mean absolute difference"},
      {"rmse", "root of the mean squared difference"},
      {"bias", "mean difference, test - truth; above 0: the test is too bright"},
      {"psnr", "dB, for a peak of 1; null for identical images"},
      {"max", "largest absolute difference"},
      {"over_1_255", "share of pixels that differ by more than 1/255"},
      {"over_0_05", "share of pixels that differ by more than 0.05"},
      {"ssim", "structural similarity, mean over the foreground"},
      {"gmsd", "gradient magnitude similarity deviation over the foreground"},
      {"flip", "of colours: FLIP (Andersson 2020), mean over the foreground, as seen from 67 pixels per degree"},
      {"rse", "of colours: mean of (test - truth)^2 / (truth^2 + 0.01)"},
  };
  Json document = Json::array();
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, help] : metrics) {
    document.push_back({{"name", name}, {"help", help}});
    rows.push_back({name, help});
  }
  json.write(document);
  if (!json.only_json()) print_table(rows, 2);
}

void list_cases(const JsonFlag& json) {
  Json document = Json::array();
  std::vector<std::vector<std::string>> rows;
  for (const stress::Case& one : stress::cases()) {
    document.push_back({{"case", one.number}, {"name", one.name}, {"property", one.property}});
    rows.push_back({fmt::format("{}", one.number), one.name, one.property});
  }
  json.write(document);
  if (!json.only_json()) print_table(rows, 3);
}

}  // namespace

void add_list(CLI::App& app) {
  struct Flags {
    std::string what;
    bool markdown = false;
    JsonFlag json;
  };
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("list", "what there is: techniques, devices, metrics, scenes or hard cases");
  command->add_option("what", flags->what, "techniques, devices, metrics, scenes or cases")->required();
  command->add_flag("--markdown", flags->markdown, "techniques as docs/techniques.md has them");
  flags->json.add_to(*command);
  command->footer("Examples:\n  gloam list techniques\n  gloam list devices --json -");
  command->callback([flags] {
    if (flags->what == "techniques") return list_techniques(flags->json, flags->markdown);
    if (flags->what == "devices") return list_devices_command(flags->json);
    if (flags->what == "metrics") return list_metrics(flags->json);
    if (flags->what == "scenes") return list_scenes(flags->json);
    if (flags->what == "cases") return list_cases(flags->json);
    const std::vector<std::string> known = {"techniques", "devices", "metrics", "scenes", "cases"};
    throw UsageError("list: no '{}'{}; {} can be listed", flags->what, suggestion(flags->what, known),
                     enumerate(known));
  });
}

}  // namespace gloam::cli
