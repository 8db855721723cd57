#include "leaderboard/results.h"

#include <algorithm>
#include <tuple>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/json_text.h"
#include "gloam/error.h"
#include "results/hard_cases.h"

namespace gloam::leaderboard {
namespace {

namespace fs = std::filesystem;
using report::Json;

/// FOLDER/*.json and FOLDER/*/bench.json, sorted.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::error_code unknown;
  if (!fs::is_directory(folder, unknown))
    throw Error("{}: is not a folder; name one that holds files of gloam bench or gloam score", folder.string());
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory(unknown)) {
      if (fs::is_regular_file(entry.path() / "bench.json", unknown)) files.push_back(entry.path() / "bench.json");
    } else if (entry.path().extension() == ".json") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw Error("{}: holds no results, neither *.json nor */bench.json; 'gloam bench --set SET -o {}' measures some",
                folder.string(), (folder / "NAME").string());
  return files;
}

/// Only looked at: what the leaderboard itself wrote may be written again.
Json document_of(const fs::path& file) {
  const LooksAtFiles looks;
  return ordered_json_of_text(read_text(file), file.string());
}

/// Whether a document is that of an earlier `gloam leaderboard --json`.
bool is_of_leaderboard(const Json& document) {
  return document.is_object() && document.contains("page") && document.contains("boards");
}

void check_one_version(const Board& board, const Results& results, const Source& added) {
  const Source& first = results.files[board.files.front()];
  if (board.set.hash == added.measurements.set.hash) return;
  throw Error("{}: is of the set {} with the hash {}, and {} with {}: two versions; leave one of the two files out",
              added.file.string(), title_of(board.set), added.measurements.set.hash.substr(0, 12), first.file.string(),
              board.set.hash.substr(0, 12));
}

bool is_same_set(const report::SetFacts& a, const report::SetFacts& b) {
  return a.name == b.name && a.part == b.part && a.seed == b.seed;
}

void add_results(Results& results, Source source) {
  const report::SetFacts& set = source.measurements.set;
  const auto is_it = [&](const Board& board) { return is_same_set(board.set, set); };
  auto board = std::find_if(results.boards.begin(), results.boards.end(), is_it);
  if (board == results.boards.end()) {
    results.boards.push_back({set, {}});
    board = results.boards.end() - 1;
  } else {
    check_one_version(*board, results, source);
  }
  board->files.push_back(results.files.size());
  for (auto* rows : {&source.measurements.rows, &source.measurements.submitted}) {
    for (report::Row& row : *rows) row.source = results.files.size();
  }
  if (!source.measurements.stability.empty())
    results.stability.push_back({source.name, source.measurements.device, source.measurements.stability});
  results.files.push_back(std::move(source));
}

/// Sets by name; frames without a set last.
void order(std::vector<Board>& boards) {
  std::stable_sort(boards.begin(), boards.end(), [](const Board& a, const Board& b) {
    return std::tuple(a.set.name.empty(), a.set.name, a.set.part, a.set.seed) <
           std::tuple(b.set.name.empty(), b.set.name, b.set.part, b.set.seed);
  });
}

}  // namespace

Results read_results(const fs::path& folder) {
  Results results;
  for (const fs::path& file : files_in(folder)) {
    const std::string name = file.lexically_relative(folder).generic_string();
    const Json document = document_of(file);
    if (is_of_leaderboard(document)) continue;
    reads_file(file, name);
    if (report::is_of_hard_cases(document)) {
      report::HardCases found = report::hard_cases_of(document, file);
      results.stability.push_back({name, found.device, found.techniques});
    } else if (document.is_object() && !document.contains("results")) {
      throw Error(
          "{}: holds neither results of gloam bench or gloam score nor hard cases of gloam stress; "
          "move it to another folder",
          file.string());
    } else {
      add_results(results, {name, file, report::read_measurements_file(file)});
    }
  }
  if (results.files.empty())
    throw Error("{}: holds {}; add a file of gloam bench or gloam score", folder.string(),
                results.stability.empty() ? "an earlier leaderboard alone" : "hard cases alone");
  order(results.boards);
  return results;
}

std::string title_of(const report::SetFacts& set) {
  if (set.name.empty()) return "frames without a set";
  if (set.part.empty() || set.part == "public") return set.name;
  return set.seed ? fmt::format("{}, {} part (seed {:.0f})", set.name, set.part, *set.seed)
                  : fmt::format("{}, {} part", set.name, set.part);
}

}  // namespace gloam::leaderboard
