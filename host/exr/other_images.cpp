#include "exr/other_images.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/lists.h"
#include "exr/channel_names.h"
#include "exr/channel_text.h"
#include "exr/errors.h"
#include "exr/image_names.h"
#include "exr/image_planes.h"
#include "exr/opened.h"
#include "exr/validation.h"
#include "exr/writers.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/frame_pattern.h"
#include "gloam/option.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

ImageWords words_for(const fs::path& file) { return {file.string(), file.filename().string()}; }

/// What becomes the file in memory.
struct Composed {
  std::string first;  ///< the file whose size counts
  int width = 0, height = 0;
  std::vector<NamedChannel> channels;
  std::vector<std::string>& notes;
};

void add_channels(std::vector<NamedChannel> channels, const std::string& file, Composed& composed) {
  for (NamedChannel& channel : channels) {
    const Layout& layout = channel.channel.layout();
    if (composed.first.empty()) {
      composed.first = file;
      composed.width = layout.width, composed.height = layout.height;
    }
    if (layout.width != composed.width || layout.height != composed.height)
      throw Error("{}: is {}x{}, and {} is {}x{}; the planes of a frame are of one size", file, layout.width,
                  layout.height, composed.first, composed.width, composed.height);
    std::erase_if(composed.channels, [&](const NamedChannel& other) { return other.name == channel.name; });
    composed.channels.push_back(std::move(channel));
  }
}

/// The number of the frame that a file's name ends in, put into the pattern of another plane's files.
fs::path with_number_of(const fs::path& frame, const fs::path& file) {
  if (!FramePattern::is_pattern(file.string())) return file;
  const std::optional<int> number = last_number(frame.stem().string());
  if (!number)
    throw Error("{}: has a place for a frame's number, and {} has no number", file.string(), frame.filename().string());
  return FramePattern(file.string(), "").path_of(*number);
}

/// All channels of an EXR of one part, as they are.
void add_exr(const fs::path& path, const ReadOptions& options, Imf::Header& header, Composed& composed) {
  guarded(path, [&] {
    const OpenedExr opened = open_parts(std::make_unique<ExrInput>(path), path, options.most_pixels);
    Imf::MultiPartInputFile& file = *opened.parts;
    check_parts(path, file, options.most_pixels);
    if (file.parts() != 1)
      throw Error("{}: has {} parts, and planes of other files are added to a file of one part alone", path.string(),
                  file.parts());
    header = file.header(0);
    if (Imf::hasMultiView(header) && Imf::multiView(header).size() > 1)
      throw Error("{}: has the views {}, and planes of other files are added to a file of one view alone",
                  path.string(), enumerate(Imf::multiView(header)));
    const Imath::Box2i box = header.dataWindow();
    check_plausible(path, header, opened.stream->size());
    Imf::FrameBuffer buffer;
    std::vector<NamedChannel> channels;
    const int width = box.max.x - box.min.x + 1, height = box.max.y - box.min.y + 1;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
      channels.push_back({channel.name(), Channel(Layout(width, height), 0.0f)});
    for (NamedChannel& channel : channels) {
      const size_t row = size_t(channel.channel.layout().pitch) * sizeof(float);
      buffer.insert(channel.name,
                    Imf::Slice::Make(Imf::FLOAT, channel.channel.row(0), box.min, width, height, sizeof(float), row));
    }
    Imf::InputPart part(file, 0);
    part.setFrameBuffer(buffer);
    part.readPixels(box.min.y, box.max.y);
    add_channels(std::move(channels), path.string(), composed);
  });
}

/// What the name of the plane's channels states of them, unless the options state something.
void take_declared(const std::string& plane, const FrameFile& file, ReadOptions& options) {
  for (const PlaneSource& source : file.planes()) {
    if (source.plane != plane) continue;
    if (plane == "depth" && source.said == DeclaredConvention::ray_distance &&
        options.depth == DepthConvention::automatic)
      options.depth = DepthConvention::ray;
    if (plane != "normal" || options.normals.space != NormalSpace::automatic) continue;
    if (source.said == DeclaredConvention::world_space) options.normals.space = NormalSpace::world;
    if (source.said == DeclaredConvention::view_space) options.normals.space = NormalSpace::view;
  }
}

/// The plane of an EXR that holds it under any name, or nothing else: red, green and blue, or the only channel.
ImageValues plane_of_exr(const std::string& plane, const fs::path& path, long long most_pixels,
                         ReadOptions& frame_options) {
  ReadOptions options;
  options.only_looks = options.unconverted = true;
  options.most_pixels = most_pixels;
  options.looks_beside = false;
  const size_t wanted = plane_kind(plane).components.size();
  const FrameFile named(path, options);
  if (!contains(named.common_planes(), plane)) {
    const std::vector<std::string> all = named.all_channels();
    const bool has_colours = contains(all, "R") && contains(all, "G") && contains(all, "B");
    if (all.size() != 1 && !has_colours)
      throw Error("{}: has no plane '{}'; it has {}", path.string(), plane, enumerate(all));
    options.channels[plane] = wanted == 3 ? "R,G,B" : all.size() == 1 ? all.front() : "R";
  }
  FrameFile file(path, options);
  take_declared(plane, file, frame_options);
  Frame frame = file.read({plane});
  ImageValues image;
  image.type = "float32";
  if (!frame.views.front().planes.count(plane)) throw Error("{}: its plane '{}' cannot be read", path.string(), plane);
  image.channels = std::move(frame.views.front().planes.at(plane).channels);
  return image;
}

