#include "gloam/variants.h"

#include "gloam/error.h"
#include "gloam/option.h"
#include "technique/default_technique.h"
#include "technique/variant_words.h"

namespace gloam {
namespace {

std::string layers_option(Layers layers) { return option("layers", word_for(layers, layers_words)); }
std::string eyes_option(bool both) { return option("eyes", word_for(both, eyes_words)); }

/// "gtao, dp-gtao (--layers peeled) and stereo-gtao (--eyes both)"
std::string all_in_words(const std::string& method) {
  std::vector<std::string> names = {method};
  for (const Technique* t : variants_of(find_technique(method)))
    names.push_back(fmt::format("{} ({})", t->name, options_of(t->variant)));
  return enumerate(names);
}

[[noreturn]] void refuse_contradiction(const Technique& technique, const std::string& choice) {
  throw UsageError("{}: is {} with {}, which {} contradicts; leave that out, or name {}", technique.name,
                   technique.variant.of, options_of(technique.variant), choice, technique.variant.of);
}

}  // namespace

Variant variant_of(const Technique& technique) {
  return technique.variant.of.empty() ? Variant{technique.name} : technique.variant;
}

const Technique* find_variant(const Variant& variant) {
  for (const Technique& t : registry()) {
    const Variant is = variant_of(t);
    if (is.of == variant.of && is.layers == variant.layers && is.both_eyes == variant.both_eyes) return &t;
  }
  return nullptr;
}

std::vector<const Technique*> variants_of(const Technique& method) {
  std::vector<const Technique*> all;
  for (const Technique& t : registry())
    if (t.variant.of == method.name) all.push_back(&t);
  return all;
}

std::string options_of(const Variant& variant) {
  std::vector<std::string> options;
  if (variant.layers != Layers::one) options.push_back(layers_option(variant.layers));
  if (variant.both_eyes) options.push_back(eyes_option(true));
  return fmt::format("{}", fmt::join(options, " "));
}

bool fits(const Technique& technique, const VariantChoice& choice) {
  const Variant& is = technique.variant;
  return is.layers == choice.layers.value_or(is.layers) && is.both_eyes == choice.both_eyes.value_or(is.both_eyes);
}

std::string variant_name(const std::string& technique, const VariantChoice& choice) {
  const Technique& named = find_technique(technique_for(technique));
  Variant wanted = variant_of(named);
  if (choice.layers) {
    if (wanted.layers != Layers::one && wanted.layers != *choice.layers)
      refuse_contradiction(named, layers_option(*choice.layers));
    wanted.layers = *choice.layers;
  }
  if (choice.both_eyes) {
    if (wanted.both_eyes && !*choice.both_eyes) refuse_contradiction(named, eyes_option(false));
    wanted.both_eyes = *choice.both_eyes;
  }
  if (const Technique* found = find_variant(wanted)) return found->name;
  if (variants_of(find_technique(wanted.of)).empty())
    throw UsageError("{}: has no variant {}, nor any other; leave that out", wanted.of, options_of(wanted));
  throw UsageError("{}: has no variant {}; there are {}", wanted.of, options_of(wanted), all_in_words(wanted.of));
}

}  // namespace gloam
