// gloam info FRAME.exr: contents, assumptions, and the techniques that can run or lack something.
#include <limits>
#include <map>
#include <memory>

#include "cli/flags/memory.h"
#include "cli/flags/options.h"
#include "cli/flags/radius.h"
#include "cli/flags/shot_flags.h"
#include "cli/flags/wrap.h"
#include "cli/info/light.h"
#include "cli/info/shot.h"
#include "cli/info/verdict.h"
#include "cli/info/views.h"
#include "exr/camera_facts.h"
#include "exr/channel_sums.h"
#include "exr/plane_facts.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "gloam/margin.h"
#include "gloam/planes.h"
#include "gloam/visualise.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

/// Share of background over all views; none without depth.
std::optional<double> background_share(const Frame& frame) {
  long long background = 0, pixels = 0;
  for (const View& view : frame.views) {
    const Plane* depth = view.find("depth");
    if (!depth) continue;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) background += is_background(depth->channels[0].at(x, y));
    }
    pixels += (long long)frame.width() * frame.height();
  }
  if (pixels == 0) return {};
  return double(background) / double(pixels);
}

/// Needs of a technique for two views that the views of the frame do not meet.
std::vector<std::string> lacking_views(const Technique& technique, const Frame& frame) {
  if (technique.views == 1) return {};
  if (frame.views.size() < 2) return {"a second view"};
  if (frame.views.size() > 2) return {"a choice of two views (--views A,B)"};
  const bool has_poses = std::all_of(frame.views.begin(), frame.views.end(),
                                     [](const View& view) { return view.camera && view.camera->pose; });
  return has_poses ? std::vector<std::string>() : std::vector<std::string>{"cameras with poses"};
}

/// Whether a plan needs a single centre of projection, which views of modules of a light-field display lack.
bool lacks_eye(const Plan& plan, const Frame& frame) {
  const bool has_modules = std::any_of(frame.views.begin(), frame.views.end(),
                                       [](const View& view) { return view.camera && view.camera->slits; });
  return has_modules && std::any_of(plan.passes.begin(), plan.passes.end(),
                                    [](const PlannedPass& planned) { return !planned.technique->any_projection; });
}

/// Techniques that can run on the file, and what the others lack.
struct Abilities {
  std::vector<std::string> runs;
  Json lacks = Json::object();               ///< by technique: missing planes (of alternatives the cheapest) and views
  std::map<std::string, std::string> words;  ///< the same for people
  /// Number of techniques by the plane, and by the need of views, that they lack.
  std::map<std::string, int> planes, views;
};

Abilities abilities_of(const FrameFile& file, const Frame& frame) {
  Abilities abilities;
  for (const Technique& technique : registry()) {
    std::vector<std::string> lacks, words;
    try {
      const Plan plan = make_plan({.outputs = {technique.name}}, file.common_planes(), holdings(file));
      if (lacks_eye(plan, frame)) {
        lacks = words = {"cameras with one eye"};
        ++abilities.views[words.back()];
      }
    } catch (const MissingPlanes& missing) {
      for (const std::string& plane : missing.planes) {
        const auto instead = missing.instead.find(plane);
        lacks.push_back(instead == missing.instead.end() ? plane : instead->second);
        words.push_back(instead == missing.instead.end() ? plane : instead->second + " or " + plane);
        ++abilities.planes[words.back()];
      }
    }
    for (const std::string& what : lacking_views(technique, frame)) {
      lacks.push_back(what);
      words.push_back(what);
      ++abilities.views[what];
    }
    if (lacks.empty()) {
      abilities.runs.push_back(technique.name);
    } else {
      abilities.lacks[technique.name] = lacks;
      abilities.words[technique.name] = fmt::format("{}", fmt::join(words, ", "));
    }
  }
  return abilities;
}

/// In words; empty for a technique that can run.
std::string lacked_by(const Abilities& abilities, const std::string& technique) {
  const auto found = abilities.words.find(technique);
  return found == abilities.words.end() ? "" : found->second;
}

std::string types_of(const PlaneSource& source) {
  std::string types;
  for (const ChannelSource& channel : source.channels) {
    if (types.find(channel.type) == std::string::npos) types += (types.empty() ? "" : "/") + channel.type;
  }
  return types;
}

