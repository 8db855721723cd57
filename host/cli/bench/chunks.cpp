#include "cli/bench/chunks.h"

#include "cli/flags/notes.h"
#include "cli/process/chunk_commands.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "sequence/chunks.h"

namespace gloam::cli {
namespace {

using Names = std::vector<std::string>;

/// What one command measures. Empty lists: all.
struct Chunk {
  Names scenes, techniques;
  bool has_first_scene = false;
};

std::vector<Chunk> chunks_of_scenes(const BenchChunks& divided) {
  std::vector<Chunk> chunks;
  for (const Names& scenes : chunks_of(divided.scenes, divided.chunks))
    chunks.push_back({scenes, divided.techniques, chunks.empty()});
  return chunks;
}

/// Each scene in some chunks of its own.
std::vector<Chunk> chunks_of_techniques(const BenchChunks& divided) {
  const std::vector<Names> scenes =
      divided.scenes.empty() ? std::vector<Names>{{}} : chunks_of(divided.scenes, int(divided.scenes.size()));
  std::vector<Chunk> chunks;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const size_t wanted = size_t(divided.chunks), begin = wanted * i / scenes.size(),
                 end = wanted * (i + 1) / scenes.size();
    for (const Names& techniques : chunks_of(divided.techniques, int(end - begin)))
      chunks.push_back({scenes[i], techniques, i == 0});
  }
  return chunks;
}

std::string list_of(const Names& names) { return fmt::format("{}", fmt::join(names, ",")); }

}  // namespace

const std::set<std::string>& not_of_bench_chunks() {
  static const std::set<std::string> flags = {"--output", "--scenes", "--techniques", "--no-growth", "--json"};
  return flags;
}

void print_bench_chunks(const BenchChunks& divided) {
  if (!FramePattern::is_pattern(divided.folder))
    throw UsageError(
        "-o {}: each of the {} chunks writes a folder of its own; write a place for its number, such as -o "
        "out/bench.##",
        divided.folder, divided.chunks);
  const FramePattern folders(divided.folder, "-o");
  const bool more_than_scenes = size_t(divided.chunks) > divided.scenes.size();
  const std::vector<Chunk> chunks =
      more_than_scenes && divided.divides_techniques ? chunks_of_techniques(divided) : chunks_of_scenes(divided);
  int number = 0;
  for (const Chunk& chunk : chunks) {
    std::vector<std::string> more = {"--output", folders.path_of(++number).string()};
    if (!chunk.scenes.empty()) more.insert(more.end(), {"--scenes", list_of(chunk.scenes)});
    if (!chunk.techniques.empty()) more.insert(more.end(), {"--techniques", list_of(chunk.techniques)});
    if (!divided.has_growth || !chunk.has_first_scene) more.push_back("--no-growth");
    print_chunk(divided.repeated, more);
  }
  end_of_chunks();
  if (number < divided.chunks)
    note({fmt::format("--chunks {}: divided into {}; {}", divided.chunks, number,
                      !divided.divides_techniques
                          ? "scenes are divided, and techniques only where --techniques names them, without --presets, "
                            "--sweep and techniques of two views"
                          : "there are no more scenes and techniques")});
}

}  // namespace gloam::cli
