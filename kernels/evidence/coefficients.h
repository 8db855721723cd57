// Coefficients of evidence.cl, by slices a pixel and samples on each side of a slice. Made by script/fit.
// Fitted to 7 frames of each of banquet, colonnade, corridor, courtyard, gallery, lounge, pillar, slab, statue, temple, 640x360, radius 22 to 95 pixels at the median depth, 64 rays a pixel, seed 1.
#ifndef GLOAM_EVIDENCE_COEFFICIENTS_H
#define GLOAM_EVIDENCE_COEFFICIENTS_H

// In the order of evidence.cl: a, b, u, aa, ab, bb, au, bu, uu, af, bf, uf.
// clang-format off
#define EVIDENCE_COEFFICIENTS(SET) \
  SET(1, 4, 1.1112f, 0.6362f, 0.0887f, -0.5822f, 0.7255f, -1.1855f, 0.5163f, -0.8294f, -0.0387f, -0.1038f, 0.1112f, 0.2968f) \
  SET(1, 9, 1.0941f, 0.1905f, 0.0266f, -0.7807f, 1.5497f, -1.1995f, 0.7156f, -1.0024f, 0.0188f, -0.1382f, 0.1877f, 0.2671f) \
  SET(1, 18, 0.9411f, 0.2039f, 0.0187f, -0.7549f, 1.6628f, -1.1681f, 0.8205f, -1.0877f, 0.0056f, -0.1139f, 0.1592f, 0.2545f) \
  SET(4, 18, 1.0026f, 0.1064f, -0.0179f, -0.8596f, 2.0160f, -1.3060f, 0.9365f, -1.1914f, 0.0361f, -0.1429f, 0.1630f, 0.2752f)
// clang-format on

#endif
