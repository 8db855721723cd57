// What the benchmarks run on, and what every benchmark program does first.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gloam/frame.h"

namespace gloam::bench {

/// The bundled loggia at any size, with depth, normal and albedo.
Frame loggia_frame(int width, int height);

/// The depth layers that a stack gets.
constexpr int most_layers = 8;

/// Adds a plane that the frame lacks: a copy of depth or normal where it means that, else noise from a hash. A stack gets
/// `most_layers` layers, each a tenth of the depth behind the one before.
void add_plane(Frame& frame, const std::string& name);

/// The median reach that a benchmark's radius has on the screen, at 1920 columns.
constexpr double reach_in_full_hd = 60;

/// The radius in scene units that reaches `pixels` at the median depth of the surfaces.
float radius_reaching(const Frame& frame, double pixels);

/// "1920x1080"
std::string size_name(const Frame& frame);

/// Takes --size=WIDTHxHEIGHT (repeatable) out of the command line; `usual` where there is none. Throws UsageError.
std::vector<std::pair<int, int>> take_sizes(int& argc, char** argv, std::pair<int, int> usual = {1920, 1080});

/// Takes --NAME out of the command line; whether it was there.
bool take_flag(int& argc, char** argv, const std::string& name);

/// Runs a program's main function; an error is one line that begins with the program's name. Returns the exit status.
int run_program(const char* name, int argc, char** argv, int (*main)(int argc, char** argv));

}  // namespace gloam::bench
