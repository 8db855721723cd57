// gloam score IMAGES --json ENTRY.json: figures of images that other methods made
#include <algorithm>
#include <memory>

#include "base/command_line.h"
#include "base/file_ledger.h"
#include "base/files.h"
#include "cli/bench/subjects.h"
#include "cli/flags/memory.h"
#include "cli/score/print.h"
#include "gloam/error.h"
#include "measure/pictures.h"
#include "score/entry.h"
#include "score/method_command.h"
#include "score/result_file.h"
#include "score/scoring.h"
#include "score/targets.h"
#include "sequence/pattern_reads.h"

namespace gloam::cli {
namespace {

namespace fs = std::filesystem;

struct ScoreFlags {
  std::vector<std::string> images, json, truths;
  std::string set, frame, folder, items;
  bool no_images = false;
  score::MethodOptions command;
  FrameFlags frame_flags;
  DeviceFlags device;
  const CLI::App* app = nullptr;

  /// The entry among the files of --json.
  std::string entry() const {
    std::string found;
    for (const std::string& each : json) {
      if (each == "-") continue;
      if (!found.empty())
        throw UsageError("--json {}: one entry is scored at a time, and {} is given already", each, found);
      found = each;
    }
    if (found.empty())
      throw UsageError("--json ENTRY.json is required: what made the images; {\"name\": \"my method\"} is enough");
    return found;
  }
  bool prints_json() const { return std::find(json.begin(), json.end(), "-") != json.end(); }
};

void check_flags(const ScoreFlags& flags) {
  const bool has_command = !flags.command.command.empty();
  if (flags.images.empty() && !has_command)
    throw UsageError("score: IMAGES are required, a folder or files, or --command that makes them");
  if (!flags.images.empty() && has_command)
    throw UsageError("--command: makes the images, and {} is given as well; leave one of the two out",
                     flags.images.front());
  if (flags.set.empty() && flags.frame.empty())
    throw UsageError("score: --set DIR is required, or --frame FRAME.exr with --truth REF.exr");
  if (!flags.set.empty() && !flags.frame.empty())
    throw UsageError("--frame {}: --set has the frames; leave one of the two out", flags.frame);
  if (flags.frame.empty() && !flags.truths.empty())
    throw UsageError("--truth {}: --set has the truths; leave it out", flags.truths.front());
  if (!flags.frame.empty() && flags.truths.empty())
    throw UsageError("--frame {}: needs --truth REF.exr, as gloam reference makes it", flags.frame);
  if (!flags.frame.empty() && !flags.items.empty())
    throw UsageError("--items {}: is for a set; leave it out", flags.items);
  const auto is_given = [&](const char* flag) { return flags.app->get_option(flag)->count() > 0; };
  for (const char* flag : {"--rounds", "--timeout", "--image-type"}) {
    if (is_given(flag) && flags.command.command.empty()) throw UsageError("{}: is for --command; leave it out", flag);
  }
  if (flags.set.empty()) return;
  check_no_reading_flags(*flags.app, {"--plane", "--limit-memory"});
}

/// All that is scored, and how far it is.
class ScoreRun {
 public:
  explicit ScoreRun(const ScoreFlags& flags)
      : flags_(flags), entry_(score::read_entry(flags.entry())), reading_(flags.frame_flags.read_options()) {
    find_targets();
    make_output_folder(flags.folder);
    check_paths({{"--json", flags.entry()}, {"--camera", flags.frame_flags.camera}}, {},
                {{"-o", (fs::path(flags.folder) / "bench.json").string()}});
    result_.emplace(flags.folder, set_);
    result_->found().check_files_of(entry_.name);
    score::ScoringOptions options;
    if (!flags.no_images) options.folder = flags.folder;
    options.frames = reading_;
    options.frames.channels.clear();
    options.images.channels = reading_.channels;
    options.afford = [this](const std::string& file, unsigned long long bytes) {
      planned_memory(flags_.frame_flags, file, process_bytes + bytes, "use a smaller one");
    };
    scoring_.emplace(entry_, options);
    if (!flags.command.command.empty())
      command_.emplace(flags.command, fs::path(flags.folder) / "submitted" / bench::file_name(entry_.name));
    else
      find_files();
    tell_ledger();
  }

  void run() {
    earlier_ = result_->found().rows_of(entry_.name);
    for (size_t i = 0; i < targets_.size(); ++i) {
      show_status(targets_[i].in_words(), double(i) / double(targets_.size()));
      score_one(targets_[i]);
    }
    add_fits();
    std::vector<std::pair<std::string, std::string>> kept;
    for (const ScoredRow& row : rows_) kept.emplace_back(row.scored.target.name, row.scored.target.effect);
    if (!rows_.empty()) {
      result_->update([&](score::Results& results) {
        for (const ScoredRow& row : rows_) results.set_fit(row.row, row.row["submitted"]["fit"]);
        if (!set_.empty() && flags_.items.empty()) results.remove_others(entry_.name, kept);
      });
    }
    erase_status();
    tell();
  }

