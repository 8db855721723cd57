#include "viewer/page.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "base/lists.h"
#include "base/memory.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "page/html.h"
#include "picture/tile.h"
#include "viewer/colour_tables.h"
#include "viewer/embedded.h"
#include "viewer/packed.h"

namespace gloam::viewer {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(PictureStyle style) {
  switch (style) {
    case PictureStyle::depth:
      return "depth";
    case PictureStyle::direction:
      return "direction";
    case PictureStyle::colour:
      return "colour";
    case PictureStyle::share:
      return "share";
    case PictureStyle::identity:
      return "identity";
    case PictureStyle::count:
      return "count";
    case PictureStyle::position:
      return "position";
    case PictureStyle::motion:
      return "motion";
    case PictureStyle::scalar:
      break;
  }
  return "scalar";
}

/// "r", "g", "b", or numbers where a plane has another number of components than its kind.
std::vector<std::string> components_of(const Plane& plane) {
  const PlaneKind kind = plane_kind(plane.name);
  if (kind.components.size() == plane.channels.size()) return kind.components;
  std::vector<std::string> numbers;
  for (size_t i = 0; i < plane.channels.size(); ++i) numbers.push_back(std::to_string(i));
  return numbers;
}

/// Whether a value below 0 of a plane says that something is wrong.
bool is_never_negative(const PlaneKind& kind, PictureStyle style) {
  return style == PictureStyle::colour || kind.meaning == PlaneKind::unit_interval ||
         kind.meaning == PlaneKind::view_depth || kind.meaning == PlaneKind::length;
}

Json json(const Packed& channel, int element) {
  const ChannelFacts& facts = channel.facts;
  return {{"data", element},
          {"half", channel.is_half},
          {"nan", facts.nan},
          {"infinite", facts.infinite},
          {"minus_infinite", facts.minus_infinite},
          {"negative", facts.negative},
          {"least", facts.has_finite ? Json(facts.least) : Json(nullptr)},
          {"most", facts.has_finite ? Json(facts.most) : Json(nullptr)}};
}

Json pairs(const std::vector<std::pair<std::string, std::string>>& texts) {
  Json list = Json::array();
  for (const auto& [name, text] : texts) list.push_back({name, text});
  return list;
}

Json json(const Window& window) { return {window.x0, window.y0, window.x1, window.y1}; }

/// The template before and after the place of the data.
std::pair<std::string, std::string> halves_of_template() {
  const std::string place = "@@pictures@@", page = embedded_files().at("view.html");
  const size_t at = page.find(place);
  return {page.substr(0, at), page.substr(at + place.size())};
}

page::Parts parts_of_page() {
  page::Parts parts = page::shared_parts();
  parts.insert(embedded_files().begin(), embedded_files().end());
  return parts;
}

/// Text between tags.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return safe;
}

}  // namespace

PageWriter::PageWriter(NewFile& out, PageOptions options)
    : out_(out), options_(std::move(options)), files_(Json::array()) {
  page::Parts parts = parts_of_page();
  parts["title"] = escaped(printable(options_.title));
  append(page::filled(halves_of_template().first, parts));
}

std::string ways_to_smaller_pages() {
  return fmt::format("{}, {} and {} take fewer images, {} and {} make them smaller", option("planes"), option("frames"),
                     option("views"), option("half"), option("scale"));
}

void PageWriter::append(const std::string& text) {
  bytes_ += text.size();
  if (bytes_ > most_page_bytes || text.size() > most_element_bytes)
    throw Error("the page would be larger than browsers open ({} in all and {} for one channel); {}",
                memory_in_words(most_page_bytes), memory_in_words(most_element_bytes), ways_to_smaller_pages());
  out_.append(text);
}

int PageWriter::put(const std::string& text) {
  append(fmt::format("<script type=\"text/plain\" id=\"data-{}\">{}</script>\n", elements_, text));
  return elements_++;
}

void PageWriter::begin_file(const std::string& name, bool is_shot) {
  files_.push_back({{"name", printable(name)}, {"shot", is_shot}, {"frames", Json::array()}});
}

Json PageWriter::put_plane(const Frame& frame, const View& view, const Plane& plane, const FrameTexts& texts) {
  const Tile tile = tile_of(view, plane);
  const PlaneKind kind = plane_kind(plane.name);
  bool half = options_.half && tile.style != PictureStyle::identity;
  if (half && !std::all_of(plane.channels.begin(), plane.channels.end(), fits_half)) {
    half = false;
    add_new(notes_, fmt::format("{}: {} of {} has values beyond the range of half, and stays float", option("half"),
                                plane.name, texts.name));
  }
  const auto window = texts.windows.find({view.name, plane.name});
  const Grid grid = grid_of(window == texts.windows.end() ? frame.window : window->second, frame.window, options_.step);
  std::vector<Packed> channels(plane.channels.size());
  cv::parallel_for_(cv::Range(0, int(channels.size())), [&](const cv::Range& part) {
    for (int i = part.start; i < part.end; ++i) channels[size_t(i)] = packed(plane.channels[size_t(i)], grid, half);
  });
  Json list = Json::array();
  for (const Packed& channel : channels) list.push_back(json(channel, put(channel.text)));
  return {{"name", printable(plane.name)},
          {"style", name_of(tile.style)},
          {"corner", {grid.x0, grid.y0}},
          {"size", {grid.width, grid.height}},
          {"help", kind.help},
          {"components", components_of(plane)},
          {"has_background", tile.background != nullptr},
          {"never_negative", is_never_negative(kind, tile.style)},
          {"channels", list}};
}

Json PageWriter::put_view(const Frame& frame, const View& view, const std::vector<std::string>& planes,
                          const FrameTexts& texts) {
  Json list = Json::array(), background = nullptr;
  for (const std::string& name : planes)
    if (const Plane* plane = view.find(name)) list.push_back(put_plane(frame, view, *plane, texts));
  const Plane* depth = view.find("depth");
  if (depth && !depth->channels.empty())
    background = put(packed_background(depth->channels[0], grid_of(frame.window, frame.window, options_.step)));
  std::string camera;
  for (const auto& [name, words] : texts.cameras)
    if (name == view.name) camera = printable(words);
  return {{"name", printable(view.name)}, {"camera", camera}, {"background", background}, {"planes", list}};
}

void PageWriter::add(const Frame& frame, const std::vector<std::string>& planes, const FrameTexts& texts) {
  const Grid whole = grid_of(frame.window, frame.window, options_.step);
  Json views = Json::array();
  for (const View& view : frame.views) views.push_back(put_view(frame, view, planes, texts));
  files_.back()["frames"].push_back({{"name", printable(texts.name)},
                                     {"number", texts.number ? Json(*texts.number) : Json(nullptr)},
                                     {"display", json(frame.display)},
                                     {"window", json(frame.window)},
                                     {"size", {whole.width, whole.height}},
                                     {"pixel_aspect", frame.pixel_aspect},
                                     {"facts", pairs(texts.facts)},
                                     {"notes", frame.assumed},
                                     {"attributes", pairs(texts.attributes)},
                                     {"views", views}});
}

void PageWriter::finish() {
  page::Parts parts = parts_of_page();
  parts["data"] = page::script_text({{"title", printable(options_.title)},
                                     {"values", options_.values},
                                     {"step", options_.step},
                                     {"half", options_.half},
                                     {"colours", colour_tables()},
                                     {"files", files_}});
  append(page::filled(halves_of_template().second, parts));
}

}  // namespace gloam::viewer
