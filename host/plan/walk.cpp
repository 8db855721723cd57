#include "plan/walk.h"

#include <algorithm>
#include <map>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "plan/settings.h"

namespace gloam {

namespace {

/// The one of these techniques that makes a plane as an extra; null if none does.
const Technique* extra_maker(const Techniques& techniques, const std::string& plane) {
  const auto found = std::find_if(techniques.begin(), techniques.end(),
                                  [&](const Technique* t) { return contains(t->extras, plane); });
  return found == techniques.end() ? nullptr : *found;
}

}  // namespace

Walk::Walk(const Wanted& wanted, const PlanRequest& request, std::vector<std::string> available,
           const std::vector<std::string>& also, const std::string& mask)
    : wanted_(wanted), request_(request), available_(std::move(available)) {
  if (!mask.empty()) need(mask, nullptr);
  for (const std::string& output : wanted.outputs) need(output, nullptr);
  for (const std::string& plane : also) need(plane, nullptr);
}

void Walk::need(const std::string& plane, const Technique* asking) {
  if (contains(made_, plane) || contains(inputs, plane) || contains(missing, plane)) return;
  // An extra of a technique that already runs costs least.
  const Technique* running = asking && !contains(available_, plane) ? extra_maker(order, plane) : nullptr;
  const Technique* maker = running ? running : maker_of(plane, asking, wanted_.makers);
  if (std::find(order.begin(), order.end(), maker) != order.end()) return need_extra(*maker, plane);
  const bool under_way = maker && std::find(begun_.begin(), begun_.end(), maker) != begun_.end();
  const bool asked_for =
      maker && std::find(wanted_.makers.begin(), wanted_.makers.end(), maker) != wanted_.makers.end();
  if (contains(available_, plane) && (!asked_for || under_way)) {
    inputs.push_back(plane);
    if (maker && !under_way) skipped.emplace_back(maker->name, fmt::format("the file has '{}'", plane));
  } else if (!maker || under_way) {
    missing.push_back(plane);
  } else {
    need_extra(*maker, plane);
    schedule(*maker);
  }
}

/// Notes that a technique has to make a plane, if the plane is one of its extras.
void Walk::need_extra(const Technique& maker, const std::string& plane) {
  if (!contains(maker.extras, plane)) return;
  extras.emplace_back(&maker, plane);
  for (const auto& [extra, read] : maker.read_for_extras) {
    if (extra == plane) need(read, &maker);
  }
}

void Walk::schedule(const Technique& technique) {
  begun_.push_back(&technique);
  for (const std::string& plane : reads_of(technique, request_)) need(plane, &technique);
  for (const std::string& plane : technique.may_read) {
    if (contains(available_, plane) && !contains(inputs, plane)) inputs.push_back(plane);
  }
  order.push_back(&technique);
  for (const std::string& plane : technique.writes) made_.push_back(plane);
}

namespace {

/// For missing planes from which a technique that nobody asked for makes a plane that nothing else reads: that plane.
std::map<std::string, std::string> substitutes(const Wanted& wanted, const Techniques& order,
                                               const std::vector<std::string>& missing) {
  std::map<std::string, std::string> instead;
  for (const std::string& plane : missing) {
    Techniques readers;
    for (const Technique* t : order) {
      if (contains(t->reads, plane)) readers.push_back(t);
    }
    if (readers.size() != 1 || readers.front()->writes.size() != 1) continue;
    const bool is_asked_for =
        std::find(wanted.makers.begin(), wanted.makers.end(), readers.front()) != wanted.makers.end();
    if (!is_asked_for) instead[plane] = readers.front()->writes.front();
  }
  return instead;
}

/// The command that makes a plane that no technique makes: "gloam capture --peel N"; empty if unknown.
std::string maker_outside(const std::string& plane) {
  return is_stack(plane) ? stack_kind(plane).source : plane_kind(plane).source;
}

/// "gloam capture --peel N makes 'peel'", with all of `planes` that the command makes.
std::string source_of(const std::string& plane, const std::vector<std::string>& planes) {
  const std::string source = maker_outside(plane);
  if (source.empty()) return "";
  std::vector<std::string> made;
  for (const std::string& other : planes) {
    if (maker_outside(other) == source) made.push_back("'" + other + "'");
  }
  return fmt::format("{} makes {}", source, enumerate(made));
}

}  // namespace

void throw_missing(const std::string& technique, const Wanted& wanted, const Walk& walk, const std::string& holds) {
  const std::vector<std::string>& missing = walk.missing;
  const std::map<std::string, std::string> instead = substitutes(wanted, walk.order, missing);
  std::vector<std::string> quoted;
  std::string sources;
  for (const std::string& plane : missing) {
    const auto least = instead.find(plane);
    quoted.push_back("'" + (least == instead.end() ? plane : least->second) + "'");
    const std::string first = least == instead.end() ? "" : source_of(least->second, {least->second});
    const std::string own = source_of(plane, missing);
    if (sources.find(own) != std::string::npos && first.empty()) continue;  // already listed for another plane
    if (!first.empty()) sources += first + (own.empty() ? "; " : ", or " + own + ", which does as well; ");
    if (first.empty() && !own.empty()) sources += own + "; ";
  }
  throw MissingPlanes(
      fmt::format("{}: needs {}, and {} ({}see docs/gbuffer.md)", technique, enumerate(quoted), holds, sources),
      missing, instead);
}

}  // namespace gloam
