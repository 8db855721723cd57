#include "exr/writers.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "base/file_ledger.h"
#include "base/json_object.h"
#include "camera/camera_search.h"
#include "exr/read_words.h"
#include "exr/writers_data.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "image/image_values.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Where the file of a plane may lie.
struct PlanePlace {
  std::vector<std::pair<std::string, std::string>> replaced;
  std::string ending;
};

struct Writer {
  std::string name, depth;
  DepthConvention convention = DepthConvention::automatic;
  std::optional<double> scale, fov;
  std::string calibration;
  std::vector<std::pair<std::string, std::vector<PlanePlace>>> planes;
};

PlanePlace place_of(const JsonObject& object) {
  PlanePlace place;
  place.ending = object.text_if("ending");
  for (const auto& pair : object.json().at("replace"))
    place.replaced.emplace_back(pair.at(0).get<std::string>(), pair.at(1).get<std::string>());
  return place;
}

const std::vector<Writer>& writers() {
  static const std::vector<Writer> all = [] {
    const auto document = nlohmann::ordered_json::parse(writers_data().at("writers.json"));
    std::vector<Writer> list;
    for (const JsonObject& row : JsonObject(document, {"writers.json"}).objects("writers")) {
      row.check_keys({"name", "depth", "is", "scale", "fov", "calibration", "planes", "source"});
      Writer writer{row.text("name"), row.text("depth")};
      writer.convention = value_of(row.text("is"), "is", depth_words);
      writer.scale = row.number_if("scale");
      writer.fov = row.number_if("fov");
      writer.calibration = row.text_if("calibration");
      const JsonObject planes = row.object("planes");
      for (const auto& [plane, places] : planes.json().items()) {
        std::vector<PlanePlace> found;
        for (const JsonObject& place : planes.objects(plane)) found.push_back(place_of(place));
        writer.planes.emplace_back(plane, found);
      }
      list.push_back(std::move(writer));
    }
    return list;
  }();
  return all;
}

/// Whether a path ends as a pattern says: # stands for digits, * for anything within a name.
bool ends_as(const std::string& path, size_t path_end, const std::string& pattern, size_t pattern_end) {
  if (pattern_end == 0) return true;
  const char wanted = pattern[pattern_end - 1];
  if (wanted != '#' && wanted != '*')
    return path_end > 0 && path[path_end - 1] == wanted && ends_as(path, path_end - 1, pattern, pattern_end - 1);
  const auto fits = [&](char c) { return wanted == '#' ? c >= '0' && c <= '9' : c != '/'; };
  for (size_t end = path_end; end > 0 && fits(path[end - 1]); --end)
    if (ends_as(path, end - 1, pattern, pattern_end - 1)) return true;
  return false;
}

const Writer* writer_of(const fs::path& depth) {
  std::error_code unknown;
  const std::string path = fs::absolute(depth, unknown).generic_string();
  for (const Writer& writer : writers())
    if (ends_as(path, path.size(), writer.depth, writer.depth.size())) return &writer;
  return nullptr;
}

/// A place where nothing else is replaced than in the last three names of a path.
std::string with_replaced(const std::string& path, const PlanePlace& place) {
  size_t first = path.size();
  for (int names = 0; names < 3 && first != std::string::npos && first > 0; ++names) first = path.rfind('/', first - 1);
  if (first == std::string::npos) first = 0;
  const std::string before = path.substr(0, first);
  std::string names = path.substr(first);
  for (const auto& [from, to] : place.replaced) {
    for (size_t at = names.find(from); at != std::string::npos; at = names.find(from, at + to.size()))
      names.replace(at, from.size(), to);
  }
  if (!place.ending.empty()) names = fs::path(names).replace_extension(place.ending).generic_string();
  return before + names;
}

/// The file of a plane, if it is there.
std::optional<fs::path> file_of(const fs::path& depth, const std::vector<PlanePlace>& places) {
  std::error_code unknown;
  const std::string path = fs::absolute(depth, unknown).generic_string();
  for (const PlanePlace& place : places) {
    const fs::path file = with_replaced(path, place);
    if (file != path && fs::is_regular_file(file, unknown)) return file;
  }
  return {};
}

/// The numbers of a camera in Middlebury's calib.txt: "cam0=[f 0 cx; 0 f cy; 0 0 1]", "doffs=", "baseline=", "width=", "height=".
struct Calibration {
  double focal = 0, x = 0, y = 0, offset = 0, baseline = 0, width = 0, height = 0;
};

double number_after(const std::string& text, const std::string& key, const fs::path& file) {
  const size_t found = text.find("\n" + key + "=");
  double number = NAN;
  if (found != std::string::npos) std::istringstream(text.substr(found + key.size() + 2)) >> number;
  if (!std::isfinite(number))
    throw Error("{}: has no number '{}', as a calibration of Middlebury has", file.string(), key);
  return number;
}

/// The camera of Middlebury's disparities: disp1.pfm is of the right image.
const char* camera_of_disparities(const fs::path& depth) {
  return depth.stem().string().ends_with('1') ? "cam1" : "cam0";
}

