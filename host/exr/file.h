// What is behind FrameFile: an open EXR file and what is known about it. read.cpp opens and reads it, rows.cpp reads it by
// rows.
#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exr/channel_names.h"
#include "exr/stream.h"
#include "exr/validation.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "normalise/normals.h"

namespace gloam {

inline std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

/// OpenEXR's message without the file's name, which stands before it anyway.
inline std::string cause(const std::exception& error, const std::filesystem::path& path) {
  const std::string text = one_line(error.what()), quoted = '"' + path.string() + "\". ";
  const size_t at = text.find(quoted);
  return at == std::string::npos ? text : text.substr(at + quoted.size());
}

/// Runs what OpenEXR does with a file; whatever it throws becomes one line that names the file.
template <typename Work>
auto guarded(const std::filesystem::path& path, Work&& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error("{}: not enough memory to read it", path.string());
  } catch (const std::exception& error) {
    throw Error("{}: truncated or corrupted EXR ({}); render or copy it again", path.string(), cause(error, path));
  }
}

/// Adds the file's name to an error about its contents.
template <typename Work>
auto named(const std::filesystem::path& path, Work&& work) {
  try {
    return work();
  } catch (const UsageError& error) {
    throw UsageError("{}: {}", path.string(), error.what());
  } catch (const Error& error) {
    throw Error("{}: {}", path.string(), error.what());
  }
}

struct FrameFile::Impl {
  std::filesystem::path path;
  ReadOptions options;
  std::unique_ptr<ExrInput> stream;
  std::unique_ptr<Imf::MultiPartInputFile> file;
  Window display, window;
  NamedPlanes names;
  std::vector<std::string> part_views;  // by the attribute `view`, else by the parts' names; "" where nothing tells
  std::vector<std::string> channel_names;
  double pixel_aspect = 1;
  std::map<std::string, Camera> cameras, modules, from_json;
  bool json_read = false;
  std::map<std::string, Pose> poses;  // of views whose header tells the pose and nothing else
  std::string json_name;              // of the camera JSON that was read
  bool json_is_shared = false;        // it is that of the other eye's file too
  std::string json_misfit;            // why it is not used: found, not asked for, and without a camera for some view
  std::optional<Eye> eye;             // the file is one of two eyes
  std::vector<std::string> camera_notes;
  std::string convention, space;
  bool background_seen = false;  // some pixel has the depth that --background names
  std::map<std::pair<std::string, std::string>, long long> nonfinite;  // by plane and view
  bool is_surveying = false;                                           // what is decoded now will be decoded once more

  // Of a frame that is read by rows: what only all of it told.
  std::map<std::string, std::optional<NormalForm>> normal_forms;  // by view; none: the normals are of no use

  void open();
  void check_parts() const;
  void find_planes();
  void find_window();
  void set_window(const Box& box);
  void become(const Eye& as);
  void find_cameras();
  void name_parts();
  std::string view_of_part(int part) const { return part_views[size_t(part)]; }
  std::vector<FileChannel> list_channels() const;
  std::vector<std::string> multi_view() const;
  const Imf::Header& header_of(const std::string& view) const;
  template <typename Found>
  auto in_headers(const std::string& view, const Found& found) const;
  const std::map<std::string, Camera>& display_cameras();
  std::optional<Camera> header_camera(const std::string& view);
  std::optional<Pose> header_pose(const std::string& view);
  std::map<std::string, Camera> json_cameras();
  std::optional<Camera> json_camera(const std::map<std::string, Camera>& from_json, const std::string& view);
  std::optional<Camera> known_camera(const std::string& view, std::optional<Pose>& pose);
  template <typename Find>
  void passing_over(bool is_allowed, const Find& find);
  const PlaneSource* source(const std::string& plane, const std::string& view) const;
  bool has(const std::string& plane, const std::string& view) const;
  std::string any_text(const std::string& name) const;
  bool any_attribute(const std::string& name) const;

  std::vector<std::string> needed(const std::vector<std::string>& planes) const;
  Frame allocate(const std::vector<std::string>& planes, const Window& rows) const;
  void decode(Frame& frame);
  void note_names(const std::vector<std::string>& asked, const std::vector<std::string>& decoded, Frame& frame) const;
  void note_unseen_background(Frame& frame) const;
  void convert_depth(View& view, Frame& frame);
  void convert_normals(View& view, Frame& frame);
  std::optional<NormalForm> settle_normals(const View& view, const NormalSamples& samples,
                                           const std::function<long long(const NormalForm&)>& count_missing,
                                           Frame& frame);
  bool is_reflectance_in_doubt(const View& view) const;
  void judge_reflectance(View& view, Frame& frame) const;
  void note_reflectance(double share, Frame& frame) const;
  void judge_positions(View& view, Frame& frame) const;
  NormalSpace said_space(const PlaneSource& normal) const;
  void settle_camera(View& view, Frame& frame) const;

  // rows.cpp
  uint64_t bytes_of(const std::vector<std::string>& planes, int rows) const;
  uint64_t bytes_to_decode(const std::vector<std::string>& planes) const;
  std::vector<std::string> whole_planes(const std::vector<std::string>& planes) const;
  std::vector<std::string> surveyed_planes(const Frame& frame, const std::vector<std::string>& planes) const;
  Frame decode_rows(const std::vector<std::string>& planes, int first, int last);
  int rows_at_once(const std::vector<std::string>& planes) const;
  void survey(const std::vector<std::string>& planes, Frame& frame);
};

}  // namespace gloam
