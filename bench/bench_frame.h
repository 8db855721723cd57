// What the benchmarks run on, and what every benchmark program does first.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gloam/frame.h"

namespace gloam::bench {

/// The bundled loggia at any size, with depth, normal and albedo.
Frame loggia_frame(int width, int height);

/// Adds a plane that the frame lacks: a copy of depth or normal where it means that, else noise from a hash.
void add_plane(Frame& frame, const std::string& name);

/// The radius in scene units that reaches `pixels` at the median depth of the surfaces.
float radius_reaching(const Frame& frame, double pixels);

/// "1920x1080"
std::string size_name(const Frame& frame);

/// Takes --size=WIDTHxHEIGHT (repeatable) out of the command line. Throws UsageError.
std::vector<std::pair<int, int>> take_sizes(int& argc, char** argv);

/// Takes --NAME out of the command line; whether it was there.
bool take_flag(int& argc, char** argv, const std::string& name);

/// OpenMP threads that spin after a loop would take the cores from PoCL's. How they wait is read once, before main: where
/// it is not set, sets it and starts the program again.
void make_openmp_wait_passively(char** argv);

double median(std::vector<double> values);

}  // namespace gloam::bench
