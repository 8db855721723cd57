// gloam list techniques|devices|metrics|scenes|shots|cases; gloam list --kernel NAME
#include <memory>

#include "cli/flags/options.h"
#include "cli/list/techniques.h"
#include "gloam/device.h"
#include "gloam/error.h"
#include "gloam/scene/scene.h"
#include "run/device_record.h"
#include "stress/case.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

/// Lists all techniques, or the named one.
void list_techniques(const std::string& name, const JsonFlag& json, bool markdown) {
  std::vector<const Technique*> wanted;
  if (!name.empty()) wanted = {&find_technique(technique_for(name))};
  for (const Technique& t : registry())
    if (name.empty()) wanted.push_back(&t);
  json.write(techniques_document(wanted));
  if (json.only_json()) return;
  if (markdown) return print_techniques_markdown();
  if (name.empty()) return print_techniques();
  std::set<std::string> names;
  for (const Parameter& p : wanted.front()->parameters) names.insert(p.name);
  print_technique(*wanted.front(), names);
}

/// What `gloam doctor` found, in a few words.
std::string verdict_of(const std::optional<DeviceRecord>& record) {
  if (!record) return "not examined";
  return fmt::format("{} ({}{})", record->held ? "holds" : "does not hold", record->day,
                     record->kernels == hash_of_kernels() ? "" : ", with other kernels");
}

void list_devices_command(const JsonFlag& json) {
  Json document = Json::array();
  std::vector<std::vector<std::string>> rows = {
      {"platform", "device", "type", "double", "lanes", "memory", "gloam doctor"}};
  for (const DeviceInfo& d : list_devices()) {
    const std::optional<DeviceRecord> record = find_record(d);
    document.push_back({{"platform", d.platform},
                        {"device", d.name},
                        {"type", d.type},
                        {"lanes", d.tuning.lanes},
                        {"double", d.has_double},
                        {"memory", d.memory},
                        {"held", record ? Json(record->held) : Json()},
                        {"examined", record ? Json(record->day) : Json()}});
    rows.push_back({d.platform, d.name, d.type, d.has_double ? "yes" : "no", std::to_string(d.tuning.lanes),
                    fmt::format("{} MiB", d.memory >> 20), verdict_of(record)});
  }
  json.write(document);
  if (!json.only_json()) print_table(rows, 6);
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

void list_shots(const JsonFlag& json) {
  Json document = Json::array();
  std::vector<std::vector<std::string>> rows = {{"scene", "shot", "frames", "summary"}};
  for (const SceneRecipe& recipe : builtin_scenes()) {
    for (const ShotRecipe& shot : recipe.shots) {
      document.push_back({{"scene", recipe.name},
                          {"shot", shot.name},
                          {"frames", shot.frames},
                          {"moves_objects", shot.moves_objects},
                          {"summary", shot.summary}});
      rows.push_back({recipe.name, shot.name, std::to_string(shot.frames), shot.summary});
    }
  }
  json.write(document);
  if (!json.only_json()) print_table(rows, 4);
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

const std::vector<std::string> listed = {"techniques", "devices", "metrics", "scenes", "shots", "cases"};

}  // namespace

void add_list(CLI::App& app) {
  struct Flags {
    std::string what, name, kernel;
    bool markdown = false;
    JsonFlag json;
  };
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      app.add_subcommand("list", "what there is: techniques, devices, metrics, scenes, their shots or hard cases");
  auto* what = add_text(*command, "what", flags->what, type_of_words(listed), "what is listed");
  add_text(*command, "name", flags->name, "NAME", "a technique: all about it");
  command->add_flag("--markdown", flags->markdown, "techniques as docs/techniques.md has them");
  add_text(*command, "--kernel", flags->kernel, "TECHNIQUE/PASS",
           "instead: the text that the compiler gets for a pass; or TECHNIQUE: the names of its passes")
      ->excludes(what);
  flags->json.add_to(*command);
  command->footer(
      "Examples:\n  gloam list techniques\n  gloam list techniques gtao\n  gloam list devices --json -\n"
      "  gloam list --kernel gtao\n  gloam list --kernel gtao/estimate");
  command->callback([flags] {
    if (!flags->kernel.empty()) return print_kernel(flags->kernel);
    if (flags->what.empty()) throw UsageError("list: what is listed is missing; {} can be", enumerate(listed));
    if (!flags->name.empty() && (flags->what != "techniques" || flags->markdown))
      throw UsageError("list {}{}: shows all; leave out '{}', or write gloam list techniques {}", flags->what,
                       flags->markdown ? " --markdown" : "", flags->name, flags->name);
    if (flags->what == "techniques") return list_techniques(flags->name, flags->json, flags->markdown);
    if (flags->what == "devices") return list_devices_command(flags->json);
    if (flags->what == "metrics") return list_metrics(flags->json);
    if (flags->what == "scenes") return list_scenes(flags->json);
    if (flags->what == "shots") return list_shots(flags->json);
    if (flags->what == "cases") return list_cases(flags->json);
    throw UsageError("list: no '{}'{}; {} can be listed", flags->what, suggestion(flags->what, listed),
                     enumerate(listed));
  });
}

}  // namespace gloam::cli
