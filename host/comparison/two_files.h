// A frame in one file beside its truth in another.
#pragma once

#include <string>
#include <vector>

#include "comparison/sides.h"

namespace gloam::comparison {

/// How far one view is from the truth.
struct ViewFigures {
  Metrics all;
  std::optional<Metrics>
      shown;  ///< of pixels whose reflected surfaces the frame shows; none where the truth does not tell
};

/// How far a test is from its truth.
struct FileFigures {
  PlanePair planes;
  ViewPairs pairs;                    ///< views of the test and of the truth
  double exposure = 0;                ///< of radiance, before SSIM, GMSD and FLIP; 0: none
  std::vector<ViewFigures> views;     ///< in the order of `pairs`
  bool is_background_known = false;   ///< else every pixel counts
  std::vector<std::string> pictures;  ///< that were written

  /// Figures of all views as one, over all pixels.
  Metrics pooled() const;
  /// Of all views that have figures of shown pixels; none if none has.
  std::optional<Metrics> pooled_shown() const;
};

/// The files of a comparison, opened.
class TwoFiles {
 public:
  /// Pairs the views. Values stay as in the file. Appends to `notes` what is assumed. Throws Error for files that cannot be read, or whose views do
  /// not go together.
  TwoFiles(const ComparedFiles& files, ReadOptions options, std::vector<std::string>& notes);

  /// The views of the test.
  const std::vector<std::string>& views() const { return test_.file.views(); }
  /// Peak memory of `compare`, bytes. `draws`: it draws a picture.
  unsigned long long bytes(bool draws) const;
  /// Compares all views, and draws test, truth and difference to `picture` (one for each view), unless that is empty. Throws Error for files
  /// without planes that can be compared.
  FileFigures compare(const std::string& picture, std::vector<std::string>& notes);

 private:
  struct Measuring;
  void add_rows(Measuring& m, int first, int last);
  void draw(Measuring& m, size_t view, const Plane& test, const Plane& truth, const Mask& mask);

  ComparedFiles files_;
  ReadOptions options_;
  Side test_, reference_;
  ViewPairs pairs_;
};

}  // namespace gloam::comparison
