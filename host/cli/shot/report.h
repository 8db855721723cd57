// What is told of a shot while it is worked on, and at its end.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "gloam/shot.h"

namespace gloam::cli {

/// Counts frames, tells of each as soon as it has ended, and draws the progress.
class ShotReport : public ShotEvents {
 public:
  ShotReport(size_t frames, const JsonFlag& json);

  void note(const std::string& sentence) override { cli::note({sentence}); }
  void done(int frame, const StepTimes& times) override;
  void skipped(int frame) override;
  void written_again(int frame, const std::string& why) override;
  /// Tells why on standard error, in a line. A lack of space is told once it is known whether later frames have found some.
  void failed(int frame, const std::string& why, bool lacks_space) override;
  void disk_is_full() override { is_disk_full_ = true; }
  /// Draws how far the frame has come that is worked on: for frames that take long, one after another.
  void in_frame(double share_done);

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
