#include "exr/position_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exr/chunks.h"
#include "exr/rows.h"
#include "normalise/background.h"

namespace gloam {
namespace {

constexpr int most_columns = 64;
constexpr size_t enough_pixels = 200;

/// Distance between neighbouring numbers of the type, about a value.
double spacing(double value, const std::string& type) {
  if (value == 0 || type == "uint") return 0;
  const int digits = type == "half" ? 10 : 23, lowest = type == "half" ? -14 : -126;
  return std::exp2(std::max(std::ilogb(value), lowest) - digits);
}

double rounding_of(const glm::vec3& stored, const PlaneSource& source) {
  double square = 0;
  for (int c = 0; c < 3; ++c) square += std::pow(spacing(stored[c], source.channels[size_t(c)].type), 2) / 36;
  return std::sqrt(square);  // spacing^2 / 12 for each axis, their mean
}

bool is_position(const glm::vec3& p) {
  const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest > 0 && largest < farthest_depth && p.x == p.x && p.y == p.y && p.z == p.z;
}

/// What a pixel holds besides its position.
struct Candidate {
  PositionedPixel pixel;
  glm::vec3 stored;
  float alpha = 1;
};

/// The channels of one view in decoded rows.
struct RowRange {
  const Plane* position;
  const Channel* depth = nullptr;
  const Channel* alpha = nullptr;
};

const Channel* first_channel(const View& view, const char* plane) {
  const Plane* found = view.find(plane);
  return found ? &found->channels.front() : nullptr;
}

class Sampler {
 public:
  Sampler(const ExrFile& file, int rows) : file_(file) {
    const int height = file.window.height();
    for (int i = 0; i < std::min(rows, height); ++i)
      rows_.push_back(int((2LL * i + 1) * height / (2 * std::min(rows, height))));
    column_step_ = std::max(1, file.window.width() / most_columns);
  }

  std::map<std::string, PositionSamples> all() {
    const std::vector<std::string> planes = planes_to_read();
    for (size_t i = 0; i < rows_.size();) {
      size_t end = i + 1;
      while (end < rows_.size() && chunk_of(rows_[end]) == chunk_of(rows_[i])) ++end;
      const Frame decoded = decode_rows(file_, {}, planes, rows_[i], rows_[end - 1] + 1);
      for (; i < end; ++i)
        for (const View& view : decoded.views)
          take_row(view, rows_[i], rows_[i] - (decoded.window.y0 - file_.window.y0));
    }
    std::map<std::string, PositionSamples> samples;
    for (auto& [view, candidates] : candidates_) samples[view] = chosen(std::move(candidates));
    return samples;
  }

 private:
  std::vector<std::string> planes_to_read() const {
    std::vector<std::string> planes = {"position"};
    for (const char* plane : {"depth", "alpha"})
      for (const PlaneSource& source : file_.names.planes)
        if (source.plane == plane && source.said != DeclaredConvention::made_of_positions &&
            std::find(planes.begin(), planes.end(), plane) == planes.end())
          planes.push_back(plane);
    return planes;
  }

  /// Rows of one block of the first view's positions.
  int64_t chunk_of(int row) const {
    for (const PlaneSource& source : file_.names.planes) {
      if (source.plane != "position") continue;
      const Imf::Header& header = file_.headers.of_part(source.channels.front().part);
      const int64_t in_part = int64_t(row) + file_.window.y0 - header.dataWindow().min.y;
      return in_part < 0 ? -1 : in_part / std::max<int64_t>(rows_per_chunk(header), 1);
    }
    return row;
  }

  void take_row(const View& view, int row, int decoded_row) {
    const PlaneSource* source = file_.source("position", view.name);
    const Plane* position = view.find("position");
    if (!source || !position || source->channels.size() != 3) return;
    const Channel *depth = first_channel(view, "depth"), *alpha = first_channel(view, "alpha");
    // Depth that is made of positions has their channels.
    if (const PlaneSource* z = file_.source("depth", view.name); z && z->said == DeclaredConvention::made_of_positions)
      depth = nullptr;
    for (int x = column_step_ / 2; x < file_.window.width(); x += column_step_) {
      Candidate candidate;
      for (int c = 0; c < 3; ++c) candidate.stored[c] = position->channels[size_t(c)].at(x, decoded_row);
      if (!is_position(candidate.stored)) continue;
      candidate.alpha = alpha ? alpha->at(x, decoded_row) : 1;
      candidate.pixel = {{file_.window.x0 + x + 0.5, file_.window.y0 + row + 0.5},
                         view.origin + glm::dvec3(candidate.stored),
                         rounding_of(candidate.stored, *source)};
      if (depth) {
        const float z = std::abs(depth->at(x, decoded_row));
        if (!is_surface(z, background_of(file_.options.background, file_.options.far))) continue;
        candidate.pixel.depth = z;
      }
      candidates_[view.name].push_back(candidate);
    }
  }

  /// No two pixels show one point of a surface.
  static std::optional<glm::vec3> shared_position(const std::vector<Candidate>& candidates) {
    std::map<std::array<float, 3>, size_t> counts;
    for (const Candidate& c : candidates) ++counts[{c.stored.x, c.stored.y, c.stored.z}];
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == counts.end() || most->second < std::max<size_t>(5, candidates.size() / 100)) return {};
    return glm::vec3(most->first[0], most->first[1], most->first[2]);
  }

  static PositionSamples chosen(std::vector<Candidate> candidates) {
    PositionSamples samples;
    samples.background = shared_position(candidates);
    std::erase_if(candidates,
                  [&](const Candidate& c) { return samples.background && c.stored == *samples.background; });
    const auto count_from = [&](float alpha) {
      return size_t(
          std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& c) { return c.alpha >= alpha; }));
    };
    // Where alpha is 0 all over, it says nothing.
    const float least = count_from(1) >= enough_pixels ? 1 : count_from(1e-6f) > 0 ? 1e-6f : -INFINITY;
    for (const Candidate& candidate : candidates)
      if (candidate.alpha >= least) samples.pixels.push_back(candidate.pixel);
    return samples;
  }

  const ExrFile& file_;
  std::vector<int> rows_;
  int column_step_ = 1;
  std::map<std::string, std::vector<Candidate>> candidates_;
};

}  // namespace

std::map<std::string, PositionSamples> sample_positions(const ExrFile& file, int rows) {
  return Sampler(file, rows).all();
}

}  // namespace gloam
