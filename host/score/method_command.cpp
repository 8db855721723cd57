#include "score/method_command.h"

#include <algorithm>

#include "base/child_process.h"
#include "base/command_line.h"
#include "base/file_ledger.h"
#include "base/files.h"
#include "base/lists.h"
#include "base/temporary_folder.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/radius.h"
#include "measure/effects.h"
#include "score/camera_file.h"
#include "technique/default_technique.h"

namespace gloam::score {
namespace {

namespace fs = std::filesystem;
constexpr const char* own_image = "gloam_own.exr";
constexpr const char* making_prefix = ".gloam-making-";  ///< of folders in which another program makes images

/// The technique that gloam takes for an effect; empty if there is none.
std::string own_technique(const std::string& effect) {
  if (technique_for(effect) != effect) return effect;  // "ao" stands for its default
  for (const Technique& technique : registry()) {
    if (bench::measured_plane(technique) == effect && technique.views == 1) return technique.name;
  }
  return "";
}

/// A command line as words: spaces divide, quotes of both kinds keep together, \ keeps the next character. No shell takes part. Throws
/// UsageError for a quote without its end, for no word, and for operators of a shell.
std::vector<std::string> words_of_command(const std::string& command) {
  static const std::vector<std::string> operators = {"|", "||", "&", "&&", ";", ">", ">>", "<", "2>", "2>&1"};
  std::vector<std::string> words;
  std::string word;
  bool is_in_word = false;
  char quote = 0;
  for (size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      if (is_in_word) words.push_back(word);
      word.clear();
      is_in_word = false;
      continue;
    }
    is_in_word = true;
    if (c == '\\' && quote != '\'' && i + 1 < command.size())
      word += command[++i];
    else if (quote == 0 && (c == '\'' || c == '"'))
      quote = c;
    else if (c == quote)
      quote = 0;
    else
      word += c;
  }
  if (quote != 0) throw UsageError("{}: the quote {} has no end", option("command", command), quote);
  if (is_in_word) words.push_back(word);
  if (words.empty()) throw UsageError("{}: is empty; write 'engine --in {{frame}} --out {{image}}'", option("command"));
  for (const std::string& each : words) {
    if (contains(operators, each))
      throw UsageError("{}: '{}' is for a shell, and gloam starts none; write sh -c '...'", option("command", command),
                       each);
  }
  return words;
}

/// Puts values in place of {name}. {{ and }} are braces. Throws UsageError for a name that has no value.
std::string with_values(const std::string& word, const std::map<std::string, std::string>& values) {
  std::string out;
  for (size_t i = 0; i < word.size(); ++i) {
    const bool is_double = i + 1 < word.size() && word[i + 1] == word[i] && (word[i] == '{' || word[i] == '}');
    const size_t end = word[i] == '{' && !is_double ? word.find('}', i) : std::string::npos;
    if (is_double) {
      out += word[i++];
    } else if (end != std::string::npos) {
      const std::string name = word.substr(i + 1, end - i - 1);
      std::vector<std::string> known;
      for (const auto& [each, value] : values) known.push_back("{" + each + "}");
      const auto found = values.find(name);
      if (found == values.end())
        throw UsageError("{}: {{{}}} stands for nothing{}; {} are allowed, and {{{{ for a brace", option("command"),
                         name, suggestion("{" + name + "}", known), enumerate(known));
      out += found->second;
      i = end;
    } else {
      out += word[i];
    }
  }
  return out;
}

/// Moves an image that another program made to its name, in place of what is there. False if there is none.
bool hand_over(const fs::path& made, const fs::path& to) {
  std::error_code failed;
  if (!fs::exists(made, failed)) return false;
  check_before_writing(to);
  fs::rename(made, to, failed);
  if (failed) throw Error("{}: cannot be written ({})", to.string(), failed.message());
  has_written(to);
  return true;
}

}  // namespace

