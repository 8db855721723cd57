// gloam doctor: whether devices compute what they should, and how they do it fastest
#include <algorithm>
#include <memory>

#include "cli/flags/options.h"
#include "doctor/diagnosis.h"
#include "gloam/error.h"
#include "run/kept_folders.h"
#include "run/kernel_cache.h"
#include "run/tuning.h"

namespace gloam::cli {
namespace {

using doctor::Diagnosis;
using doctor::TestResult;

struct DoctorFlags {
  std::string device;
  bool again = false, child = false;
  JsonFlag json;
};

std::string in_words(const KernelTuning& tuning) {
  return (tuning.group == 0 ? "groups as the driver chooses" : fmt::format("groups of {}", tuning.group)) +
         (tuning.registers == 0 ? "" : fmt::format(" and at most {} registers", tuning.registers));
}

std::string lanes_in_words(const Tuning& tuning) {
  return fmt::format("{} {}{}", tuning.lanes, tuning.lanes == 1 ? "lane" : "lanes",
                     tuning.gathers_by_loads && tuning.lanes == 16 ? " that load one by one" : "");
}

/// "16 lanes, groups of 16", or of each kind of kernel where the kinds differ.
std::string in_words(const Tuning& tuning) {
  const std::string search = in_words(tuning.search), others = in_words(tuning.others);
  if (search == others) return fmt::format("{}, {}", lanes_in_words(tuning), search);
  return fmt::format("{}, {} for kernels that look around, {} for the others", lanes_in_words(tuning), search, others);
}

/// "holds: 14 of 14 self-tests, 13 with the known bits"
std::string verdict_of(const Diagnosis& diagnosis) {
  const auto count = [&](bool TestResult::*is) {
    return std::count_if(diagnosis.tests.begin(), diagnosis.tests.end(),
                         [&](const TestResult& test) { return test.*is; });
  };
  return fmt::format("{}: {} of {} self-tests held, {} of them with the known bits",
                     diagnosis.record.held ? "holds" : "DOES NOT HOLD", count(&TestResult::held),
                     diagnosis.tests.size(), count(&TestResult::same_bits));
}

void print(const Diagnosis& diagnosis) {
  const DeviceInfo& info = diagnosis.info;
  const DeviceRecord& record = diagnosis.record;
  fmt::print("{} ({}, driver {})\n  {}\n", printable(info.name), printable(info.platform), printable(info.driver),
             printable(verdict_of(diagnosis)));
  for (const std::string& failure : record.failures) fmt::print("  FAILED: {}\n", printable(failure));
  if (record.tuning) {
    std::vector<std::string> times;
    for (const doctor::Timed& one : diagnosis.timed)
      times.push_back(fmt::format("{}, {} {:.2f} + {:.2f} ms", lanes_in_words(one.tuning), in_words(one.tuning.search),
                                  one.ms, one.ms_of_others));
    fmt::print("  fastest: {} ({})\n", in_words(*record.tuning),
               times.empty() ? "measured before; --again measures anew"
                             : fmt::format("measured now: {}", fmt::join(times, "; ")));
  }
  if (record.cold_ms && record.warm_ms)
    fmt::print("  start to the first image: {:.0f} ms where nothing is compiled yet, {:.0f} ms afterwards\n",
               *record.cold_ms, *record.warm_ms);
  fmt::print("  compiled kernels: {}\n", info.keeps_kernels ? "kept by the driver" : "kept by gloam");
  for (const std::string& lack : diagnosis.lacks) fmt::print("  lacks {}\n", lack);
  for (const std::string& text : diagnosis.notes) fmt::print("  note: {}\n", printable(text));
}

Json document_of(const Diagnosis& diagnosis) {
  const DeviceRecord& record = diagnosis.record;
  Json tests = Json::array(), timed = Json::array();
  for (const TestResult& test : diagnosis.tests)
    tests.push_back({{"kind", test.kind},
                     {"technique", test.technique},
                     {"held", test.held},
                     {"same_bits", test.same_bits},
                     {"why", test.why}});
  for (const doctor::Timed& one : diagnosis.timed) timed.push_back(doctor::document_of(one));
  Json document = {{"device", diagnosis.info.name},
                   {"platform", diagnosis.info.platform},
                   {"driver", diagnosis.info.driver},
                   {"held", record.held}};
  document.update(gloam::document_of(record.tuning.value_or(diagnosis.info.usual)));
  document.update({{"cold_ms", or_null(record.cold_ms)},
                   {"warm_ms", or_null(record.warm_ms)},
                   {"lacks", diagnosis.lacks},
                   {"failures", record.failures},
                   {"notes", diagnosis.notes},
                   {"tests", tests},
                   {"timed", timed}});
  return document;
}

/// What is to be said of the folder, and of what was in it.
std::vector<std::string> notes_on_cache() {
  std::vector<std::string> notes;
  const CacheFolder& cache = cache_folder();
  if (cache.folder.empty())
    notes.push_back(fmt::format("nothing can be kept: {}; set GLOAM_CACHE_DIR to a folder that can be written",
                                cache.why_elsewhere));
  else if (!cache.why_elsewhere.empty())
    notes.push_back(fmt::format("{}: what is kept goes to {}; set GLOAM_CACHE_DIR to a folder that lasts",
                                cache.why_elsewhere, cache.folder.string()));
  const KernelCache kernels = own_kernel_cache();
  const KernelCache::Check check = kernels.check();
  if (check.damaged > 0)
    notes.push_back(fmt::format("{} of {} compiled kernels in {} were damaged, and have been removed", check.damaged,
                                check.kept + check.damaged, kernels.folder().string()));
  return notes;
}

/// Keeps what was found; a note if that fails.
void keep(Diagnosis& diagnosis) {
  try {
    keep_record(diagnosis.info, diagnosis.record);
  } catch (const Error& error) {
    diagnosis.notes.push_back(error.what());
  }
}

void run_doctor(const DoctorFlags& flags) {
  if (flags.child) return doctor::examine_device_here(flags.device, flags.again);
  check_paths({}, {{"--json", flags.json.file()}});
  const std::vector<DeviceInfo> devices = list_devices(flags.device);
  note(notes_on_cache());
  const std::function<void(int, int)> bar = progress_bar();
  constexpr int steps = 60;  // of a device: tests and rounds of measuring
  Json document = {{"devices", Json::array()}};
  std::vector<std::string> failed;
  for (size_t i = 0; i < devices.size(); ++i) {
    int step = 0;
    Diagnosis diagnosis = doctor::diagnose(devices[i], flags.again, [&] {
      if (bar) bar(int(i) * steps + std::min(++step, steps), int(devices.size()) * steps);
    });
    keep(diagnosis);
    document["devices"].push_back(document_of(diagnosis));
    if (!flags.json.only_json()) print(diagnosis);
    if (!diagnosis.record.held) failed.push_back("'" + diagnosis.info.name + "'");
  }
  flags.json.write(document);
  if (!failed.empty())
    throw Error("{} {} not compute what {} should; use another device (--device), or another version of the driver",
                enumerate(failed), failed.size() == 1 ? "does" : "do", failed.size() == 1 ? "it" : "they");
}

}  // namespace

void add_doctor(CLI::App& app) {
  auto flags = std::make_shared<DoctorFlags>();
  CLI::App* command =
      app.add_subcommand("doctor", "whether devices compute what they should, and how they do it fastest");
  add_text(*command, "--device", flags->device, "TEXT", "part of a device's or platform's name; default: all devices");
  command->add_flag("--again", flags->again, "measure anew what an earlier examination measured");
  command->add_flag("--child", flags->child)->group("");
  flags->json.add_to(*command);
  command->footer(
      "Runs each kind of kernel against known figures, times lane widths and group sizes, and keeps what it finds, "
      "which all\n"
      "commands use from then on (--no-tuning: not). Exit status 1 if a device does not hold.\n"
      "Examples:\n"
      "  gloam doctor\n"
      "  gloam doctor --device pocl --again\n"
      "  gloam doctor --json -");
  command->callback([flags] { run_doctor(*flags); });
}

}  // namespace gloam::cli
