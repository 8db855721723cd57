// The words by which commands and the Python module choose variants.
#pragma once

#include "base/words.h"
#include "gloam/technique.h"

namespace gloam {

inline const Choices<Layers> layers_words = {
    {"one", Layers::one}, {"stochastic", Layers::stochastic}, {"peeled", Layers::peeled}};
/// Whether both eyes are meant.
inline const Choices<bool> eyes_words = {{"one", false}, {"both", true}};

}  // namespace gloam
