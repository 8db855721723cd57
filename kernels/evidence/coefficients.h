// Coefficients of evidence.cl, by slices a pixel and samples on each side of a slice. Made by script/fit.
// Fitted to 7 frames of each of banquet, colonnade, corridor, courtyard, gallery, lounge, pillar, slab, statue, temple, 640x360, radius 22 to 95 pixels at the median depth, 64 rays a pixel, seed 1.
#ifndef GLOAM_EVIDENCE_COEFFICIENTS_H
#define GLOAM_EVIDENCE_COEFFICIENTS_H

// In the order of evidence.cl: a, b, u, aa, ab, bb, au, bu, uu, af, bf, uf.
// clang-format off
#define EVIDENCE_COEFFICIENTS(SET) \
  SET(1, 4, 1.1221f, 0.6226f, 0.0890f, -0.5966f, 0.7525f, -1.1957f, 0.5176f, -0.8272f, -0.0384f, -0.1055f, 0.1137f, 0.2960f) \
  SET(1, 9, 1.0984f, 0.1862f, 0.0265f, -0.7863f, 1.5577f, -1.2016f, 0.7132f, -0.9976f, 0.0197f, -0.1378f, 0.1870f, 0.2666f) \
  SET(1, 18, 0.9467f, 0.1970f, 0.0185f, -0.7618f, 1.6666f, -1.1626f, 0.8171f, -1.0797f, 0.0069f, -0.1128f, 0.1580f, 0.2537f) \
  SET(4, 18, 1.0054f, 0.1040f, -0.0179f, -0.8652f, 2.0304f, -1.3156f, 0.9356f, -1.1885f, 0.0368f, -0.1419f, 0.1614f, 0.2746f)
// clang-format on

#endif
