#include "gloam/exr_copy.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>
#include <OpenEXR/ImfDeepTiledOutputPart.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

#include <algorithm>
#include <memory>

#include "base/files.h"
#include "base/lists.h"
#include "exr/added_parts.h"
#include "exr/attributes.h"
#include "exr/channel_names.h"
#include "exr/errors.h"
#include "exr/headers.h"
#include "exr/opened.h"
#include "exr/stream.h"
#include "exr/validation.h"
#include "exr/write.h"
#include "exr/written_channels.h"
#include "exr/written_header.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "image/image_values.h"

namespace gloam {
namespace {

/// The name of the only part of a file that names none: compositors take it for the picture itself.
constexpr const char* name_of_only_part = "rgba";

OpenedExr open_original(const std::filesystem::path& path) {
  if (is_image_file(path))
    throw Error("{}: is no EXR, and a copy with results as parts is made of EXR alone; {} writes the result by itself",
                path.string(), option("output", "OUT.exr"));
  return guarded(path, [&] { return open_parts(std::make_unique<ExrInput>(path), path, max_pixels); });
}

/// With the attributes that a part of several must have.
Imf::Header header_of_copy(const Imf::Header& header) {
  Imf::Header copy = header;
  if (!copy.hasName()) copy.setName(name_of_only_part);
  if (!copy.hasType()) copy.setType(copy.hasTileDescription() ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  return copy;
}

template <typename InputPart, typename OutputPart>
void copy_as(Imf::MultiPartInputFile& from, int from_part, Imf::MultiPartOutputFile& to, int to_part) {
  InputPart input(from, from_part);
  OutputPart output(to, to_part);
  output.copyPixels(input);
}

/// Copies compressed blocks as they are.
void copy_blocks(Imf::MultiPartInputFile& from, int from_part, Imf::MultiPartOutputFile& to, int to_part) {
  const std::string& type = to.header(to_part).type();
  if (type == Imf::TILEDIMAGE)
    copy_as<Imf::TiledInputPart, Imf::TiledOutputPart>(from, from_part, to, to_part);
  else if (type == Imf::DEEPSCANLINE)
    copy_as<Imf::DeepScanLineInputPart, Imf::DeepScanLineOutputPart>(from, from_part, to, to_part);
  else if (type == Imf::DEEPTILE)
    copy_as<Imf::DeepTiledInputPart, Imf::DeepTiledOutputPart>(from, from_part, to, to_part);
  else
    copy_as<Imf::InputPart, Imf::OutputPart>(from, from_part, to, to_part);
}

/// The origin that a reader of the copy takes for positions of a view.
glm::dvec3 origin_of(const Headers& headers, const std::string& view) {
  for (const std::string& prefix : {view.empty() ? std::string() : view + ".", std::string()})
    if (const auto origin = origin_attribute(headers.of_view(view), prefix)) return *origin;
  return glm::dvec3(0.0);
}

/// A part to add, and the values of its channels.
struct NewPart {
  Imf::Header header;
  std::vector<WrittenChannel> channels;
  Window window;   ///< of the values
  int height = 0;  ///< rows to write
};

/// All parts of a file agree in these attributes.
void share_attributes(const Imf::Header& from, Imf::Header& to) {
  for (const char* name : {"displayWindow", "pixelAspectRatio", "timeCode", "chromaticities"}) {
    const auto attribute = from.find(name);
    if (attribute != from.end()) to.insert(name, attribute.attribute());
  }
}

NewPart new_part(const Headers& original, const AddedPlanes& added, const View& view) {
  NewPart part;
  part.window = added.frame->window;
  part.height = written_window(*added.frame, added.writing).height();
  part.channels = channels_of_view(view, view.origin - origin_of(original, view.name), added.writing);
  part.header = header_of_part(*added.frame, view, part.channels, added.writing);
  share_attributes(original.of_part(0), part.header);
  part.header.setName(added_part_name(added.content, view.name));
  part.header.setType(Imf::SCANLINEIMAGE);
  // Where the names of parts tell the views, an attribute of one part would hide the others'.
  if (!view.name.empty() && !original.has_views_by_part_names()) part.header.setView(view.name);
  return part;
}

std::vector<NewPart> new_parts(const Headers& original, const std::vector<AddedPlanes>& all) {
  std::vector<NewPart> parts;
  for (const AddedPlanes& added : all) {
    for (const View& view : added.frame->views) {
      if (!view.planes.empty()) parts.push_back(new_part(original, added, view));
    }
  }
  if (parts.empty()) throw Error("the frame has no plane");
  return parts;
}

void write_part(const NewPart& part, Imf::MultiPartOutputFile& file, int number) {
  ChannelCopies copies;
  Imf::FrameBuffer buffer;
  for (const WrittenChannel& channel : part.channels)
    buffer.insert(channel.name, slice_for(copies, channel, part.window));
  Imf::OutputPart output(file, number);
  output.setFrameBuffer(buffer);
  output.writePixels(part.height);
}

/// The parts of the original that the new ones do not replace.
std::vector<int> parts_kept(const Headers& original, const std::vector<NewPart>& added,
                            std::vector<std::string>& notes) {
  std::vector<int> kept;
  for (int part = 0; part < original.parts(); ++part) {
    const Imf::Header& header = original.of_part(part);
    const bool is_replaced = std::any_of(added.begin(), added.end(), [&](const NewPart& other) {
      return header.hasName() && header.name() == other.header.name();
    });
    if (is_replaced)
      notes.push_back(
          fmt::format("copy: the input has a part '{}' already, and the new one replaces it", header.name()));
    else
      kept.push_back(part);
  }
  return kept;
}

/// A note for each plane that the original has itself: readers mostly take the first that they find.
void note_planes_there_twice(const Headers& original, const std::vector<int>& kept, const std::vector<AddedPlanes>& all,
                             std::vector<std::string>& notes) {
  std::vector<FileChannel> channels = original.channels();
  std::erase_if(channels, [&](const FileChannel& channel) {
    return std::find(kept.begin(), kept.end(), channel.part) == kept.end();
  });
  for (const PlaneSource& source : name_planes(channels, original.listed_views()).planes) {
    for (const AddedPlanes& added : all) {
      if (!added.frame->views.front().find(source.plane) || added.content == composite_content) continue;
      add_new(notes,
              fmt::format(
                  "copy: the input has '{}' too: of the copy, {} reads that one, and {} the new one", source.plane,
                  channels_option(source.plane, source.channels.front().name),
                  channels_option(source.plane,
                                  fmt::format("{}:{}", added_part_name(added.content, added.frame->views.front().name),
                                              fmt::join(plane_kind(source.plane).channels, ",")))));
    }
  }
}

std::vector<std::string> write(NewFile& new_file, const std::string& name, const std::filesystem::path& path,
                               const std::vector<AddedPlanes>& planes) {
  const OpenedExr original = open_original(path);
  const Headers headers(*original.parts);
  const std::vector<NewPart> added = new_parts(headers, planes);
  std::vector<std::string> notes;
  const std::vector<int> kept = parts_kept(headers, added, notes);
  note_planes_there_twice(headers, kept, planes, notes);
  std::vector<Imf::Header> all;
  for (const int number : kept) all.push_back(header_of_copy(headers.of_part(number)));
  for (const NewPart& part : added) all.push_back(part.header);
  ExrOutput stream(new_file.descriptor(), name);
  {
    Imf::MultiPartOutputFile file(stream, all.data(), int(all.size()));
    for (size_t i = 0; i < kept.size(); ++i) copy_blocks(*original.parts, kept[i], file, int(i));
    for (size_t i = 0; i < added.size(); ++i) write_part(added[i], file, int(kept.size() + i));
  }
  stream.finish();
  return notes;
}

}  // namespace

std::vector<std::string> write_copy(const std::filesystem::path& path, const std::filesystem::path& original,
                                    const std::vector<AddedPlanes>& added) {
  for (const AddedPlanes& planes : added) check(planes.writing);
  use_all_threads();
  std::vector<std::string> notes;
  write_atomically(path, [&](NewFile& file) { notes = write(file, path.string(), original, added); });
  return notes;
}

void write_frame_like(const std::filesystem::path& path, const std::filesystem::path& original, int part,
                      const Frame& frame, const WriteOptions& options) {
  if (is_image_file(original)) return write_frame(path, frame, options);  // which has no header to be like
  check(options);
  const OpenedExr from = open_original(original);
  const Imf::Header& like = from.parts->header(part);
  write_atomically(path, [&](NewFile& file) { write_exr(file, path.string(), frame, options, &like); });
}

}  // namespace gloam