/// "peel (10 techniques), roughness (4)": those that most techniques lack come first.
std::string most_wanted(const std::map<std::string, int>& lacking) {
  std::vector<std::pair<std::string, int>> sorted(lacking.begin(), lacking.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> words;
  for (const auto& [what, count] : sorted)
    words.push_back(fmt::format("{} ({}{})", what, count,
                                !words.empty() ? ""
                                : count == 1   ? " technique"
                                               : " techniques"));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// At most three lines; with `by_technique` one for each technique.
void print_lacks(const Abilities& abilities, bool by_technique) {
  if (by_technique) {
    for (const auto& [technique, words] : abilities.words) fmt::print("lacks  {}: {}\n", technique, printable(words));
    return;
  }
  const auto line = [](const std::string& text) { fmt::print("lacks  {}\n", wrapped(printable(text), 7, 9)); };
  if (!abilities.planes.empty()) line("planes: " + most_wanted(abilities.planes));
  if (!abilities.views.empty()) line("views: " + most_wanted(abilities.views));
  const size_t count = abilities.words.size();
  if (count > 0) fmt::print("       --lacks says which of them each of {} techniques needs\n", count);
}

void print_info(const FrameFile& file, const std::vector<PlaneFacts>& facts, const Json& document,
                const std::vector<std::string>& assumed, const Abilities& abilities, bool lacks_by_technique) {
  const Window display = file.display(), window = file.window();
  fmt::print("{}: {} x {}", printable(file.path().string()), display.width(), display.height());
  if (window != display)
    fmt::print(", data to {} x {} at ({}, {}), a margin of {}", window.width(), window.height(), window.x0, window.y0,
               in_words(margin_of(window, display)));
  if (file.views().size() > 1 || !file.views()[0].empty())
    fmt::print(", views {}", printable(fmt::format("{}", fmt::join(file.views(), ", "))));
  fmt::print("\n\n");
  std::vector<std::vector<std::string>> rows = {
      {"plane", "view", "channels", "type", "min", "max", "mean", "not finite"}};
  for (const PlaneFacts& f : facts) {
    std::vector<std::string> names;
    for (const ChannelSource& channel : f.source.channels) names.push_back(channel.name);
    if (is_sum(f.source)) names = {layers_in_words(f.source)};
    const auto figure = [&](double value) { return f.counted ? fmt::format("{:.4g}", value) : "-"; };
    rows.push_back({f.source.plane, f.source.view, fmt::format("{}", fmt::join(names, " ")), types_of(f.source),
                    figure(f.min), figure(f.max), figure(f.mean), std::to_string(f.nonfinite)});
  }
  print_table(rows, 4);
  const std::vector<Cryptomatte> cryptomattes = cryptomattes_of(file.path());
  const std::vector<std::string> unread = without_channels_of(cryptomattes, unread_channels(file));
  if (facts.empty()) fmt::print("no plane that gloam knows\n");
  if (!unread.empty()) fmt::print("{}\n", wrapped("not read: " + printable(first_names(unread)), 0, 2));
  for (const std::string& line : light_in_words(file)) fmt::print("{}\n", wrapped(printable(line), 0, 2));
  for (const std::string& line : lines_on(cryptomattes)) fmt::print("{}\n", wrapped(printable(line), 0, 2));
  fmt::print("\n");
  for (const auto& [view, camera] : document["cameras"].items())
    fmt::print("camera {}{}\n", view.empty() ? "" : "of " + printable(view) + ": ", printable(camera_line(camera)));
  if (!document["depth_convention"].is_null()) {
    fmt::print("depth  {}, background {:.2f} %\n", document["depth_convention"].get<std::string>(),
               100 * document["background_share"].get<double>());
  }
  if (!document["normal_space"].is_null()) fmt::print("normal {} space\n", document["normal_space"].get<std::string>());
  for (const std::string& note : assumed) fmt::print("{}\n", wrapped("assumed: " + printable(note), 0, 2));
  fmt::print("\n{}", runs_in_words(abilities.runs));
  print_lacks(abilities, lacks_by_technique);
}

Json planes_document(const std::vector<PlaneFacts>& facts) {
  Json planes = Json::array();
  for (const PlaneFacts& f : facts) {
    Json channels = Json::array();
    for (const ChannelSource& channel : f.source.channels) channels.push_back(channel.name);
    const auto figure = [&](double value) { return f.counted ? Json(value) : Json(); };
    planes.push_back({{"name", f.source.plane},
                      {"view", f.source.view},
                      {"channels", channels},
                      {"type", types_of(f.source)},
                      {"help", plane_kind(f.source.plane).help},
                      {"min", figure(f.min)},
                      {"max", figure(f.max)},
                      {"mean", figure(f.mean)},
                      {"nonfinite", f.nonfinite}});
  }
  return planes;
}

/// Draws the planes: after all checks, and before anything is printed.
void write_planes_picture(const std::string& picture, const std::string& path, const Frame& frame) {
  if (picture.empty()) return;
  const bool drawable =
      std::any_of(frame.views.begin(), frame.views.end(), [](const View& view) { return !view.planes.empty(); });
  if (!drawable) throw Error("--picture {}: {} has no plane that gloam knows; nothing to draw", picture, path);
  write_contact_sheet(picture, frame, {.title = std::filesystem::path(path).filename().string()});
}

struct InfoFlags {
  std::string frame, picture;
  bool lacks = false;
  ViewPictureFlags views;
  FrameChoice choice;
  FrameFlags frame_flags;
  JsonFlag json;
  const CLI::App* app = nullptr;

  /// Pictures of one plane need that plane alone.
  bool is_pictures_only() const { return views.any() && picture.empty() && json.path.empty(); }
};

void check_outputs(const InfoFlags& flags) {
  check_picture_name(flags.picture, "--picture");
  flags.views.check();
  std::vector<NamedPath> outputs = flags.views.outputs();
  outputs.insert(outputs.end(), {{"--picture", flags.picture}, {"--json", flags.json.file()}});
  check_paths({{"the frame", flags.frame}, {"--camera", flags.frame_flags.camera}}, outputs);
}

/// What the writer of the file can do about a camera that is not known. `lines`: for Blender's console.
void print_way_to_camera(const FrameFile& file, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  if (!is_of_blender(file)) {
    fmt::print("\n{}\n", wrapped("The camera is not known: --fov DEG gives its width, --camera FILE.json all of it; "
                                 "docs/gbuffer.md says where gloam looks for it in files of each renderer.",
                                 0, 0));
    return;
  }
  fmt::print("\n{}\n\n",
             wrapped("Blender writes no camera; these lines in its Python console write it beside the frame:", 0, 0));
  for (const std::string& line : lines) fmt::print("{}\n", printable(line));
}

void describe(const InfoFlags& flags, std::vector<std::string> pictures) {
  const std::string &path = flags.frame, &picture = flags.picture;
  ReadOptions options = flags.frame_flags.read_options();
  options.only_looks = true;
  options.count_nonfinite = true;
  options.as_stored = true;
  FrameFile file(path, options);
  std::vector<std::string> all;
  for (const PlaneSource& source : file.planes()) {
    if (std::find(all.begin(), all.end(), source.plane) == all.end()) all.push_back(source.plane);
  }
  const unsigned long long memory =
      planned_memory(flags.frame_flags, path,
                     process_bytes + (picture.empty() ? file.bytes_to_read_by_rows(all) : file.bytes_to_read(all)),
                     picture.empty() ? "crop or shrink the frame" : "leave --picture out, or shrink the frame");
  // A picture shows all planes at once.
  const Frame frame = picture.empty() ? file.survey(all) : file.read(all);
  const std::vector<PlaneFacts> facts = picture.empty() ? facts_by_rows(file, frame) : facts_of(file, frame);
  file.verify();

  const Abilities abilities = abilities_of(file, frame);
  const auto text = [](const std::string& value) { return value.empty() ? Json() : Json(value); };
  const std::optional<double> share = background_share(frame);
  std::vector<std::string> views = file.views();
  if (views == std::vector<std::string>{""}) views.clear();
  const Window display = file.display(), window = file.window();
  Json document = {{"size", {display.width(), display.height()}},
                   {"window", {window.x0, window.y0, window.x1, window.y1}},
                   {"views", views},
                   {"planes", planes_document(facts)},
                   {"camera", Json()},
                   {"cameras", Json()},
                   {"camera_from", Json()},
                   {"camera_residual_pixels", Json()},
                   {"camera_residual_pixels_99", Json()},
                   {"depth_convention", text(file.depth_convention())},
                   {"normal_space", text(file.normal_space())},
                   {"background_share", share ? Json(*share) : Json()},
                   {"assumed", frame.assumed},
                   {"runs", abilities.runs},
                   {"lacks", abilities.lacks},
                   {"unread", unread_channels(file)},
                   {"cryptomattes", names_of(cryptomattes_of(file.path()))},
                   {"memory_bytes", memory}};
  add_cameras(file, options, document);
  const std::vector<std::string> for_blender = lines_for_blender(file);
  if (!for_blender.empty()) document["camera_lines"] = for_blender;
  const Radius suggested = default_radius(frame, stated_radius(file));
  const RadiusReport radius(suggested, frame, {});
  if (pixels_at_median_depth(frame)) radius.add_to(document);
  write_planes_picture(picture, path, frame);
  if (!picture.empty()) pictures.push_back(picture);
  flags.json.write(document, pictures);
  if (flags.json.only_json()) return;
  const bool has_surfaces = pixels_at_median_depth(frame).has_value();
  const Json& from = document["camera_from"];
  const FoundOnFrame found{abilities.runs, lacked_by(abilities, technique_for("ao")), reading_text(*flags.app),
                           from.is_null() ? "" : from.get<std::string>(),
                           has_surfaces ? std::optional(suggested.value) : std::nullopt};
  fmt::print("{}\n\n", wrapped(verdict_on(file, found), 0, 0));
  print_info(file, facts, document, frame.assumed, abilities, flags.lacks);
  if (has_surfaces) radius.print();
  print_way_to_camera(file, for_blender);
  print_written(pictures);
}

/// A shot has no pictures.
void info_on_shot(const InfoFlags& flags) {
  if (!flags.picture.empty() || flags.views.any())
    throw UsageError("{}: is a shot, and pictures show one frame; name the file of a frame", flags.frame);
  if (flags.lacks) throw UsageError("--lacks: is told of one frame; name the file of a frame of {}", flags.frame);
  check_paths({}, {{"--json", flags.json.file()}});
  describe_shot(flags.frame, flags.choice, flags.frame_flags, flags.json, reading_text(*flags.app));
}

void info_command(const InfoFlags& flags) {
  if (FramePattern::is_pattern(flags.frame)) return info_on_shot(flags);
  check_no_frames(flags.choice, flags.frame);
  check_outputs(flags);
  const std::vector<std::string> pictures = write_view_pictures(flags.frame, flags.views, flags.frame_flags);
  if (flags.is_pictures_only())
    print_written(pictures);
  else
    describe(flags, pictures);
}

}  // namespace

void add_info(CLI::App& app) {
  auto flags = std::make_shared<InfoFlags>();
  CLI::App* command = app.add_subcommand("info", "what a frame holds, what is assumed, what can run on it");
  add_text(*command, "frame", flags->frame, "FRAME.exr", "EXR file, or those of a shot: 'shot.####.exr'")->required();
  add_text(*command, "--picture", flags->picture, "PLANES.png", "also all planes as a contact sheet");
  command->add_flag("--lacks", flags->lacks, "what each technique lacks, one a line");
  flags->views.add_to(*command);
  add_frames(*command, flags->choice);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  flags->app = command;
  command->footer(
      "Examples:\n  gloam info frame.exr\n  gloam info frame.exr --picture planes.png\n"
      "  gloam info display.exr --sheet views.png\n"
      "  gloam info display.exr --scan-line line.png --row 400 --what depth\n"
      "  gloam info frame.exr --depth ray --json -\n"
      "  gloam info 'shot.####.exr' --frames 1001-1100\n"
      "  gloam info frame.exr --plane depth=Layer.Z");
  command->callback([flags] { info_command(*flags); });
}

}  // namespace gloam::cli
