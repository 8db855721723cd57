// gloam report DIR: what gloam bench measured, as one page
#include <fstream>
#include <memory>

#include "gloam/error.h"
#include "gloam/files.h"
#include "options.h"
#include "report/page.h"

namespace gloam::cli {
namespace {

struct ReportCommand {
  std::string folder, picture_width = "640";
  JsonFlag json;
};

Json setting_of(const report::Row& row) {
  return {{"technique", row.technique}, {"preset", row.preset}, {"variant", row.variant}};
}

/// Who is on which front.
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

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw Error("{}: cannot be written", path.string());
  });
}

void report_command(const ReportCommand& flags) {
  const std::filesystem::path folder = flags.folder, path = folder / "report.html";
  report::PageOptions options;
  options.picture_width = parse_whole_number(flags.picture_width, "--picture-width", 0, 65536);
  const report::Measurements measurements = report::read_measurements(folder);
  check_paths({{"bench.json", (folder / "bench.json").string()}},
              {{"report.html", path.string()}, {"--json", flags.json.file()}});
  options.progress = progress_bar();
  const report::Page page = report::make_page(measurements, folder, options);
  note(page.notes);
  write_text(path, page.html);
  flags.json.write(document_of(measurements, path.string()));
  if (flags.json.only_json()) return;
  const auto counted = [](size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  fmt::print("wrote {}: {}, {}, {}, {:.1f} MB\n", printable(path.string()), counted(measurements.rows.size(), "row"),
             counted(measurements.scenes.size(), "scene"), counted(size_t(page.pictures), "picture"),
             double(page.html.size()) / 1e6);
}

}  // namespace

void add_report(CLI::App& app) {
  auto flags = std::make_shared<ReportCommand>();
  CLI::App* command = app.add_subcommand("report", "what gloam bench measured, as one page for a browser");
  command->add_option("folder", flags->folder, "folder that gloam bench -o wrote")->required()->type_name("DIR");
  command
      ->add_option("--picture-width", flags->picture_width, "reduce wider pictures to this; 0: as stored; default: 640")
      ->type_name("PIXELS");
  flags->json.add_to(*command);
  command->footer(
      "Writes DIR/report.html, one file that needs no other and no network. Examples:\n"
      "  gloam report out/bench\n"
      "  gloam report out/bench --picture-width 0 --json -");
  command->callback([flags] { report_command(*flags); });
}

}  // namespace gloam::cli
