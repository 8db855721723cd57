#include "cli/options.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "base/files.h"
#include "base/lists.h"
#include "base/statistics.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam::cli {
namespace {

bool same_file(const std::string& a, const std::string& b) {
  std::error_code unknown;
  if (std::filesystem::equivalent(a, b, unknown)) return true;
  return std::filesystem::weakly_canonical(a, unknown) == std::filesystem::weakly_canonical(b, unknown);
}

void check_writable(const NamedPath& output) {
  const std::filesystem::path parent = std::filesystem::path(output.second).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  std::error_code unknown;
  if (!std::filesystem::is_directory(folder, unknown)) {
    throw Error("{} {}: cannot be written, '{}' is not a folder", output.first, output.second, folder);
  }
  if (access(folder.c_str(), W_OK) != 0)
    throw Error("{} {}: cannot be written, the folder '{}' is not writable", output.first, output.second, folder);
  if (const std::string why = why_unwritable(output.second); !why.empty())
    throw Error("{} {}: cannot be written, {}", output.first, output.second, why);
}

std::vector<std::string> kept_notes;

/// Without repetitions.
std::vector<std::string> notes_so_far() {
  std::vector<std::string> notes;
  for (const std::string& note : kept_notes) add_new(notes, note);
  return notes;
}

/// To a file, or to standard output as "-".
void write_document(const std::string& path, const std::string& text) {
  if (path != "-") return write_text(path, text);
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (std::fflush(stdout) != 0) throw Error("standard output: cannot be written");
}

}  // namespace

double parse_number(const std::string& text, const std::string& flag, double min, double max,
                    const std::string& or_else) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !(value >= min && value <= max)) {
    throw UsageError("{} {} is not allowed; a number from {:g} to {:g}{} is", flag, text, min, max,
                     or_else.empty() ? "" : ", or " + or_else + ",");
  }
  return value;
}

int parse_whole_number(const std::string& text, const std::string& flag, int min, int max) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value < min || value > max) {
    throw UsageError("{} {} is not allowed; a whole number from {} to {} is", flag, text, min, max);
  }
  return value;
}

void check_paths(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].second.empty()) continue;
    std::vector<NamedPath> others = inputs;
    others.insert(others.end(), outputs.begin(), outputs.begin() + long(i));
    for (const auto& [what, path] : others) {
      if (path.empty() || !same_file(path, outputs[i].second)) continue;
      throw UsageError("{} {}: is also {}; name another file", outputs[i].first, outputs[i].second, what);
    }
    check_writable(outputs[i]);
  }
}

std::pair<int, int> parse_size(const std::string& text, const std::string& flag) {
  const size_t cross = text.find('x');
  if (cross == std::string::npos) throw UsageError("{} {} is not WIDTHxHEIGHT; write 1920x1080", flag, text);
  const int width = parse_whole_number(text.substr(0, cross), flag + " " + text + ": width", 1, 65536);
  const int height = parse_whole_number(text.substr(cross + 1), flag + " " + text + ": height", 1, 65536);
  if ((long long)width * height > max_pixels)
    throw UsageError("{} {} has more than {} pixels; take a smaller one", flag, text, max_pixels);
  return {width, height};
}

std::vector<std::pair<std::string, std::string>> parse_settings(const std::vector<std::string>& items,
                                                                const std::string& flag) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const std::string& item : items) {
    const size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == item.size())
      throw UsageError("{} '{}' is not NAME=VALUE; write {} radius=0.3", flag, item, flag);
    settings.emplace_back(item.substr(0, equals), item.substr(equals + 1));
  }
  return settings;
}

