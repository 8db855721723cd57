// Coefficients of evidence.cl, by slices a pixel and samples on each side of a slice. Made by script/fit.
// Fitted to 7 frames of each of banquet, colonnade, corridor, courtyard, gallery, lounge, pillar, slab, statue, temple, 640x360, radius 22 to 95 pixels at the median depth, 64 rays a pixel, seed 1.
#ifndef GLOAM_EVIDENCE_COEFFICIENTS_H
#define GLOAM_EVIDENCE_COEFFICIENTS_H

// In the order of evidence.cl: a, b, u, aa, ab, bb, au, bu, uu, af, bf, uf.
// clang-format off
#define EVIDENCE_COEFFICIENTS(SET) \
  SET(1, 4, 1.1114f, 0.6359f, 0.0887f, -0.5825f, 0.7259f, -1.1857f, 0.5165f, -0.8297f, -0.0387f, -0.1040f, 0.1114f, 0.2968f) \
  SET(1, 9, 1.0941f, 0.1905f, 0.0266f, -0.7808f, 1.5498f, -1.1996f, 0.7156f, -1.0023f, 0.0189f, -0.1383f, 0.1878f, 0.2671f) \
  SET(1, 18, 0.9414f, 0.2035f, 0.0187f, -0.7553f, 1.6634f, -1.1684f, 0.8207f, -1.0879f, 0.0056f, -0.1141f, 0.1595f, 0.2545f) \
  SET(4, 18, 1.0028f, 0.1061f, -0.0179f, -0.8599f, 2.0165f, -1.3062f, 0.9366f, -1.1916f, 0.0361f, -0.1430f, 0.1631f, 0.2751f)
// clang-format on

#endif
