// Several bench.json as one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/measurements.h"

namespace gloam::report {

/// One of the files that a page is made of.
struct Source {
  std::string name;            ///< as the page says it: "out/bench/bench.json"
  std::filesystem::path file;  ///< its pictures are named from its folder
  Measurements measurements;
};

std::filesystem::path folder_of(const Source& source);

/// All scenes, rows, converged images, changes of scale and planes of the sources; what says how one file was measured
/// stays there (`Row::source`, `Scene::source`). Scenes go by class; one that was measured at several sizes or on
/// several devices has these in its name. Throws Error where two files hold the same setting on the same scene, or one
/// scene with two radii: which of the two to show is not for a program to say.
Measurements joined(const std::vector<Source>& sources);

/// What to take means over: the same with the name of its group in place of each scene's class. A group is a class,
/// measured at one size on one device; own frames (class "own") have little in common, so each is a group.
Measurements by_group(Measurements joined, const std::vector<Source>& sources);

}  // namespace gloam::report
