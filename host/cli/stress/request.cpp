#include "cli/stress/request.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam::cli {

std::vector<int> parse_cases(const std::string& text, const std::string& flag) {
  std::vector<int> numbers;
  for (const stress::Case& one : stress::cases()) numbers.push_back(one.number);
  if (text.empty()) return numbers;
  std::vector<int> wanted;
  for (const std::string& item : split_list(text, flag)) {
    const int number = parse_number(item, flag, Range<int>{1, 999});
    if (std::find(numbers.begin(), numbers.end(), number) == numbers.end())
      throw UsageError("{} {}: no hard case {}; there are {} (gloam list cases)", flag, text, number,
                       fmt::join(numbers, ", "));
    if (std::find(wanted.begin(), wanted.end(), number) == wanted.end()) wanted.push_back(number);
  }
  return wanted;
}

std::vector<std::string> parse_techniques(const std::string& text) {
  if (text == "all") return technique_names();
  std::vector<std::string> names;
  for (const std::string& name : split_list(text, "stress")) add_new(names, find_technique(name).name);
  return names;
}

StressRequest request_of(const StressCommand& flags) {
  StressRequest request;
  request.techniques = parse_techniques(flags.technique);
  request.cases = parse_cases(flags.cases, "--case");
  request.extent = flags.quick ? stress::Extent::quick : stress::Extent::full;
  if (flags.frames) {
    request.frames = *flags.frames;
    if (std::find(request.cases.begin(), request.cases.end(), 1) == request.cases.end())
      throw UsageError("--frames {} is for the random frames of case 1, which --case {} leaves out", *flags.frames,
                       flags.cases);
  }
  if (flags.seed) request.seed = unsigned(*flags.seed);
  if (flags.trial) {
    request.trial = flags.trial;
    if (request.techniques.size() != 1 || request.cases.size() != 1)
      throw UsageError("--trial {} is a trial of one case on one technique; name both, such as hbao+ --case 3",
                       *flags.trial);
  }
  if (!flags.out.empty() && !request.trial)
    throw UsageError("-o {} is where the frames of one trial are written; say which with --case and --trial",
                     flags.out);
  return request;
}

}  // namespace gloam::cli
