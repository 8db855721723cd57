// What is told of a shot while it is worked on, and at its end.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "cli/flags/options.h"

namespace gloam::cli {

/// Wall-clock times of a frame's steps, milliseconds.
struct StepTimes {
  double decode = 0, compute = 0, write = 0;
};

/// Counts frames, tells of each as soon as it has ended, and draws the progress. Threads may share it.
class ShotReport {
 public:
  ShotReport(size_t frames, const JsonFlag& json);

  void done(int frame, const StepTimes& times);
  void skipped(int frame);
  /// Tells why on standard error, in a line.
  void failed(int frame, const std::string& why);
  /// As `failed`, for lack of space on the disk. It is told once it is known whether later frames have found some. Returns
  /// whether so many frames in a row have failed for it that the others would too.
  bool found_no_space(int frame, const std::string& why);
  /// Runs a step of a frame. An error ends the frame and, with `is_told`, is told; `stop` is called where all others would fail too. Returns what the
  /// step returns, and false if it failed.
  bool attempt(int frame, const std::function<bool()>& step, const std::function<void()>& stop, bool is_told = true);
  /// Draws how far the frame has come that is worked on: for frames that take long, one after another.
  void in_frame(double share_done);
  /// Remembers why a frame is written again, if its file is there.
  void written_again(int frame, const std::filesystem::path& file, const std::string& why);
  /// Whether a frame is left alone: if there is no reason to write it again. Tells it, or remembers the reason.
  bool leaves_alone(int frame, const std::filesystem::path& file, const std::string& why);

  /// Tells what is still to be told, prints figures and notes, and writes the document. Throws Error if a frame failed: with
  /// the numbers of the failed frames, or if space was lacking with what to do.
  void finish(const std::string& output, const std::string& contents);

 private:
  struct Failure {
    int frame;
    std::string why;
  };
  void end_frame(Json line);
  void tell(const Failure& failure);
  void draw();
  double seconds() const;
  Json summary() const;
  void print(const std::string& output, const std::string& contents) const;

  std::mutex mutex_;
  const size_t frames_;
  const JsonFlag json_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double drawn_ = 0;  ///< when the progress was drawn last, seconds
  size_t done_ = 0, skipped_ = 0;
  StepTimes sums_;
  std::vector<int> failed_;
  std::vector<Failure> without_space_;  ///< the last frames in a row
  bool is_disk_full_ = false;
  double share_done_ = 0;  ///< of the frame that is worked on
  std::map<std::string, std::vector<int>> again_;
  std::string lines_;  ///< for a file of --json
};

}  // namespace gloam::cli
