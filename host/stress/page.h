// The findings of hard cases as a page of documentation.
#pragma once

#include <string>
#include <vector>

#include "stress/document.h"

namespace gloam::stress {

/// docs/stability.md, from documents of `gloam stress --json`: the first in full; of further ones (other devices), what differs
/// between devices. Throws Error for a document of another kind.
std::string stability_page(const std::vector<Json>& documents);

}  // namespace gloam::stress
