// gloam plan OUTPUT[,OUTPUT] FRAME.exr: what would be read, compiled and run. Needs no device.
#include <algorithm>
#include <memory>

#include "base/memory.h"
#include "cli/flags/memory.h"
#include "cli/flags/options.h"
#include "cli/flags/radius.h"
#include "cli/process/words.h"
#include "run/checks.h"
#include "sequence/plan_files.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

void print_plan(const Plan& plan, const std::vector<std::string>& decoded) {
  fmt::print("outputs   {}\n", fmt::join(plan.outputs, ", "));
  fmt::print("decoded   {}\n", decoded.empty() ? "nothing" : printable(fmt::format("{}", fmt::join(decoded, ", "))));
  for (const PlannedPass& planned : plan.passes) {
    std::vector<std::string> reads, writes;
    for (const Binding& b : planned.pass.reads) reads.push_back(b.plane);
    for (const Binding& b : planned.pass.writes) writes.push_back(b.plane);
    fmt::print("pass      {}: {} -> {}\n", planned.label(), fmt::join(reads, ", "), fmt::join(writes, ", "));
  }
  for (const auto& [what, why] : plan.skipped) fmt::print("skipped   {}: {}\n", printable(what), printable(why));
  for (const std::string& what : plan.depends_on_pixels) fmt::print("by pixels {}\n", printable(what));
}

/// The radius from the depth, the only plane that is decoded.
std::optional<RadiusReport> radius_of_depth(PlanRequest& request, Plan& plan, FrameFiles& files) {
  const std::vector<std::string> available = files.common_planes();
  if (!radius_of(plan, request, RadiusSource::frame) || !contains(available, "depth")) return {};
  const Frame frame = files.read({"depth"});
  const auto radius = settle_radius(request, plan, frame, stated_radius(files), available, holdings(files));
  return report_on(radius, frame, plan);
}

bool goes_on_by_itself(const std::string& output) {
  return names_technique(output) && accumulates_by_itself(find_technique(technique_for(output)));
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
  add_text(*command, "outputs", flags->outputs, "OUTPUT[,OUTPUT]", "planes or techniques, separated by commas")
      ->required();
  flags->frame.add_to(*command);
  flags->technique.add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Examples:\n  gloam plan ao frame.exr\n  gloam plan normals,hbao+ frame.exr --json -\n"
      "  gloam plan multiview pair_L.exr pair_R.exr\n  gloam plan gtao pair.exr --eyes both");
  command->callback([flags] {
    check_order("plan", flags->outputs, flags->frame.frame);
    check_paths(flags->frame.inputs(), {{"--json", flags->json.file()}});
    std::vector<std::string> outputs = split_list(flags->outputs, "OUTPUT");
    if (flags->technique.variant.any())
      for (std::string& name : outputs) name = variant_name(name, flags->technique.variant);
    PlanRequest request = flags->technique.request(outputs);
    request.only_filtered = flags->frame.history.empty() && !flags->technique.temporal &&
                            std::none_of(outputs.begin(), outputs.end(), goes_on_by_itself);
    ReadOptions options = flags->frame_flags.read_options();
    options.only_looks = true;
    FrameFiles files = flags->frame.open(options);
    for (const FrameFile& file : files.files()) note(file.camera_notes());
    request = going_on(std::move(request), files, flags->technique.temporal);
    if (request.temporal && !files.history()) files.expect_history();
    Plan plan = plan_for(files, request);
    check_number_of_views(plan, files.views().size());
    planned_memory(flags->frame_flags, files.name(), process_bytes + bytes_to_read(files, {"depth"}),
                   "crop or shrink the frame");
    const std::vector<std::string> decoded = decoded_channels(plan.inputs, files);
    const std::optional<RadiusReport> radius = radius_of_depth(request, plan, files);
    const unsigned long long memory = bytes_of_run(files, plan.inputs, plan, true);
    Json document = plan_document(plan, decoded);
    document["memory_bytes"] = memory;
    if (radius) radius->add_to(document);
    flags->json.write(document);
    if (flags->json.only_json()) return;
    print_plan(plan, decoded);
    if (radius) radius->print();
    fmt::print("memory    about {} at the peak\n", memory_in_words(memory));
  });
}

}  // namespace gloam::cli
