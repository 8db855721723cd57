// gloam plan OUTPUT[,OUTPUT] FRAME.exr: what would be read, compiled and run. Needs no device.
#include <memory>

#include "options.h"

namespace gloam::cli {
namespace {

void print_plan(const Plan& plan, const std::vector<std::string>& decoded) {
  fmt::print("outputs   {}\n", fmt::join(plan.outputs, ", "));
  fmt::print("decoded   {}\n", decoded.empty() ? "nothing" : fmt::format("{}", fmt::join(decoded, ", ")));
  for (const PlannedPass& planned : plan.passes) {
    std::vector<std::string> reads, writes;
    for (const Binding& b : planned.pass.reads) reads.push_back(b.plane);
    for (const Binding& b : planned.pass.writes) writes.push_back(b.plane);
    fmt::print("pass      {}: {} -> {}\n", planned.label(), fmt::join(reads, ", "), fmt::join(writes, ", "));
  }
  for (const auto& [what, why] : plan.skipped) fmt::print("skipped   {}: {}\n", what, why);
  for (const std::string& what : plan.depends_on_pixels) fmt::print("by pixels {}\n", what);
}

}  // namespace

void add_plan(CLI::App& app) {
  struct Flags {
    std::string outputs;
    FrameArguments frame;
    FrameFlags frame_flags;
    TechniqueFlags technique;
    JsonFlag json;
  };
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("plan", "show what a run would read, compile and compute (needs no device)");
  command->add_option("outputs", flags->outputs, "planes or techniques, separated by commas")
      ->required()
      ->type_name("OUTPUT[,OUTPUT]");
  flags->frame.add_to(*command);
  flags->technique.add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Examples:\n  gloam plan ao frame.exr\n  gloam plan normals,hbao+ frame.exr --json -\n"
      "  gloam plan multiview pair_L.exr pair_R.exr");
  command->callback([flags] {
    check_paths(flags->frame.inputs(), {{"--json", flags->json.file()}});
    const PlanRequest request = flags->technique.request(split_list(flags->outputs, "OUTPUT"));
    const FrameFiles files = flags->frame.open(flags->frame_flags.read_options());
    const Plan plan = plan_for(files, request);
    const std::vector<std::string> decoded = decoded_channels(plan.inputs, files);
    flags->json.write(plan_document(plan, decoded));
    if (!flags->json.only_json()) print_plan(plan, decoded);
  });
}

}  // namespace gloam::cli
