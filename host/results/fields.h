// The fields of bench.json, each once: a table of an object's fields reads it, writes it, and describes it in docs/benchmarking.md.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/json_object.h"
#include "results/measurements.h"

namespace gloam::report {

/// What holds for a field besides its type.
enum Rules : unsigned {
  may_lack = 0,       ///< a file may be without it
  needed = 1,         ///< a file without it is refused
  null_if_empty = 2,  ///< an empty text or list, or an object that is not there, is written as null; numbers always are
  left_out = 4,       ///< what is empty is not written
  whole = 8,          ///< its numbers are whole
  of_frames = 16,     ///< written only where `is_of_frames` is set
};

template <typename Thing>
struct Field {
  std::string key, type;
  unsigned rules;
  bool may_be_null;
  std::string meaning, unit;
  std::function<void(Thing&, const JsonObject&)> read;
  std::function<Json(const Thing&)> write;  ///< discarded: is left out
};
template <typename Thing>
using Fields = std::vector<Field<Thing>>;

/// The tables, in the order of the file.
const Fields<Milliseconds>& fields(const Milliseconds*);
const Fields<PassCount>& fields(const PassCount*);
const Fields<Bound>& fields(const Bound*);
const Fields<Pass>& fields(const Pass*);
const Fields<Share>& fields(const Share*);
const Fields<AgainstNaive>& fields(const AgainstNaive*);
const Fields<Ladder>& fields(const Ladder*);
const Fields<Row>& fields(const Row*);
const Fields<Peaks>& fields(const Peaks*);
const Fields<Base>& fields(const Base*);
const Fields<Scene>& fields(const Scene*);
const Fields<GrowthPoint>& fields(const GrowthPoint*);
const Fields<Growth>& fields(const Growth*);
const Fields<Converged>& fields(const Converged*);
const Fields<ScaleChange>& fields(const ScaleChange*);
const Fields<PlaneReading>& fields(const PlaneReading*);
const Fields<Skipped>& fields(const Skipped*);
const Fields<LeftOut>& fields(const LeftOut*);
const Fields<PaperFigure>& fields(const PaperFigure*);
const Fields<SetFacts>& fields(const SetFacts*);
const Fields<Worst>& fields(const Worst*);
const Fields<SequenceRow>& fields(const SequenceRow*);
const Fields<Sequence>& fields(const Sequence*);
const Fields<Measurements>& fields(const Measurements*);

/// Throws Error naming the file and the field that is missing or of another type.
template <typename Thing>
Thing read(const JsonObject& object) {
  Thing thing;
  for (const Field<Thing>& field : fields(&thing)) field.read(thing, object);
  return thing;
}

template <typename Thing>
Json json_of(const Thing& thing) {
  Json object = Json::object();
  for (const Field<Thing>& field : fields(&thing)) {
    if constexpr (requires { thing.is_of_frames; }) {
      if ((field.rules & of_frames) && !thing.is_of_frames) continue;
    }
    Json value = field.write(thing);
    if (!value.is_discarded()) object[field.key] = std::move(value);
  }
  return object;
}

/// The tables as Markdown, which docs/benchmarking.md has (bench/result_fields.cpp).
std::string fields_as_markdown();

}  // namespace gloam::report