std::function<void(int, int)> progress_bar() {
  if (!isatty(STDERR_FILENO)) return {};
  const auto start = std::chrono::steady_clock::now();
  return [start](int done, int of) {
    if (std::chrono::steady_clock::now() - start < std::chrono::seconds(1)) return;
    const int width = 40, filled = int(double(width) * done / of);
    fmt::print(stderr, "\r[{:=<{}}{:<{}}] {}/{}{}", "", filled, "", width - filled, done, of,
               done == of ? "\r\033[K" : "");
    std::fflush(stderr);
  };
}

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789_./+-=:,@%") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<std::string> split_list(const std::string& text, const std::string& flag) {
  std::vector<std::string> items;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) items.push_back(item);
  if (items.empty() || std::find(items.begin(), items.end(), "") != items.end() || text.back() == ',') {
    throw UsageError("{} '{}' has an empty item; write a,b", flag, text);
  }
  return items;
}

void FrameArguments::add_to(CLI::App& app) {
  app.add_option("frame", frame, "EXR file")->required()->type_name("FRAME.exr");
  app.add_option("other_eye", other_eye, "the second eye, where FRAME.exr holds one view and this file the other")
      ->type_name("RIGHT.exr");
  app.add_option("--history", history, "what gloam run wrote for the frame before, for techniques that accumulate")
      ->type_name("PREVIOUS.exr")
      ->group("Reading the frame");
}

FrameFiles FrameArguments::open(const ReadOptions& options) const {
  std::vector<std::string> paths = {frame};
  if (!other_eye.empty()) paths.push_back(other_eye);
  FrameFiles files(paths, options);
  if (!history.empty()) files.take_history(history);
  return files;
}

void FrameFlags::add_to(CLI::App& app) {
  app.add_option("--camera", camera, "camera JSON; default: the one beside the frame, if any")
      ->type_name("FILE")
      ->group("Reading the frame");
  app.add_option("--fov", fov, "horizontal field of view, 1 to 179 degrees, over every other camera")
      ->type_name("DEG")
      ->group("Reading the frame");
  app.add_option("--depth", depth, "what depth values mean: auto, z, ray, ndc or reversed")
      ->type_name("CONVENTION")
      ->group("Reading the frame");
  app.add_option("--near", near, "near plane, scene units (for ndc and reversed)")
      ->type_name("Z")
      ->group("Reading the frame");
  app.add_option("--far", far, "far plane, scene units; depth there is background")
      ->type_name("Z")
      ->group("Reading the frame");
  app.add_option("--background", background, "the depth value that means background")
      ->type_name("VALUE")
      ->group("Reading the frame");
  app.add_option("--normal-space", normal_space, "space of the normals: auto, view or world")
      ->type_name("SPACE")
      ->group("Reading the frame");
  app.add_option("--plane", planes,
                 "take a plane from these channels or layer: depth=Layer.Z; none: leave the plane out (repeatable)")
      ->type_name("PLANE=CHANNELS")
      ->group("Reading the frame")
      ->expected(1)
      ->take_all();
  CLI::Option* one =
      app.add_option("--view", view, "use this view only")->type_name("NAME")->group("Reading the frame");
  app.add_option("--views", views, "use these views, in this order")
      ->type_name("A,B")
      ->group("Reading the frame")
      ->excludes(one);
  app.add_option("--limit-memory", limit_memory,
                 "refuse, before anything is decoded, what would take more; default: what is available")
      ->type_name("4G|512M")
      ->group("Reading the frame");
}

/// What a float holds, or an infinity.
static float parse_depth_value(const std::string& text, const std::string& flag) {
  const double infinity = std::numeric_limits<double>::infinity(), most = std::numeric_limits<float>::max();
  const double value = parse_number(text, flag, -infinity, infinity);
  if (std::isfinite(value) && std::abs(value) > most)
    throw UsageError("{} {} is not allowed; a number from {:g} to {:g}, inf or -inf is", flag, text, -most, most);
  return float(value);
}

