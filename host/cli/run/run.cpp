// gloam run TECHNIQUE FRAME.exr -o OUT.exr
#include <memory>
#include <string>

#include "cli/flags/given_flags.h"
#include "cli/list/techniques.h"
#include "cli/process/chunk_commands.h"
#include "cli/process/words.h"
#include "cli/run/command.h"
#include "cli/run/outputs.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"

namespace gloam::cli {
namespace {

/// Flags that each command of a chunk has in its own form.
const std::set<std::string> not_of_chunks = {"--frames", "--warm-up", "--resume"};

void run_command(const RunCommand& given, const CLI::App& command) {
  RunCommand flags = given;
  check_order("run", flags.technique, flags.frame.frame);
  settle_outputs(flags);
  flags.technique = variant_name(given.technique, given.technique_flags.variant);
  PlanRequest request = flags.technique_flags.request({flags.technique});
  request.only_filtered = !is_temporal(flags);
  if (!flags.outputs.empty()) request.only_outputs = split_list(flags.outputs, "--outputs");
  if (flags.frame.has_pattern()) {
    flags.given = contents_in_words(command);
    flags.repeated = repeated_words(command, not_of_chunks);
    return run_on_shot(flags, request);
  }
  check_no_shot(flags.frame, named(outputs_of(flags)), flags.shot.any());
  run_on_frame(flags, request);
}

}  // namespace

bool is_temporal(const RunCommand& flags) {
  return flags.technique_flags.temporal || !flags.frame.history.empty() ||
         accumulates_by_itself(find_technique(flags.technique));
}

void add_run(CLI::App& app) {
  auto flags = std::make_shared<RunCommand>();
  CLI::App* command = app.add_subcommand("run", "run a technique on a frame, or on each frame of a shot");
  add_text(*command, "technique", flags->technique, "TECHNIQUE",
           "gloam list techniques shows them; ao: the default of ambient occlusion")
      ->required();
  flags->frame.add_to(*command);
  add_text(*command, "-o,--output", flags->out, "OUT.exr",
           "EXR file to write, or a picture, OUT.png; default: beside the frame, frame_ao.exr");
  add_text(*command, "--into", flags->into, "COPY.exr",
           "a copy of the frame's file with all that it holds, and the result as a part");
  add_text(*command, "--outputs", flags->outputs, "A,B",
           "write these planes, such as ao,ao_raw, and compute only what they need; default: filtered results");
  add_text(*command, "--picture", flags->picture, "OUT.png", "the first output as a picture for people");
  command->add_flag("--bare", flags->bare, "leave cameras and depth out of OUT.exr");
  CLI::Option* half = command->add_flag("--half", flags->half,
                                        "write AO and the like as half: the default, but with --temporal or --history");
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
      "  gloam ao frame.exr\n"
      "  gloam run ao frame.exr -o ao.exr --picture ao.png\n"
      "  gloam ao --depth-file depth.png --normal-file normal.png --depth-scale 0.001 --fov 60\n"
      "  gloam run ao frame.exr --into with_ao.exr\n"
      "  gloam run ao frame.exr --composite graded.exr --composite-strength 0.8 --tint 0.1,0.05,0\n"
      "  gloam run hbao+ frame.exr -o ao.exr --radius 0.3\n"
      "  gloam run hbao+ frame.exr -o ao.exr --preset high --filter none --repeat 9\n"
      "  gloam run hbao+ pair_L.exr pair_R.exr -o ao.exr --camera pair.camera.json\n"
      "  gloam run gtao frame.exr -o ao.exr --only corner-mask\n"
      "  gloam run gtao layers.exr -o ao.exr --layers peeled\n"
      "  gloam run temporal-sssr frame.0002.exr --history reflection.0001.exr -o reflection.0002.exr\n"
      "  gloam run gtao 'shot.####.exr' -o 'ao.####.exr' --frames 1001-1100 --resume\n"
      "  gloam run gtao 'shot.####.exr' -o 'ao.####.exr' --frames 1-1000 --chunks 25 --print | parallel\n"
      "  gloam run normals depth_only.exr -o normals.exr --fov 60 --json -\n"
      "Every parameter of the technique is a flag: gloam run TECHNIQUE --help shows them.");
  command->callback([flags, command] { run_command(*flags, *command); });
}

}  // namespace gloam::cli
