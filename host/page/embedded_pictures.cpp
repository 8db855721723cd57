#include "page/embedded_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "gloam/error.h"
#include "page/html.h"
#include "page/pictures.h"
#include "picture/picture.h"

namespace gloam::report {
namespace {

namespace fs = std::filesystem;

/// Averages over areas; transparent pixels do not count.
cv::Mat reduced(const cv::Mat& grey_alpha, int width) {
  const int height = std::max(1, cvRound(double(grey_alpha.rows) * width / grey_alpha.cols));
  std::vector<cv::Mat> planes;
  cv::Mat in;
  grey_alpha.convertTo(in, CV_32FC2);
  cv::split(in, planes);
  planes[0] = planes[0].mul(planes[1]);
  for (cv::Mat& plane : planes) cv::resize(plane, plane, cv::Size(width, height), 0, 0, cv::INTER_AREA);
  planes[0] /= cv::max(planes[1], 1e-6f);
  cv::Mat merged, out;
  cv::merge(planes, merged);
  merged.convertTo(out, CV_8UC2);
  return out;
}

/// A picture below the folder, at most `width` wide, as grey and alpha. Throws Error.
cv::Mat picture(const fs::path& folder, const std::string& name, int width) {
  const cv::Mat stored = stored_picture(folder, name);
  return width > 0 && stored.cols > width ? reduced(stored, width) : stored;
}

}  // namespace

void EmbeddedPictures::add(const fs::path& folder, const std::string& name) {
  const Key key{folder, name};
  if (name.empty() || index_.count(key)) return;
  index_[key] = -1;
  names_.push_back(key);
}

void EmbeddedPictures::embed(int width, const std::function<void(int done, int of)>& progress) {
  for (size_t i = 0; i < names_.size(); ++i) {
    const auto& [folder, name] = names_[i];
    try {
      put(picture(folder, name, width), count_);
      index_[names_[i]] = count_++;
    } catch (const Error& error) {
      notes_.push_back(fmt::format("{}; the page goes without this picture", error.what()));
    } catch (const cv::Exception&) {  // what it throws where memory runs out
      notes_.push_back(fmt::format("{}: memory ran out; the page goes without this picture", (folder / name).string()));
    }
    if (progress) progress(int(i + 1), int(names_.size()));
  }
}

Json EmbeddedPictures::index(const fs::path& folder, const std::string& name) const {
  const auto found = index_.find({folder, name});
  return found == index_.end() || found->second < 0 ? Json(nullptr) : Json(found->second);
}

/// Stores a picture as text that the browser ignores until the picture is asked for: 200 of them cost nothing at loading.
void EmbeddedPictures::put_text(const std::string& attributes, const std::string& png) {
  html_ += fmt::format("<script type=\"text/plain\" {}>{}</script>\n", attributes, page::base64(png));
}

void EmbeddedPictures::put(const cv::Mat& grey_alpha, int number) {
  cv::Mat grey, alpha;
  cv::extractChannel(grey_alpha, grey, 0);
  cv::extractChannel(grey_alpha, alpha, 1);
  put_text(fmt::format("id=\"picture-{}\" data-mask=\"{}\"", number, mask(alpha)), encode_png(grey));
}

/// The number of a mask: a black picture with this alpha.
size_t EmbeddedPictures::mask(const cv::Mat& alpha) {
  cv::Mat black = cv::Mat::zeros(alpha.size(), CV_8UC2);
  cv::insertChannel(alpha, black, 1);
  const std::string png = encode_png(black);
  const auto [found, is_new] = masks_.emplace(png, masks_.size());
  if (is_new) put_text(fmt::format("id=\"mask-{}\"", found->second), png);
  return found->second;
}

}  // namespace gloam::report
