// Several bench.json files as one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/measurements.h"

namespace gloam::report {

/// One of the files that a page is made from.
struct Source {
  std::string name;            ///< as printed on the page: "out/bench/bench.json"
  std::filesystem::path file;  ///< its pictures are relative to its folder
  Measurements measurements;
};

std::filesystem::path folder_of(const Source& source);

/// All scenes, rows, converged images, changes of scale and planes of the sources. How each file was measured stays in the file
/// (`Row::source`, `Scene::source`). Scenes are ordered by class; a scene measured at several sizes or on several devices gets
/// these in its name. Throws Error if two files hold the same setting on the same scene, or one scene with two radii: a program
/// cannot decide which one to show.
Measurements joined(const std::vector<Source>& sources);

/// The measurements with each scene's class replaced by its group, over which means are taken. A group is a class measured at one
/// size on one device; own frames (class "own") have little in common, so each is a group.
Measurements by_group(Measurements joined, const std::vector<Source>& sources);

}  // namespace gloam::report