 private:
  /// Of the pictures and, with a command, of the images and cameras.
  void tell_ledger() const {
    for (const score::Target& target : targets_) {
      if (command_ && target.effect != entry_.effect) continue;
      if (!flags_.no_images) {
        for (const std::string& name : {std::string("truth"), score::submitted_picture(entry_.name)})
          writes_file("-o", fs::path(flags_.folder) / score::picture_file(target, name));
      }
      if (command_) command_->tell_ledger(target);
    }
  }

  void find_targets() {
    if (!flags_.set.empty()) {
      std::vector<std::string> notes;
      score::ScoredSet found = score::read_set(flags_.set, notes);
      note(notes);
      set_ = found.id;
      targets_ = std::move(found.targets);
      of_set_ = targets_;
      if (!flags_.items.empty()) score::keep_items(targets_, split_list(flags_.items, "--items"));
      return;
    }
    ReadOptions reading = reading_;
    reading.channels.clear();
    targets_ = score::own_targets({flags_.frame, flags_.truths, reading}, entry_.effect);
  }

  /// Finds the images, and leaves out the effects of which there are none.
  void find_files() {
    for (const std::string& image : flags_.images)
      if (FramePattern::is_pattern(image)) reads_pattern(FramePattern(image, "IMAGES"));
    const bool are_free =
        set_.empty() && score::files_given(flags_.images, targets_.front(), targets_.front().frames.front().number);
    std::vector<std::string> effects = {entry_.effect};
    if (!are_free) {
      files_.emplace(flags_.images, targets_, entry_.effect);
      for (const fs::path& path : files_->unknown()) {
        const bool is_of_another = score::parse_image_name(path.stem().string(), of_set_, entry_.effect).has_value();
        if (!is_of_another) note({no_item(path)});
      }
      if (files_->size() > 0) effects = files_->effects();
    }
    std::erase_if(targets_, [&](const score::Target& target) { return !contains(effects, target.effect); });
    if (targets_.empty())
      throw Error("{}: the images are of {}, and the set has no truth of it", flags_.images.front(),
                  enumerate(effects));
  }

  std::string no_item(const fs::path& path) const {
    std::vector<std::string> names;
    for (const score::Target& target : targets_) add_new(names, target.name);
    return fmt::format("{}: its name is of no item{}; ITEM[.FRAME][_VIEW][_EFFECT] names one, and it is left alone",
                       path.string(), suggestion(path.stem().string(), names));
  }

  std::vector<score::SubmittedFile> files_of(const score::Target& target, const score::TargetFrame& at) {
    if (command_) return command_->files_of(target, at);
    if (!files_) return *score::files_given(flags_.images, target, at.number);
    std::vector<score::SubmittedFile> files = files_->files_of(target, at.number);
    if (files.empty())
      throw Error("there is no image of it; {} names one", score::SubmittedFiles::name_for(target, at.number));
    return files;
  }

  void score_one(const score::Target& target) {
    if (command_ && target.effect != entry_.effect) return;
    if (files_ && !files_->has(target)) {
      missing_.push_back({target.in_words(), "there is no image of it; " +
                                                 score::SubmittedFiles::name_for(target, target.frames.front().number) +
                                                 " names one"});
      return;
    }
    const auto files = [this](const score::Target& of, const score::TargetFrame& at) { return files_of(of, at); };
    const std::optional<score::Scored> scored = scoring_->score(target, files);
    if (!scored) return;
    score::RowDetails details;
    details.scored_by = command_line();
    if (command_) {
      std::vector<std::string> notes;
      details.whole = command_->time(target, notes);
      note(notes);
    }
    rows_.push_back({*scored, {}, score::row_of(*scored, entry_, details)});
    result_->update([&](score::Results& results) { results.put(rows_.back().row, score::scene_of(*scored)); });
    say_on_interruption(interruption_words());
  }

  /// In memory that lasts as long as the process.
  const char* interruption_words() {
    static std::string words;
    if (words.empty()) words = printable(fmt::format("what was scored is in {}", result_->path().string()));
    return words.c_str();
  }

  void add_fits() {
    const auto files = [this](const score::Target& of, const score::TargetFrame& at) { return files_of(of, at); };
    for (ScoredRow& row : rows_) {
      const score::Target& target = row.scored.target;
      const std::optional<score::BestFit> fit = scoring_->best_fit(target.effect);
      if (!fit) continue;
      fits_[target.effect] = *fit;
      show_status(target.in_words() + ": best fit", double(&row - rows_.data()) / double(rows_.size()));
      row.at_fit = scoring_->score_fitted(target, files, *fit);
      if (!row.at_fit) continue;
      row.row["submitted"]["fit"] = score::document_of(*fit, *row.at_fit, target.effect);
    }
  }