ReadOptions FrameFlags::read_options() const {
  ReadOptions options;
  options.camera_file = camera;
  if (!fov.empty()) options.fov_degrees = parse_number(fov, "--fov", 1, 179);
  const double most = std::numeric_limits<double>::infinity();
  if (!near.empty()) options.near = parse_number(near, "--near", 0, most);
  if (!far.empty()) options.far = parse_number(far, "--far", 0, most);
  if (!background.empty()) options.background = parse_depth_value(background, "--background");
  options.depth = one_of<DepthConvention>(depth, "--depth",
                                          {{"auto", DepthConvention::automatic},
                                           {"z", DepthConvention::z},
                                           {"ray", DepthConvention::ray},
                                           {"ndc", DepthConvention::ndc},
                                           {"reversed", DepthConvention::reversed}});
  options.normal_space = one_of<NormalSpace>(
      normal_space, "--normal-space",
      {{"auto", NormalSpace::automatic}, {"view", NormalSpace::view}, {"world", NormalSpace::world}});
  if (!view.empty()) options.views = {view};
  if (!views.empty()) options.views = split_list(views, "--views");
  for (const std::string& plane : planes) {
    const size_t equals = plane.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == plane.size()) {
      throw UsageError("--plane '{}' is not PLANE=CHANNELS; write depth=Layer.Z", plane);
    }
    options.channels[plane.substr(0, equals)] = plane.substr(equals + 1);
  }
  return options;
}

