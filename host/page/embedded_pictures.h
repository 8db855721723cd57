// Pictures that stand in a page as text.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "results/measurements.h"

namespace cv {
class Mat;
}

namespace gloam::report {

/// Every picture once, in order of first use. The pictures of a scene share their alpha, the frame's foreground, which would take
/// a fifth of every file: it is stored once. pictures.js reads them.
class EmbeddedPictures {
 public:
  /// A picture below a folder; an empty name is none.
  void add(const std::filesystem::path& folder, const std::string& name);

  /// Reads what was added. Wider pictures are reduced to `width` by averaging; 0: as stored. Those that cannot be read are left out,
  /// with a note. `progress` may be empty.
  void embed(int width, const std::function<void(int done, int of)>& progress);

  /// Number of a picture; null if there is none.
  Json index(const std::filesystem::path& folder, const std::string& name) const;
  const std::string& html() const { return html_; }
  int count() const { return count_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  using Key = std::pair<std::filesystem::path, std::string>;

  void put_text(const std::string& attributes, const std::string& png);
  void put(const cv::Mat& grey_alpha, int number);
  size_t mask(const cv::Mat& alpha);

  std::map<Key, int> index_;  ///< -1: not read
  std::map<std::string, size_t> masks_;
  std::vector<Key> names_;
  std::string html_;
  std::vector<std::string> notes_;
  int count_ = 0;
};

}  // namespace gloam::report
