#include "timed_table.h"

#include <algorithm>
#include <memory>

#include "timing.h"

namespace gloam::bench {
namespace {

Series counted(const TimedPlan& timed, const std::function<bool(const std::string&)>& counts) {
  Series sum;
  for (const TimedPlan::Pass& pass : timed.passes()) {
    if (!counts(pass.name)) continue;
    sum.resize(std::max(sum.size(), pass.ms.size()));
    for (size_t i = 0; i < pass.ms.size(); ++i) sum[i] += pass.ms[i];
  }
  return sum;
}

/// The entry that this one is measured by.
size_t base_of(const Entry& entry, const std::vector<Entry>& entries) {
  size_t base = entries.size();
  for (size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].is_base && (base == entries.size() || entries[i].column == entry.column)) base = i;
  }
  return base;
}

/// Each once, where several entries have it in common.
void state_parts(Study& study, const TimedTable& table, const Entry& e, const TimedPlan& timed) {
  for (const Part& part : table.parts) {
    const Series ms = counted(timed, part.counts);
    PaperTime time{table.parts_name, e.row, e.column + ", " + part.name, median(ms), {}, {}, table.base};
    const bool is_new = std::none_of(study.result.times.begin(), study.result.times.end(), [&](const PaperTime& known) {
      return known.table == time.table && known.row == time.row && known.column == time.column;
    });
    if (!ms.empty() && is_new) study.result.times.push_back(std::move(time));
  }
}

}  // namespace

void measure(Study& study, const TimedTable& table, const std::vector<Entry>& entries) {
  std::vector<std::unique_ptr<TimedPlan>> timed;
  std::vector<Contender> contenders;
  for (const Entry& e : entries) {
    study.tell(fmt::format("{}: {}, {}", table.name, e.column, e.row), double(timed.size()) / double(entries.size()));
    timed.push_back(std::make_unique<TimedPlan>(study.plan_of(*e.stage, e.asked), e.stage->frame, study.device()));
    contenders.push_back({e.row, [plan = timed.back().get()] { return plan->run(); }});
  }
  interleaved(contenders, study.options().rounds,
              [&](int done, int of) { study.tell(table.name + ": in turn", double(done) / of); });
  for (size_t i = 0; i < entries.size(); ++i) {
    const Entry& e = entries[i];
    const size_t base = base_of(e, entries);
    const Series ms = counted(*timed[i], e.counts);
    PaperTime time{table.name, e.row, e.column, median(ms), {}, {}, table.base};
    if (i != base) {
      time.ratio = ratio(ms, counted(*timed[base], entries[base].counts));
      if (e.paper && entries[base].paper) time.paper_ratio = *e.paper / *entries[base].paper;
    }
    study.result.times.push_back(std::move(time));
    state_parts(study, table, e, *timed[i]);
  }
}

}  // namespace gloam::bench