namespace {

/// "bent_normal (mean unoccluded direction, view space), by bitmask, gtao; cone (...), by the same"
std::string extras_in_words() {
  std::map<std::string, std::vector<std::string>> makers;
  for (const Technique& t : registry()) {
    for (const std::string& plane : t.extras) makers[plane].push_back(t.name);
  }
  std::vector<std::string> words;
  std::string last;
  for (const auto& [plane, names] : makers) {
    const std::string by = enumerate(names);
    words.push_back(fmt::format("{} ({}), by {}", plane, plane_kind(plane).help, by == last ? "the same" : by));
    last = by;
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace

void TechniqueFlags::add_to(CLI::App& app, bool with_mask) {
  app.add_option("--set", settings, "set a parameter; --radius 0.3 is short for --set radius=0.3 (repeatable)")
      ->type_name("NAME=VALUE")
      ->group("Technique")
      ->expected(1)
      ->take_all();
  app.add_option("--preset", preset, "low, medium, high or ultra, where the technique has presets")
      ->type_name("NAME")
      ->group("Technique");
  app.add_option("--filter", then, "the technique that follows, or none; default: what the technique names")
      ->type_name("NAME")
      ->group("Technique");
  app.add_option("--with", with, "planes to make beside the usual ones: " + extras_in_words())
      ->type_name("A,B")
      ->group("Technique");
  app.add_option(
         "--resolution", resolution,
         "full, half or quarter: estimate and filter every pixel, every 2nd or every 4th each way, then upsample")
      ->type_name("NAME")
      ->group("Technique");
  app.add_option("--adaptive", adaptive,
                 "preset for tiles where AO hardly varies, by a base pass: --preset ultra --adaptive medium")
      ->type_name("NAME")
      ->group("Technique");
  if (!with_mask) return;
  app.add_option("--only", only,
                 "estimate and filter only where this is above 0, and leave the rest open: a plane of the frame, or a "
                 "technique that makes a mask, such as corner-mask")
      ->type_name("MASK")
      ->group("Technique");
  app.add_option("--elsewhere", elsewhere,
                 "technique that estimates what --only leaves out: run sd-gtao --only hidden-mask --elsewhere gtao")
      ->type_name("TECHNIQUE")
      ->group("Technique");
}

PlanRequest TechniqueFlags::request(const std::vector<std::string>& outputs) const {
  PlanRequest request{.outputs = outputs, .then = then, .preset = preset};
  request.settings = parse_settings(settings, "--set");
  request.mask = only;
  request.elsewhere = elsewhere;
  request.adaptive = adaptive;
  if (!with.empty()) request.with = split_list(with, "--with");
  request.resolution = one_of<int>(resolution, "--resolution", {{"full", 1}, {"half", 2}, {"quarter", 4}});
  return request;
}

void RunFlags::add_to(CLI::App& app) {
  app.add_option("--device", device, "part of a device's or platform's name (gloam list devices)")
      ->type_name("TEXT")
      ->group("Device");
  app.add_option("--lanes", lanes, "pixels per work-item: auto, 1, 4, 8 or 16")->type_name("N")->group("Device");
  app.add_option("--math", math, "precise (same bits at every lane width) or fast")->type_name("MODE")->group("Device");
  app.add_option("--real", real, "float or double")->type_name("TYPE")->group("Device");
  app.add_option("--seed", seed, "of the random numbers; default: 0, or one more than --history had")
      ->type_name("N")
      ->group("Device");
  app.add_option("--repeat", repeat, "timed runs; more than one: after a warm-up")->type_name("N")->group("Device");
}

RunOptions RunFlags::run_options() const {
  RunOptions options;
  options.lanes = one_of<int>(lanes, "--lanes", {{"auto", 0}, {"1", 1}, {"4", 4}, {"8", 8}, {"16", 16}});
  options.math = one_of<Math>(math, "--math", {{"precise", Math::precise}, {"fast", Math::fast}});
  options.real = one_of<Real>(real, "--real", {{"float", Real::float32}, {"double", Real::float64}});
  if (!seed.empty()) options.seed = parse_whole_number(seed, "--seed", 0, std::numeric_limits<int>::max());
  options.repeat = parse_whole_number(repeat, "--repeat", 1, 10000);
  return options;
}

void JsonFlag::add_to(CLI::App& app) {
  app.add_option("--json", path,
                 "write the figures as JSON to this file; - is standard output, and nothing else goes there")
      ->type_name("FILE|-")
      ->group("Writing");
}

void JsonFlag::write(const Json& document, const std::vector<std::string>& complete) const {
  if (path.empty()) return;
  Json with_notes = document;
  if (document.is_object() && !document.contains("notes")) with_notes["notes"] = notes_so_far();
  try {
    write_document(path, with_notes.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  } catch (const Error& error) {
    if (complete.empty()) throw;
    throw Error("{}; {} {} complete", error.what(), enumerate(complete), complete.size() == 1 ? "is" : "are");
  }
}

Json milliseconds(std::vector<double> ms) {
  const double middle = median(ms);
  const auto [least, most] = std::minmax_element(ms.begin(), ms.end());
  return {{"median", middle}, {"min", ms.empty() ? 0 : *least}, {"max", ms.empty() ? 0 : *most}};
}

Json plan_document(const Plan& plan, const std::vector<std::string>& decoded) {
  Json document = {{"outputs", plan.outputs},
                   {"passes", Json::array()},
                   {"decoded", decoded},
                   {"skipped", Json::array()},
                   {"depends_on_pixels", plan.depends_on_pixels}};
  for (const PlannedPass& planned : plan.passes) {
    Json reads = Json::array(), writes = Json::array();
    for (const Binding& b : planned.pass.reads) reads.push_back(b.plane);
    for (const Binding& b : planned.pass.writes) writes.push_back(b.plane);
    document["passes"].push_back({{"name", planned.label()}, {"reads", reads}, {"writes", writes}});
  }
  for (const auto& [what, why] : plan.skipped) document["skipped"].push_back({{"what", what}, {"why", why}});
  return document;
}

std::vector<std::string> decoded_channels(const std::vector<std::string>& planes, const FrameFiles& files) {
  std::vector<std::string> names;
  for (const FrameFile& file : files.files()) {
    const std::string prefix = files.files().size() > 1 ? file.path().filename().string() + ": " : "";
    for (const PlaneSource& source : file.planes()) {
      if (!contains(planes, source.plane)) continue;
      for (const ChannelSource& channel : source.channels) names.push_back(prefix + channel.name);
    }
  }
  if (!files.history() || !contains(planes, "history")) return names;
  const FrameFile& before = files.history()->file();
  for (const PlaneSource& source : before.planes()) {
    if (!contains(History::planes_of_file(), source.plane)) continue;
    for (const ChannelSource& channel : source.channels)
      names.push_back(before.path().filename().string() + ": " + channel.name);
  }
  return names;
}

std::string first_names(std::vector<std::string> names) {
  const size_t most = 16;
  const std::string rest = names.size() > most ? fmt::format(" and {} more", names.size() - most) : "";
  names.resize(std::min(names.size(), most));
  return fmt::format("{}{}", fmt::join(names, ", "), rest);
}

std::string holdings(const FrameFile& file) {
  const std::vector<std::string> names = file.all_channels();
  const std::string name = file.path().filename().string();
  return names.empty() ? name + " has no channels" : fmt::format("{} has only {}", name, first_names(names));
}

std::string holdings(const FrameFiles& files) {
  std::vector<std::string> words;
  for (const FrameFile& file : files.files()) words.push_back(holdings(file));
  return enumerate(words);
}

namespace {

/// A history that nothing asks for was most likely meant for another technique.
void check_history(const Plan& plan, const FrameFiles& files) {
  if (!files.history() || reads_history(plan)) return;
  std::vector<std::string> takers;
  for (const Technique& technique : registry()) {
    if (contains(technique.reads, "history")) takers.push_back(technique.name);
  }
  note({fmt::format("--history: '{}' takes nothing over from the frame before, as {} would", plan.technique,
                    fmt::join(takers, " or "))});
}

}  // namespace

bool reads_history(const Plan& plan) { return contains(plan.inputs, "history"); }

Plan plan_for(const FrameFiles& files, const PlanRequest& request) {
  try {
    Plan plan = make_plan(request, files.common_planes(), holdings(files));
    check_history(plan, files);
    return plan;
  } catch (const MissingPlanes& missing) {
    // Where one view has what another lacks, the list of channels would only confuse.
    std::vector<std::string> wanted = missing.planes;
    for (const auto& [plane, instead] : missing.instead) wanted.push_back(instead);
    for (const std::string& plane : wanted) {
      const std::string why = files.why_missing(plane);
      if (!why.empty()) {
        throw Error(
            "{}: needs '{}', and in {} {}; {}", request.outputs.front(), plane, files.name(), why,
            files.files().size() > 1 ? "give the file of the other view alone" : "--view NAME chooses another view");
      }
    }
    throw;
  }
}

void check_frame_name(const std::string& path, const std::string& flag) {
  if (std::filesystem::path(path).extension() == ".exr") return;
  throw UsageError("{} {}: a frame is an EXR file; name it with .exr", flag, path);
}

void check_picture_name(const std::string& path, const std::string& flag) {
  if (path.empty() || std::filesystem::path(path).extension() == ".png") return;
  throw UsageError("{} {}: the picture is a PNG; name it with .png", flag, path);
}

/// A view's name comes from a file: what a path would take for a folder, a terminal for a command, or a file system for nothing
/// at all is written as its number, so that no two views share a name.
static std::string as_file_name(const std::string& view) {
  std::string name;
  for (const char c : view) {
    const unsigned char byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) || byte >= 0x80 || c == '_' || c == '-' || c == '.' || c == ' ';
    name += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return name;
}

std::filesystem::path picture_path(const std::string& path, const std::string& view, bool several) {
  if (!several) return path;
  std::filesystem::path with_view = path;
  return with_view.replace_extension(as_file_name(view) + std::filesystem::path(path).extension().string());
}

void print_table(const std::vector<std::vector<std::string>>& rows, size_t first_number) {
  std::vector<size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], printable(row[i]).size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
      const bool last = i + 1 == row.size();
      const std::string cell = printable(row[i]);
      line += i >= first_number ? fmt::format("{:>{}}", cell, widths[i])
              : last            ? cell
                                : fmt::format("{:<{}}", cell, widths[i]);
      if (!last) line += "  ";
    }
    fmt::print("{}\n", line);
  }
}

void note(const std::vector<std::string>& notes) { kept_notes.insert(kept_notes.end(), notes.begin(), notes.end()); }

void print_notes() {
  for (const std::string& note : notes_so_far()) {
    std::fputs(("note: " + printable(note) + "\n").c_str(), stderr);  // a closed standard error is no failure
  }
}

}  // namespace gloam::cli
