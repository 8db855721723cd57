#include "cli/flags/options.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "base/file_identity.h"
#include "base/file_ledger.h"
#include "base/files.h"
#include "base/lists.h"
#include "base/statistics.h"
#include "camera/camera_search.h"
#include "cli/flags/wrap.h"
#include "gloam/error.h"
#include "sequence/plan_files.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

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

/// Tells the ledger of an output that is the camera file beside a frame: it is the frame's even where this time the header or a flag
/// gives the camera, and the file is not read.
void tell_of_camera(const std::vector<NamedPath>& inputs, const std::filesystem::path& output) {
  if (!may_be_camera_file(output)) return;
  for (const auto& [what, path] : inputs) {
    const std::filesystem::path frame = path;
    if (frame.extension() != ".exr") continue;
    try {
      const auto found = find_camera_file(frame);
      if (found && are_same_file(*found, output))
        reads_file(output, fmt::format("the camera file of {}", frame.filename().string()));
    } catch (const UsageError&) {
      throw;
    } catch (const Error&) {  // two files could be its camera
    }
  }
}

/// Writes to a file, or to standard output for "-".
void write_document(const std::string& path, const std::string& text) {
  if (path != "-") return write_text(path, text);
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (std::fflush(stdout) != 0) throw Error("standard output: cannot be written");
}

}  // namespace

void check_paths(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs,
                 const std::vector<NamedPath>& growing) {
  for (const auto& [what, path] : inputs) reads_file(path, what);
  std::set<NamedPath> told;  // of two alike the ledger would take the second for the first, said again
  const auto check = [&](const NamedPath& output, OutputUse use) {
    if (output.second.empty()) return;
    if (!told.insert(output).second)
      throw UsageError("{} {}: is also {}; name another file", output.first, output.second, output.first);
    tell_of_camera(inputs, follow_links(output.second));
    writes_file(output.first, output.second, use);
    check_writable(output);
  };
  for (const NamedPath& output : outputs) check(output, OutputUse::result);
  for (const NamedPath& output : growing) check(output, OutputUse::grows);
}

Settings parse_settings(const std::vector<std::string>& items, const std::string& flag) {
  Settings settings;
  for (const std::string& item : items) {
    const size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == item.size())
      throw UsageError("{} '{}' is not NAME=VALUE; write {} radius=0.3", flag, item, flag);
    settings.emplace_back(item.substr(0, equals), item.substr(equals + 1));
  }
  return settings;
}

std::string counted(size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void add_compression(CLI::App& app, std::string& name) {
  add_word(app, "--compression", name, compressions(), "lossless; default zip, and none is fastest");
}

void JsonFlag::add_to(CLI::App& app) {
  add_text(app, "--json", path, "FILE|-",
           "write the figures as JSON to this file; - is standard output, and nothing else goes there")
      ->group("Writing");
}

void JsonFlag::write(const Json& document, const std::vector<std::string>& complete) const {
  if (path.empty()) return;
  try {
    write_document(path, noted(document).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  } catch (const Error& error) {
    if (complete.empty()) throw;
    throw Error("{}; {} {} complete", error.what(), enumerate(complete), complete.size() == 1 ? "is" : "are");
  }
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
  if (!files.history() || !has_history(planes)) return names;
  const FrameFile& before = files.history()->file();
  for (const PlaneSource& source : before.planes()) {
    if (!contains(files.history()->planes_of_file(), source.plane)) continue;
    for (const ChannelSource& channel : source.channels)
      names.push_back(before.path().filename().string() + ": " + channel.name);
  }
  return names;
}

void check_history(const Plan& plan, const FrameFiles& files) {
  if (!files.history() || reads_history(plan)) return;
  note({fmt::format(
      "--history: '{}' takes nothing over from the frame before; ambient occlusion, indirect light and reflections do",
      plan.technique)});
}

PlanRequest going_on(PlanRequest request, const FrameFiles& files, bool temporal) {
  // Accumulation is of a technique: a name of planes, such as ao, stands for their default one, as for gloam run.
  if ((temporal || files.history()) && request.outputs.size() == 1)
    request.outputs = {technique_for(request.outputs.front())};
  const bool can = request.outputs.size() == 1 && contains(technique_names(), request.outputs.front()) &&
                   can_accumulate(find_technique(request.outputs.front()));
  request.temporal = temporal || (files.history() && can);
  if (temporal && !files.history())
    note({fmt::format("--temporal: without --history, a sequence begins with {}", files.name())});
  return request;
}

bool reads_history(const Plan& plan) { return contains(plan.inputs, "history_depth"); }

Plan plan_for(const FrameFiles& files, const PlanRequest& request) {
  Plan plan = plan_for_files(files, request);
  check_history(plan, files);
  return plan;
}

void check_frame_name(const std::string& path, const std::string& flag) {
  if (std::filesystem::path(path).extension() == ".exr") return;
  throw UsageError("{} {}: a frame is an EXR file; name it with .exr", flag, path);
}

void check_picture_name(const std::string& path, const std::string& flag) {
  if (path.empty() || std::filesystem::path(path).extension() == ".png") return;
  throw UsageError("{} {}: the picture is a PNG; name it with .png", flag, path);
}

void check_pictures(const NamedPath& picture, const std::vector<std::string>& views) {
  if (picture.second.empty() || views.size() < 2) return;
  for (const std::string& view : views) writes_file(picture.first, picture_path(picture.second, view, true));
}

void print_written(const std::vector<std::string>& files) {
  for (const std::string& file : files) fmt::print("wrote {}\n", printable(file));
}

namespace {

/// A row with text at its end, which has lines of its own where the columns before it leave no room.
std::string ended_by(std::string row, const std::string& text) {
  constexpr size_t indent = 6;
  if (has_room_from(row.size())) return row + wrapped(text, row.size(), row.size());
  row.resize(row.find_last_not_of(' ') + 1);
  return row + "\n" + std::string(indent, ' ') + wrapped(text, indent, indent);
}

}  // namespace

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
      if (last && i < first_number) {
        line = ended_by(std::move(line), cell);
        break;
      }
      line += i >= first_number ? fmt::format("{:>{}}", cell, widths[i]) : fmt::format("{:<{}}", cell, widths[i]);
      if (!last) line += "  ";
    }
    fmt::print("{}\n", line);
  }
}

}  // namespace gloam::cli
