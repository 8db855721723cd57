// gloam set list|make|verify: frozen sets of frames and truths
#include <cmath>

#include "base/file_ledger.h"
#include "cli/flags/options.h"
#include "gloam/error.h"
#include "measure/commit.h"
#include "set/hard_frames.h"
#include "set/making.h"
#include "set/seeded.h"
#include "set/verification.h"

namespace gloam::cli {
namespace {

using namespace gloam::sets;
namespace fs = std::filesystem;

struct SetCommand {
  std::string action, name, out, only;
  std::optional<int> seed;
  JsonFlag json;
};

/// Throws UsageError for flags that say how a set is made.
void check_makes_nothing(const SetCommand& flags) {
  for (const auto& [flag, given] : {std::pair("--only", !flags.only.empty()),
                                    std::pair("--seed", flags.seed.has_value()), std::pair("-o", !flags.out.empty())}) {
    if (given) throw UsageError("set {}: {} is for gloam set make; leave it out", flags.action, flag);
  }
}

// --- list

Json document_of(const Recipe& recipe) {
  Json items = Json::array();
  for (const ItemRecipe& item : recipe.items) {
    std::vector<std::string> effects;
    for (const TruthRecipe& truth : item.truths) effects.push_back(truth.effect);
    items.push_back({{"name", item.name},
                     {"kind", item.kind},
                     {"class", class_of(item)},
                     {"radius", item.radius},
                     {"effects", effects}});
  }
  return {{"set", recipe.name},
          {"summary", recipe.summary},
          {"licence", recipe.licence},
          {"frozen_with", recipe.frozen_with},
          {"items", items}};
}

void list_sets(const JsonFlag& json) {
  Json document = Json::array();
  std::vector<std::vector<std::string>> rows;
  for (const Recipe& recipe : recipes()) {
    document.push_back(document_of(recipe));
    rows.push_back({recipe.name, counted(recipe.items.size(), "item"), recipe.summary});
  }
  json.write(document);
  if (!json.only_json()) print_table(rows, 3);
}

/// What an item shows, in a few words.
std::string shown_by(const ItemRecipe& item) {
  if (!item.hard.empty()) return help_of_hard_frame(item.hard);
  std::string text = item.scene;
  if (!item.camera.empty()) text += ", camera " + item.camera;
  if (!item.shot.empty())
    text += fmt::format(", shot {}, frames {} to {}", item.shot, item.frames.front(), item.frames.back());
  if (!item.display.empty()) text += ", display " + item.display;
  return text;
}

void list_items(const Recipe& recipe, const JsonFlag& json) {
  std::vector<std::vector<std::string>> rows;
  for (const ItemRecipe& item : recipe.items) {
    std::string effects;
    for (const TruthRecipe& truth : item.truths) effects += (effects.empty() ? "" : ", ") + truth.effect;
    rows.push_back({item.name, item.kind, fmt::format("{:g}", item.radius), effects, shown_by(item)});
  }
  json.write(document_of(recipe));
  if (!json.only_json()) print_table(rows, 5);
}

// --- make

fs::path folder_of(const SetCommand& flags) {
  if (!flags.out.empty()) return flags.out;
  return flags.seed ? fmt::format("{}-seed{}", flags.name, *flags.seed) : flags.name;
}

/// "courtyard: ao 512 rays, noise 0.0051, 7 % of the best error; 12.3 s"
std::string line_of(const SetItem& item, double seconds) {
  std::string line = item.name + ":";
  for (const SetTruth& truth : item.truths) {
    line +=
        fmt::format("{} {} {}", line.ends_with(":") ? "" : ";", truth.effect,
                    truth.rays == 0 ? "in closed form" : fmt::format("{} rays, noise {:.2g}", truth.rays, truth.noise));
    if (truth.best_error && *truth.best_error > 0 && truth.rays > 0)
      line += fmt::format(", {:.0f} % of the best error", 100 * truth.noise / *truth.best_error);
  }
  return line + fmt::format("; {:.1f} s", seconds);
}

Json document_of(const SetCommand& flags, const MakeResult& result) {
  Json differences = Json::array();
  for (const Difference& one : result.differences)
    differences.push_back({{"file", one.file}, {"expected", one.expected}, {"got", one.got}, {"cause", one.cause}});
  const Manifest& manifest = result.manifest;
  return {{"set", manifest.set},
          {"part", manifest.part},
          {"seed", manifest.seed ? Json(*manifest.seed) : Json()},
          {"folder", folder_of(flags).string()},
          {"hash", manifest.hash},
          {"made", result.made},
          {"kept", result.kept},
          {"complete", result.missing.empty()},
          {"missing", result.missing},
          {"unfrozen", result.unfrozen},
          {"differs", differences}};
}

void print_result(const SetCommand& flags, const MakeResult& result) {
  const std::string folder = folder_of(flags).string();
  fmt::print("{}: {} of {}, {} made, {} kept; hash {}\n", printable(folder),
             counted(result.manifest.items.size(), "item"), flags.name, counted(size_t(result.made), "file"),
             counted(size_t(result.kept), "file"), result.manifest.hash);
  if (!result.missing.empty())
    fmt::print("not complete: {} {} missing: {}\n", counted(result.missing.size(), "item"),
               result.missing.size() == 1 ? "is" : "are", enumerate(result.missing));
  if (!result.unfrozen.empty())
    fmt::print("not frozen yet, so compared with nothing: {}\n", enumerate(result.unfrozen));
  for (const Difference& one : result.differences)
    fmt::print("{}: expected {}, got {}; likely cause: {}\n", printable(one.file), one.expected, printable(one.got),
               printable(one.cause));
}

/// The files of a set; those that are whole stay when it is made again.
void tell_ledger(const Recipe& recipe, const fs::path& folder) {
  writes_file("-o", folder / "manifest.json", OutputUse::grows);
  for (const ItemRecipe& item : recipe.items) {
    std::vector<std::string> files = frame_files(item);
    for (const TruthRecipe& truth : item.truths) add_new(files, truth_files(item, truth.effect));
    for (const std::string& file : files) writes_file("-o", folder / file, OutputUse::grows);
  }
}

/// Throws UsageError for a folder that looks like a file.
void check_folder_name(const std::string& out) {
  const std::string extension = lower(fs::path(out).extension().string());
  if (contains(std::vector<std::string>{".json", ".exr", ".png", ".html"}, extension))
    throw UsageError(
        "-o {}: is the folder to make the set in, and looks like a file; name a folder, such as sets/gloam-1{}", out,
        extension == ".json" ? ", and --json FILE for the figures" : "");
}

void make(const SetCommand& flags) {
  check_folder_name(flags.out);
  if (flags.name.empty()) throw UsageError("set make: needs the name of a set; gloam set list shows them");
  Recipe recipe = find_recipe(flags.name);
  if (flags.seed) recipe = seeded_recipe(recipe, uint64_t(*flags.seed));
  MakeOptions options;
  options.folder = folder_of(flags);
  tell_ledger(recipe, options.folder);
  check_paths({}, {{"--json", flags.json.file()}});
  if (!flags.only.empty()) options.only = split_list(flags.only, "--only");
  if (flags.seed) options.seed = uint64_t(*flags.seed);
  options.gloam = GLOAM_VERSION, options.commit = bench::commit;
  const auto bar = progress_bar();
  if (bar) options.progress = [&](const std::string&, double share) { bar(int(1e4 * share), 10000); };
  if (!flags.json.only_json())
    options.item_done = [&](const SetItem& item, double seconds) {
      fmt::print("{}\n", line_of(item, seconds));
      std::fflush(stdout);
    };
  const MakeResult result = make_set(recipe, options);
  flags.json.write(document_of(flags, result));
  if (!flags.json.only_json()) print_result(flags, result);
  if (!result.differences.empty())
    throw Error("{}: {} {} from the frozen set {}: errors measured on it cannot be compared with those of others",
                options.folder.string(), counted(result.differences.size(), "file"),
                result.differences.size() == 1 ? "differs" : "differ", flags.name);
}

// --- verify

Json document_of(const Verification& found) {
  Json problems = Json::array();
  for (const Problem& one : found.problems) problems.push_back({{"file", one.file}, {"problem", one.problem}});
  const Manifest& manifest = found.manifest;
  return {{"set", manifest.set},
          {"part", manifest.part},
          {"seed", manifest.seed ? Json(*manifest.seed) : Json()},
          {"hash", manifest.hash},
          {"files", found.files},
          {"held", found.problems.empty()},
          {"complete", found.missing.empty()},
          {"missing", found.missing},
          {"unfrozen", found.unfrozen},
          {"problems", problems}};
}

void print_verification(const std::string& folder, const Verification& found) {
  for (const Problem& one : found.problems) fmt::print("{} {}\n", printable(one.file), printable(one.problem));
  if (!found.missing.empty())
    fmt::print("not complete: {} not made: {}; gloam set make {} -o {} makes them\n",
               counted(found.missing.size(), "item"), enumerate(found.missing), quoted_for_shell(found.manifest.set),
               quoted_for_shell(folder));
  if (!found.unfrozen.empty())
    fmt::print("not frozen yet, so compared with the manifest alone: {}\n", enumerate(found.unfrozen));
  if (found.problems.empty())
    fmt::print("{}: {} of {} {} as {}; hash {}\n", printable(folder), counted(size_t(found.files), "file"),
               printable(found.manifest.set), found.files == 1 ? "is" : "are",
               found.manifest.seed ? "the manifest says" : "frozen", found.manifest.hash);
}

void verify(const SetCommand& flags) {
  if (flags.name.empty()) throw UsageError("set verify: needs the folder of a set: gloam set verify DIR");
  check_paths({}, {{"--json", flags.json.file()}});
  const Verification found = verify_set(flags.name, progress_bar());
  flags.json.write(document_of(found));
  if (!flags.json.only_json()) print_verification(flags.name, found);
  if (!found.problems.empty())
    throw Error("{}: {} of the set {} {} not as the set says", flags.name, counted(found.problems.size(), "file"),
                found.manifest.set, found.problems.size() == 1 ? "is" : "are");
}

const std::vector<std::string> actions = {"list", "make", "verify"};

void set_command(const SetCommand& flags) {
  if (!contains(actions, flags.action))
    throw UsageError("set: no '{}'{}; there are {}", flags.action, suggestion(flags.action, actions),
                     enumerate(actions));
  if (flags.action == "make") return make(flags);
  check_makes_nothing(flags);
  if (flags.action == "verify") return verify(flags);
  if (flags.name.empty()) return list_sets(flags.json);
  list_items(find_recipe(flags.name), flags.json);
}

}  // namespace

void add_set(CLI::App& app) {
  auto flags = std::make_shared<SetCommand>();
  CLI::App* command =
      app.add_subcommand("set", "frozen sets of frames and truths: what there is, make one, verify one");
  add_text(*command, "action", flags->action, type_of_words(actions), "what to do")->required();
  add_text(*command, "name", flags->name, "NAME|DIR",
           "make: the set; verify: its folder; list: a set, to show its items");
  add_text(*command, "-o,--output", flags->out, "DIR", "folder to make the set in; default: one of its name");
  add_text(*command, "--only", flags->only, "ITEM,ITEM", "make only these items (gloam set list NAME)");
  add_number(*command, "--seed", flags->seed, allowed_seeds,
             "make the seeded part instead: items that are drawn from this number", "N");
  flags->json.add_to(*command);
  command->footer(
      "A set is the same on every machine, and has hashes to prove it. An interrupted make goes on where it stopped. "
      "Examples:\n"
      "  gloam set list\n"
      "  gloam set list gloam-1\n"
      "  gloam set make gloam-1 -o sets/gloam-1\n"
      "  gloam set make gloam-1 --only courtyard,gallery\n"
      "  gloam set make gloam-1 --seed 7\n"
      "  gloam set verify sets/gloam-1");
  command->callback([flags] { set_command(*flags); });
}

}  // namespace gloam::cli