ImageValues only_image(const std::string& plane, const fs::path& file, const ReadOptions& options) {
  std::vector<ImageValues> images = read_images(file, options.most_pixels);
  if (images.size() == 1) return std::move(images.front());
  std::vector<std::string> names;
  for (ImageValues& image : images) {
    if (plane_in_file_name(image.name) == plane) return std::move(image);
    names.push_back(image.name);
  }
  throw Error("{}: holds the arrays {}, and none is called as {} is; give the file as the frame, and {}", file.string(),
              enumerate(names), plane, option("plane", plane + "=NAME"));
}

void add_stated_plane_file(const std::string& plane, const fs::path& file, ReadOptions& options, Composed& composed) {
  if (plane == "normal") take_space_in_name(file, options);
  ImageValues image = is_image_file(file) ? only_image(plane, file, options)
                      : ExrInput(file).has_magic()
                          ? plane_of_exr(plane, file, options.most_pixels, options)
                          : throw Error("{}: is no image that is read; EXR, {} are", file.string(), image_formats());
  add_channels(channels_of_plane(plane, std::move(image), words_for(file), options, composed.notes), file.string(),
               composed);
}

/// A plane that nobody named, but that lies where a writer puts it, is left out where it does not fit.
void add_plane_file(const std::string& plane, const fs::path& file, bool is_stated, ReadOptions& options,
                    Composed& composed) {
  if (is_stated) return add_stated_plane_file(plane, file, options, composed);
  try {
    add_stated_plane_file(plane, file, options, composed);
  } catch (const Error& error) {
    composed.notes.push_back(fmt::format("{}: left out: {}", plane, error.what()));
  }
}

/// A 3x3 matrix of intrinsics gives the field of view, where no camera does.
bool take_intrinsics(const ImageValues& image, const Layout& size, ReadOptions& options,
                     std::vector<std::string>& notes) {
  const Channel& matrix = image.channels.front();
  if (image.layout() != Layout(3, 3) || image.channels.size() != 1 || options.fov_degrees ||
      !options.camera_file.empty())
    return false;
  const double focal = double(matrix.at(0, 0));
  if (!(focal > 0) || matrix.at(2, 2) != 1 || matrix.at(0, 1) != 0 || matrix.at(1, 0) != 0) return false;
  const double fov = 2 * std::atan(size.width / (2 * focal)) * 180 / std::numbers::pi;
  if (!(fov >= 1 && fov <= 179)) return false;
  options.fov_degrees = fov;
  options.fov_from = fmt::format("matrix '{}'", printable(image.name));
  notes.push_back(
      fmt::format("camera: the field of view, {:.4g} degrees, is that of the matrix '{}', with square pixels and a "
                  "centred lens; {} says otherwise",
                  fov, printable(image.name), option("camera", "FILE")));
  return true;
}

/// The arrays of the size that depth has, or else that most have.
void add_arrays(std::vector<ImageValues> images, const fs::path& path, ReadOptions& options, Composed& composed) {
  const auto is_depth = [](const ImageValues& image) { return plane_in_file_name(image.name) == "depth"; };
  const auto area = [](const ImageValues& image) { return (long long)image.layout().width * image.layout().height; };
  auto leading = std::find_if(images.begin(), images.end(), is_depth);
  if (leading == images.end())
    leading =
        std::max_element(images.begin(), images.end(), [&](const auto& a, const auto& b) { return area(a) < area(b); });
  const Layout size = leading->layout();
  const std::string leading_name = printable(leading->name);
  for (ImageValues& image : images) {
    if (image.layout() != size) {
      if (take_intrinsics(image, size, options, composed.notes)) continue;
      composed.notes.push_back(fmt::format("{}: the array '{}' of {}x{} is left out: '{}' is {}x{}",
                                           path.filename().string(), printable(image.name), image.layout().width,
                                           image.layout().height, leading_name, size.width, size.height));
      continue;
    }
    const std::string name = image.name;
    add_channels(channels_of_layer(image, words_for(path), options, composed.notes),
                 fmt::format("{} '{}'", path.string(), name), composed);
  }
}

