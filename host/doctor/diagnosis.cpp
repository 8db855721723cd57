#include "doctor/diagnosis.h"

#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "base/child_process.h"
#include "base/elapsed.h"
#include "base/temporary_folder.h"
#include "doctor/measure.h"
#include "doctor/self_test.h"
#include "gloam/exr.h"
#include "gloam/option.h"
#include "run/driver.h"
#include "run/kept_folders.h"
#include "run/tuning.h"
#include "stress/frames.h"
#include "technique/data_files.h"

namespace gloam::doctor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double patience = 120;  ///< seconds without a sign of life; compiling one kernel takes a few

const std::string& table() { return data_files().at("self_test.json"); }

/// Milliseconds of a command from its start to its end; none if it fails.
std::optional<double> time_of_start(const std::vector<std::string>& arguments,
                                    const std::map<std::string, std::string>& environment) {
  const auto start = std::chrono::steady_clock::now();
  const ChildEnd end = run_child(
      arguments, patience, [](const std::string&) {}, environment);
  if (end.status != 0) return {};
  return 1000 * seconds_since(start);
}

/// Times two runs of a command on an image: where no kernels are kept, and where those of the first are.
void measure_starts(Diagnosis& diagnosis, const std::function<void()>& goes_on) {
  const TemporaryFolder temporary("doctor");
  const fs::path& folder = temporary.path();
  const fs::path frame = folder / "frame.exr", cache = folder / "cache";
  fs::create_directory(cache);
  write_frame(frame, stress::shoot(stress::perspective(640, 360), stress::room()));
  const std::vector<std::string> command = {
      "run",      measured_technique(table()), frame.string(), "-o", (folder / "ao.exr").string(),
      "--device", label_of(diagnosis.info)};
  std::map<std::string, std::string> environment;
  for (const char* name : {"GLOAM_CACHE_DIR", "POCL_CACHE_DIR", "MESA_SHADER_CACHE_DIR", "CUDA_CACHE_PATH"})
    environment[name] = cache.string();
  for (std::optional<double>* ms : {&diagnosis.record.cold_ms, &diagnosis.record.warm_ms}) {
    *ms = time_of_start(command, environment);
    goes_on();
  }
}

std::vector<std::string> lacks_of(const DeviceInfo& info) {
  std::vector<std::string> lacks;
  if (!info.has_double) lacks.push_back(fmt::format("double precision: {} is refused", option("real", "double")));
  if (!info.has_timestamps) lacks.push_back("times of its own: passes are timed by the host's clock");
  if (!info.rounds_correctly && info.type != "cpu")
    lacks.push_back(
        fmt::format("division and square root rounded as IEEE 754 says: {} is near a CPU's bits, not equal to them",
                    option("math", "precise")));
  return lacks;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

/// Takes over what a child wrote.
void take(const std::string& text, Diagnosis& diagnosis) {
  const Json line = Json::parse(text, nullptr, false);
  if (!line.is_object()) return;                         // a driver's own output
  if (line.contains("device")) diagnosis.tests.clear();  // the child has started again
  if (line.contains("kind"))
    diagnosis.tests.push_back(
        {line.at("kind"), line.at("technique"), line.at("why"), line.at("held"), line.at("same_bits")});
  if (line.contains("best")) diagnosis.record.tuning = tuning_in(line.at("best"));
  if (line.contains("timed")) {
    for (const Json& one : line.at("timed"))
      diagnosis.timed.push_back({tuning_in(one).value(), one.at("ms"), one.at("ms_of_others")});
  }
}

/// The tests' failures, and how the child ended if it did not end by itself.
void judge_end(const ChildEnd& end, size_t tests, Diagnosis& diagnosis) {
  DeviceRecord& record = diagnosis.record;
  for (const TestResult& test : diagnosis.tests) {
    if (!test.held) record.failures.push_back(fmt::format("{} ({}): {}", test.kind, test.technique, test.why));
  }
  const std::string after = diagnosis.tests.size() < tests
                                ? fmt::format("after {} of {} self-tests", diagnosis.tests.size(), tests)
                                : "while it was measured";
  if (!end.ended_by.empty())
    record.failures.push_back(fmt::format("the driver ended the program {}: {}", after, end.ended_by));
  else if (end.status != 0)
    record.failures.push_back(fmt::format("{} {}", last_line_of(end), after));
  record.held = record.failures.empty();
  for (size_t at = end.said.find("note: "); at != std::string::npos; at = end.said.find("note: ", at + 1))
    diagnosis.notes.push_back(end.said.substr(at + 6, end.said.find('\n', at) - at - 6));
}

}  // namespace

void examine_device_here(const std::string& name, bool measures) {
  end_with_parent();
  Device device(name);
  say_to_parent({{"device", device.info().name}});
  bool all_held = true;
  for (const SelfTest& test : self_tests(table(), device.info())) {
    const Outcome outcome = examine(test, device);
    all_held = all_held && outcome.held;
    say_to_parent({{"kind", test.kind},
                   {"technique", test.request.outputs.front()},
                   {"held", outcome.held},
                   {"same_bits", outcome.same_bits},
                   {"why", outcome.why}});
  }
  if (!all_held) {
    // The driver's kept kernels may be damaged: once more without them. If that does not help, they are as good as new ones.
    if (device.info().keeps_kernels) restart_without_kept_kernels();
    return remove_kernels_made_anew();
  }
  if (!measures) return;
  const Measurement measured = measure_tuning(measured_technique(table()), device, [] {
    say_to_parent({{"goes_on", true}});
  });
  Json timed = Json::array();
  for (const Timed& one : measured.timed) timed.push_back(document_of(one));
  say_to_parent({{"best", gloam::document_of(measured.best)}, {"timed", timed}});
}

Diagnosis diagnose(const DeviceInfo& info, bool again, const std::function<void()>& goes_on) {
  Diagnosis diagnosis{.info = info, .lacks = lacks_of(info)};
  const std::optional<DeviceRecord> before = find_record(info);
  const bool is_known =
      before && before->kernels == hash_of_kernels() && before->tuning && before->cold_ms && before->warm_ms;
  const bool measures = again || !is_known;
  DeviceRecord& record = diagnosis.record;
  record.day = today(), record.kernels = hash_of_kernels();
  if (!measures) record.tuning = before->tuning, record.cold_ms = before->cold_ms, record.warm_ms = before->warm_ms;
  const size_t tests = self_tests(table(), info).size();
  std::vector<std::string> arguments = {"doctor", "--child", "--device", label_of(info)};
  if (measures) arguments.push_back("--again");
  const ChildEnd end = run_child(arguments, patience, [&](const std::string& line) {
    take(line, diagnosis);
    goes_on();
  });
  judge_end(end, tests, diagnosis);
  if (measures && record.held) measure_starts(diagnosis, goes_on);
  return diagnosis;
}

}  // namespace gloam::doctor
