#include "cli/report/compare.h"

#include "base/files.h"
#include "gloam/error.h"
#include "report/comparison_page.h"

namespace gloam::cli {
namespace {

void print_cells(const std::vector<std::vector<std::string>>& cells, size_t first_number) {
  std::vector<std::vector<std::string>> shown = cells;
  for (std::vector<std::string>& row : shown) {
    for (std::string& cell : row) cell = printable(cell);
  }
  fmt::print("\n");
  print_table(shown, first_number);
}

}  // namespace

std::string shown_path(const std::filesystem::path& path) {
  if (path.is_relative()) return path.lexically_normal().generic_string();
  const std::filesystem::path normal = (path / "").lexically_normal().parent_path();  // without a slash at the end
  return (normal.parent_path().filename() / normal.filename()).generic_string();
}

report::Source result_of(const std::string& given) {
  const std::filesystem::path file = report::measurements_file(given);
  return {shown_path(file), file, report::read_measurements_file(file)};
}

void print(const report::Comparison& comparison, const report::Source& first, const report::Source& second) {
  for (const std::string& line : report::heading_of(comparison, first, second)) fmt::print("{}\n", printable(line));
  if (const auto table = report::table_of_techniques(comparison); table.size() > 1) print_cells(table, 2);
  if (const auto table = report::table_of_rows(comparison, true); table.size() > 1) print_cells(table, 6);
  if (const auto table = report::table_of_devices(comparison, first, second); table.size() > 1) print_cells(table, 6);
  fmt::print("\n");
  for (const std::string& line : report::counts_of(comparison, first, second)) fmt::print("{}\n", printable(line));
}

void report_compare(const std::string& first, const std::string& second, const std::string& markdown,
                    const JsonFlag& json) {
  const report::Source a = result_of(first), b = result_of(second);
  check_paths({{first, a.file.string()}, {second, b.file.string()}},
              {{"--markdown", markdown}, {"--json", json.file()}});
  const report::Comparison comparison = report::compare(a, b);
  note(comparison.notes);
  if (!markdown.empty()) {
    const std::string command = fmt::format("gloam report {} {} --compare --markdown {}", quoted_for_shell(a.name),
                                            quoted_for_shell(b.name), quoted_for_shell(shown_path(markdown)));
    write_text(markdown, report::page_of(comparison, a, b, command));
  }
  json.write(report::document_of(comparison, a, b));
  if (!json.only_json()) print(comparison, a, b);
}

}  // namespace gloam::cli
