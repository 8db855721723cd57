#include "leaderboard/page.h"

#include <algorithm>
#include <set>

#include "base/json_text.h"
#include "gloam/error.h"
#include "leaderboard/commands.h"
#include "leaderboard/embedded.h"
#include "leaderboard/table.h"
#include "page/embedded_pictures.h"
#include "page/html.h"
#include "page/submitted.h"

namespace gloam::leaderboard {
namespace {

using report::Json;
using report::Measurements;

Json json(const report::SetFacts& set) {
  if (set.name.empty()) return nullptr;
  return {{"name", set.name}, {"part", set.part}, {"seed", or_null(set.seed)}, {"hash", set.hash}};
}

void add_figures(Json& object, const Figures& figures) {
  for (size_t f = 0; f < figure_count; ++f) {
    if (figures[f]) object[figure_names()[f]] = *figures[f];
  }
}

Json json(const Source& file) {
  const Measurements& m = file.measurements;
  return {{"file", file.name},
          {"set", json(m.set)},
          {"gloam", or_null(m.gloam)},
          {"commit", or_null(m.commit)},
          {"date", or_null(m.date)},
          {"device", or_null(m.device)},
          {"cpu", or_null(m.cpu)},
          {"driver", or_null(m.driver)},
          {"rounds", or_null(m.rounds)},
          {"rows", m.rows.size()},
          {"submitted", m.submitted.size()},
          {"command", m.command}};
}

Json json(const Entry& entry) {
  Json made = {{"technique", entry.technique},
               {"preset", entry.preset},
               {"variant", entry.variant},
               {"device", entry.device},
               {"driver", entry.driver},
               {"reads", entry.is_submitted ? Json(nullptr) : Json(in_words(entry.reads))},
               {"held", nullptr},
               {"cases", nullptr},
               {"submitted", nullptr}};
  if (entry.stability) {
    made["held"] = entry.stability->held;
    made["cases"] = entry.stability->cases;
  }
  if (!entry.is_submitted) return made;
  const report::SubmittedFacts facts = report::facts_of(entry.rows.front().second->submitted);
  made["submitted"] = {
      {"version", facts.version}, {"link", facts.link}, {"authors", facts.authors}, {"convention", facts.convention}};
  return made;
}

Json json(const Choice& choice) {
  Json rows = Json::array();
  for (const TableRow& row : choice.rows) {
    Json made = {{"entry", row.entry}, {"items", row.items}};
    add_figures(made, row.means);
    rows.push_back(std::move(made));
  }
  return {{"what", choice.what}, {"name", choice.name}, {"items", choice.items}, {"rows", rows}};
}

/// One page's parts from results.
class Making {
 public:
  Making(const Results& results, const PageOptions& options) : results_(results), options_(options) {}

  Page make() {
    for (const Board& board : results_.boards) {
      std::vector<EffectTable> tables = tables_of(board, results_);
      if (tables.empty()) continue;
      boards_.push_back({board, std::move(tables)});
    }
    if (boards_.empty())
      throw Error("{}: holds no rows; 'gloam bench' measures some", results_.files.front().file.string());
    embed();
    Page page;
    page.document = document(false);
    page::Parts parts = page::shared_parts();
    parts.insert(embedded_files().begin(), embedded_files().end());
    parts["data"] = page::script_text(document(true));
    parts["pictures"] = pictures_.html();
    page.html = page::filled(parts.at("leaderboard.html"), parts);
    page.pictures = pictures_.count();
    page.notes = notes_;
    std::set<std::string> methods;
    for (const auto& [board, tables] : boards_) {
      for (const EffectTable& table : tables) {
        page.items += table.items.size();
        for (const Entry& entry : table.entries) methods.insert(entry.technique);
      }
    }
    page.methods = methods.size();
    return page;
  }

 private:
  std::filesystem::path folder(size_t file) const { return folder_of(results_.files[file]); }

  /// Whether pictures of a file are to be looked for. Results are often passed on without their pictures: one note says so.
  bool has_pictures(size_t file) {
    std::error_code unknown;
    if (std::filesystem::is_directory(folder(file) / "images", unknown)) return true;
    if (noted_.insert(file).second)
      notes_.push_back(fmt::format("{}: there is no {} beside it; the page goes without the pictures of this file",
                                   results_.files[file].file.string(), "images/"));
    return false;
  }

