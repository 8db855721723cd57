#include "exr/writers.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "base/file_ledger.h"
#include "base/json_object.h"
#include "base/lists.h"
#include "camera/camera_search.h"
#include "exr/image_names.h"
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
  std::vector<std::string> endings;  ///< in turn; "": as the depth's
};

struct Writer {
  std::string name;
  std::vector<std::string> depth;
  DepthConvention convention = DepthConvention::automatic;
  std::optional<double> scale, fov;
  std::string calibration;
  std::vector<std::pair<std::string, std::vector<PlanePlace>>> planes;
};

PlanePlace place_of(const JsonObject& object) {
  PlanePlace place;
  place.endings = object.texts_if("endings").value_or(std::vector<std::string>{""});
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
      Writer writer{row.text("name"), row.texts("depth")};
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
    for (const std::string& depth_file : writer.depth)
      if (ends_as(path, path.size(), depth_file, depth_file.size())) return &writer;
  return nullptr;
}

/// A place where nothing else is replaced than in so many last names of a path.
std::string with_replaced(const std::string& path, const PlanePlace& place, const std::string& ending, int last) {
  size_t first = path.size();
  for (int count = 0; count < last && first != std::string::npos && first > 0; ++count)
    first = path.rfind('/', first - 1);
  if (first == std::string::npos) first = 0;
  const std::string before = path.substr(0, first);
  std::string names = path.substr(first);
  for (const auto& [from, to] : place.replaced) {
    for (size_t at = names.find(from); at != std::string::npos; at = names.find(from, at + to.size()))
      names.replace(at, from.size(), to);
  }
  if (!ending.empty()) names = fs::path(names).replace_extension(ending).generic_string();
  return before + names;
}

/// The file of a plane, if it is there.
std::optional<fs::path> file_of(const fs::path& depth, const std::vector<PlanePlace>& places) {
  std::error_code unknown;
  const std::string path = fs::absolute(depth, unknown).generic_string();
  constexpr int most_names = 3;
  for (const PlanePlace& place : places) {
    for (const std::string& ending : place.endings) {
      for (int last = 1; last <= most_names; ++last) {
        const fs::path file = with_replaced(path, place, ending, last);
        if (file != path && fs::is_regular_file(file, unknown)) return file;
      }
    }
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

bool is_frame_file(const fs::path& path) { return is_image_file(path) || path.extension() == ".exr"; }

/// Whether an EXR may be one plane and nothing else: it has one channel, or red, green and blue, and no name of another plane than depth.
bool is_one_plane(const fs::path& path, long long most_pixels) {
  ReadOptions options;
  options.only_looks = options.unconverted = true;
  options.most_pixels = most_pixels;
  options.looks_beside = false;
  const FrameFile file(path, options);
  const std::vector<std::string> channels = file.all_channels();
  const auto is_colour = [](const std::string& name) { return contains({"R", "G", "B", "A"}, name); };
  const auto may_be_depth = [](const PlaneSource& source) {
    return source.plane == "depth" || source.plane == "color" || source.plane == "alpha";
  };
  return std::all_of(file.planes().begin(), file.planes().end(), may_be_depth) &&
         (channels.size() == 1 || std::all_of(channels.begin(), channels.end(), is_colour));
}

}  // namespace

void take_writer(const fs::path& depth, ReadOptions& options, std::vector<std::string>& notes) {
  const Writer* writer = is_frame_file(depth) ? writer_of(depth) : nullptr;
  const bool is_image = is_image_file(depth);
  if (!writer) return;
  if (!is_image && (!options.looks_beside || options.channels.count("depth") || !fs::is_regular_file(depth) ||
                    !is_one_plane(depth, options.most_pixels)))
    return;
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
    options.fov_from = "default of the data set";
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
  const bool is_found = !planes.empty() || !said.empty();
  if (!is_image && !is_found && plane_in_file_name(depth) != "depth") return;
  options.plane_files.emplace("depth", depth);
  if (!is_found) return;
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
    if (!entry->is_regular_file(unknown) || !is_frame_file(entry->path())) continue;
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
