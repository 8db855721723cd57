#include <cmath>
#include <iterator>

#include "evidence/coefficients.h"
#include "evidence/params.h"
#include "technique/ambient_occlusion.h"

namespace gloam::techniques {
namespace {

/// What a row of the coefficients was fitted with.
struct Set {
  int directions, steps;
};

#define DIRECTIONS_AND_STEPS(directions, steps, ...) {directions, steps},
constexpr Set sets[] = {EVIDENCE_COEFFICIENTS(DIRECTIONS_AND_STEPS)};
#undef DIRECTIONS_AND_STEPS

/// How unlike two samplings are: what is missed between samples goes with 1 / steps, noise with 1 / directions.
double distance(const Set& a, const Set& b) {
  return std::hypot(1.0 / a.directions - 1.0 / b.directions, 1.0 / a.steps - 1.0 / b.steps);
}

/// The row that was fitted with the most similar sampling.
int nearest_set(const Set& wanted) {
  int nearest = 0;
  for (int i = 1; i < int(std::size(sets)); ++i)
    if (distance(sets[i], wanted) < distance(sets[nearest], wanted)) nearest = i;
  return nearest;
}

std::vector<Pass> passes(const EvidenceParams& p) {
  return {ambient_occlusion_estimate(p, "evidence_estimate",
                                     {{"DIRECTIONS", p.directions},
                                      {"STEPS", p.steps},
                                      {"COEFFICIENTS", nearest_set({p.directions, p.steps})},
                                      {"TERM", p.term}})};
}

}  // namespace

std::vector<Technique> evidence() {
  Technique t = over_slices(ambient_occlusion(
      "evidence", "ambient occlusion expected from what slices show: thickness is judged by extent",
      "coefficients fitted to ray-traced truth; slices after Jimenez, Wu, Pesce, Jarabo 2016", "evidence/evidence.cl"));
  t.parameters = EvidenceParams::table();
  t.passes = passes_of(passes);
  return {t};
}

}  // namespace gloam::techniques
