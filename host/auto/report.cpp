#include "auto/report.h"

#include <algorithm>
#include <cmath>

#include "base/json_text.h"
#include "gloam/error.h"
#include "planner/goal.h"

namespace gloam {
namespace {

using Json = nlohmann::ordered_json;

Json document_of(const EffectChoice& choice) {
  return {{"name", choice.technique->effect.name},
          {"technique", choice.technique->name},
          {"wanted", choice.is_wanted},
          {"everywhere", choice.is_everywhere},
          {"why", choice.why},
          {"share_of_tiles", choice.share}};
}

Json document_of(const Outcome& o) {
  Json effect = document_of(o.decision.effect);
  effect["runs"] = o.runs() ? Json(o.decision.request.outputs.front()) : Json(nullptr);
  effect["ms"] = o.ms;
  effect["ms_everywhere"] = or_null(o.ms_everywhere);
  effect["ms_masked"] = or_null(o.ms_masked);
  effect["masked"] = o.is_masked;
  effect["change"] = or_null(o.change);
  effect["lost"] = or_null(o.lost);
  effect["refinements"] = Json::array();
  for (const EffectChoice& refinement : o.decision.refinements)
    effect["refinements"].push_back(document_of(refinement));
  return effect;
}

/// What a budget has chosen, as scripts outside rely on.
Json chosen_of(const std::vector<Outcome>& outcomes) {
  Json chosen = Json::array();
  for (const Outcome& o : outcomes) {
    if (!o.runs() || o.setting.empty()) continue;
    const PlanRequest& request = o.decision.request;
    chosen.push_back({{"effect", o.decision.effect.technique->effect.name},
                      {"technique", request.outputs.front()},
                      {"outputs", request.outputs},
                      {"planes", o.outputs},
                      {"preset", request.preset},
                      {"resolution", request.resolution},
                      {"masked", o.is_masked},
                      {"expected_ms", o.ms - o.decision.effect.classify_ms},
                      {"expected_error", or_null(o.lost)}});
  }
  return chosen;
}

std::string in_words(const ExpectedError& expected) {
  return fmt::format("expected error of the picture {:.4f} (RMSE, give or take {:.4f}), of the colour alone {:.4f}",
                     expected.error, expected.uncertainty, expected.of_color_alone);
}

double ms_of(const AutoResult& result) {
  double ms = result.glance_ms;
  for (const Outcome& o : result.outcomes) ms += o.ms;
  return ms;
}

}  // namespace

nlohmann::ordered_json document_of(const AutoResult& result, const Goal& goal, const DeviceInfo& device) {
  Json effects = Json::array();
  double classify_ms = 0;
  for (const Outcome& o : result.outcomes) {
    effects.push_back(document_of(o));
    classify_ms += o.decision.effect.classify_ms;
  }
  Json document = {{"effects", effects},
                   {"classify_ms", classify_ms},
                   {"glance_ms", result.glance_ms},
                   {"total_ms", ms_of(result)},
                   {"device", device.name}};
  if (!result.spent) return document;
  document["chosen"] = chosen_of(result.outcomes);
  if (goal.ms) document["budget_ms"] = *goal.ms;
  if (goal.error) document["error_goal"] = *goal.error;
  const ExpectedError expected = result.expected.value_or(ExpectedError{});
  document["expected_error"] = expected.error;
  document["expected_error_uncertainty"] = expected.uncertainty;
  document["expected_error_of_color"] = expected.of_color_alone;
  document["goal_met"] = !result.spent->is_missed;
  document["why"] = result.spent->why;
  return document;
}

std::string runs_in_words(const Outcome& o) {
  if (!o.runs()) return "";
  const std::string techniques = fmt::format("{}", fmt::join(o.decision.request.outputs, " + "));
  return o.setting.empty() ? techniques : techniques + ", " + o.setting;
}

std::string where_in_words(const EffectChoice& choice) {
  if (choice.is_everywhere) return "everywhere";
  if (choice.cells.empty() || choice.share == 0) return "-";
  return choice.share < 0.01 ? "less than 1 %" : fmt::format("{:.0f} %", 100 * choice.share);
}

std::string saved_in_words(const Outcome& o) {
  const bool leaves_out = !o.runs() || o.is_masked;
  const double ms = o.ms_everywhere - o.ms;
  // Two times of one computation differ by chance: nothing was saved then.
  return leaves_out && ms > 0 ? fmt::format("{:.1f} of {:.1f} ms", ms, o.ms_everywhere) : "";
}

std::string lost_in_words(const Outcome& o) { return std::isnan(o.lost) ? "" : fmt::format("{:.4f}", o.lost); }

std::string totals_in_words(const AutoResult& result, const Goal& goal) {
  double looking = result.glance_ms;
  for (const Outcome& o : result.outcomes) looking += o.decision.effect.classify_ms;
  const std::string error = result.expected ? "; " + in_words(*result.expected) : "";
  if (!result.spent)
    return fmt::format("{:.1f} ms for all effects, {:.1f} ms of them to find where the frame calls for them{}",
                       ms_of(result), looking, error);
  return fmt::format("{}: {:.2f} ms on the device, {:.2f} of it for looking{}", in_words(goal), ms_of(result),
                     result.spent->glance_ms, error);
}

std::string sentence_on(const AutoResult& result) {
  if (result.spent && !result.spent->why.empty()) return result.spent->why;
  std::vector<std::string> called_for;
  for (const Outcome& o : result.outcomes)
    if (o.runs()) called_for.push_back(o.decision.effect.technique->effect.name);
  return called_for.empty() ? "the frame calls for no effect that can be computed"
                            : fmt::format("the frame calls for {}", enumerate(called_for));
}

std::string note_on_goal(const AutoResult& result, const Goal& goal) {
  if (!result.spent) return "";
  const Spent& spent = *result.spent;
  const auto is_left_out = [](const Outcome& o) { return o.is_left_out; };
  const auto runs = [](const Outcome& o) { return o.runs(); };
  const std::vector<Outcome>& all = result.outcomes;
  if (!spent.is_missed && goal.ms && std::none_of(all.begin(), all.end(), runs) &&
      std::any_of(all.begin(), all.end(), is_left_out))
    return fmt::format(
        "{}: all effects were left out, as the colour alone is expected to be nearer to the truth than with any that "
        "fits",
        in_words(goal));
  if (!spent.is_missed) return "";
  if (goal.error)
    return fmt::format("{}: no choice is expected to reach it; the nearest, {:.4f}, was taken", in_words(goal),
                       result.expected.value_or(ExpectedError{}).error);
  const std::string looking = spent.glance_ms > 0 ? fmt::format("looking takes {:.2f} ms, and ", spent.glance_ms) : "";
  return fmt::format("{}: nothing fits, so all effects were left out; {}with the cheapest, {}, it is {:.2f} ms",
                     in_words(goal), looking, spent.cheapest, spent.cheapest_ms);
}

std::string json_of(const AutoResult& result, const Goal& goal, const DeviceInfo& device) {
  return document_of(result, goal, device).dump();
}

nlohmann::ordered_json composition_document(const Composition& composition) {
  Json parts = Json::array();
  for (const ComposedPart& part : composition.parts)
    parts.push_back({{"plane", part.plane}, {"used", part.is_used}, {"how", part.how}});
  return parts;
}

std::string composition_in_words(const Composition& composition) {
  std::vector<std::string> used, left_out;
  for (const ComposedPart& part : composition.parts) {
    if (part.is_used)
      used.push_back(fmt::format("{} {}", part.plane, part.how));
    else
      left_out.push_back(fmt::format("{} is left out: {}", part.plane, part.how));
  }
  if (used.empty()) used.emplace_back("colour as it was");
  used.insert(used.end(), left_out.begin(), left_out.end());
  return fmt::format("composite: {}", fmt::join(used, "; "));
}

}  // namespace gloam
