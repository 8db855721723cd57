// The words by which commands and the Python module name how a frame is read.
#pragma once

#include "base/words.h"
#include "gloam/exr.h"

namespace gloam {

inline const Choices<DepthConvention> depth_words = {
    {"auto", DepthConvention::automatic},    {"z", DepthConvention::z},
    {"ray", DepthConvention::ray},           {"ndc", DepthConvention::ndc},
    {"reversed", DepthConvention::reversed}, {"inverse", DepthConvention::inverse}};
inline const Choices<DepthBytes> depth_bytes_words = {
    {"auto", DepthBytes::automatic}, {"low-first", DepthBytes::low_first}, {"high-first", DepthBytes::high_first}};
inline const Choices<NormalSpace> normal_space_words = {
    {"auto", NormalSpace::automatic}, {"view", NormalSpace::view}, {"world", NormalSpace::world}};
inline const Choices<NormalRange> normal_range_words = {{"auto", NormalRange::automatic},
                                                        {"signed", NormalRange::signed_values},
                                                        {"unsigned", NormalRange::unsigned_values},
                                                        {"srgb", NormalRange::srgb_values}};

}  // namespace gloam
