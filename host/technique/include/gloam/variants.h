// Variants of methods: over other depths, or for two eyes. Each is a row of the registry with a name of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/technique.h"

namespace gloam {

/// What is asked for of a method's variants; what is not stays as the name says.
struct VariantChoice {
  std::optional<Layers> layers = {};
  std::optional<bool> both_eyes = {};
};

/// Whether a technique is what is asked for; any is where nothing is.
bool fits(const Technique& technique, const VariantChoice& choice);

/// The name of a method's variant: "dp-gtao" for "gtao" over peeled layers. A name that is a variant itself keeps what makes it one, so
/// that "sd-hbao+" for both eyes is "stereo-sd-hbao+"; "ao" stands for its default technique. Without a choice the name stays.
/// Throws UsageError, which says what there is, for unknown names, for variants that do not exist and for a choice that contradicts the
/// name.
std::string variant_name(const std::string& technique, const VariantChoice& choice);

/// The row of the registry that is this variant; null if there is none.
const Technique* find_variant(const Variant& variant);

/// What a technique is as a variant: of a method that is none itself, `of` is its own name.
Variant variant_of(const Technique& technique);

/// The rows that are variants of a technique.
std::vector<const Technique*> variants_of(const Technique& method);

/// "--layers stochastic --eyes both", as the caller writes options (option.h); empty for one layer and one eye.
std::string options_of(const Variant& variant);

}  // namespace gloam