  void tell() {
    std::vector<score::LeftOut> left_out = scoring_->left_out();
    left_out.insert(left_out.end(), missing_.begin(), missing_.end());
    note(scoring_->notes());
    note(scoring_->doubts());
    if (earlier_ > 0 && !rows_.empty())
      note({fmt::format("{}: had {} of '{}', which the new ones replace", result_->path().string(),
                        counted(earlier_, "row"), entry_.name)});
    tell_left_out(left_out);
    if (rows_.empty()) {
      print_notes();
      throw Error("nothing could be scored: {} left out", counted(left_out.size(), "image"));
    }
    if (flags_.prints_json()) {
      JsonFlag{"-"}.write(scores_document(entry_, rows_, fits_, left_out));
    } else {
      print_scores(entry_, rows_, fits_);
      fmt::print("{} {}: gloam report {} shows them\n", result_->is_new() ? "wrote" : "added to",
                 printable(result_->path().string()), quoted_for_shell(flags_.folder));
    }
    if (left_out.empty()) return;
    std::fflush(stdout);
    print_notes();
    throw Error("{} left out, {} scored", counted(left_out.size(), "image"), counted(rows_.size(), "item"));
  }

  const ScoreFlags& flags_;
  const score::Entry entry_;
  const ReadOptions reading_;
  report::SetFacts set_;
  std::vector<score::Target> targets_, of_set_;  ///< those chosen, and all of the set
  std::optional<score::ResultFile> result_;
  std::optional<score::Scoring> scoring_;
  std::optional<score::MethodCommand> command_;
  std::optional<score::SubmittedFiles> files_;
  std::vector<ScoredRow> rows_;
  std::vector<score::LeftOut> missing_;
  std::map<std::string, score::BestFit> fits_;
  size_t earlier_ = 0;
};

void score_command(const ScoreFlags& given) {
  ScoreFlags flags = given;
  check_flags(flags);
  flags.command.device = flags.device.device;
  ScoreRun(flags).run();
}

}  // namespace

void add_score(CLI::App& app) {
  auto flags = std::make_shared<ScoreFlags>();
  CLI::App* command = app.add_subcommand("score", "figures of images that any method made, beside gloam's own");
  add_text(*command, "images", flags->images, "IMAGES",
           "EXR or PNG files, or a folder of them: ITEM[.FRAME][_VIEW][_EFFECT].exr; with --frame under any name");
  add_text(*command, "--json", flags->json, "ENTRY.json|-",
           "what made the images, and how they show their values (docs/score.md); - also prints the figures as "
           "JSON, and nothing else, on standard output")
      ->expected(1)
      ->take_all();
  add_text(*command, "--set", flags->set, "DIR", "set of frames and truths, as gloam set make makes it");
  add_text(*command, "--items", flags->items, "A,B", "of the set, these items only");
  add_text(*command, "--frame", flags->frame, "FRAME.exr",
           "frame that the images are of, in place of a set; frame.####.exr: a sequence");
  add_text(*command, "--truth", flags->truths, "REF.exr", "its truth, once for each effect or view")
      ->expected(1)
      ->take_all();
  add_text(*command, "-o,--output", flags->folder, "DIR",
           "folder whose bench.json the figures join, with those of gloam bench or of other methods; made where "
           "it is not there")
      ->required();
  command->add_flag("--no-images", flags->no_images, "leave out the pictures in DIR/images");
  const char* group = "Running the method";
  add_text(*command, "--command", flags->command.command, "COMMAND",
           "makes the images: 'engine --in {frame} --out {image}'; also {camera} {radius} {effect} {view} {item} "
           "{frame_number}, and {frames} {images} for a whole sequence at once")
      ->group(group);
  add_number(*command, "--rounds", flags->command.rounds, allowed_rounds,
             "times that the command and gloam's own technique run in turn, to be timed; default 3", "N")
      ->group(group);
  add_number(*command, "--timeout", flags->command.timeout, {0.1, 1e6}, "a run that takes longer is ended; default 600",
             "SECONDS")
      ->group(group);
  add_word(*command, "--image-type", flags->command.image_type, {"exr", "png"}, "of {image}; default exr")
      ->group(group);
  flags->device.add_to(*command, group);
  flags->frame_flags.add_to(*command);
  flags->app = command;
  command->footer(
      "Images of the same entry are replaced. Exit status 1 where anything was left out; the rest is scored. "
      "Examples:\n"
      "  gloam score images --json entry.json --set out/set -o out/scores\n"
      "  gloam score ao.exr --frame frame.exr --truth truth.exr --json entry.json -o out/mine\n"
      "  gloam score --command 'engine --in {frame} --out {image}' --json entry.json --set out/set -o out/scores\n"
      "  gloam report out/scores");
  command->callback([flags] { score_command(*flags); });
}

}  // namespace gloam::cli
