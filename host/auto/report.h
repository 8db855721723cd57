// What gloam auto tells of effects: JSON, and words.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gloam/auto.h"

namespace gloam {

/// As `gloam auto --json` writes it (`json_of`).
nlohmann::ordered_json document_of(const AutoResult& result, const Goal& goal, const DeviceInfo& device);

/// "evidence + multi-bounce, medium, half": what runs for an effect, with the setting that a budget chose.
std::string runs_in_words(const Outcome& outcome);
/// "everywhere", "34 %" or "-".
std::string where_in_words(const EffectChoice& choice);
/// What the mask, or leaving the effect out, saves: "1.2 of 8.1 ms"; empty: not known.
std::string saved_in_words(const Outcome& outcome);
/// The expected error that the choice for an effect brings to the picture: ".0021"; empty: not known.
std::string lost_in_words(const Outcome& outcome);

/// The time of all effects, and what a budget came to: a sentence.
std::string totals_in_words(const AutoResult& result, const Goal& goal);

/// What the frame calls for, or what a budget buys and why: a sentence.
std::string sentence_on(const AutoResult& result);

/// [{"plane": "ao", "used": true, "how": "darkens ambient light"}, ...]
nlohmann::ordered_json composition_document(const Composition& composition);
/// "composite: ao darkens ambient light; contact is left out: the colour holds shadows already"
std::string composition_in_words(const Composition& composition);

}  // namespace gloam
