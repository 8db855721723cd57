#include "cli/bench/subjects.h"

#include "cli/flags/memory.h"
#include "cli/flags/notes.h"
#include "gloam/error.h"
#include "measure/effects.h"

namespace gloam::cli {

using namespace gloam::bench;

void erase_status() {
  if (shows_progress()) fmt::print(stderr, "\r\033[K");
}

/// Shows the current work on a terminal, in a line that the next one overwrites.
void show_status(const std::string& what, double share) {
  if (!shows_progress()) return;
  fmt::print(stderr, "\r\033[K{} {:.0f} %", printable(what), 100 * share);
  std::fflush(stderr);
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error, unknown;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::exists(folder, unknown) && !std::filesystem::is_directory(folder, unknown))
    throw Error("-o {}: is a file; name a folder", folder.string());
  if (error) throw Error("-o {}: cannot be made ({})", folder.string(), error.message());
}

std::vector<std::string> parse_effects(const std::string& list) {
  const std::vector<std::string> known = effect_names();
  if (list == "all") return known;
  const std::vector<std::string> named = split_list(list, "--effects");
  for (const std::string& name : named) {
    if (!contains(known, name))
      throw UsageError("--effects: no effect '{}' is measured{}; there are {} and all", name, suggestion(name, known),
                       enumerate(known));
  }
  std::vector<std::string> chosen;
  for (const std::string& name : known) {
    if (contains(named, name)) chosen.push_back(name);
  }
  return chosen;
}

namespace {

/// The techniques' default cap on the radius; none if no technique has one.
std::optional<double> default_cap(const std::vector<const Technique*>& techniques) {
  for (const Technique* technique : techniques) {
    const ParameterValues initial(technique->parameters);
    if (initial.has("max_reach")) return initial.number("max_reach");
  }
  return {};
}

}  // namespace

RadiusReport report_of(const Subject& subject, const std::vector<const Technique*>& techniques) {
  return RadiusReport(subject.radius, subject.frame, default_cap(techniques));
}

OwnFrame own_frame(const std::string& frame, const FrameFlags& flags, const std::vector<std::string>& truths) {
  const auto afford = [flags](const std::string& name, unsigned long long bytes) {
    return planned_memory(flags, name, process_bytes_with_device + bytes,
                          "name fewer --techniques, or crop or shrink the frame");
  };
  return {frame, flags.read_options(), truths, afford};
}

}  // namespace gloam::cli