/// An image alone: the plane that its name speaks of, else depth if it has one component, else colour.
void add_image_alone(const fs::path& path, ReadOptions& options, Composed& composed) {
  std::vector<ImageValues> images = read_images(path, options.most_pixels);
  const std::string file = path.filename().string();
  if (holds_arrays(path)) return add_arrays(std::move(images), path, options, composed);
  std::string plane = plane_in_file_name(path);
  if (plane.empty() && is_named_for_disparities(path)) plane = "depth";
  if (plane.empty()) {
    plane = images.front().channels.size() <= 2 ? "depth" : "color";
    composed.notes.push_back(fmt::format("{}: taken for the {}, since its name says nothing of another plane", file,
                                         plane == "color" ? "colours" : "depth"));
  }
  add_channels(channels_of_plane(plane, std::move(images.front()), words_for(path), options, composed.notes),
               path.string(), composed);
}

/// A file in memory, with the header's attributes.
int file_in_memory(Imf::Header header, const Composed& composed, const fs::path& path) {
  const int descriptor = ::memfd_create("frame", MFD_CLOEXEC);
  if (descriptor < 0) throw Error("{}: cannot be held in memory: {}", path.string(), std::strerror(errno));
  try {
    header.compression() = Imf::NO_COMPRESSION;
    header.erase("tiles");
    header.erase("type");
    header.channels() = Imf::ChannelList();
    Imf::FrameBuffer buffer;
    const Imath::V2i origin = header.dataWindow().min;
    for (const NamedChannel& named : composed.channels) {
      header.channels().insert(named.name, Imf::Channel(Imf::FLOAT));
      const size_t row = size_t(named.channel.layout().pitch) * sizeof(float);
      buffer.insert(named.name, Imf::Slice::Make(Imf::FLOAT, named.channel.row(0), origin, composed.width,
                                                 composed.height, sizeof(float), row));
    }
    ExrOutput stream(descriptor, path.string());
    {
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(buffer);
      file.writePixels(composed.height);
    }
    stream.finish();
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  return descriptor;
}

bool is_same(const fs::path& a, const fs::path& b) { return a.lexically_normal() == b.lexically_normal(); }

/// The header of a frame whose planes all come from files: that of the depth, if it is an EXR of one part, with its camera.
Imf::Header header_of_images(const fs::path& path, const ReadOptions& options, const Composed& composed) {
  Imf::Header header(composed.width, composed.height);
  if (is_image_file(path)) return header;
  guarded(path, [&] {
    const OpenedExr opened = open_parts(std::make_unique<ExrInput>(path), path, options.most_pixels);
    const Imath::Box2i data = header.dataWindow();
    if (opened.parts->parts() == 1) header = opened.parts->header(0);
    header.dataWindow() = data;
    const Imath::Box2i display = header.displayWindow();
    if (display.max - display.min != data.max - data.min)
      header.displayWindow() = data;
    else
      header.dataWindow() = display;
  });
  return header;
}

}  // namespace

std::unique_ptr<ExrInput> open_input(const fs::path& path, ReadOptions& options, std::vector<std::string>& notes) {
  if (std::error_code unknown; fs::is_directory(path, unknown))
    throw Error("{}: is a folder; {}", path.string(), advice_on_folder(path));
  for (auto& [plane, file] : options.plane_files) {
    check_plane_name(plane, "plane-file");
    file = with_number_of(path, file);
    if (options.channels.count(plane))
      throw UsageError("{}: the plane has a file of its own, {}; give one of them",
                       channels_option(plane, options.channels.at(plane)), file.string());
  }
  const bool is_image = is_image_file(path);
  std::vector<std::string> stated = {"depth"};
  for (const auto& [plane, file] : options.plane_files) stated.push_back(plane);
  const auto depth_file = options.plane_files.find("depth");
  if (depth_file == options.plane_files.end() || is_same(depth_file->second, path)) take_writer(path, options, notes);
  if (!is_image && options.plane_files.empty()) return std::make_unique<ExrInput>(path);
  const auto own_depth = options.plane_files.find("depth");
  if (own_depth != options.plane_files.end() || is_image)
    take_name_of_depth(own_depth != options.plane_files.end() ? own_depth->second : path, options, notes);
  Composed composed{{}, 0, 0, {}, notes};
  Imf::Header header(1, 1);
  const auto is_frame = [&](const auto& entry) { return is_same(entry.second, path); };
  const bool has_own_plane = std::any_of(options.plane_files.begin(), options.plane_files.end(), is_frame);
  const bool is_exr_frame = !is_image && !has_own_plane;
  if (is_exr_frame)
    add_exr(path, options, header, composed);
  else if (!has_own_plane)
    add_image_alone(path, options, composed);
  for (const auto& [plane, file] : options.plane_files)
    add_plane_file(plane, file, contains(stated, plane), options, composed);
  if (!is_exr_frame) header = header_of_images(path, options, composed);
  return guarded(path, [&] { return std::make_unique<ExrInput>(path, file_in_memory(header, composed, path)); });
}

}  // namespace gloam
