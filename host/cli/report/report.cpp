// gloam report DIR: results of gloam bench, as one page for a browser or as a page of documentation
#include <algorithm>
#include <cctype>
#include <fstream>
#include <memory>

#include "base/files.h"
#include "cli/flags/options.h"
#include "cli/report/compare.h"
#include "gloam/error.h"
#include "report/markdown.h"
#include "report/page.h"

namespace gloam::cli {
namespace {

struct ReportCommand {
  std::vector<std::string> sources;
  std::string markdown, pictures;
  std::optional<int> picture_width;
  bool compare = false;
  JsonFlag json;
};

Json setting_of(const report::Row& row) {
  return {{"technique", row.technique}, {"preset", row.preset}, {"variant", row.variant}};
}

/// JSON of the fronts and their settings.
Json document_of(const report::Measurements& measurements, const std::string& path) {
  Json scenes = Json::array(), classes = Json::array();
  for (const report::Scene& scene : measurements.scenes) {
    Json front = Json::array();
    for (const size_t i : report::front_of_scene(measurements.rows, scene.name).all)
      front.push_back(setting_of(measurements.rows[i]));
    scenes.push_back({{"name", scene.name}, {"front", front}});
  }
  for (const report::ClassFront& each : report::fronts_of_classes(measurements)) {
    Json front = Json::array();
    for (const report::ClassPoint& p : each.points) {
      if (!p.on_front) continue;
      front.push_back({{"technique", p.technique},
                       {"preset", p.preset},
                       {"variant", p.variant},
                       {"scenes_on_front", p.fronts.size()},
                       {"scenes", each.scenes.size()}});
    }
    classes.push_back({{"name", each.name}, {"front", front}});
  }
  return {{"report", path}, {"scenes", scenes}, {"classes", classes}};
}

// --- For a browser

void write_page(const ReportCommand& flags) {
  const std::filesystem::path folder = flags.sources.front(), path = folder / "report.html";
  report::PageOptions options;
  options.picture_width = flags.picture_width.value_or(options.picture_width);
  const report::Measurements measurements = report::read_measurements(folder);
  check_paths({{"bench.json", (folder / "bench.json").string()}},
              {{"report.html", path.string()}, {"--json", flags.json.file()}});
  options.progress = progress_bar();
  const report::Page page = report::make_page(measurements, folder, options);
  note(page.notes);
  write_text(path, page.html);
  flags.json.write(document_of(measurements, path.string()));
  if (flags.json.only_json()) return;
  const auto& sequence = measurements.sequence;
  const size_t submitted = measurements.submitted.size();
  fmt::print("wrote {}: {}, {}{}, {}, {}{:.1f} MB\n", printable(path.string()),
             counted(measurements.rows.size(), "row"), submitted ? counted(submitted, "submitted row") + ", " : "",
             counted(measurements.scenes.size(), "scene"), counted(size_t(page.pictures), "picture"),
             sequence ? counted(sequence->rows.size(), "row") + " of a shot, " : "", double(page.html.size()) / 1e6);
}

// --- For documentation

std::string command_of(const ReportCommand& flags) {
  std::string command = "gloam report";
  for (const std::string& source : flags.sources) command += " " + quoted_for_shell(shown_path(source));
  command += " --markdown " + quoted_for_shell(shown_path(flags.markdown));
  if (!flags.pictures.empty()) command += " --pictures " + quoted_for_shell(shown_path(flags.pictures));
  return command;
}

std::vector<report::Source> read_sources(const ReportCommand& flags) {
  std::vector<report::Source> sources;
  for (const std::string& given : flags.sources) sources.push_back(result_of(given));
  return sources;
}

/// Call it before writing: throws if an output is also an input or cannot be written in its place.
void check_outputs(const ReportCommand& flags, const report::MarkdownPage& page) {
  std::vector<NamedPath> inputs, outputs{{"--markdown", flags.markdown}, {"--json", flags.json.file()}};
  for (const std::string& given : flags.sources) inputs.push_back({given, report::measurements_file(given).string()});
  for (const report::PictureFile& picture : page.pictures) outputs.push_back({"--pictures", picture.path.string()});
  check_paths(inputs, outputs);
  for (const auto& [flag, path] : outputs) {
    std::error_code unknown;
    if (std::filesystem::is_directory(path, unknown))
      throw Error("{} {}: cannot be written, it is a folder; name a file in it", flag, path);
  }
}

Json document_of(const report::MarkdownPage& page, const std::string& path) {
  Json pictures = Json::array(), groups = Json::array();
  for (const report::PictureFile& picture : page.pictures) pictures.push_back(picture.path.string());
  for (const report::GroupChoices& group : page.groups) {
    Json needs = Json::array();
    for (const report::Choice& choice : group.choices) {
      Json need = {{"need", choice.need}, {"setting", nullptr}};
      if (const auto& p = choice.best) {
        need["setting"] = {{"technique", p->technique}, {"preset", p->preset}, {"variant", p->variant}};
        need["rmse"] = p->error;
        need["bias"] = p->bias ? Json(*p->bias) : Json(nullptr);
        need["ratio"] = p->ratio;
      }
      needs.push_back(need);
    }
    groups.push_back({{"name", group.name}, {"scenes", group.scenes}, {"needs", needs}});
  }
  return {{"markdown", path}, {"pictures", pictures}, {"groups", groups}};
}

void write_markdown(const ReportCommand& flags) {
  if (flags.picture_width)
    throw UsageError("--picture-width {}: is for report.html and not allowed beside --markdown; leave it out",
                     *flags.picture_width);
  std::error_code unknown;
  if (!flags.pictures.empty() && !std::filesystem::is_directory(flags.pictures, unknown))
    throw Error("--pictures {}: is not a folder; make it first", flags.pictures);
  const std::vector<report::Source> sources = read_sources(flags);
  const report::MarkdownPage page = report::make_markdown(sources, {command_of(flags), flags.markdown, flags.pictures});
  check_outputs(flags, page);
  note(page.notes);
  // The page is written last, so that it never links to a missing picture.
  for (const report::PictureFile& picture : page.pictures) write_text(picture.path, picture.png);
  write_text(flags.markdown, page.text);
  flags.json.write(document_of(page, flags.markdown));
  if (flags.json.only_json()) return;
  fmt::print("wrote {}: from {}, {}\n", printable(flags.markdown), counted(sources.size(), "file"),
             counted(page.pictures.size(), "picture"));
}

void compare_command(const ReportCommand& flags) {
  if (flags.sources.size() != 2)
    throw UsageError("--compare: takes two results, the one before and the one after, and {} given",
                     flags.sources.size() == 1 ? "one is" : fmt::format("{} are", flags.sources.size()));
  report_compare(flags.sources[0], flags.sources[1], flags.markdown, flags.json);
}

void report_command(const ReportCommand& flags) {
  if (flags.compare) return compare_command(flags);
  if (!flags.markdown.empty()) return write_markdown(flags);
  if (!flags.pictures.empty())
    throw UsageError("--pictures {}: needs --markdown FILE.md; report.html has its pictures in itself", flags.pictures);
  if (flags.sources.size() > 1)
    throw UsageError(
        "{} folders: report.html is made of one; of several a page of documentation is, with --markdown FILE.md",
        flags.sources.size());
  std::error_code unknown;
  if (std::filesystem::is_regular_file(flags.sources.front(), unknown))
    throw UsageError(
        "{}: is a file; report.html is made of the folder that gloam bench -o wrote, a file does for --markdown",
        flags.sources.front());
  write_page(flags);
}

}  // namespace

void add_report(CLI::App& app) {
  auto flags = std::make_shared<ReportCommand>();
  CLI::App* command =
      app.add_subcommand("report", "what gloam bench measured, as one page for a browser or for documentation");
  add_text(*command, "source", flags->sources, "DIR|JSON",
           "folder that gloam bench -o wrote; with --markdown also a bench.json by itself, and several of either")
      ->required();
  add_number(*command, "--picture-width", flags->picture_width, {0, 65536},
             "reduce wider pictures to this; 0: as stored; default: 480", "PIXELS");
  CLI::Option* compare = command->add_flag(
      "--compare", flags->compare,
      "say of two results which rows are faster or slower, nearer or farther; --markdown writes all rows as a page");
  add_text(*command, "--markdown", flags->markdown, "FILE.md",
           "write a page of documentation instead: which technique for which need, and all figures")
      ->group("Writing");
  add_text(*command, "--pictures", flags->pictures, "DIR",
           "with --markdown: folder for pictures of up to three scenes, which the page shows")
      ->group("Writing");
  for (const char* of_pages : {"--picture-width", "--pictures"}) compare->excludes(command->get_option(of_pages));
  flags->json.add_to(*command);
  command->footer(
      "Writes DIR/report.html, one file that needs no other and no network. Examples:\n"
      "  gloam report out/bench\n"
      "  gloam report out/bench --picture-width 0 --json -\n"
      "  gloam report out/bench out/mine/bench.json --markdown page.md --pictures images\n"
      "  gloam report before/bench.json after/bench.json --compare");
  command->callback([flags] { report_command(*flags); });
}

}  // namespace gloam::cli
