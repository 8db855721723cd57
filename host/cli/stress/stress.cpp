// gloam stress TECHNIQUE|all: hard cases, on any device
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "base/files.h"
#include "base/json_text.h"
#include "cli/process/chunk_commands.h"
#include "cli/stress/child.h"
#include "cli/stress/chunks.h"
#include "cli/stress/request.h"
#include "gloam/error.h"
#include "stress/document.h"
#include "stress/page.h"

namespace gloam::cli {
namespace {

using stress::CaseResult;
using stress::Finding;
using stress::StressRun;

std::string shown(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "inf"; }

std::string text_of(const stress::Place& place) {
  if (place.plane.empty()) return "";
  return fmt::format("{}{} at ({}, {}): {}", place.view.empty() ? "" : place.view + ".", place.plane, place.x, place.y,
                     place.holds);
}

/// Prints every finding of one technique.
void print_findings(const std::vector<CaseResult>& results) {
  std::vector<std::vector<std::string>> rows = {{"case", "", "worst", "bound", "measured"}};
  for (const CaseResult& result : results) {
    const std::string number = fmt::format("{}", result.number);
    if (!result.opted_out.empty()) rows.push_back({number, "-", "", "", "opted out: " + result.opted_out});
    for (const std::string& reason : result.opted_out_parts)
      rows.push_back({number, "-", "", "", "opted out of " + reason});
    for (const std::string& reason : result.passed_over) rows.push_back({number, "-", "", "", "not asked: " + reason});
    for (const Finding& f : result.findings)
      rows.push_back({number, f.held() ? "held" : "FAILED", shown(f.worst),
                      std::isinf(f.bound) ? "stated" : shown(f.bound), f.what});
    if (!result.broken.empty()) rows.push_back({number, "FAILED", "", "", "broken off: " + result.broken});
  }
  print_table(rows, 5);
}

void print_failures(const StressRun& run, const std::string& device_flag) {
  for (const CaseResult& result : run.results) {
    const std::string name =
        fmt::format("{}, case {} ({})", result.technique, result.number, stress::find_case(result.number).name);
    if (!result.broken.empty()) fmt::print("\n{}\n  broken off in {}\n", name, result.broken);
    for (const Finding& f : result.findings) {
      if (f.held()) continue;
      fmt::print("\n{}\n  {}: {} where {} is the most\n  {}\n  {}\n  again: {} -o FOLDER\n", name, f.what,
                 shown(f.worst), shown(f.bound), f.conditions, text_of(f.place),
                 replay_command(run, result.technique, result.number, f.trial, device_flag));
    }
  }
}

/// Prints one line for a finished technique, in a long run over many.
void print_done(const std::string& technique, const std::vector<CaseResult>& results) {
  int held = 0, opted_out = 0, failed = 0, trials = 0;
  for (const CaseResult& result : results) {
    trials += result.trials;
    if (!result.opted_out.empty())
      ++opted_out;
    else
      ++(result.held() ? held : failed);
  }
  fmt::print("{:<20} {:>6} trials, {:>2} cases held, {} opted out, {} failed\n", technique, trials, held, opted_out,
             failed);
  std::fflush(stdout);
}

using ResultsByTechnique = std::map<std::string, std::vector<CaseResult>>;

/// Puts the known results into the run, by technique.
void gather(const StressRequest& request, const ResultsByTechnique& known, StressRun& run) {
  run.results.clear();
  run.left.clear();
  for (const std::string& technique : request.techniques) {
    const auto found = known.find(technique);
    if (found == known.end()) {
      run.left.push_back(technique);
      continue;
    }
    std::copy(found->second.begin(), found->second.end(), std::back_inserter(run.results));
  }
}

/// The device flags to repeat a trial: a device asked for by name, and the devices compared with.
std::string device_flags(const StressCommand& flags) {
  return flags.as_text() + (flags.against == "all" ? "" : " --against " + quoted_for_shell(flags.against));
}

/// Examines all techniques, several at a time. An ordinary error of one of them, such as a missing device, ends all. The file of
/// --json is written after each technique, so that an interrupted run keeps its results.
void examine_all(const StressCommand& flags, const StressRequest& request, StressRun& run) {
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  const int jobs = flags.jobs.value_or(cores);
  ResultsByTechnique known;
  // Those of two eyes take the longest: begun last, they would keep one core busy alone.
  std::vector<std::string> techniques = request.techniques;
  std::stable_sort(techniques.begin(), techniques.end(), [](const std::string& a, const std::string& b) {
    return find_technique(a).views > find_technique(b).views;
  });
  std::atomic<size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto progress = progress_bar();
  const auto take = [&](const std::string& technique, const Examination& examination) {
    std::vector<CaseResult>& results = known[technique] = examination.results;
    std::sort(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    if (!examination.device.is_null()) {
      run.device = examination.device.at("device");
      run.driver = examination.device.at("driver");
      run.others = examination.device.at("against");
    }
    gather(request, known, run);
    if (run.left.empty()) return;  // the final message comes with the exit status
    if (!flags.json.file().empty()) {
      if (known.size() == 1)
        say_on_interruption("the file of --json is as it was, or holds the techniques that were done");
      flags.json.write(document_of(run, device_flags(flags)));
      say_on_interruption("the file of --json holds the techniques that were done");
    }
  };
  const auto work = [&] {
    for (size_t i = next++; i < techniques.size(); i = next++) {
      const std::string& technique = techniques[i];
      Examination examination(flags, request, technique);
      std::exception_ptr thrown;
      try {
        examination.run();
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(mutex);
      try {
        if (!thrown) take(technique, examination);
      } catch (...) {
        thrown = std::current_exception();
      }
      if (thrown) failure = thrown, next = request.techniques.size();
      if (request.techniques.size() > 1 && !thrown && !flags.json.only_json() && !is_quiet())
        print_done(technique, examination.results);
      if (progress) progress(int(known.size()), int(request.techniques.size()));
    }
  };
  std::vector<std::thread> workers;
  for (int i = 0; i < std::min(jobs, int(request.techniques.size())); ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  if (failure) std::rethrow_exception(failure);
}

void write_page(const std::string& path, const std::vector<stress::Json>& documents) {
  if (!path.empty()) write_text(path, stress::stability_page(documents));
}

stress::Json read_document(const std::string& path) {
  const stress::Json document = json_of_text(read_text(path), path);
  const auto refuse = [&] {
    throw Error("{}: holds no results of this gloam's stress command; gloam stress all --json FILE writes some", path);
  };
  try {
    stress::stability_page({document});
    for (const stress::Json& entry : document.at("cases")) entry.at("replay").get<std::string>();
  } catch (const Error&) {
    refuse();
  } catch (const stress::Json::exception&) {
    refuse();
  }
  return document;
}

/// The results of earlier runs, joined: as a page, or in words with the exit status that one run would have had.
void join_files(const StressCommand& flags) {
  if (!flags.technique.empty())
    throw UsageError("stress: --from joins earlier results and examines nothing; leave out '{}'", flags.technique);
  std::vector<NamedPath> inputs;
  for (const std::string& path : flags.from) inputs.emplace_back("--from", path);
  check_paths(inputs, {{"--markdown", flags.markdown}, {"--json", flags.json.file()}});
  std::vector<StressFile> files;
  for (const std::string& path : flags.from) files.push_back({path, read_document(path)});
  const std::vector<stress::Json> documents = joined(files);
  if (!flags.json.path.empty() && documents.size() > 1)
    throw UsageError(
        "--json {}: holds the results of one device and one set of settings, and --from those of {}; join "
        "them one by one",
        flags.json.path, documents.size());
  write_page(flags.markdown, documents);
  if (!flags.json.path.empty()) flags.json.write(documents.front());
  if (flags.markdown.empty()) return judge(documents, !flags.json.only_json());
  if (!flags.json.only_json()) fmt::print("wrote {}\n", printable(flags.markdown));
}

/// Throws UsageError if the requested trial does not exist.
void check_trial(const StressCommand& flags, const StressRequest& request, const StressRun& run) {
  if (!request.trial || run.results.empty()) return;
  const CaseResult& result = run.results[0];
  if (!result.broken.empty() || result.trials >= *request.trial) return;
  std::string why = result.opted_out.empty() ? "" : "; opted out: " + result.opted_out;
  for (const std::string& reason : result.passed_over) why += "; not asked: " + reason;
  throw UsageError("--trial {}: case {} of {} has {} trials{}{}", *request.trial, request.cases[0], flags.technique,
                   result.trials, flags.quick ? " in a quick look" : "", why);
}

void make_folder(const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error("-o {}: this folder cannot be made ({}); name another", folder, failed.message());
}

void stress_command(const StressCommand& flags) {
  if (flags.is_child) return examine_here(flags);
  if (!flags.from.empty()) return join_files(flags);
  if (flags.technique.empty()) throw UsageError("stress: which technique? name one, or all (gloam list techniques)");
  const StressRequest request = request_of(flags);
  if (flags.chunks > 0) return print_stress_chunks(flags, request);
  check_paths({}, {{"--markdown", flags.markdown}}, {{"--json", flags.json.file()}});
  if (!flags.out.empty()) make_folder(flags.out);
  StressRun run{.extent = request.extent, .seed = request.seed, .frames = request.frames};
  examine_all(flags, request, run);
  check_trial(flags, request, run);
  const std::string device_flag = device_flags(flags);
  const stress::Json document = document_of(run, device_flag);
  write_page(flags.markdown, {document});
  flags.json.write(document);
  const int failed = stress::failures(run);
  if (!flags.json.only_json()) {
    if (request.techniques.size() == 1) print_findings(run.results);
    print_failures(run, device_flag);
    fmt::print("{}, {}; compared with {}\n", printable(run.device), printable(run.driver),
               run.others.empty() ? "no other device" : printable(fmt::format("{}", fmt::join(run.others, "; "))));
  }
  if (failed > 0)
    throw Error("stress: {} of the figures {} beyond {} bound", failed, failed == 1 ? "is" : "are",
                failed == 1 ? "its" : "their");
}

}  // namespace

void add_stress(CLI::App& app) {
  auto flags = std::make_shared<StressCommand>();
  CLI::App* command =
      app.add_subcommand("stress", "go through frames that are hard to get right, and say how stable a technique is");
  add_text(*command, "technique", flags->technique, "TECHNIQUE", "one or several, A,B (gloam list techniques), or all");
  command->add_option("--case", flags->cases, "only these, by number: 3 or 1,7 (gloam list cases)")
      ->check(accepted_by(parse_cases, "--case"))  // stays text, for messages
      ->type_name("N,N");
  add_number(*command, "--trial", flags->trial, {1, std::numeric_limits<int>::max()},
             "only this trial of one case, to see what was found", "N");
  command->add_flag("--quick", flags->quick, "a few of each kind: what a build can afford each time");
  add_number(*command, "--frames", flags->frames, {1, 1000000000}, "random frames of case 1 (quick 60, else 1000)",
             "N");
  add_number(*command, "--seed", flags->seed, allowed_seeds, "of the random frames (1)", "N");
  flags->DeviceFlags::add_to(*command);
  command->add_option("--against", flags->against, "devices to compare with: part of a name, all, or none")
      ->capture_default_str();
  add_number(*command, "--jobs", flags->jobs, {1, 1024}, "techniques at a time (as many as there are cores)", "N");
  add_number(*command, "--patience", flags->patience, {1, 1e6},
             "seconds without a sign of life after which a trial is given up (600)", "SECONDS");
  add_text(*command, "-o,--output", flags->out, "DIR", "folder for the frames of a --trial and what was made of them");
  add_text(*command, "--markdown", flags->markdown, "FILE.md", "write a page with all figures");
  add_text(*command, "--from", flags->from, "FILE.json",
           "what earlier runs wrote with --json, joined: in words, or as the page of --markdown")
      ->take_all();
  add_chunk_flags(*command, flags->chunks, flags->print, "the techniques, or the cases of a single one,",
                  "Several machines");
  command->add_flag("--child", flags->is_child)->group("");
  flags->json.add_to(*command);
  command->footer(
      "Examples:\n"
      "  gloam stress hbao+\n"
      "  gloam stress all --quick --device NVIDIA --json stress.json\n"
      "  gloam stress gtao --case 3 --trial 17 -o out/trial\n"
      "  gloam stress all --frames 10000 --json 'stress.##.json' --chunks 8 --print | parallel\n"
      "  gloam stress --from stress.*.json\n"
      "Exit status 1 when something is beyond its bound.");
  command->callback([flags, command] {
    if (flags->chunks > 0) flags->repeated = repeated_words(*command, not_of_stress_chunks());
    stress_command(*flags);
  });
}

}  // namespace gloam::cli
