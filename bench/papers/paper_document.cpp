#include "papers/paper_document.h"

#include "base/json_text.h"

namespace gloam::bench {
namespace {

Json document_of(const report::PaperFigure& time) { return report::json_of(time); }

Json document_of(const PaperFact& f) {
  return {{"figure", f.figure}, {"row", f.row}, {"column", f.column}, {"value", f.value}, {"unit", f.unit}};
}

Json document_of(const PaperPicture& p) { return {{"figure", p.figure}, {"caption", p.caption}, {"file", p.file}}; }

template <typename Thing>
Json list_of(const std::vector<Thing>& things) {
  Json list = Json::array();
  for (const Thing& thing : things) list.push_back(document_of(thing));
  return list;
}

}  // namespace

Json document_of(const PaperResult& result, const PaperOptions& options, const DeviceInfo& device) {
  report::Measurements origin = results_on(device);
  origin.is_of_frames = false;
  Json document = report::document_of(origin);
  for (const char* list : {"results", "skipped", "paper"}) document.erase(list);
  document.update({{"rounds", options.rounds},
                   {"width", options.width},
                   {"height", options.height},
                   {"rays", options.rays},
                   {"results", Json::array()},
                   {"paper", list_of(result.times)},
                   {"facts", list_of(result.facts)},
                   {"pictures", list_of(result.pictures)},
                   {"notes", result.notes}});
  return document;
}

}  // namespace gloam::bench
