#include "fuzz/words.h"

#include <cfloat>
#include <climits>
#include <cmath>
#include <limits>

namespace gloam::fuzz {

const std::vector<std::string>& channel_words() {
  static const std::vector<std::string> words = {
      "Z",      "X",     "Y",         "R",         "G",    "B",    "A",    "V",        "U",     "W",
      "z",      "r",     "x",         "T",         "a",    "AO",   "ao",   "AO_raw",   "depth", "Depth",
      "ZBack",  "BackZ", "instance",  "roughness", "mask", "both", "cone", "distance", "hitPz", "count",
      "frames", "ID",    "occlusion", "alpha",     "dist", "N.X",  "P.Y",  "RY",       "BY"};
  return words;
}

const std::vector<std::string>& layer_words() {
  static const std::vector<std::string> words = {"",
                                                 "ViewLayer.Depth",
                                                 "ViewLayer.Normal",
                                                 "ViewLayer.Combined",
                                                 "Depth",
                                                 "Normal",
                                                 "Position",
                                                 "N",
                                                 "P",
                                                 "beauty",
                                                 "albedo",
                                                 "GlossCol",
                                                 "peel.00",
                                                 "peel.01",
                                                 "peel.99",
                                                 "stochastic.00",
                                                 "stochastic.01",
                                                 "outline",
                                                 "peel",
                                                 "history",
                                                 "reflection",
                                                 "motion",
                                                 "Vector",
                                                 "bent",
                                                 "hit",
                                                 "ray",
                                                 "nn",
                                                 "reflectance",
                                                 "FinalImage",
                                                 "WorldDepth",
                                                 "instance",
                                                 "mask",
                                                 "Cameranormal",
                                                 "velocity",
                                                 "geo.normal",
                                                 "peel.7",
                                                 "peel.007",
                                                 "N.X",
                                                 "..",
                                                 "crypto00"};
  return words;
}

const std::vector<std::string>& view_words() {
  static const std::vector<std::string> words = {"left", "right", "",         "mono",     "L",      "R",
                                                 "main", "Z",     "module00", "module01", "left.a", "middle"};
  return words;
}

double odd_number(Random& random) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double value = random.pick<double>(
      {0.0,     1.0,     0.5,     2.0,     1e-9,    1e-30,         1e-38,        1e-45,   1e-300, 1e6,
       1e7,     1e10,    1e12,    1e30,    3.5e38,  1e300,         4e-324,       90.0,    179.0,  1e-12,
       65504.0, FLT_MIN, FLT_MAX, DBL_MAX, DBL_MIN, INT_MAX * 1.0, 4294967296.0, 16384.0, inf,    double(NAN)});
  return random.one_in(3) ? -value : value;
}

int odd_whole_number(Random& random) {
  const int value =
      random.pick({0, 1, 2, 3, 7, 16, 17, 63, 255, 256, 65535, 65536, 1 << 20, 1 << 28, 1 << 30, INT_MAX});
  return random.one_in(3) ? -value : value;
}

std::string odd_word(Random& random) {
  switch (random.below(8)) {
    case 0:
      return "";
    case 1: {
      const char letter = char('a' + random.below(26));
      return std::string(1 + random.below(300), letter);
    }
    case 2:
      return random.pick(
          {"\n", "\x1b[31m", "a\nb", "\xff\xfe", "\xc2\x85", "\xe2\x80\xae", "{}", "%s%n", "..", ".", "a b"});
    case 3:
      return std::to_string(odd_whole_number(random));
    case 4:
      return random.pick(view_words());
    case 5:
      return random.pick(layer_words());
    default:
      return random.pick(channel_words());
  }
}

}  // namespace gloam::fuzz
