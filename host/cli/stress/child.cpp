#include "cli/stress/child.h"

#include <cstdlib>
#include <memory>

#include "base/child_process.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

struct OtherDevices {
  std::vector<std::unique_ptr<Device>> opened;
  std::vector<std::string> names;  ///< names, also of devices that could not be opened, with the reason
};

/// Every device but `own` whose name contains `text`. Throws UsageError if the user asked for a device that does not exist.
OtherDevices other_devices(const DeviceInfo& own, const std::string& text) {
  OtherDevices others;
  if (text == "none") return others;
  for (const DeviceInfo& info : list_devices()) {
    if (info.name == own.name && info.platform == own.platform) continue;
    if (text != "all" && (info.name + " " + info.platform).find(text) == std::string::npos) continue;
    others.names.push_back(info.name + ", " + info.platform);
    try {
      // By both: a platform has several devices, and one device has the same name on several platforms.
      others.opened.push_back(std::make_unique<Device>(label_of(info)));
    } catch (const Error& error) {
      others.names.back() += fmt::format(" (not compared: {})", error.what());
    }
  }
  if (others.names.empty() && text != "all")
    throw UsageError(
        "--against {}: no device but {} has this in its name (gloam list devices); all and none are allowed", text,
        own.name);
  return others;
}

/// Why a child failed.
std::string why(const ChildEnd& end) {
  const std::string said = last_line_of(end);
  return said.empty() ? "it ended without a message" : said;
}

void examine_technique(const StressCommand& flags) {
  setenv("RUSTICL_ENABLE", "llvmpipe", 0);  // a second implementation for CPUs, if it is installed
  const StressRequest request = request_of(flags);
  Device device = flags.open();
  const auto others = other_devices(device.info(), flags.against);
  stress::Subject subject{.technique = &find_technique(request.techniques.front()),
                          .device = &device,
                          .extent = request.extent,
                          .frames = request.frames,
                          .seed = request.seed,
                          .trial = request.trial,
                          .folder = flags.out};
  for (const auto& other : others.opened) subject.others.push_back(other.get());
  say_to_parent({{"device", device.info().name},
                 {"driver", device.info().platform + " " + device.info().driver},
                 {"against", others.names}});
  for (const int number : request.cases) {
    subject.begins = [&](int trial, const std::string& conditions) {
      say_to_parent({{"case", number}, {"trial", trial}, {"conditions", conditions}});
    };
    say_to_parent({{"result", document_of(examine(stress::find_case(number), subject))}});
  }
}

}  // namespace

/// What is refused is told at once: a driver may crash, or write lines of its own, while the process ends.
void examine_here(const StressCommand& flags) {
  end_with_parent();
  try {
    examine_technique(flags);
  } catch (const Error& error) {
    say_to_parent({{"refused", error.what()}, {"status", error.exit_status()}});
    throw;
  }
}

Examination::Examination(const StressCommand& flags, const StressRequest& request, std::string technique)
    : flags_(flags), technique_(std::move(technique)), left_(request.cases), patience_(flags.patience) {}

void Examination::run() {
  while (!left_.empty()) {
    case_ = left_.front(), trial_ = 0, conditions_ = "before its first trial";
    refused_ = nullptr;
    const ChildEnd end = run_child(arguments(), patience_, [&](const std::string& line) { take(line); });
    if (left_.empty()) return;  // all results have arrived, however the child ended
    if (trial_ == 0 && !refused_.is_null()) {
      const std::string why = refused_.at("refused");
      if (refused_.at("status") == UsageError("").exit_status()) throw UsageError("{}", why);
      throw Error("{}", why);
    }
    if (end.ended_by.empty() && trial_ == 0) throw Error("{}", why(end));
    stress::CaseResult broken{.technique = technique_, .number = case_, .trials = trial_, .broken_on = conditions_};
    broken.broken = fmt::format("trial {} ({}): {}", trial_, conditions_,
                                end.ended_by.empty() ? why(end) : "ended by " + end.ended_by);
    results.push_back(broken);
    std::erase(left_, case_);
  }
}

std::vector<std::string> Examination::arguments() const {
  std::vector<std::string> all = {"stress", technique_, "--child", "--against", flags_.against};
  const auto add = [&](const char* flag, const std::string& value) {
    if (!value.empty()) all.insert(all.end(), {flag, value});
  };
  add("--case", fmt::format("{}", fmt::join(left_, ",")));
  const auto add_whole = [&](const char* flag, const std::optional<int>& value) {
    if (value) add(flag, std::to_string(*value));
  };
  add_whole("--trial", flags_.trial);
  add_whole("--frames", flags_.frames);
  add_whole("--seed", flags_.seed);
  add("--device", flags_.device);
  add("-o", flags_.out);
  if (flags_.quick) all.push_back("--quick");
  if (flags_.no_tuning) all.push_back("--no-tuning");
  return all;
}

void Examination::take(const std::string& text) {
  const stress::Json line = stress::Json::parse(text, nullptr, false);
  if (line.contains("device")) {
    device = line;
  } else if (line.contains("result")) {
    results.push_back(stress::case_result_of(line.at("result")));
    std::erase(left_, results.back().number);
    if (!left_.empty()) case_ = left_.front(), trial_ = 0, conditions_ = "before its first trial";
  } else if (line.contains("refused")) {
    refused_ = line;
  } else if (line.contains("conditions")) {  // other lines are a driver's own output
    case_ = line.at("case"), trial_ = line.at("trial"), conditions_ = line.at("conditions");
  }
}

}  // namespace gloam::cli