  bool is_shown(const Row& row) const {
    return options_.shown == ShownPictures::all || (options_.shown == ShownPictures::plain && row.variant.empty());
  }

  void embed() {
    const auto add = [&](size_t file, const std::string& image) {
      if (!image.empty() && options_.shown != ShownPictures::none && has_pictures(file))
        pictures_.add(folder(file), image);
    };
    for (const auto& [board, tables] : boards_) {
      for (const EffectTable& table : tables) {
        for (const Item& item : table.items) add(item.file, item.truth_image);
        for (const Entry& entry : table.entries) {
          for (const auto& [item, row] : entry.rows) {
            if (is_shown(*row)) add(row->source, row->image);
          }
        }
      }
    }
    pictures_.embed(options_.picture_width, options_.progress);
    notes_.insert(notes_.end(), pictures_.notes().begin(), pictures_.notes().end());
  }

  Json json_of(const Item& item) const {
    return {{"name", item.name},
            {"kind", or_null(item.kind)},
            {"class", or_null(item.item_class)},
            {"width", or_null(item.width)},
            {"height", or_null(item.height)},
            {"radius", or_null(item.radius)},
            {"truth_noise", or_null(item.truth_noise)}};
  }

  Json json_of(const Row& row, size_t entry, size_t item, const EffectTable& table, const Board& board) const {
    Json made = {{"entry", entry}, {"item", item}, {"file", row.source}};
    add_figures(made, figures_of(row));
    if (row.submitted.is_null()) made["ms"] = row.ms.median;
    const Measurements& file = results_.files[row.source].measurements;
    made["run"] = or_null(run_command(row, table.items[item], board.set));
    // The file states the command of its own rows.
    if (!row.submitted.is_null()) {
      const report::SubmittedFacts facts = report::facts_of(row.submitted);
      made["measured_by"] = or_null(measuring_command(row, file));
      for (const auto& [name, value] :
           {std::pair("fit_exponent", facts.fit_exponent), std::pair("fit_strength", facts.fit_strength),
            std::pair("fit_scale", facts.fit_scale), std::pair("whole_ms", facts.whole_ms)})
        made[name] = or_null(value);
    }
    return made;
  }

  Json json_of(const EffectTable& table, const Board& board, bool for_page) const {
    Json made = {{"effect", table.effect}};
    for (const char* list : {"items", "entries", "choices", "rows"}) made[list] = Json::array();
    for (const Item& item : table.items) {
      made["items"].push_back(json_of(item));
      if (!for_page) continue;
      made["items"].back()["white"] = item.white;
      made["items"].back()["truth_picture"] = pictures_.index(folder(item.file), item.truth_image);
    }
    for (const Choice& choice : table.choices) made["choices"].push_back(json(choice));
    for (size_t e = 0; e < table.entries.size(); ++e) {
      made["entries"].push_back(json(table.entries[e]));
      for (const auto& [item, row] : table.entries[e].rows) {
        made["rows"].push_back(json_of(*row, e, item, table, board));
        if (for_page) made["rows"].back()["picture"] = pictures_.index(folder(row->source), row->image);
      }
    }
    return made;
  }

  Json document(bool for_page) const {
    Json made = {{"files", Json::array()}, {"boards", Json::array()}};
    for (const Source& file : results_.files) {
      made["files"].push_back(json(file));
      made["files"].back()["measured_by"] = or_null(measuring_command(Row{}, file.measurements));
    }
    for (const auto& [board, tables] : boards_) {
      Json effects = Json::array();
      for (const EffectTable& table : tables) effects.push_back(json_of(table, board, for_page));
      made["boards"].push_back({{"title", title_of(board.set)}, {"set", json(board.set)}, {"effects", effects}});
    }
    return made;
  }

  const Results& results_;
  const PageOptions& options_;
  std::vector<std::pair<Board, std::vector<EffectTable>>> boards_;
  report::EmbeddedPictures pictures_;
  std::set<size_t> noted_;
  std::vector<std::string> notes_;
};

}  // namespace

Page make_page(const Results& results, const PageOptions& options) { return Making(results, options).make(); }

}  // namespace gloam::leaderboard
