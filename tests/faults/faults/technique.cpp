#include "gloam/technique.h"

namespace gloam::techniques {
namespace {

const char* const names[] = {"faultless",        "absolute-epsilon", "background-unknown", "by-lanes",
                             "beside-the-image", "shadows-itself",   "one-sided",          "crashes",
                             "does-not-end",     "one-camera",       "squares-depth",      "brightens"};

std::vector<Pass> passes(int fault) {
  return {{.name = "estimate",
           .kernel = "faults",
           .reads = {"depth", "normal"},
           .writes = {"ao"},
           .defines = {{"FAULT", fault}}}};
}

}  // namespace

std::vector<Technique> faults() {
  std::vector<Technique> all;
  for (int fault = 0; const char* name : names) {
    all.push_back({.name = name,
                   .summary = "for tests",
                   .paper = "",
                   .source = "faults/faults.cl",
                   .reads = {"depth", "normal"},
                   .writes = {"ao"},
                   .passes = [fault](const ParameterValues&) { return passes(fault); }});
    ++fault;
  }
  return all;
}

}  // namespace gloam::techniques
