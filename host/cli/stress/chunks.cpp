#include "cli/stress/chunks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cli/process/chunk_commands.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "sequence/chunks.h"

namespace gloam::cli {
namespace {

using stress::Json;

/// Lists of a document, with an entry for each technique and case.
const std::vector<std::string> lists = {"cases", "opted_out", "opted_out_in_part", "passed_over"};

/// Files that agree in these can be joined.
const std::vector<std::string> conditions = {"device", "driver", "against", "extent", "seed", "frames"};

bool are_alike(const Json& a, const Json& b) {
  return std::all_of(conditions.begin(), conditions.end(), [&](const auto& key) { return a.at(key) == b.at(key); });
}

using TechniqueAndCase = std::pair<std::string, int>;

TechniqueAndCase place_of(const Json& entry) { return {entry.at("technique"), entry.at("case")}; }

std::set<TechniqueAndCase> places_in(const Json& document) {
  std::set<TechniqueAndCase> places;
  for (const std::string& list : lists) {
    for (const Json& entry : document.at(list)) places.insert(place_of(entry));
  }
  return places;
}

std::set<std::string> techniques_in(const Json& document) {
  std::set<std::string> names;
  for (const auto& [technique, number] : places_in(document)) names.insert(technique);
  return names;
}

void add(const Json& more, Json& document) {
  for (const std::string& list : lists) {
    for (const Json& entry : more.at(list)) document.at(list).push_back(entry);
  }
  document["failed"] = document.at("failed").get<int>() + more.at("failed").get<int>();
  std::set<std::string> left = document.at("left"), more_left = more.at("left");
  left.merge(more_left);
  for (const std::string& technique : techniques_in(document)) left.erase(technique);
  document["left"] = left;
}

std::string shown(const Json& number) { return number.is_null() ? "inf" : fmt::format("{:.3g}", number.get<double>()); }

/// One technique's row.
struct Counts {
  std::set<int> cases;
  int figures = 0, beyond = 0, opted_out = 0;
};

void print_counts(const Json& document) {
  std::map<std::string, Counts> counts;
  for (const auto& [technique, number] : places_in(document)) counts[technique].cases.insert(number);
  for (const Json& entry : document.at("cases")) {
    Counts& row = counts[entry.at("technique")];
    ++row.figures;
    row.beyond += !entry.at("held").get<bool>();
  }
  for (const Json& entry : document.at("opted_out")) ++counts[entry.at("technique")].opted_out;
  std::vector<std::vector<std::string>> rows = {{"technique", "cases", "opted out", "figures", "beyond"}};
  for (const auto& [technique, row] : counts)
    rows.push_back({technique, std::to_string(row.cases.size()), std::to_string(row.opted_out),
                    std::to_string(row.figures), std::to_string(row.beyond)});
  print_table(rows, 1);
}

void print_beyond(const Json& document) {
  for (const Json& entry : document.at("cases")) {
    if (entry.at("held").get<bool>()) continue;
    const std::string text =
        fmt::format("{}, case {}: {}: {} where {} is the most\n  {}\n  again: {} -o FOLDER",
                    entry.at("technique").get<std::string>(), entry.at("case").get<int>(),
                    entry.at("what").get<std::string>(), shown(entry.at("worst")), shown(entry.at("bound")),
                    entry.at("conditions").get<std::string>(), entry.at("replay").get<std::string>());
    fmt::print("\n");
    for (const std::string& line : CLI::detail::split(text, '\n')) fmt::print("{}\n", printable(line));
  }
}

void print_one(const Json& document) {
  print_counts(document);
  print_beyond(document);
  std::string against;
  for (const Json& other : document.at("against")) against += (against.empty() ? "" : "; ") + other.get<std::string>();
  fmt::print("{}\n", printable(fmt::format("{}, {}; compared with {}", document.at("device").get<std::string>(),
                                           document.at("driver").get<std::string>(),
                                           against.empty() ? "no other device" : against)));
  const std::set<std::string> there = techniques_in(document);
  std::vector<std::string> absent = technique_names();
  std::erase_if(absent, [&](const std::string& name) { return there.count(name) > 0; });
  if (there.size() > 1 && !absent.empty()) fmt::print("not in these files: {}\n", first_names(absent));
}

}  // namespace

const std::set<std::string>& not_of_stress_chunks() {
  static const std::set<std::string> flags = {"technique", "--case", "--json"};
  return flags;
}

void print_stress_chunks(const StressCommand& flags, const StressRequest& request) {
  if (request.trial)
    throw UsageError("--trial {}: is one trial, which cannot be divided; leave out --chunks", *request.trial);
  if (!flags.markdown.empty())
    throw UsageError("--markdown {}: each chunk would write it; leave it out, and make the page of all files by --from",
                     flags.markdown);
  if (!FramePattern::is_pattern(flags.json.file()))
    throw UsageError(
        "--chunks {}: each chunk writes a file of its own; write a place for its number, such as --json "
        "stress.##.json",
        flags.chunks);
  const FramePattern files(flags.json.path, "--json");
  int number = 0;
  const auto print = [&](const std::string& techniques, const std::string& cases) {
    std::vector<std::string> words = flags.repeated, more = {"--json", files.path_of(++number).string()};
    words.insert(words.begin() + 1, techniques);
    if (!cases.empty()) more.insert(more.begin(), {"--case", cases});
    print_chunk(words, more);
  };
  if (request.techniques.size() > 1) {
    for (const auto& chunk : chunks_of(request.techniques, flags.chunks))
      print(fmt::format("{}", fmt::join(chunk, ",")), flags.cases);
  } else {
    for (const auto& chunk : chunks_of(request.cases, flags.chunks))
      print(request.techniques.front(), fmt::format("{}", fmt::join(chunk, ",")));
  }
  end_of_chunks();
}

std::vector<Json> joined(const std::vector<StressFile>& files) {
  std::vector<Json> documents;
  std::vector<std::map<TechniqueAndCase, std::string>> paths;  // of each document
  for (const StressFile& file : files) {
    const auto is_alike = [&](const Json& document) { return are_alike(document, file.document); };
    const auto i = size_t(std::find_if(documents.begin(), documents.end(), is_alike) - documents.begin());
    if (i == documents.size()) paths.emplace_back();
    for (const TechniqueAndCase& place : places_in(file.document)) {
      const auto [before, is_new] = paths[i].emplace(place, file.path);
      if (!is_new)
        throw Error("{}: case {} of {} is also in {}, of the same device and settings; leave one of the two files out",
                    file.path, place.second, place.first, before->second);
    }
    if (i == documents.size())
      documents.push_back(file.document);
    else
      add(file.document, documents[i]);
  }
  return documents;
}

void judge(const std::vector<Json>& documents, bool in_words) {
  int failed = 0;
  std::set<std::string> left;
  for (const Json& document : documents) {
    if (in_words) print_one(document);
    failed += document.at("failed").get<int>();
    std::set<std::string> more = document.at("left");
    left.merge(more);
  }
  std::string why;
  if (failed > 0)
    why = fmt::format("{} of the figures {} beyond {} bound", failed, failed == 1 ? "is" : "are",
                      failed == 1 ? "its" : "their");
  if (!left.empty())
    why += fmt::format("{}{} techniques were not examined, since a run was broken off: {}; run them again",
                       why.empty() ? "" : "; ", left.size(), first_names({left.begin(), left.end()}));
  if (!why.empty()) throw Error("stress: {}", why);
}

}  // namespace gloam::cli
