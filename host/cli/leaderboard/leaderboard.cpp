// gloam leaderboard FOLDER: result files as one page that orders methods by error, time and more
#include <memory>

#include "base/files.h"
#include "cli/flags/options.h"
#include "leaderboard/page.h"

namespace gloam::cli {
namespace {

using leaderboard::ShownPictures;

const Choices<ShownPictures> shown_pictures{
    {"plain", ShownPictures::plain}, {"all", ShownPictures::all}, {"none", ShownPictures::none}};

struct LeaderboardCommand {
  std::string folder, output;
  std::optional<int> picture_width;
  ShownPictures shown = ShownPictures::plain;
  JsonFlag json;
};

void leaderboard_command(const LeaderboardCommand& flags) {
  const std::filesystem::path folder = flags.folder;
  const std::filesystem::path path =
      flags.output.empty() ? folder / "leaderboard.html" : std::filesystem::path(flags.output);
  const leaderboard::Results results = leaderboard::read_results(folder);
  std::vector<NamedPath> inputs;
  for (const leaderboard::Source& file : results.files) inputs.push_back({file.name, file.file.string()});
  check_paths(inputs, {{"--output", path.string()}, {"--json", flags.json.file()}});
  leaderboard::PageOptions options;
  options.picture_width = flags.picture_width.value_or(options.picture_width);
  options.shown = flags.shown;
  options.progress = progress_bar();
  leaderboard::Page page = leaderboard::make_page(results, options);
  note(page.notes);
  write_text(path, page.html);
  Json document = {{"page", path.string()}};
  document.update(page.document);
  flags.json.write(document, {path.string()});
  if (flags.json.only_json()) return;
  fmt::print("wrote {}: from {}, {}, {}, {}, {:.1f} MB\n", printable(path.string()),
             counted(results.files.size(), "file"), counted(page.methods, "method"), counted(page.items, "item"),
             counted(size_t(page.pictures), "picture"), double(page.html.size()) / 1e6);
}

}  // namespace

void add_leaderboard(CLI::App& app) {
  auto flags = std::make_shared<LeaderboardCommand>();
  CLI::App* command =
      app.add_subcommand("leaderboard", "methods by error, time and more, from the result files of a folder");
  add_text(*command, "folder", flags->folder, "FOLDER",
           "folder of files that gloam bench, gloam score and gloam stress --json wrote, and of "
           "folders with a bench.json each")
      ->required();
  add_text(*command, "-o,--output", flags->output, "PAGE.html", "page to write; default: FOLDER/leaderboard.html");
  add_number(*command, "--picture-width", flags->picture_width, {0, 65536},
             "reduce wider pictures to this; 0: as stored; default: 480", "PIXELS");
  add_choice(*command, "--pictures", flags->shown, shown_pictures,
             "which pictures the page holds; plain (the default): without variants");
  flags->json.add_to(*command);
  command->footer(
      "Writes one file that needs no other and no network. Examples:\n"
      "  gloam leaderboard data/results/gloam-1\n"
      "  gloam leaderboard results -o leaderboard.html --json table.json");
  command->callback([flags] { leaderboard_command(*flags); });
}

}  // namespace gloam::cli
