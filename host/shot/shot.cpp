#include "shot/shot.h"

#include "base/file_identity.h"
#include "base/memory.h"
#include "gloam/error.h"
#include "normalise/depth_encoding.h"
#include "normalise/normal_axes.h"
#include "shot/run_step.h"
#include "technique/default_technique.h"

namespace gloam {
namespace {

/// Hands on what is told, and keeps which frames ended how.
class CountedEvents : public ShotEvents {
 public:
  explicit CountedEvents(ShotEvents& events) : events_(events) {}
  void note(const std::string& sentence) override { events_.note(sentence); }
  void done(int frame, const StepTimes& times) override {
    summary.done.push_back(frame);
    events_.done(frame, times);
  }
  void skipped(int frame) override {
    summary.skipped.push_back(frame);
    events_.skipped(frame);
  }
  void written_again(int frame, const std::string& why) override { events_.written_again(frame, why); }
  void failed(int frame, const std::string& why, bool lacks_space) override {
    summary.failed.push_back(frame);
    events_.failed(frame, why, lacks_space);
  }
  void disk_is_full() override {
    summary.is_disk_full = true;
    events_.disk_is_full();
  }

  ShotSummary summary;

 private:
  ShotEvents& events_;
};

/// All that decides the contents of a frame's file, but for its input and the version: results of other requests differ from it.
std::string settings_in_words(const ShotRequest& request) {
  const PlanRequest& asked = request.computing;
  const ReadOptions& reading = request.reading;
  std::string words = fmt::format("shot {}", fmt::join(asked.outputs, ","));
  const auto add = [&](const char* name, const auto& value) { words += fmt::format(" {}={}", name, value); };
  for (const auto& [name, value] : asked.settings) words += " " + with_hash_of_file(name + "=" + value);
  if (asked.radius) add("radius", *asked.radius);
  for (const auto& [name, list] :
       {std::pair{"outputs", asked.only_outputs}, {"extras", asked.with}, {"views", reading.views}})
    if (!list.empty()) add(name, fmt::format("{}", fmt::join(list, ",")));
  for (const auto& [name, word] : {std::pair{"filter", asked.filter},
                                   {"preset", asked.preset},
                                   {"only", asked.only},
                                   {"elsewhere", asked.elsewhere},
                                   {"adaptive", asked.adaptive}})
    if (!word.empty()) add(name, word);
  for (const auto& [plane, channel] : reading.channels) add(plane.c_str(), channel);
  for (const auto& [name, number] : {std::pair{"near", reading.near}, {"far", reading.far}})
    if (number) add(name, *number);
  if (reading.background) add("background", *reading.background);
  for (const auto& [name, number] :
       {std::pair{"depth_scale", reading.depth_scale}, {"depth_offset", reading.depth_offset}})
    if (number) add(name, *number);
  if (reading.depth_bytes != DepthBytes::automatic) add("depth_bytes", int(reading.depth_bytes));
  if (reading.depth_encoding) add("depth_encoding", in_words(*reading.depth_encoding));
  for (const auto& [plane, file] : reading.plane_files) add((plane + "_file").c_str(), file.string());
  if (reading.normals.axes) add("axes", in_words(*reading.normals.axes));
  const RunOptions& options = request.options;
  words += fmt::format(
      " resolution={} temporal={} depth={} normals={},{} as_stored={} math={} real={} lanes={} seed={}",
      asked.resolution, asked.temporal, int(reading.depth), int(reading.normals.space), int(reading.normals.range),
      reading.as_stored, int(options.math), int(options.real), options.lanes, options.seed);
  const WriteOptions& writing = request.writing;
  return words + fmt::format(" half={},{} compression={} keeps_depth={} keeps_margin={}", writing.half,
                             fmt::join(writing.half_planes, ","), writing.compression, request.keeps_depth,
                             writing.keeps_margin);
}

/// Throws UsageError for an output that is an input. The command has a ledger of files for that (base/file_ledger.h).
void check_output(const FramePattern& output, const SequenceFiles& files) {
  if (std::filesystem::path(output.text()).extension() != ".exr")
    throw UsageError("output {}: frames are EXR files; name them with .exr", output.text());
  for (const SequenceFrame& frame : files.frames()) {
    const std::filesystem::path path = output.path_of(frame.number);
    for (const FramePattern& input : files.inputs()) {
      const std::optional<int> read = input.frame_of(path.filename().string());
      if (are_same_file(path, input.path_of(frame.source)) || (read && are_same_file(path, input.path_of(*read))))
        throw UsageError("output {}: frame {} would be written over an input; write the frames elsewhere",
                         output.text(), frame.number);
    }
  }
}

MemoryLimit limit_of(unsigned long long memory) {
  const MemoryLimit available = available_limit();
  if (memory == 0 || memory >= available.bytes) return available;
  return {memory, fmt::format("{} are allowed", memory_in_words(memory))};
}

}  // namespace

ShotSummary run_shot(const SequenceFiles& files, const ShotRequest& request,
                     const std::function<std::shared_ptr<Device>()>& device, ShotEvents& events,
                     const std::function<void(Frame&)>& as_read) {
  check(request.writing);
  const FramePattern output(request.output, "output");
  check_output(output, files);
  ShotRequest whole = request;
  PlanRequest& computing = whole.computing;
  if (computing.outputs.size() != 1)
    throw UsageError("a shot takes one technique, and {} are given", computing.outputs.size());
  computing.outputs = {technique_for(computing.outputs.front())};
  computing.temporal |= accumulates_by_itself(find_technique(computing.outputs.front()));
  if (computing.temporal) check_temporal(computing);
  for (const SequenceFrame& frame : files.frames())
    if (computing.temporal && frame.source != frame.number)
      throw UsageError("frame {} is held, and does not go on from the one before; skip missing frames", frame.number);
  RunSettings settings{.request = computing,
                       .options = request.options,
                       .outputs = {.out = output},
                       .writing = {.out = request.writing},
                       .carried = {.depth = request.keeps_depth},
                       .contents = settings_in_words(whole),
                       .as_read = as_read};
  CountedEvents counted(events);
  RunStep step(files, settings, first_planned(files, settings), counted);
  const ShotMemory memory = step.memory(limit_of(request.memory), "ask for fewer planes or one view, or allow more");
  ShotRun run(files, step,
              {.version = version_with_kernels(GLOAM_VERSION),
               .resumes = request.resumes,
               .goes_on = computing.temporal,
               .size = step.size(),
               .memory = memory},
              counted);
  step.start(device);
  run.run();
  return counted.summary;
}

ShotSummary run_shot(const ShotRequest& request, const std::function<std::shared_ptr<Device>()>& device,
                     ShotEvents& events) {
  std::vector<FramePattern> inputs;
  for (const std::string& pattern : request.inputs) inputs.emplace_back(pattern, "input");
  if (inputs.empty()) throw UsageError("a shot is read from no file; name a pattern such as shot.####.exr");
  std::vector<std::string> notes;
  const SequenceFiles files(std::move(inputs), request.reading, {.frames = request.frames}, notes);
  for (const std::string& note : notes) events.note(note);
  return run_shot(files, request, device, events);
}

}  // namespace gloam
