#include "gloam/technique.h"

#include "shared/both/params.h"

#define DIELECTRIC_PARAMS(P)             \
  P(float, reflectance, 0.04f, 0, 1, "", \
    "reflectance of every surface at normal incidence; 0.04: glass, varnish and most paints")

PARAMS(DielectricParams, DIELECTRIC_PARAMS)

namespace gloam::techniques {
namespace {

std::vector<Pass> dielectric_passes(const DielectricParams&) {
  return {{.name = "reflectance", .kernel = "dielectric", .reads = {"depth"}, .writes = {"reflectance"}}};
}

}  // namespace

std::vector<Technique> dielectric() {
  Technique t;
  t.name = "dielectric";
  t.summary = "reflectance for frames without one: all surfaces alike, none a metal";
  t.paper = "Fresnel at normal incidence, index of refraction 1.5";
  t.source = "dielectric/dielectric.cl";
  t.reads = {"depth"};
  t.writes = {"reflectance"};
  t.parameters = DielectricParams::table();
  t.passes = passes_of(dielectric_passes);
  return {t};
}

}  // namespace gloam::techniques
