#include "shared/both/params.h"

#define TEMPORAL_PARAMS(P)                                                                                             \
  P(float, radius, 0.5f, 0, INFINITY, "scene units", "radius of the AO: how far something that moves changes it")      \
  P(int, most_frames, 64, 1, 65536, "frames", "the mean is over this many frames at most")                             \
  P(float, plane_tolerance, 0.002f, 0, INFINITY, "radii",                                                              \
    "distance from a tangent plane, besides pixel_tolerance, from which on a surface is another")                      \
  P(float, pixel_tolerance, 0.2f, 0, INFINITY, "pixels", "the same, as a share of a pixel's width at its depth")       \
  P(float, depth_change, 0.05f, 0, 1, "shares of the depth",                                                           \
    "change of depth from which on a surface that moves by itself is another")                                         \
  P(float, edge_loss, 4, 0, 1000, "frames",                                                                            \
    "the less of the four pixels around a position shows the surface, the fewer frames count: 1 / (1 / frames + "      \
    "edge_loss * share)")                                                                                              \
  P(float, turn, 0.002f, 1e-9f, INFINITY, "radians",                                                                   \
    "turn of the line of sight to a point at rest since the frame before from which on turn_loss and new_loss count "  \
    "whole; less counts in proportion")                                                                                \
  P(float, turn_loss, 0.43f, 0, 1000, "shares a frame",                                                                \
    "the history counts for 1 / (1 / frames + turn_loss + new_loss / (frames - 1)) frames where the view turns")       \
  P(float, new_loss, 2, 0, 1000, "frames", "the same: what has just come into view counts least")                   \
  P(float, motion_loss, 2.33f, 0, 1000, "shares a frame",                                                              \
    "of a surface that moves by itself the history counts for 1 / motion_loss frames at most")                         \
  P(float, change_tolerance, 4, 0, INFINITY, "variances",                                                              \
    "near what moves, means over neighbours that differ from those of the frame before by more forget earlier frames") \
  P(float, light_tolerance, 9, 0, INFINITY, "variances",                                                               \
    "the same for indirect light where nothing moves: light changes there too")

PARAMS(TemporalParams, TEMPORAL_PARAMS)
