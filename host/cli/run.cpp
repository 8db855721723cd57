// gloam run TECHNIQUE FRAME.exr -o OUT.exr
#include <memory>
#include <set>
#include <string>

#include "base/files.h"
#include "base/hash.h"
#include "cli/list_techniques.h"
#include "cli/run_frame.h"
#include "cli/run_outputs.h"
#include "cli/run_shot.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"

namespace gloam::cli {
namespace {

/// Flags that do not change what the file of a frame holds, or of which its header says more (the files read).
const std::set<std::string> not_of_contents = {
    "frame",     "other_eye", "--camera", "--output", "--into",  "--picture",      "--json", "--frames",
    "--missing", "--resume",  "--memory", "--repeat", "--quiet", "--limit-memory", "--help", "technique"};

/// A flag's value; a parameter that is a file, coefficients=FILE, with a hash of what the file holds.
std::string value_in_words(const std::string& value) {
  const size_t equals = value.find('=');
  const std::string file = equals == std::string::npos ? "" : value.substr(equals + 1);
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return value;
  return fmt::format("{} ({:016x})", value, hash_of(read_text(file)));
}

/// The name of a flag, with dashes, or of a positional argument.
std::string flag_of(const CLI::Option& option) {
  return (option.nonpositional() ? "--" : "") + option.get_single_name();
}

/// Those given, in the order of `--help`.
std::vector<const CLI::Option*> options_given(const CLI::App& command, const std::set<std::string>& left_out) {
  return command.get_options(
      [&](const CLI::Option* option) { return option->count() > 0 && left_out.count(flag_of(*option)) == 0; });
}

/// The other flags given: "--set radius=0.5 --preset medium".
std::string contents_in_words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : options_given(command, not_of_contents)) {
    words += " " + flag_of(*option);
    for (const std::string& value : option->results()) words += " " + value_in_words(value);
  }
  return words;
}

/// Flags that each command of a chunk has in its own form, or not at all.
const std::set<std::string> not_of_chunks = {"--frames", "--chunks", "--print", "--resume", "--help"};

/// The words of a command that do the same as this one, but for the frames.
std::vector<std::string> repeated_words(const CLI::App& command) {
  std::vector<std::string> words = {command.get_name()};
  for (const CLI::Option* option : options_given(command, not_of_chunks)) {
    const bool takes_value = option->get_items_expected_max() > 0;
    if (!takes_value) words.push_back(flag_of(*option));
    for (const std::string& value : takes_value ? option->results() : std::vector<std::string>()) {
      if (option->nonpositional()) words.push_back(flag_of(*option));
      words.push_back(value);
    }
  }
  return words;
}

bool has_pattern(const FrameArguments& frame) {
  return FramePattern::is_pattern(frame.frame) ||
         (!frame.other_eye.empty() && FramePattern::is_pattern(frame.other_eye));
}

void run_command(const RunCommand& given, const CLI::App& command) {
  RunCommand flags = given;
  flags.technique = technique_for(given.technique);
  find_technique(flags.technique);
  PlanRequest request = flags.technique_flags.request({flags.technique});
  if (!flags.outputs.empty()) request.only = split_list(flags.outputs, "--outputs");
  if (has_pattern(flags.frame)) {
    flags.given = contents_in_words(command);
    flags.repeated = repeated_words(command);
    return run_on_shot(flags, request);
  }
  for (const auto& [flag, path] : outputs_of(flags).named()) {
    if (FramePattern::is_pattern(path))
      throw UsageError("{} {}: is a pattern, and {} is one frame; write both as patterns, such as shot.####.exr", flag,
                       path, flags.frame.frame);
  }
  if (const std::string flag = flags.shot.any(flags.into.empty()); !flag.empty())
    throw UsageError("{}: is for a shot, and {} is one frame; write its number as in shot.####.exr", flag,
                     flags.frame.frame);
  run_on_frame(flags, request);
}

}  // namespace

void add_run(CLI::App& app) {
  auto flags = std::make_shared<RunCommand>();
  CLI::App* command = app.add_subcommand("run", "run a technique on a frame, or on each frame of a shot");
  command
      ->add_option("technique", flags->technique,
                   "gloam list techniques shows them; ao: the default of ambient occlusion")
      ->required()
      ->type_name("TECHNIQUE");
  flags->frame.add_to(*command);
  command->add_option("-o,--output", flags->out, "EXR file to write")->type_name("OUT.exr");
  command
      ->add_option("--into", flags->into, "a copy of the frame's file with all that it holds, and the result as a part")
      ->type_name("COPY.exr");
  command->add_option("--outputs", flags->outputs, "write these planes only, and compute only what they need")
      ->type_name("A,B");
  command->add_option("--picture", flags->picture, "the first output as a picture for people")->type_name("OUT.png");
  command->add_flag("--bare", flags->bare, "leave depth, normals and cameras out of OUT.exr");
  CLI::Option* half = command->add_flag("--half", flags->half, "write AO as half instead of float");
  add_compression(*command, flags->compression);
  flags->technique_flags.add_to(*command);
  flags->run_flags.add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->composite.add_to(*command);
  flags->shot.add_to(*command);
  command->get_option("--float")->excludes(half);
  flags->json.add_to(*command);
  command->footer(
      "Examples:\n"
      "  gloam run ao frame.exr -o ao.exr --picture ao.png\n"
      "  gloam run ao frame.exr --into with_ao.exr\n"
      "  gloam run ao frame.exr --composite graded.exr --strength 0.8 --tint 0.1,0.05,0\n"
      "  gloam run hbao+ frame.exr -o ao.exr --radius 0.3\n"
      "  gloam run hbao+ frame.exr -o ao.exr --preset high --filter none --repeat 9\n"
      "  gloam run hbao+ pair_L.exr pair_R.exr -o ao.exr --camera pair.camera.json\n"
      "  gloam run gtao frame.exr -o ao.exr --only corner-mask\n"
      "  gloam run temporal-sssr frame.0002.exr --history reflection.0001.exr -o reflection.0002.exr\n"
      "  gloam run gtao 'shot.####.exr' -o 'ao.####.exr' --frames 1001-1100 --resume\n"
      "  gloam run gtao 'shot.####.exr' -o 'ao.####.exr' --frames 1-1000 --chunks 25 --print | parallel\n"
      "  gloam run normals depth_only.exr -o normals.exr --fov 60 --json -\n"
      "Every parameter of the technique is a flag: gloam run TECHNIQUE --help shows them.");
  command->callback([flags, command] { run_command(*flags, *command); });
}

}  // namespace gloam::cli
