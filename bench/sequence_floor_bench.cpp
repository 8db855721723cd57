// bench_sequence_floor: reads the channels that a run on a shot decodes, and writes the channels that it writes, by OpenEXR
// with its own threads and nothing else. What `gloam run` takes for a frame beyond that is gloam's.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfThreading.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <map>
#include <thread>

#include "base/elapsed.h"
#include "flags/typed.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/frame_pattern.h"

namespace gloam::bench {
namespace {

struct Flags {
  std::string in, out, written, channels = "Z,N.X,N.Y,N.Z";
  std::optional<std::vector<int>> frames;
  int threads = int(std::max(1u, std::thread::hardware_concurrency()));
};

/// The pixels of some channels of a file, in the type of the file or as float.
struct Pixels {
  Imf::Header header;
  std::map<std::string, std::vector<char>> channels;
  Imf::FrameBuffer buffer;
};

Pixels space_for(const Imf::Header& header, const std::vector<std::string>& names, bool as_float) {
  Pixels pixels{header, {}, {}};
  const Imath::Box2i data = header.dataWindow();
  const size_t width = size_t(data.max.x - data.min.x + 1), height = size_t(data.max.y - data.min.y + 1);
  for (const std::string& name : names) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (!channel) throw Error("no channel '{}' in the file", name);
    const Imf::PixelType type = as_float ? Imf::FLOAT : channel->type;
    const size_t bytes = type == Imf::HALF ? 2 : 4;
    std::vector<char>& memory = pixels.channels[name];
    memory.resize(width * height * bytes);
    pixels.buffer.insert(name, Imf::Slice::Make(type, memory.data(), data, bytes, bytes * width));
  }
  return pixels;
}

/// The file that each frame is written as, with the header of a run on a shot.
Pixels what_is_written(const std::string& path) {
  Imf::InputFile file(path.c_str());
  std::vector<std::string> names;
  for (auto channel = file.header().channels().begin(); channel != file.header().channels().end(); ++channel)
    names.emplace_back(channel.name());
  Pixels pixels = space_for(file.header(), names, false);
  file.setFrameBuffer(pixels.buffer);
  file.readPixels(file.header().dataWindow().min.y, file.header().dataWindow().max.y);
  pixels.header.zipCompressionLevel() = 1;  // as gloam writes
  return pixels;
}

void read_frame(const std::string& path, const std::vector<std::string>& names) {
  Imf::InputFile file(path.c_str());
  Pixels pixels = space_for(file.header(), names, true);
  file.setFrameBuffer(pixels.buffer);
  file.readPixels(file.header().dataWindow().min.y, file.header().dataWindow().max.y);
}

void write_frame(const std::string& path, const Pixels& pixels) {
  Imf::OutputFile file(path.c_str(), pixels.header);
  file.setFrameBuffer(pixels.buffer);
  file.writePixels(pixels.header.dataWindow().max.y - pixels.header.dataWindow().min.y + 1);
}

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

void run(const Flags& flags) {
  const FramePattern in(flags.in, "FRAME.exr"), out(flags.out, "-o");
  const std::vector<int> frames = flags.frames ? *flags.frames : in.frames_there();
  if (frames.empty()) throw Error("{}: no file of this pattern is there", flags.in);
  Imf::setGlobalThreadCount(flags.threads);
  const Pixels written = what_is_written(flags.written);
  const std::vector<std::string> names = cli::split_list(flags.channels, "--channels");
  double reading = 0, writing = 0;
  const double before = processor_seconds();
  for (const int frame : frames) {
    auto start = std::chrono::steady_clock::now();
    read_frame(in.path_of(frame).string(), names);
    reading += seconds_since(start);
    start = std::chrono::steady_clock::now();
    write_frame(out.path_of(frame).string(), written);
    writing += seconds_since(start);
  }
  const double count = double(frames.size());
  fmt::print("{} frames, {} threads; a frame: {:.1f} ms (read {:.1f}, write {:.1f}), {:.1f} ms of processor time\n",
             frames.size(), flags.threads, 1000 * (reading + writing) / count, 1000 * reading / count,
             1000 * writing / count, 1000 * (processor_seconds() - before) / count);
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) {
  using namespace gloam;
  bench::Flags flags;
  CLI::App app{"bench_sequence_floor: what reading and writing a shot takes by OpenEXR alone"};
  app.add_option("frames", flags.in, "files to read: shot.####.exr")->required();
  app.add_option("-o,--output", flags.out, "files to write: floor.####.exr")->required();
  app.add_option("--written", flags.written, "file whose channels are written for each frame: ao.0001.exr")->required();
  app.add_option("--channels", flags.channels, "channels to read")->capture_default_str();
  cli::add_parsed(app, "--frames", flags.frames, parse_frame_numbers, "frames; default: all that are there");
  cli::add_number(app, "--threads", flags.threads, {0, 1024}, "threads of OpenEXR; default: one for each core");
  try {
    app.parse(argc, argv);
    bench::run(flags);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_sequence_floor: {}\n", error.what());
    return 1;
  }
  return 0;
}
