#include "exr/plane_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/lists.h"
#include "exr/file.h"

namespace gloam {
namespace {

/// Sums of a plane, for each channel by itself. They do not depend on how rows are grouped.
struct Sums {
  explicit Sums(const PlaneSource& source) : facts{source}, of_channel(source.channels.size()) {}
  PlaneFacts facts;
  std::vector<double> of_channel;

  /// `rows`: rows of the image from `first_row` on. Unusable planes are missing in it; `Frame::assumed` says why.
  void add(const Frame& rows, const Frame& whole, int first_row) {
    const Plane* plane = rows.view(facts.source.view).find(facts.source.plane);
    const Plane* depth = whole.view(facts.source.view).find("depth");
    for (size_t c = 0; plane && c < plane->channels.size(); ++c) {
      for (int y = 0; y < rows.height(); ++y)
        add_row(plane->channels[c].row(y), depth ? depth->channels[0].row(first_row + y) : nullptr, rows.width(),
                of_channel[c]);
    }
  }

  void add_row(const float* row, const float* depth, int width, double& sum) {
    for (int x = 0; x < width; ++x) {
      const float value = row[x];
      if ((depth && is_background(depth[x])) || !std::isfinite(value)) continue;
      facts.min = std::min(facts.min, double(value));
      facts.max = std::max(facts.max, double(value));
      sum += value;
      ++facts.counted;
    }
  }

  PlaneFacts result(const FrameFile& file) {
    double sum = 0;
    for (const double channel : of_channel) sum += channel;
    if (facts.counted) facts.mean = sum / double(facts.counted);
    facts.nonfinite = file.nonfinite(facts.source.plane, facts.source.view);
    return facts;
  }
};

std::vector<Sums> sums_of(const FrameFile& file) {
  std::vector<Sums> sums;
  for (const PlaneSource& source : file.planes()) sums.emplace_back(source);
  return sums;
}

std::vector<PlaneFacts> results(std::vector<Sums>& sums, const FrameFile& file) {
  std::vector<PlaneFacts> facts;
  for (Sums& each : sums) facts.push_back(each.result(file));
  return facts;
}

/// Whether a channel is the luminance that gloam wrote beside its own result for other programs (`WriteOptions::shows_result`).
bool is_own_copy(const Headers& headers, const FileChannel& channel) {
  const std::string end = channel.name.substr(channel.name.rfind('.') + 1);
  return end == "Y" && !headers.text_for_part(channel.part, "gloamTechnique").empty();
}

}  // namespace

std::vector<PlaneFacts> facts_of(const FrameFile& file, const Frame& frame) {
  std::vector<Sums> sums = sums_of(file);
  for (Sums& each : sums) each.add(frame, frame, 0);
  return results(sums, file);
}

std::vector<PlaneFacts> facts_by_rows(FrameFile& file, const Frame& frame) {
  std::vector<Sums> sums = sums_of(file);
  std::vector<std::string> by_rows;
  for (const PlaneSource& source : file.planes())
    if (source.plane != "depth") add_new(by_rows, source.plane);
  for (Sums& each : sums)
    if (each.facts.source.plane == "depth") each.add(frame, frame, 0);
  const int step = file.rows_at_once(by_rows);
  for (int first = 0; !by_rows.empty() && first < frame.height(); first += step) {
    const Frame rows = file.read_rows(by_rows, first, std::min(first + step, frame.height()));
    for (Sums& each : sums) each.add(rows, frame, first);
  }
  return results(sums, file);
}

std::vector<std::string> unread_channels(const FrameFile& file) {
  std::set<std::pair<int, std::string>> read;
  for (const PlaneSource& source : file.planes()) {
    for (const ChannelSource& channel : source.channels) read.emplace(channel.part, channel.name);
  }
  const ExrFile opened = open_exr(file.path(), {});
  const std::vector<FileChannel> all = opened.headers.channels();
  std::map<std::string, int> parts;  // that have a channel of this name
  for (const FileChannel& channel : all) ++parts[channel.name];
  std::vector<std::string> unread;
  for (const FileChannel& channel : all) {
    if (read.contains({channel.part, channel.name}) || is_own_copy(opened.headers, channel)) continue;
    const std::string part = channel.part_name.empty() ? std::to_string(channel.part) : channel.part_name;
    unread.push_back(parts.at(channel.name) > 1 ? part + ":" + channel.name : channel.name);
  }
  return unread;
}

}  // namespace gloam
