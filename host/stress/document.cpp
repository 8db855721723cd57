#include "stress/document.h"

#include <algorithm>
#include <cmath>

#include "base/json_text.h"
namespace gloam::stress {
namespace {

Json document_of(const Place& place) {
  if (place.plane.empty()) return nullptr;
  return {{"view", place.view}, {"plane", place.plane}, {"x", place.x}, {"y", place.y}, {"holds", place.holds}};
}

Place place_from(const Json& document) {
  if (document.is_null()) return {};
  return {document.at("view"), document.at("plane"), document.at("x"), document.at("y"), document.at("holds")};
}

Json document_of(const Finding& finding) {
  return {{"what", finding.what},
          {"worst", or_null(finding.worst)},
          {"bound", or_null(finding.bound)},
          {"held", finding.held()},
          {"trial", finding.trial},
          {"conditions", finding.conditions},
          {"place", document_of(finding.place)}};
}

Finding finding_of(const Json& document) {
  return {document.at("what"),
          number_of(document.at("worst")),
          number_of(document.at("bound")),
          place_from(document.at("place")),
          document.at("trial"),
          document.at("conditions")};
}

std::string extent_in_words(Extent extent) { return extent == Extent::quick ? "quick" : "full"; }

}  // namespace

Json document_of(const CaseResult& result) {
  Json findings = Json::array();
  for (const Finding& finding : result.findings) findings.push_back(document_of(finding));
  return {{"technique", result.technique},     {"case", result.number},
          {"opted_out", result.opted_out},     {"opted_out_parts", result.opted_out_parts},
          {"passed_over", result.passed_over}, {"findings", findings},
          {"trials", result.trials},           {"seconds", result.seconds},
          {"broken", result.broken},           {"broken_on", result.broken_on}};
}

CaseResult case_result_of(const Json& document) {
  CaseResult result{.technique = document.at("technique"),
                    .number = document.at("case"),
                    .opted_out = document.at("opted_out"),
                    .opted_out_parts = document.at("opted_out_parts"),
                    .passed_over = document.at("passed_over"),
                    .findings = {},
                    .trials = document.at("trials"),
                    .seconds = document.at("seconds"),
                    .broken = document.at("broken"),
                    .broken_on = document.at("broken_on")};
  for (const Json& finding : document.at("findings")) result.findings.push_back(finding_of(finding));
  return result;
}

std::string replay_command(const StressRun& run, const std::string& technique, int number, int trial,
                           const std::string& device_flag) {
  std::string command = fmt::format("gloam stress {} --case {}", technique, number);
  if (trial > 0) command += fmt::format(" --trial {}", trial);  // 0: the case ended before its first trial
  if (run.extent == Extent::quick) command += " --quick";
  if (run.seed != 1) command += fmt::format(" --seed {}", run.seed);
  if (run.frames != 0) command += fmt::format(" --frames {}", run.frames);
  return command + device_flag;
}

int failures(const StressRun& run) {
  int count = 0;
  for (const CaseResult& result : run.results) {
    count += !result.broken.empty();
    for (const Finding& finding : result.findings) count += !finding.held();
  }
  return count;
}

Json document_of(const StressRun& run, const std::string& device_flag) {
  Json all = Json::array(), opted_out = Json::array(), in_part = Json::array(), passed_over = Json::array();
  for (const CaseResult& result : run.results) {
    const Json head = {{"technique", result.technique}, {"case", result.number}};
    const auto add = [&](Json& list, const Json& more) {
      Json entry = head;
      entry.update(more);
      list.push_back(std::move(entry));
    };
    for (const Finding& finding : result.findings) {
      Json more = document_of(finding);
      more["replay"] = replay_command(run, result.technique, result.number, finding.trial, device_flag);
      add(all, more);
    }
    if (!result.broken.empty()) {
      add(all, {{"what", "broken off: " + result.broken},
                {"worst", nullptr},
                {"bound", 0},
                {"held", false},
                {"trial", result.trials},
                {"conditions", result.broken_on},
                {"place", nullptr},
                {"replay", replay_command(run, result.technique, result.number, result.trials, device_flag)}});
    }
    if (!result.opted_out.empty()) add(opted_out, {{"why", result.opted_out}});
    for (const std::string& reason : result.opted_out_parts) add(in_part, {{"why", reason}});
    for (const std::string& reason : result.passed_over) add(passed_over, {{"why", reason}});
  }
  return {{"device", run.device},
          {"driver", run.driver},
          {"against", run.others},
          {"extent", extent_in_words(run.extent)},
          {"seed", run.seed},
          {"frames", run.frames},
          {"cases", all},
          {"opted_out", opted_out},
          {"opted_out_in_part", in_part},
          {"passed_over", passed_over},
          {"failed", failures(run)},
          {"left", run.left}};
}

}  // namespace gloam::stress
