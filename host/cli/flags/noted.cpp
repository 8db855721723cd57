#include "cli/flags/noted.h"

#include "cli/flags/notes.h"

namespace gloam::cli {

nlohmann::ordered_json noted(nlohmann::ordered_json document) {
  if (document.is_object() && !document.contains("notes")) document["notes"] = notes_so_far();
  return document;
}

}  // namespace gloam::cli