Calibration read_calibration(const fs::path& file, const char* which) {
  std::ifstream stream(file);
  if (!stream) throw Error("{}: cannot be read, and has the camera of the disparities beside it", file.string());
  opens_file(file);
  constexpr size_t longest = 1 << 16;
  std::string text(longest, '\0');
  stream.read(text.data(), std::streamsize(longest));
  text = "\n" + text.substr(0, size_t(stream.gcount()));
  Calibration found;
  const size_t matrix = text.find(fmt::format("\n{}=[", which));
  double zero = 0;
  char semicolon = 0;
  std::istringstream rows(matrix == std::string::npos ? "" : text.substr(matrix + 7));
  if (!(rows >> found.focal >> zero >> found.x >> semicolon >> zero >> zero >> found.y) || !(found.focal > 0))
    throw Error("{}: has no camera '{}=[f 0 cx; 0 f cy; 0 0 1]'", file.string(), which);
  found.offset = number_after(text, "doffs", file);
  found.baseline = number_after(text, "baseline", file);
  found.width = number_after(text, "width", file);
  found.height = number_after(text, "height", file);
  if (!(found.baseline > 0))
    throw Error("{}: 'baseline' is {:g}; a length > 0 is needed", file.string(), found.baseline);
  return found;
}

/// 1/z = (d + doffs) / (f baseline). Its pixels have their centres at whole numbers.
void take_calibration(const fs::path& file, const char* which, bool has_camera, ReadOptions& options) {
  const Calibration camera = read_calibration(file, which);
  options.calibration_file = file;
  const double scale = 1 / (camera.focal * camera.baseline);
  if (!options.depth_scale) options.depth_scale = scale;
  if (!options.depth_offset) options.depth_offset = camera.offset * scale;
  if (has_camera) return;
  const nlohmann::json matrix = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  options.camera_file = file;
  options.camera_text = nlohmann::json({{"width", camera.width},
                                        {"height", camera.height},
                                        {"fx", camera.focal},
                                        {"fy", camera.focal},
                                        {"cx", camera.x + 0.5},
                                        {"cy", camera.y + 0.5},
                                        {"camera_to_world", matrix}})
                            .dump();
}

}  // namespace

void take_writer(const fs::path& depth, ReadOptions& options, std::vector<std::string>& notes) {
  const Writer* writer = writer_of(depth);
  if (!writer) return;
  std::vector<std::string> said;
  if (options.depth == DepthConvention::automatic && writer->convention != DepthConvention::automatic) {
    options.depth = writer->convention;
    said.push_back(option("depth", word_for(writer->convention, depth_words)));
  }
  if (!options.depth_scale && writer->scale) {
    options.depth_scale = writer->scale;
    said.push_back(option("depth-scale", fmt::format("{:g}", *writer->scale)));
  }
  const bool gives_camera = writer->fov || !writer->calibration.empty();
  const bool has_camera =
      gives_camera && (options.fov_degrees || !options.camera_file.empty() || find_camera_file(depth));
  if (!has_camera && writer->fov) {
    options.fov_degrees = writer->fov;
    said.push_back(option("fov", fmt::format("{:g}", *writer->fov)));
  }
  const fs::path calibration = depth.parent_path() / writer->calibration;
  if (!writer->calibration.empty() && fs::exists(calibration)) {
    take_calibration(calibration, camera_of_disparities(depth), has_camera, options);
    said.push_back(writer->calibration);
  }
  std::vector<std::string> planes;
  for (const auto& [plane, places] : writer->planes) {
    const std::optional<fs::path> file = file_of(depth, places);
    if (!file || options.channels.count(plane) || !options.plane_files.emplace(plane, *file).second) continue;
    planes.push_back(fmt::format("{} from {}", plane, (file->parent_path().filename() / file->filename()).string()));
  }
  options.plane_files.emplace("depth", depth);
  if (planes.empty() && said.empty()) return;
  const std::string read = planes.empty() ? "" : enumerate(planes) + (said.empty() ? "" : ", ");
  notes.push_back(fmt::format("{}: named as by {}: {}{}", depth.filename().string(), writer->name, read,
                              said.empty() ? "" : fmt::format("{} taken", enumerate(said))));
}

std::string advice_on_folder(const fs::path& folder) {
  constexpr int deepest = 3;
  constexpr int most = 100000;
  std::error_code unknown;
  std::optional<fs::path> first;
  const Writer* writer = nullptr;
  int count = 0, seen = 0;
  for (auto entry = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, unknown);
       entry != fs::recursive_directory_iterator() && seen < most; entry.increment(unknown), ++seen) {
    if (unknown) break;
    if (entry.depth() >= deepest) entry.disable_recursion_pending();
    if (!entry->is_regular_file(unknown) || !is_image_file(entry->path())) continue;
    const Writer* found = writer_of(entry->path());
    if (!found || (writer && found != writer)) continue;
    writer = found;
    ++count;
    if (!first || entry->path() < *first) first = entry->path();
  }
  if (!first) return "name an EXR file in it, or an image of the depth";
  return fmt::format("it has {} frame{} as by {}; name one by its depth: {}", count, count == 1 ? "" : "s",
                     writer->name, first->string());
}

}  // namespace gloam
