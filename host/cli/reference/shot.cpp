#include "cli/reference/shot.h"

#include <algorithm>
#include <limits>

#include "base/elapsed.h"
#include "base/file_ledger.h"
#include "base/files.h"
#include "cli/flags/radius.h"
#include "cli/shot/report.h"
#include "cli/shot/shot.h"
#include "cli/shot/start.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/visualise.h"
#include "sequence/frame_making.h"

namespace gloam::cli {
namespace {

/// Where the unfinished truth of a frame is kept.
std::filesystem::path checkpoint_of(const FramePattern& output, int frame) {
  return output.path_of(frame).string() + ".partial";
}

/// The frames of a shot, one after another.
class TruthsOfShot {
 public:
  TruthsOfShot(const ReferenceCommand& flags, const ReferenceJob& job, const ShotFiles& shot,
               const FramePattern& output, ShotReport& report)
      : flags_(flags), job_(job), shot_(shot), output_(output), report_(report), scene_(flags.scene.named(), note) {
    if (!flags.picture.empty()) pictures_.emplace(flags.picture, "--picture");
  }

  /// Throws UsageError where no frame could be traced, for lack of a scene. Frames that cannot be read are told in their turn.
  void check_scene() {
    for (const SequenceFrame& frame : shot_.frames()) {
      try {
        scene_.load_for(shot_.open(frame).files().front());
        return;
      } catch (const UsageError&) {
        throw;
      } catch (const Error&) {
        continue;
      }
    }
  }

  /// Until the disk is full.
  void trace_all() {
    bool goes_on = true;
    for (const SequenceFrame& frame : shot_.frames()) {
      StepTimes times;
      const bool is_done = report_.attempt(
          frame.number, [&] { return trace(frame, times); }, [&] { goes_on = false; });
      if (is_done) report_.done(frame.number, times);
      if (!goes_on) return;
    }
  }

  /// "ao, ao_noise; radius 0.5 scene units"
  std::string contents() const {
    std::string words = fmt::format("{0}, {0}_noise", job_.plane);
    if (radius_)
      words += radius_->from == RadiusSource::frame ? "; each frame's own radius"
                                                    : fmt::format("; radius {:g} scene units", radius_->value);
    return words;
  }

  void add_notes() const {
    if (!unlike_.empty())
      note(
          {fmt::format("in frames {} the scene is over 1 % nearer or farther than the frame in up to {:.1f} % of the "
                       "pixels looked at",
                       frames_in_words(unlike_), 100 * most_unlike_share_)});
  }

 private:
  /// False for a frame that --resume leaves alone.
  bool trace(const SequenceFrame& frame, StepTimes& times) {
    auto start = std::chrono::steady_clock::now();
    const auto lap = [&] {
      const double ms = 1000 * seconds_since(start);
      start = std::chrono::steady_clock::now();
      return ms;
    };
    FrameFiles files = shot_.open(frame);
    scene_.load_for(files.files().front());
    const FrameMaking making = making_of(files);
    const std::filesystem::path out = output_.path_of(frame.number);
    if (flags_.resume && report_.leaves_alone(frame.number, out, why_again(out, making))) return false;
    times.decode = lap();
    const std::filesystem::path checkpoint = checkpoint_of(output_, frame.number);
    ReferenceOptions options;
    options.seed = seed_of(frame.number);
    options.checkpoint = checkpoint;
    options.progress = [&](double share) { report_.in_frame(share); };
    TracedFrame traced = trace_frame(flags_, job_, files, scene_, options);
    times.compute = lap();
    traced.truth.frame.attributes.merge(attributes_of(making));
    write_frame(out, traced.truth.frame, {flags_.half, flags_.compression});
    std::error_code gone;
    std::filesystem::remove(checkpoint, gone);
    if (pictures_) write_pictures(pictures_->path_of(frame.number).string(), job_, traced);
    times.write = lap();
    look_at(frame.number, traced);
    return true;
  }

  FrameMaking making_of(const FrameFiles& files) const {
    std::string how = fmt::format("reference {}{}; {}", flags_.request.what, flags_.given, scene_.identity());
    if (!job_.identity.empty()) how += "; " + job_.identity;
    return {GLOAM_VERSION, how, identity_of(files)};
  }

  /// Frames have rays of their own: their noise differs, and is in no frame what it was in the one before.
  uint32_t seed_of(int number) const { return uint32_t(flags_.seed) + uint32_t(number); }

  /// What holds for one frame mostly holds for all, and is told of the first.
  void look_at(int number, const TracedFrame& traced) {
    if (traced.radius && !is_looked_at_) {
      const RadiusReport noted(*traced.radius, traced.frame, std::nullopt);
      radius_ = traced.radius;
      if (traced.radius->from == RadiusSource::frame)
        note({"radius: each frame has its own, made from its depths; --radius gives one to all"});
    }
    is_looked_at_ = true;
    note(traced.truth.notes);
    if (traced.truth.unlike_share <= most_unlike) return;
    unlike_.push_back(number);
    most_unlike_share_ = std::max(most_unlike_share_, traced.truth.unlike_share);
  }

  const ReferenceCommand& flags_;
  const ReferenceJob& job_;
  const ShotFiles& shot_;
  const FramePattern& output_;
  ShotReport& report_;
  SceneOfFrame scene_;
  std::optional<FramePattern> pictures_;
  std::vector<int> unlike_;
  double most_unlike_share_ = 0;
  std::optional<Radius> radius_;  ///< of the first frame
  bool is_looked_at_ = false;
};

}  // namespace

void write_pictures(const std::string& picture, const ReferenceJob& job, const TracedFrame& traced) {
  if (picture.empty()) return;
  const std::vector<View>& views = traced.truth.frame.views;
  for (const View& view : views)
    write_picture(picture_path(picture, view.name, views.size() > 1), view.planes.at(job.plane),
                  traced.frame.view(view.name).find("depth"));
}

void reference_on_shot(const ReferenceCommand& flags, const ReferenceJob& job) {
  if (!FramePattern::is_pattern(flags.out))
    throw UsageError("-o {}: is one file, and {} a shot; write both as patterns, such as truth.####.exr", flags.out,
                     flags.frame);
  if (!flags.picture.empty() && !FramePattern::is_pattern(flags.picture))
    throw UsageError("--picture {}: is one file, and {} a shot; write both as patterns, such as truth.####.png",
                     flags.picture, flags.frame);
  const FramePattern output(flags.out, "-o");
  const ShotFiles shot({.frame = flags.frame}, flags.frame_flags, flags.choice);
  const NamedPatterns outputs = {{"-o", output}};
  NamedPatterns all = outputs;
  if (!flags.picture.empty()) all.emplace_back("--picture", FramePattern(flags.picture, "--picture"));
  for (const SequenceFrame& frame : shot.frames())
    writes_file("the unfinished", checkpoint_of(output, frame.number), OutputUse::grows);
  check_outputs(all, shot, {{"--json", flags.json.file()}});
  check_paths({{"--scene", find_builtin_scene(flags.scene.scene) ? "" : flags.scene.scene},
               {"--environment", flags.request.environment}},
              {{"--json", flags.json.file()}});
  ShotReport report(shot.frames().size(), flags.json);
  TruthsOfShot truths(flags, job, shot, output, report);
  truths.check_scene();
  const ShotStart start(outputs, shot.numbers());
  truths.trace_all();
  truths.add_notes();
  report.finish(flags.out, truths.contents());
}

}  // namespace gloam::cli
