#include "comparison/two_files.h"

#include <algorithm>

#include "exr/options_beside.h"
#include "gloam/visualise.h"
#include "picture/picture_path.h"

namespace gloam::comparison {

Metrics FileFigures::pooled() const {
  std::vector<Metrics> all;
  for (const ViewFigures& view : views) all.push_back(view.all);
  return gloam::pooled(all);
}

std::optional<Metrics> FileFigures::pooled_shown() const {
  std::vector<Metrics> all;
  for (const ViewFigures& view : views)
    if (view.shown) all.push_back(*view.shown);
  return all.empty() ? std::nullopt : std::optional(gloam::pooled(all));
}

/// Results so far.
struct TwoFiles::Measuring {
  FileFigures& figures;
  const std::string& picture;
  Frame background;  ///< the depth of the frame that is named beside the two; empty where none is
  Overlap overlap;
  std::vector<Comparison> all, shown;  ///< of each view
};

TwoFiles::TwoFiles(const ComparedFiles& files, ReadOptions options, std::vector<std::string>& notes)
    : files_(files),
      options_([&] {
        options.as_stored = true;
        return options;
      }()),
      test_{FrameFile(files.test, options_), {}},
      reference_{FrameFile(files.reference, options_beside(options_, files.reference)), {}},
      pairs_(pair_views(test_.file, reference_.file, !options_.views.empty(), notes)) {
  if (files_.frame.empty()) files_.frame = frame_of_result(test_.file, reference_.file, options_, notes);
}

unsigned long long TwoFiles::bytes(bool draws) const {
  return bytes_of_comparison(files_, options_, test_.file, reference_.file, draws);
}

void TwoFiles::draw(Measuring& m, size_t view, const Plane& test, const Plane& truth, const Mask& mask) {
  const Metrics figures = naming(files_, [&] { return m.all[view].figures(); });
  const std::string path = picture_path(m.picture, pairs_[view].first, pairs_.size() > 1).string();
  write_difference_picture(
      path, test, truth, mask, figures,
      {test_.file.path().filename().string(), reference_.file.path().filename().string(), 0, m.figures.exposure});
  m.figures.pictures.push_back(path);
}

/// Adds rows [first, last), with the surrounding rows that figures need. All rows at once may be drawn.
void TwoFiles::add_rows(Measuring& m, int first, int last) {
  const Layout& layout = m.overlap.layout;
  const Rows rows{std::max(first - Comparison::reach(), 0), std::min(last + Comparison::reach(), layout.height)};
  const PlanePair& planes = m.figures.planes;
  const Frame tests = test_.read(planes.test, m.overlap, rows),
              truths = reference_.read(planes.reference, m.overlap, rows);
  for (size_t i = 0; i < pairs_.size(); ++i) {
    const auto& [test_view, truth_view] = pairs_[i];
    const Plane left = without_confidence(test_.rows_of(tests, planes.test, test_view, m.overlap, rows));
    Plane truth = reference_.rows_of(truths, planes.reference, truth_view, m.overlap, rows);
    const std::optional<Mask> known = mask_of(files_, m.background, test_, reference_, pairs_[i], m.overlap, rows);
    m.figures.is_background_known = m.figures.is_background_known || known;
    const Mask mask = known ? *known : Mask(size_t(layout.width) * size_t(rows.last - rows.first), 1);
    const std::optional<Mask> where_shown = shown_pixels(truth, mask);
    const Plane right = without_confidence(std::move(truth));
    naming(files_, [&] {
      m.all[i].add({left, right, mask, rows.first}, first, last);
      if (where_shown) m.shown[i].add({left, right, *where_shown, rows.first}, first, last);
    });
    if (!m.picture.empty()) draw(m, i, left, right, mask);
  }
}

FileFigures TwoFiles::compare(const std::string& picture, std::vector<std::string>& notes) {
  FileFigures figures{.planes = survey_sides(test_, reference_, files_.plane, !files_.frame.empty()), .pairs = pairs_};
  note_differences(test_.file, reference_.file, figures.planes, notes);
  Frame background = files_.frame.empty() ? Frame() : background_file(files_, options_).read({"depth"});
  figures.exposure = exposure_of(files_, reference_.file, figures.planes.reference);
  Measuring m{figures, picture, std::move(background), overlap_of(test_, reference_), {}, {}};
  const int height = m.overlap.layout.height;
  for (std::vector<Comparison>* each : {&m.all, &m.shown})
    for (size_t i = 0; i < pairs_.size(); ++i) each->emplace_back(height, figures.exposure);
  // All rows at once for a picture, which shows the whole image, else some at a time.
  const int at_once = std::min(test_.file.rows_at_once({figures.planes.test}),
                               reference_.file.rows_at_once({figures.planes.reference}));
  const int step = picture.empty() ? std::max(at_once / Comparison::step, 1) * Comparison::step : height;
  for (int first = 0; first < height; first += step) add_rows(m, first, std::min(first + step, height));
  for (size_t i = 0; i < pairs_.size(); ++i) {
    figures.views.push_back({naming(files_, [&] { return m.all[i].figures(); }), {}});
    if (m.shown[i].pixels() > 0) figures.views.back().shown = m.shown[i].figures();
  }
  return figures;
}

}  // namespace gloam::comparison
