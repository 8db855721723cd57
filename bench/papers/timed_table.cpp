#include "papers/timed_table.h"

#include <algorithm>
#include <memory>

#include "base/lists.h"

namespace gloam::bench {
namespace {

void add(Series& sum, const Series& ms) {
  sum.resize(std::max(sum.size(), ms.size()));
  for (size_t i = 0; i < ms.size(); ++i) sum[i] += ms[i];
}

/// The first entry with the same runs.
size_t runs_of(const Entry& entry, const std::vector<Entry>& entries) {
  const auto same = std::find_if(entries.begin(), entries.end(), [&](const Entry& other) {
    return other.stage == entry.stage && other.asked == entry.asked;
  });
  return size_t(same - entries.begin());
}

/// The entry that this one's ratio is to.
size_t base_of(const Entry& entry, const std::vector<Entry>& entries) {
  size_t base = entries.size();
  for (size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].is_base && (base == entries.size() || entries[i].column == entry.column)) base = i;
  }
  return base;
}

/// States the parts of an entry, each once even if several entries share it.
void state_parts(Study& study, const TimedTable& table, const Entry& e, const TimedPlan& timed) {
  for (const Part& part : table.parts) {
    const Series ms = series_of(timed, part.counts);
    report::PaperFigure time{table.parts_name, e.row, e.column + ", " + part.name, median(ms), {}, {}, {}, table.base};
    const bool is_new =
        std::none_of(study.result.times.begin(), study.result.times.end(), [&](const report::PaperFigure& known) {
          return known.table == time.table && known.row == time.row && known.column == time.column;
        });
    if (!ms.empty() && is_new) study.result.times.push_back(std::move(time));
  }
}

}  // namespace

Series series_of(const TimedPlan& timed, const std::function<bool(const std::string&)>& counts,
                 const std::string& view) {
  Series sum;
  for (const TimedPlan::Pass& pass : timed.passes()) {
    if (!counts(pass.name)) continue;
    if (view.empty())
      add(sum, pass.ms);
    else if (const auto own = pass.of_views.find(view); own != pass.of_views.end())
      add(sum, own->second);
  }
  return sum;
}

std::function<bool(const std::string&)> passes_named(const std::vector<std::string>& names) {
  return [names](const std::string& label) { return contains(names, label.substr(label.find('/') + 1)); };
}

void measure(Study& study, const TimedTable& table, const std::vector<Entry>& entries) {
  std::vector<std::shared_ptr<TimedPlan>> timed;  // one per entry
  std::vector<Contender> contenders;
  for (const Entry& e : entries) {
    study.tell(fmt::format("{}: {}, {}", table.name, e.column, e.row), double(timed.size()) / double(entries.size()));
    if (const size_t first = runs_of(e, entries); first < timed.size()) {
      timed.push_back(timed[first]);
      continue;
    }
    timed.push_back(std::make_shared<TimedPlan>(study.plan_of(*e.stage, e.asked), e.stage->frame, study.device()));
    contenders.push_back({e.row, [plan = timed.back().get()] { return plan->run(); }});
  }
  interleaved(contenders, study.options().rounds,
              [&](int done, int of) { study.tell(table.name + ": in turn", double(done) / of); });
  for (size_t i = 0; i < entries.size(); ++i) {
    const Entry& e = entries[i];
    const size_t base = base_of(e, entries);
    const Series ms = series_of(*timed[i], e.counts, e.view);
    report::PaperFigure time{table.name, e.row, e.column, median(ms), {}, e.paper, {}, table.base};
    if (i != base) {
      time.ratio = ratio(ms, series_of(*timed[base], entries[base].counts, entries[base].view));
      if (e.paper && entries[base].paper) time.paper_ratio = *e.paper / *entries[base].paper;
    }
    study.result.times.push_back(std::move(time));
    state_parts(study, table, e, *timed[i]);
  }
}

}  // namespace gloam::bench
