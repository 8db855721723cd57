// The frame of the benchmarks, and the start of every benchmark program.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gloam/frame.h"

namespace CLI {
class App;
}

namespace gloam::bench {

/// The bundled loggia at any size, with depth, normal and albedo.
Frame loggia_frame(int width, int height);

/// The same seen by two eyes 65 mm apart.
Frame loggia_stereo_frame(int width, int height);

/// Depth layers of a stack in the benchmarks.
constexpr int most_layers = 8;

/// Adds a plane that the frame's views lack: a copy of depth or normal for planes of that meaning, else noise from a hash. A stack gets
/// `most_layers` layers, each a tenth of the depth behind the one before.
void add_plane(Frame& frame, const std::string& name);

/// Median reach of a benchmark's radius on the screen, pixels, for 1920 columns.
constexpr double reach_in_full_hd = 60;

/// The radius in scene units that reaches `pixels` at the median depth of the surfaces.
float radius_reaching(const Frame& frame, double pixels);

/// "1920x1080"
std::string size_name(const Frame& frame);

/// Removes `flags` from the command line; names and Google Benchmark's flags stay. Throws UsageError.
void take_flags(CLI::App& flags, int& argc, char** argv);

/// The same for flags that are given or not, and for --size=WIDTHxHEIGHT, repeatable: `sizes` holds those measured without it.
void take_flags(int& argc, char** argv, std::vector<std::pair<int, int>>& sizes,
                const std::map<std::string, bool*>& switches = {});

/// Runs a program's main function. An error becomes one line that begins with the program's name. Returns the exit status.
int run_program(const char* name, int argc, char** argv, int (*main)(int argc, char** argv));

}  // namespace gloam::bench
