#include "cli/stress_request.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam::cli {
namespace {

std::vector<int> cases_of(const StressCommand& flags) {
  std::vector<int> numbers;
  for (const stress::Case& one : stress::cases()) numbers.push_back(one.number);
  if (flags.cases.empty()) return numbers;
  std::vector<int> wanted;
  for (const std::string& text : split_list(flags.cases, "--case")) {
    const int number = stress::find_case(parse_whole_number(text, "--case", 1, 999)).number;
    if (std::find(wanted.begin(), wanted.end(), number) == wanted.end()) wanted.push_back(number);
  }
  return wanted;
}

}  // namespace

StressRequest request_of(const StressCommand& flags) {
  StressRequest request;
  if (flags.technique == "all")
    request.techniques = technique_names();
  else
    request.techniques = {find_technique(flags.technique).name};
  request.cases = cases_of(flags);
  request.extent = flags.quick ? stress::Extent::quick : stress::Extent::full;
  if (!flags.frames.empty()) {
    request.frames = parse_whole_number(flags.frames, "--frames", 1, 1000000000);
    if (std::find(request.cases.begin(), request.cases.end(), 1) == request.cases.end())
      throw UsageError("--frames {} is how many random frames case 1 draws, and --case {} leaves it out", flags.frames,
                       flags.cases);
  }
  if (!flags.seed.empty()) request.seed = unsigned(parse_whole_number(flags.seed, "--seed", 0, 2147483647));
  if (!flags.trial.empty()) {
    request.trial = parse_whole_number(flags.trial, "--trial", 1, 2147483647);
    if (request.techniques.size() != 1 || request.cases.size() != 1)
      throw UsageError("--trial {} is a trial of one case on one technique; name both, such as hbao+ --case 3",
                       flags.trial);
  }
  if (!flags.out.empty() && !request.trial)
    throw UsageError("-o {} is where the frames of one trial are written; say which with --case and --trial",
                     flags.out);
  return request;
}

}  // namespace gloam::cli
