#include "cli/shot/report.h"

#include <algorithm>
#include <cstdio>

#include "base/elapsed.h"
#include "base/files.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"

namespace gloam::cli {
namespace {

/// Seconds.
constexpr double least_between_drawings = 0.1;

/// One line of a document in JSON lines.
std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

void erase_progress() {
  if (shows_progress()) std::fputs("\r\033[K", stderr);
}

/// "1 h 2 min", "3 min 20 s", "12 s"
std::string time_in_words(double seconds) {
  const long s = long(seconds + 0.5);
  if (s >= 3600) return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
  return s >= 60 ? fmt::format("{} min {} s", s / 60, s % 60) : fmt::format("{} s", s);
}

}  // namespace

ShotReport::ShotReport(size_t frames, const JsonFlag& json) : frames_(frames), json_(json) {}

double ShotReport::seconds() const { return seconds_since(start_); }

void ShotReport::done(int frame, const StepTimes& times) {
  ++done_;
  sums_.decode += times.decode, sums_.compute += times.compute, sums_.write += times.write;
  if (!is_disk_full_) {
    for (const Failure& failure : without_space_) tell(failure);
    without_space_.clear();
  }
  end_frame(
      {{"frame", frame}, {"status", "done"}, {"error", nullptr}, {"ms", times.decode + times.compute + times.write}});
}

void ShotReport::skipped(int frame) {
  ++skipped_;
  end_frame({{"frame", frame}, {"status", "skipped"}, {"error", nullptr}, {"ms", 0}});
}

void ShotReport::failed(int frame, const std::string& why, bool lacks_space) {
  failed_.push_back(frame);
  if (lacks_space)
    without_space_.push_back({frame, why});
  else
    tell({frame, why});
  end_frame({{"frame", frame}, {"status", "failed"}, {"error", why}, {"ms", nullptr}});
}

void ShotReport::in_frame(double share_done) {
  share_done_ = share_done;
  draw();
}

void ShotReport::written_again(int frame, const std::string& why) { again_[why].push_back(frame); }

void ShotReport::end_frame(Json line) {
  share_done_ = 0;
  if (json_.only_json()) {
    std::fputs(line_of(line).c_str(), stdout);
    std::fflush(stdout);
  } else if (!json_.path.empty()) {
    lines_ += line_of(line);
  }
  draw();
}

void ShotReport::tell(const Failure& failure) {
  erase_progress();
  std::fputs(printable(fmt::format("gloam: frame {}: {}", failure.frame, failure.why)).append("\n").c_str(), stderr);
}

void ShotReport::draw() {
  if (!shows_progress() || seconds() < drawn_ + least_between_drawings) return;
  drawn_ = seconds();
  const size_t ended = done_ + skipped_ + failed_.size();
  const double come = double(ended) + share_done_, worked = double(done_ + failed_.size()) + share_done_;
  const double per_second = worked / seconds();
  const int width = 40, filled = int(double(width) * come / double(frames_));
  const std::string left =
      worked == 0 ? "" : fmt::format(", {} left", time_in_words((double(frames_) - come) / per_second));
  fmt::print(stderr, "\r[{:=<{}}{:<{}}] {}/{}, {:.2g} frames a second{}\033[K", "", filled, "", width - filled, ended,
             frames_, per_second, left);
  std::fflush(stderr);
}

Json ShotReport::summary() const {
  const double done = std::max<double>(1, double(done_));
  return {{"frames", frames_},
          {"done", done_},
          {"skipped", skipped_},
          {"failed", failed_.size()},
          {"fps", double(done_) / seconds()},
          {"decode_ms", sums_.decode / done},
          {"compute_ms", sums_.compute / done},
          {"write_ms", sums_.write / done},
          {"notes", notes_so_far()}};
}

void ShotReport::print(const std::string& output, const std::string& contents) const {
  const double done = std::max<double>(1, double(done_));
  if (done_ > 0) {
    fmt::print("{:.1f} s, {:.2f} frames a second; a frame: decode {:.0f} ms, compute {:.0f} ms, write {:.0f} ms\n",
               seconds(), double(done_) / seconds(), sums_.decode / done, sums_.compute / done, sums_.write / done);
    fmt::print("wrote {}, {} ({})\n", counted(done_, "frame"), printable(output), contents);
  }
  if (skipped_ > 0) fmt::print("left {} alone, whole and made in the same way\n", counted(skipped_, "frame"));
}

void ShotReport::finish(const std::string& output, const std::string& contents) {
  erase_progress();
  std::sort(failed_.begin(), failed_.end());
  if (!is_disk_full_) {
    for (const Failure& failure : without_space_) tell(failure);
  }
  for (auto& [why, frames] : again_) {
    std::sort(frames.begin(), frames.end());
    note(fmt::format("--resume: written again: {}: {}", frames_in_words(frames), why));
  }
  if (json_.only_json()) {
    std::fputs(line_of(summary()).c_str(), stdout);
  } else {
    if (!json_.path.empty()) write_text(json_.path, lines_ + line_of(summary()));
    print(output, contents);
  }
  if (std::fflush(stdout) != 0) throw Error("standard output: cannot be written");
  if (failed_.empty()) return;
  print_notes();
  if (is_disk_full_)
    throw Error("{}; {} of {} frames are whole; free some space, then the same command with --resume goes on",
                without_space_.front().why, done_ + skipped_, frames_);
  throw Error("{} of {} frames failed: {}", failed_.size(), frames_, frames_in_words(failed_, 32));
}

}  // namespace gloam::cli
