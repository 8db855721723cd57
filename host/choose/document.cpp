#include "choose/document.h"

#include "base/lists.h"
#include "gloam/error.h"
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

/// "a, b, c and 4 more"
std::string in_short(const std::vector<std::string>& items) {
  constexpr size_t most = 3;
  if (items.size() <= most) return enumerate(items);
  return fmt::format("{} and {} more", fmt::join(items.begin(), items.begin() + most, ", "), items.size() - most);
}

}  // namespace

std::string resolution_of(const Variation& v) { return v.resolution == 1 ? "full" : v.variant; }

nlohmann::ordered_json document_of(const Picked& picked, PickBy by, const DeviceInfo& device) {
  Json document = entry_of(picked.finalists[picked.best]);
  document["why"] = picked.why;
  document["device"] = device.name;
  document["error_to"] = picked.truth;
  document["by"] = word_for(by, pick_figures);
  document["finalists"] = Json::array();
  for (const Choice& choice : picked.finalists) document["finalists"].push_back(entry_of(choice));
  document["skipped"] = entries_of(picked.skipped);
  document["left_out"] = entries_of(picked.left_out);
  return document;
}

std::string not_tried_in_words(const std::vector<Skipped>& left_out, const std::vector<Skipped>& skipped) {
  size_t ruled_out = 0, out_of_time = 0;
  std::vector<std::string> reasons, techniques, parts;
  for (const Skipped& s : left_out) {
    const bool is_out_of_time = s.why == time_was_over;
    ++(is_out_of_time ? out_of_time : ruled_out);
    if (!is_out_of_time) add_new(reasons, s.why);
  }
  for (const Skipped& s : skipped) add_new(techniques, s.technique);
  if (ruled_out > 0)
    parts.push_back(fmt::format("{} that faster settings rule out ({})", ruled_out, in_short(reasons)));
  if (out_of_time > 0)
    parts.push_back(fmt::format("{} for want of time ({} gives more, {} all that it takes)", out_of_time,
                                option("time"), option("all")));
  if (!techniques.empty())
    parts.push_back(fmt::format("settings of {}, which cannot run here or have to be named", in_short(techniques)));
  return parts.empty() ? "" : fmt::format("not tried: {}", fmt::join(parts, "; "));
}

std::string stand_in_warning(const Picked& picked) {
  return fmt::format(
      "NO TRUTH: errors are to {}: what errs as that does looks nearer to the truth than it is; {} takes a ray-traced "
      "image (gloam reference, or a renderer's own)",
      picked.truth, option("truth", "REF.exr"));
}

}  // namespace gloam::bench
