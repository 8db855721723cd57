#include "cli/shot/shot.h"

#include <algorithm>

#include "base/file_ledger.h"
#include "cli/flags/radius.h"
#include "cli/reference/job.h"
#include "cli/shot/report.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/visualise.h"
#include "shot/shot_run.h"

namespace gloam::cli {
namespace {

/// Where the unfinished truth of a frame is kept.
std::filesystem::path checkpoint_of(const FramePattern& output, int frame) {
  return output.path_of(frame).string() + ".partial";
}

/// Truths of the frames, one after another: a scene that stays the same is prepared once.
class TruthStep : public FrameStep {
 public:
  TruthStep(const ReferenceCommand& flags, const ReferenceJob& job, const FramePattern& output, ShotReport& report)
      : flags_(flags), job_(job), output_(output), report_(report), scene_(flags.scene.named(), note) {
    if (!flags.picture.empty()) pictures_.emplace(flags.picture, "--picture");
  }

  /// Throws UsageError where no frame could be traced, for lack of a scene. Frames that cannot be read are told in their turn.
  void check_scene(const SequenceFiles& shot) {
    for (const SequenceFrame& frame : shot.frames()) {
      try {
        scene_.load_for(shot.open(frame).files().front());
        return;
      } catch (const UsageError&) {
        throw;
      } catch (const Error&) {
        continue;
      }
    }
  }

  std::vector<ShotOutput> outputs() const override { return {{output_, ""}}; }

  std::string settings_of(const SequenceFrame& /*frame*/, const FrameFiles& files) override {
    scene_.load_for(files.files().front());
    std::string how = fmt::format("reference {}{}; {}", flags_.request.what, flags_.given, scene_.identity());
    if (!job_.identity.empty()) how += "; " + job_.identity;
    return how;
  }

  std::unique_ptr<FrameWork> begin(const FrameTurn& turn, FrameFiles files) override;

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
  class Work;

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
  const FramePattern& output_;
  ShotReport& report_;
  SceneOfFrame scene_;
  std::optional<FramePattern> pictures_;
  std::vector<int> unlike_;
  double most_unlike_share_ = 0;
  std::optional<Radius> radius_;  ///< of the first frame
  bool is_looked_at_ = false;
};

class TruthStep::Work : public FrameWork {
 public:
  Work(TruthStep& step, FrameFiles files) : step_(step), files_(std::move(files)) {}

  void decode() override {}  // trace_frame does

  void compute() override {
    const int number = turn.frame.number;
    ReferenceOptions options;
    // Frames have rays of their own: their noise differs, and is in no frame what it was in the one before.
    options.seed = uint32_t(step_.flags_.seed) + uint32_t(number);
    options.checkpoint = checkpoint_of(step_.output_, number);
    options.progress = [&](double share) { step_.report_.in_frame(share); };
    traced_ = trace_frame(step_.flags_, step_.job_, files_, step_.scene_, options);
    traced_.truth.frame.attributes.merge(attributes_of(making));
  }

  void write() override {
    const int number = turn.frame.number;
    write_frame(step_.output_.path_of(number), traced_.truth.frame, {step_.flags_.half, step_.flags_.compression});
    std::error_code gone;
    std::filesystem::remove(checkpoint_of(step_.output_, number), gone);
    if (step_.pictures_) write_pictures(step_.pictures_->path_of(number).string(), step_.job_, traced_);
    step_.look_at(number, traced_);
  }

 private:
  TruthStep& step_;
  FrameFiles files_;
  TracedFrame traced_;
};

std::unique_ptr<FrameWork> TruthStep::begin(const FrameTurn& /*turn*/, FrameFiles files) {
  return std::make_unique<Work>(*this, std::move(files));
}

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
  const SequenceFiles shot = shot_files(FrameArguments{.frame = flags.frame}, flags.frame_flags, flags.choice);
  NamedPatterns all = {{"-o", output}};
  if (!flags.picture.empty()) all.emplace_back("--picture", FramePattern(flags.picture, "--picture"));
  for (const SequenceFrame& frame : shot.frames())
    writes_file("the unfinished", checkpoint_of(output, frame.number), OutputUse::grows);
  check_outputs(all, shot, {{"--json", flags.json.file()}});
  check_paths({{"--scene", find_builtin_scene(flags.scene.scene) ? "" : flags.scene.scene},
               {"--environment", flags.request.environment}},
              {{"--json", flags.json.file()}});
  ShotReport report(shot.frames().size(), flags.json);
  TruthStep step(flags, job, output, report);
  step.check_scene(shot);
  ShotRun run(shot, step, {.version = GLOAM_VERSION, .resumes = flags.resume}, report);
  say_how_to_go_on();
  run.run();
  step.add_notes();
  report.finish(flags.out, step.contents());
}

}  // namespace gloam::cli
