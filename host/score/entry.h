// A submission's entry: what its authors state about the method and about its images (docs/score.md).
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gloam::score {

using Json = nlohmann::ordered_json;

/// How the images show their plane. With `ao` from 0 (closed) to 1 (open), a stored value is range.low + (range.high - range.low) * v,
/// where v = 1 - strength * (1 - ao^exponent), or 1 minus that where it is inverted.
struct Convention {
  bool inverted = false;
  double exponent = 1, strength = 1;
  std::optional<std::pair<double, double>> range;  ///< stored values of 0 and 1; none: what the file's type says
  int scale = 1;                                   ///< an image pixel stands for scale x scale pixels of the frame
  std::optional<double> radius;                    ///< scene units; of the method, where it is not the truth's
  std::string falloff;                             ///< empty: not stated
};

struct Entry {
  std::string name, version, link, device, licence;
  Json authors = nullptr;                  ///< a text or a list of texts
  Json settings = Json::object();          ///< any values by name
  std::optional<double> time_ms;           ///< of every item, as its authors state it
  std::map<std::string, double> times_ms;  ///< by item
  std::string effect = "ao";               ///< of images whose names state none
  Convention convention;

  /// The time that is stated for an item; none if there is none.
  std::optional<double> stated_time(const std::string& item) const;
};

/// Planes that can be scored: those that gloam measures, and reflections.
std::vector<std::string> scored_effects();

/// Whether a plane's values lie from 0 to 1, so that it may be inverted.
bool is_share(const std::string& effect);

/// Throws Error in one line that names the file, the key, its value, and what is allowed: for an unknown key, a value of another type or
/// out of range, a name that a technique of gloam has, and a convention that the effect has not.
Entry read_entry(const std::filesystem::path& file);
/// The same from the file's content.
Entry entry_of(const std::string& text, const std::string& file);

/// As in the entry, with what it leaves out.
Json document_of(const Convention& convention);

}  // namespace gloam::score
