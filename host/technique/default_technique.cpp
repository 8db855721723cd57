#include "technique/default_technique.h"

#include "base/lists.h"
#include "gloam/technique.h"

namespace gloam {

std::string technique_for(const std::string& name) {
  for (const Technique& technique : registry()) {
    if (contains(technique.default_for, name) || contains(technique.default_for, name + "_raw")) return technique.name;
  }
  return name;
}

}  // namespace gloam