MethodCommand::MethodCommand(const MethodOptions& flags, const fs::path& folder)
    : flags_(flags), words_(words_of_command(flags.command)), folder_(folder) {
  // A misspelt placeholder is told before one that is missing.
  Target target;
  target.name = "ITEM";
  const TargetFrame at;
  for (const std::string& word : words_) with_values(word, values_for(target, at, "", "image.exr", "images.exr"));
  const bool by_frame = has("{frame}") && has("{image}"), by_sequence = has("{frames}") && has("{images}");
  if (by_frame == by_sequence)
    throw UsageError(
        "{}: has to say where the frame and the image go: {{frame}} and {{image}} for one run per frame, or "
        "{{frames}} and "
        "{{images}} for one run per sequence",
        option("command", flags.command));
  if (by_sequence && has("{view}"))
    throw UsageError("{}: {{view}} goes with {{frame}} and {{image}}, one run per frame and view",
                     option("command", flags.command));
}

bool MethodCommand::has(const char* placeholder) const {
  return std::any_of(words_.begin(), words_.end(),
                     [&](const std::string& word) { return word.find(placeholder) != std::string::npos; });
}

std::string MethodCommand::image_of(const Target& target, const std::string& frame, const std::string& view) const {
  return fmt::format("{}{}{}_{}.{}", target.name, target.is_sequence ? "." + frame : "", view.empty() ? "" : "_" + view,
                     target.effect, flags_.image_type);
}

fs::path MethodCommand::camera_of(const Target& target, const TargetFrame& at) const {
  return folder_ /
         fmt::format("{}{}.camera.json", target.name, target.is_sequence ? fmt::format(".{:04}", at.number) : "");
}

std::map<std::string, std::string> MethodCommand::values_for(const Target& target, const TargetFrame& at,
                                                             const std::string& view, const fs::path& image,
                                                             const fs::path& images) const {
  std::map<std::string, std::string> values = {{"frame", at.frame.string()},
                                               {"image", image.string()},
                                               {"radius", target.radius ? fmt::format("{}", *target.radius) : ""},
                                               {"effect", target.effect},
                                               {"item", target.name},
                                               {"frame_number", std::to_string(at.number)},
                                               {"view", view},
                                               {"camera", camera_of(target, at).string()},
                                               {"frames", at.frame.string()},
                                               {"images", images.string()}};
  if (target.is_sequence) values["frames"] = target.pattern;
  return values;
}

bool MethodCommand::is_whole(const Target& target) const { return target.is_sequence && has("{frames}"); }

std::vector<MethodCommand::Job> MethodCommand::jobs_for(const Target& target, const TargetFrame& at,
                                                        const fs::path& folder) const {
  std::vector<std::string> views = {""};
  if (has("{view}") && target.views.size() > 1) views = target.views;
  std::vector<Job> jobs;
  for (const std::string& view : views) {
    Job job;
    job.view = view;
    job.image = image_of(target, fmt::format("{:04}", at.number), view);
    const fs::path images = folder / (target.is_sequence ? image_of(target, "####", "") : job.image);
    for (const std::string& word : words_)
      job.words.push_back(with_values(word, values_for(target, at, view, folder / job.image, images)));
    jobs.push_back(std::move(job));
  }
  return jobs;
}

void MethodCommand::tell_ledger(const Target& target) const {
  for (const TargetFrame& at : target.frames) {
    for (const Job& job : jobs_for(target, at, folder_))
      writes_file("the image", folder_ / job.image, OutputUse::grows);
    if (has("{camera}")) writes_file("{camera}", camera_of(target, at), OutputUse::grows);
  }
}

std::vector<std::string> MethodCommand::names_of(const Target& target, const Job& job) const {
  if (!is_whole(target)) return {job.image};
  std::vector<std::string> names;
  for (const TargetFrame& at : target.frames) names.push_back(image_of(target, fmt::format("{:04}", at.number), ""));
  return names;
}

MethodCommand::Made MethodCommand::make(const Target& target, const TargetFrame& at) {
  if (is_whole(target) && target.pattern.empty())
    return {{},
            fmt::format("{}: the names of its frames follow no pattern; {{frame}} and {{image}} run the command for "
                        "each of them",
                        target.in_words())};
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return {{}, fmt::format("{}: cannot be made ({})", folder_.string(), error.message())};
  Made made;
  try {
    if (has("{camera}")) write_camera_file(camera_of(target, at), at.frame);
    const TemporaryFolder making(folder_, making_prefix);
    for (const Job& job : jobs_for(target, at, making.path())) {
      const ForeignEnd end = run_foreign(job.words, flags_.timeout);
      if (!end.why.empty()) return {{}, fmt::format("'{}' ended: {}", job.words.front(), in_words(end))};
      for (const std::string& name : names_of(target, job)) {
        // An image of an earlier run stays where there is no new one.
        if (hand_over(making.path() / name, folder_ / name))
          made.files.push_back({folder_ / name, job.view});
        else if (!is_whole(target) || name == job.image)
          return {{},
                  fmt::format("'{}' left no {}{}", job.words.front(), (folder_ / name).string(),
                              end.said.empty() ? "" : "; it said: " + end.said)};
      }
    }
  } catch (const UsageError&) {
    throw;
  } catch (const Error& failure) {
    made.failure = failure.what();
  }
  return made;
}

