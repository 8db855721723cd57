// FrameFile by rows: figures of a frame that is never in memory as a whole.
#include <algorithm>
#include <set>

#include "base/lists.h"
#include "exr/decode.h"
#include "exr/file.h"
#include "exr/view_planes.h"
#include "gloam/planes.h"
#include "normalise/normalise.h"
#include "normalise/reflectance.h"

namespace gloam {
namespace {

constexpr uint64_t bytes_at_once = 4 << 20;

/// Sums over a view's rows.
struct Survey {
  explicit Survey(const Layout& image) : samples(image) {}
  NormalSamples samples;
  long long missing = 0, missing_where_encoded = 0;  ///< normals, as they stand and as they would be decoded
  WhitePixels white;
};

Plane decoded(const Plane& normal, const Camera& camera) {
  Plane out = normal.clone();
  bring_to_view_space(out, {NormalSpace::view, true}, camera);
  return out;
}

void add_rows(Survey& survey, const View& rows, const View& whole, int first_row) {
  const Plane* depth = whole.find("depth");
  if (const Plane* normal = rows.find("normal")) {
    survey.samples.take(*normal, first_row);
    if (depth) {
      const Channel& z = depth->channels.front();
      survey.missing += count_missing_normals(*normal, z, first_row);
      survey.missing_where_encoded += count_missing_normals(decoded(*normal, *whole.camera), z, first_row);
    }
  }
  if (const Plane* reflectance = rows.find("reflectance"))
    survey.white.add(*reflectance, depth->channels.front(), first_row);
}

}  // namespace

/// Of planes with so many rows, of all views.
uint64_t FrameFile::Impl::bytes_of(const std::vector<std::string>& planes, int rows) const {
  uint64_t channels = 0;
  for (const std::string& view : names.views)
    for (const std::string& plane : planes)
      if (const PlaneSource* from = source(plane, view))
        channels += from->channels.size();
      else
        channels += has(plane, view);
  return channels * Layout(window.width(), rows).bytes();
}

/// What the decoder holds beside the planes, of the part that takes most.
uint64_t FrameFile::Impl::bytes_to_decode(const std::vector<std::string>& planes) const {
  uint64_t most = 0;
  for (const PlaneSource& plane : names.planes)
    for (const ChannelSource& channel : plane.channels)
      if (contains(planes, plane.plane)) most = std::max(most, decoder_bytes(file->header(channel.part)));
  return most;
}

/// Those decoded whole: the depth, and alpha where it may tell what a depth means.
std::vector<std::string> FrameFile::Impl::whole_planes(const std::vector<std::string>& planes) const {
  std::vector<std::string> whole;
  if (!contains(needed(planes), "depth")) return whole;
  whole.push_back("depth");
  if (contains(planes, "alpha")) whole.push_back("alpha");
  return whole;
}

/// Those of which something has to be known before they can be used.
std::vector<std::string> FrameFile::Impl::surveyed_planes(const Frame& frame,
                                                          const std::vector<std::string>& planes) const {
  std::vector<std::string> surveyed;
  if (contains(planes, "normal")) surveyed.push_back("normal");
  const auto in_doubt = [&](const View& view) { return is_reflectance_in_doubt(view); };
  if (contains(planes, "reflectance") && std::any_of(frame.views.begin(), frame.views.end(), in_doubt))
    surveyed.push_back("reflectance");
  return surveyed;
}

Frame FrameFile::Impl::decode_rows(const std::vector<std::string>& planes, int first, int last) {
  const Window rows{window.x0, window.y0 + first, window.x1, window.y0 + last};
  Frame frame = guarded(path, [&] { return allocate(planes, rows); });
  decode(frame);
  return frame;
}

int FrameFile::Impl::rows_at_once(const std::vector<std::string>& planes) const {
  int64_t chunk = 1;
  for (const PlaneSource& plane : names.planes)
    for (const ChannelSource& channel : plane.channels)
      if (contains(planes, plane.plane)) chunk = std::max(chunk, rows_per_chunk(file->header(channel.part)));
  const uint64_t row = std::max<uint64_t>(bytes_of(planes, 1), 1);
  const int64_t chunks = std::max<int64_t>(int64_t(bytes_at_once / row) / chunk, 1);
  return int(std::min<int64_t>(chunks * chunk, window.height()));
}

/// `frame`: the depth, as far as it is needed.
void FrameFile::Impl::survey(const std::vector<std::string>& planes, Frame& frame) {
  normal_forms.clear();
  const std::vector<std::string> surveyed = surveyed_planes(frame, planes);
  const Layout image(window.width(), window.height());
  std::vector<Survey> surveys(frame.views.size(), Survey(image));
  const int step = rows_at_once(surveyed);
  is_surveying = true;
  for (int first = 0; !surveyed.empty() && first < image.height; first += step) {
    const Frame rows = decode_rows(surveyed, first, std::min(first + step, image.height));
    for (size_t i = 0; i < surveys.size(); ++i) add_rows(surveys[i], rows.views[i], frame.views[i], first);
  }
  is_surveying = false;
  for (size_t i = 0; i < surveys.size(); ++i) {
    const View& view = frame.views[i];
    const Survey& sums = surveys[i];
    if (contains(surveyed, "normal") && source("normal", view.name)) {
      const auto missing = [&](const NormalForm& form) {
        return form.is_encoded ? sums.missing_where_encoded : sums.missing;
      };
      normal_forms[view.name] = settle_normals(view, sums.samples, missing, frame);
    }
    if (contains(surveyed, "reflectance") && is_reflectance_in_doubt(view)) note_reflectance(sums.white.share(), frame);
  }
}

Frame FrameFile::survey(const std::vector<std::string>& planes) {
  const std::vector<std::string> whole = impl_->whole_planes(planes);
  Frame frame = guarded(impl_->path, [&] { return impl_->allocate(whole, impl_->window); });
  impl_->nonfinite.clear();
  impl_->background_seen = false;
  // Alpha comes once more, with the rows.
  impl_->decode(frame);
  for (const std::string& view : views()) impl_->nonfinite.erase({"alpha", view});
  impl_->note_names(planes, impl_->needed(planes), frame);
  for (View& view : frame.views) {
    impl_->settle_camera(view, frame);
    impl_->convert_depth(view, frame);
    view.planes.erase("alpha");
  }
  impl_->survey(planes, frame);
  impl_->note_unseen_background(frame);
  normalise_planes(frame, impl_->options.background, impl_->options.as_stored);
  for (std::string& sentence : frame.assumed) sentence = printable(sentence);
  return frame;
}

Frame FrameFile::read_rows(const std::vector<std::string>& planes, int first, int last) {
  std::vector<std::string> by_rows = planes;
  std::erase(by_rows, "depth");
  Frame rows = impl_->decode_rows(by_rows, first, last);
  for (View& view : rows.views) {
    impl_->settle_camera(view, rows);
    const auto normal = view.planes.find("normal");
    if (normal == view.planes.end()) continue;
    const std::optional<NormalForm>& form = impl_->normal_forms.at(view.name);
    if (form)
      bring_to_view_space(normal->second, *form, *view.camera);
    else
      view.planes.erase(normal);
  }
  normalise_planes(rows, impl_->options.background, impl_->options.as_stored);
  return rows;
}

int FrameFile::rows_at_once(const std::vector<std::string>& planes) const {
  std::vector<std::string> by_rows = planes;
  std::erase(by_rows, "depth");
  return impl_->rows_at_once(by_rows);
}

unsigned long long FrameFile::bytes_to_read(const std::vector<std::string>& planes) const {
  const std::vector<std::string> needed = impl_->needed(planes);
  return impl_->bytes_of(needed, window().height()) + impl_->bytes_to_decode(needed);
}

unsigned long long FrameFile::bytes_to_read_by_rows(const std::vector<std::string>& planes) const {
  const std::vector<std::string> whole = impl_->whole_planes(planes);
  const int rows = rows_at_once(planes);
  std::vector<std::string> by_rows = planes;
  std::erase(by_rows, "depth");
  // Alpha is whole only while the depth is understood; tiles lie beside the rows that they are cut to.
  const uint64_t at_once = std::max(2 * impl_->bytes_of(by_rows, rows),
                                    impl_->bytes_of({"alpha"}, window().height()) * (contains(whole, "alpha") ? 1 : 0));
  return impl_->bytes_of(contains(whole, "depth") ? std::vector<std::string>{"depth"} : std::vector<std::string>{},
                         window().height()) +
         at_once + impl_->bytes_to_decode(planes);
}

}  // namespace gloam
