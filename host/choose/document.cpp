#include "choose/document.h"

#include "gloam/option.h"

namespace gloam::bench {
namespace {

using Json = nlohmann::ordered_json;

Json entry_of(const Choice& choice) {
  Json entry = {{"technique", choice.variation.technique->name},
                {"preset", choice.variation.name()},
                {"resolution", resolution_of(choice.variation)},
                {"ms", choice.ms},
                {"rmse", choice.rmse},
                {"ssim", choice.ssim ? Json(*choice.ssim) : Json(nullptr)}};
  if (choice.flip) entry["flip"] = *choice.flip;
  return entry;
}

Json entries_of(const std::vector<Skipped>& all) {
  Json entries = Json::array();
  for (const Skipped& s : all) entries.push_back({{"technique", s.technique}, {"preset", s.preset}, {"why", s.why}});
  return entries;
}

}  // namespace

std::string resolution_of(const Variation& v) { return v.resolution == 1 ? "full" : v.variant; }

nlohmann::ordered_json document_of(const Picked& picked, PickBy by, const DeviceInfo& device) {
  Json document = entry_of(picked.finalists[picked.best]);
  document["device"] = device.name;
  document["error_to"] = picked.truth;
  document["by"] = word_for(by, pick_figures);
  document["finalists"] = Json::array();
  for (const Choice& choice : picked.finalists) document["finalists"].push_back(entry_of(choice));
  document["skipped"] = entries_of(picked.skipped);
  document["left_out"] = entries_of(picked.left_out);
  return document;
}

std::string stand_in_warning(const Picked& picked) {
  return fmt::format(
      "NO TRUTH: errors are to {}: what errs as that does looks nearer to the truth than it is; {} takes a ray-traced "
      "image (gloam reference, or a renderer's own)",
      picked.truth, option("truth", "REF.exr"));
}

}  // namespace gloam::bench