std::vector<SubmittedFile> MethodCommand::files_of(const Target& target, const TargetFrame& at) {
  const std::string key = fmt::format("{} {} {}", target.name, target.effect, is_whole(target) ? 0 : at.number);
  if (!made_.count(key)) {
    // one run makes all images of a sequence: that of the first frame is looked for
    made_[key] = make(target, is_whole(target) ? target.frames.front() : at);
  }
  const Made& made = made_.at(key);
  if (!made.failure.empty()) throw Error("{}", made.failure);
  if (!is_whole(target)) return made.files;
  const fs::path image = folder_ / image_of(target, fmt::format("{:04}", at.number), "");
  const auto is_it = [&](const SubmittedFile& file) { return file.path == image; };
  if (std::none_of(made.files.begin(), made.files.end(), is_it))
    throw Error("'{}' left no {}", words_.front(), image.string());
  return {{image, ""}};
}

double MethodCommand::milliseconds_of(const Target& target, const TargetFrame& at) const {
  double ms = 0;
  const TemporaryFolder making(folder_, making_prefix);
  for (const Job& job : jobs_for(target, at, making.path())) {
    const ForeignEnd end = run_foreign(job.words, flags_.timeout);
    if (!end.why.empty()) throw Error("'{}' ended: {}", job.words.front(), in_words(end));
    ms += end.ms;
  }
  return ms;
}

std::vector<std::string> MethodCommand::own_words(const Target& target, const TargetFrame& at,
                                                  const fs::path& folder) const {
  const std::string image = (folder / (is_whole(target) ? "gloam_own.####.exr" : own_image)).string();
  std::vector<std::string> words = {
      "gloam", "run",    own_technique(target.effect), is_whole(target) ? target.pattern : at.frame.string(), "-o",
      image,   "--quiet"};
  const std::string radius = radius_parameter(find_technique(technique_for(own_technique(target.effect))).parameters);
  if (target.radius && !radius.empty())
    words.insert(words.end(), {"--set", fmt::format("{}={}", radius, *target.radius)});
  if (!flags_.device.empty()) words.insert(words.end(), {"--device", flags_.device});
  return words;
}

std::optional<WholeTimes> MethodCommand::time(const Target& target, std::vector<std::string>& notes) try {
  WholeTimes times;
  times.command = command_without_folders(flags_.command);
  const bool has_own = !own_technique(target.effect).empty();
  const size_t frames = is_whole(target) ? 1 : target.frames.size();
  const double per = is_whole(target) ? double(target.frames.size()) : 1;  // of a frame
  const TemporaryFolder making(folder_, making_prefix);
  if (has_own)
    times.gloam_command = command_without_folders(shell_line(own_words(target, target.frames.front(), folder_)));
  const auto run_own = [&](const TargetFrame& at) {
    std::vector<std::string> words = own_words(target, at, making.path());
    words.front() = fs::read_symlink("/proc/self/exe").string();
    const ForeignEnd end = run_foreign(words, flags_.timeout);
    if (!end.why.empty()) throw Error("'gloam run' ended: {}", in_words(end));
    return end.ms;
  };
  // The first run of both is not timed: it fills caches, those of kernels too. The command's made the image.
  if (has_own) run_own(target.frames.front());
  for (int round = 0; round < flags_.rounds; ++round) {
    const TargetFrame& at = target.frames[size_t(round) % frames];
    times.ms.push_back(milliseconds_of(target, at) / per);
    if (has_own) times.gloam_ms.push_back(run_own(at) / per);
  }
  return times;
} catch (const UsageError&) {
  throw;
} catch (const Error& error) {
  notes.push_back(fmt::format("{}: not timed: {}", target.in_words(), error.what()));
  return {};
}

}  // namespace gloam::score
