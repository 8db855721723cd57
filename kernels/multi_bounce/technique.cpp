#include "gloam/technique.h"

#include "shared/both/params.h"

#define MULTI_BOUNCE_PARAMS(P)        \
  P(choice, fit, own, (own, jimenez), \
    "how reflected light grows with albedo: fitted to traced light, or the cubic of Jimenez et al. 2016")

PARAMS(MultiBounceParams, MULTI_BOUNCE_PARAMS)

namespace gloam::techniques {
namespace {

std::vector<Pass> multi_bounce_passes(const MultiBounceParams& p) {
  return {{.name = "bounces",
           .kernel = "multi_bounce",
           .reads = {"ao", "albedo"},
           .writes = {"bounces"},
           .defines = {{"JIMENEZ", p.fit == MultiBounceParams::fit_values::jimenez}}}};
}

}  // namespace

std::vector<Technique> multi_bounce() {
  Technique t;
  t.name = "multi-bounce";
  t.summary = "ambient light with light reflected between surfaces, from AO and albedo";
  t.paper = "Jimenez, Wu, Pesce, Jarabo 2016";
  t.source = "multi_bounce/multi_bounce.cl";
  t.reads = {"ao", "albedo"};
  t.writes = {"bounces"};
  t.parameters = MultiBounceParams::table();
  t.passes = passes_of(multi_bounce_passes);
  t.effect = {.name = "ambient light between surfaces", .completes = "evidence", .changes = "bounces"};
  return {t};
}

}  // namespace gloam::techniques
