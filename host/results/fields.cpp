#include "results/fields.h"

#include "results/field_values.h"

namespace gloam::report {
const Fields<Milliseconds>& fields(const Milliseconds*) {
  using T = Milliseconds;
  static const Fields<T> all = [] {
    Field<T> interval = field("interval", &T::interval, null_if_empty, "of the median, 95 %", "ms");
    const auto write = interval.write;
    interval.write = [write](const T& ms) { return ms.rounds.empty() ? Json(Json::value_t::discarded) : write(ms); };
    return Fields<T>{field("median", &T::median, needed, "over the rounds", "ms"),
                     field("min", &T::min, may_lack, "", "ms"), field("max", &T::max, may_lack, "", "ms"), interval,
                     field("rounds", &T::rounds, left_out, "each round", "ms")};
  }();
  return all;
}

const Fields<PassCount>& fields(const PassCount*) {
  using T = PassCount;
  static const Fields<T> all = {
      field("operations", &T::operations, needed, "on floats; a fused multiply-add is two"),
      field("loads", &T::loads, needed, "of one value from a plane"),
      field("bytes_loaded", &T::bytes_loaded, needed, "", "bytes"),
      field("bytes_stored", &T::bytes_stored, needed, "", "bytes"),
      field("instructions", &T::instructions, may_lack, "of any kind"),
      field("float_instructions", &T::float_instructions, may_lack, "of these, those of floats"),
      field("bytes_of_planes", &T::bytes_of_planes, may_lack, "of the planes read and written, each once", "bytes"),
      field("looks_around", &T::looks_around, may_lack, "reads far around each pixel")};
  return all;
}

const Fields<Bound>& fields(const Bound*) {
  using T = Bound;
  static const Fields<T> all = {field("by", &T::by, needed, "`instructions`, `reads` or `copies`"),
                                field("share", &T::share, needed, "of the pass's time, at the device's peak")};
  return all;
}

const Fields<Pass>& fields(const Pass*) {
  using T = Pass;
  static const Fields<T> all = {
      field("name", &T::name, needed, "`hbao+/estimate`"), field("ms", &T::ms, needed, "[times](#fields-of-times)"),
      field("per_pixel", &T::per_pixel, may_lack,
            "what it does by count: `operations`, `loads`, `bytes_loaded`, `bytes_stored`, `instructions`, "
            "`float_instructions`, "
            "`bytes_of_planes`, `looks_around`"),
      field("bound", &T::bound, may_lack, "[what limits it](#what-limits-a-pass): `by` and `share`")};
  return all;
}

const Fields<Share>& fields(const Share*) {
  using T = Share;
  static const Fields<T> all = {field("what", &T::what, needed, ""), field("share", &T::share, needed, "0 to 1")};
  return all;
}

const Fields<AgainstNaive>& fields(const AgainstNaive*) {
  using T = AgainstNaive;
  static const Fields<T> all = {
      field("part", &T::part, needed, "`estimate`, `filter` or `both`"),
      field("ms", &T::ms, may_lack, "gloam's [times](#fields-of-times)"),
      field("naive_ms", &T::naive_ms, may_lack, "those of the naive kernels"),
      field("ratio", &T::ratio, needed, "gloam's time over theirs"),
      field("mean_difference", &T::mean_difference, may_lack, "of the two images, absolute; null for the filter alone"),
      field("max_difference", &T::max_difference, may_lack, "")};
  return all;
}

const Fields<Ladder>& fields(const Ladder*) {
  using T = Ladder;
  static const Fields<T> all = {field("t0w", &T::t0w, may_lack, ""),
                                field("t1", &T::t1, may_lack, ""),
                                field("t2", &T::t2, may_lack, ""),
                                field("t12", &T::t12, may_lack, ""),
                                field("t3", &T::t3, may_lack, ""),
                                field("t4_bias", &T::t4_bias, may_lack, ""),
                                field("t4_noise", &T::t4_noise, may_lack, ""),
                                field("t5", &T::t5, may_lack, "")};
  return all;
}

const Fields<Row>& fields(const Row*) {
  using T = Row;
  static const Fields<T> all = [] {
    Fields<T> made = {
        field("technique", &T::technique, needed, "name of the technique, or of a submitted method"),
        field("preset", &T::preset, may_lack, "empty: it has none; `submitted` of other methods"),
        field("variant", &T::variant, may_lack, "[what differs](#what-is-measured) from the preset; empty: nothing"),
        depths_field<T>(),
        views_field<T>(),
        field("settings", &T::settings, may_lack, "by name, as `gloam run --set NAME=VALUE` takes them"),
        field("samples", &T::samples, whole | of_frames, "per pixel; null: the technique does not state it"),
        field("resolution", &T::resolution, may_lack, "`full`, `half` or `quarter`"),
        field("math", &T::math, of_frames, "`fast` or `precise`"),
        field("real", &T::real, of_frames, "`float` or `double`"),
        field("storage", &T::storage, of_frames, "`float` or `half`"),
        field("scene", &T::scene, needed, "name of its scene"),
        field("effect", &T::effect, may_lack, "the plane that was measured; missing: `ao`"),
        field("width", &T::width, whole, "", "pixels"),
        field("height", &T::height, whole, "", "pixels"),
        field("lanes", &T::lanes, whole | of_frames, "pixels per work-item"),
        row_time_field(),
        field("passes", &T::passes, of_frames, "[passes](#fields-of-passes), in their order"),
        field("own_floor_ms", &T::own_floor_ms, of_frames, "the technique's own passes without arithmetic", "ms"),
        field("ratio_to_own_floor", &T::ratio_to_own_floor, of_frames, "[ratios](#intervals) of the whole plan"),
        field("spent_on", &T::spent_on, of_frames, "parts of the time: `what`, and its `share` from 0 to 1"),
        field("ratio_to_naive", &T::ratio_to_naive, of_frames, ""),
        field("naive", &T::naive, of_frames, "[against naive kernels](#fields-of-naive); empty: there are none"),
        field("ratio_to_native", &T::ratio_to_native, of_frames, ""),
        field("ratio_to_gather_floor", &T::ratio_to_gather_floor, may_lack, ""),
        field("ratio_to_copy_floor", &T::ratio_to_copy_floor, of_frames, ""),
        field("copy_floor_ms", &T::copy_floor_ms, of_frames, "what `ratio_to_copy_floor` is over", "ms"),
        field("ratio_to_hbao_plus", &T::ratio_to_hbao_plus, may_lack, ""),
        field("rmse_to_truth", &T::rmse_to_truth, may_lack, "null: no truth"),
        field("bias", &T::bias, may_lack, "mean difference to the truth; above 0: too bright"),
        field("ssim", &T::ssim, may_lack, "to the truth; 1: the same"),
        field("flip", &T::flip, may_lack, "to the truth; 0: the same"),
        field("flicker", &T::flicker, may_lack, "of a sequence of a set"),
        field("inconsistency", &T::inconsistency, may_lack, "of the two views of a frame"),
        field("kind", &T::kind, null_if_empty, "of its item of a set: `frame`, `sequence`, `eyes`, `display`, `hard`"),
        field("ladder", &T::ladder, of_frames,
              "[where errors come from](#errors-step-by-step): `t0w`, `t1`, `t2`, `t12`, `t3`, `t4_bias`, `t4_noise`, "
              "`t5`, RMSE each"),
        field("image", &T::image, null_if_empty, "path below the folder"),
        field("submitted", &T::submitted, left_out, "[of other methods](score.md#what-is-written)"),
        field("cpu_ms", &T::cpu_ms, null_if_empty | of_frames, "as `ms`, of what the cores spent")};
    add_rounds(made, "ratio_to_hbao_plus", &T::hbao_plus_rounds);
    add_rounds(made, "ratio_to_gather_floor", &T::gather_floor_rounds);
    add_rounds(made, "ratio_to_copy_floor", &T::copy_floor_rounds);
    made.push_back(field("processes", &T::processes, left_out | whole,
                         "rounds of each process, one after another; missing: one process"));
    return made;
  }();
  return all;
}

const Fields<Peaks>& fields(const Peaks*) {
  using T = Peaks;
  static const Fields<T> all = {field("copy_gb_per_s", &T::copy_gb_per_s, may_lack, ""),
                                field("gather_g_per_s", &T::gather_g_per_s, may_lack, ""),
                                field("fma_gflops", &T::fma_gflops, may_lack, "")};
  return all;
}

const Fields<Base>& fields(const Base*) {
  using T = Base;
  static const Fields<T> all = {field("name", &T::name, may_lack, ""), field("rmse_to_truth", &T::rmse, may_lack, ""),
                                field("bias", &T::bias, may_lack, "")};
  return all;
}

const Fields<Scene>& fields(const Scene*) {
  using T = Scene;
  static const Fields<T> all = {
      field("name", &T::name, needed, "of the scene, the frame or the item"),
      field("class", &T::scene_class, may_lack,
            "`architecture`, `thin`, `object`, `flat`, as in `gloam list scenes`; `own` for `--frame`"),
      field("effect", &T::effect, may_lack, "the plane that was measured; missing: `ao`"),
      size_field<T>(),
      field("radius", &T::radius, may_lack, "", "scene units"),
      field("radius_from", &T::radius_from, may_lack, "`flag`, `truth`, `scene` or `frame`"),
      field("radius_pixels", &T::radius_pixels, may_lack, "at the median depth", "pixels"),
      field("truth_noise", &T::truth_noise, may_lack, "RMS"),
      field("truth_rays", &T::truth_rays, may_lack, "per pixel"),
      field("truth_image", &T::truth_image, null_if_empty, "path below the folder"),
      field("white", &T::white, may_lack, "the value that pictures show as white"),
      field("peaks", &T::peaks, may_lack, "of the device on it: `copy_gb_per_s`, `gather_g_per_s`, `fma_gflops`"),
      field("base", &T::base, may_lack,
            "what there is without a technique: `name` (`white`, `black`), `rmse_to_truth`, `bias`"),
      field("made", &T::made, left_out, "files that were traced"),
      field("reused", &T::reused, left_out, "files of an earlier run"),
      field("kind", &T::kind, left_out, "of its item of a set")};
  return all;
}

const Fields<GrowthPoint>& fields(const GrowthPoint*) {
  using T = GrowthPoint;
  static const Fields<T> all = {field("x", &T::x, may_lack, ""), field("ms", &T::ms, may_lack, "", "ms")};
  return all;
}

const Fields<Growth>& fields(const Growth*) {
  using T = Growth;
  static const Fields<T> all = {field("technique", &T::technique, needed, ""),
                                field("over", &T::over, needed, "`pixels`, `samples`, `radius`, `layers` or `views`"),
                                field("scene", &T::scene, may_lack, ""),
                                field("exponent", &T::exponent, needed, "of the time as a power of `x`"),
                                field("points", &T::points, may_lack, "`x`, and the median `ms` there")};
  return all;
}

const Fields<Converged>& fields(const Converged*) {
  using T = Converged;
  static const Fields<T> all = {
      field("technique", &T::technique, needed, ""),
      field("scene", &T::scene, needed, ""),
      field("effect", &T::effect, may_lack, ""),
      depths_field<T>(),
      views_field<T>(),
      field("rmse_to_truth", &T::rmse_to_truth, may_lack, "with so many samples that more change nothing, unfiltered"),
      field("bias", &T::bias, may_lack, "")};
  return all;
}

const Fields<ScaleChange>& fields(const ScaleChange*) {
  using T = ScaleChange;
  static const Fields<T> all = {field("technique", &T::technique, needed, ""),
                                field("scene", &T::scene, needed, ""),
                                field("from", &T::from, needed, "a size: `480x270`"),
                                field("to", &T::to, needed, "a size: `960x540`"),
                                field("mean_change", &T::mean_change, may_lack, "above 0: brighter with more pixels"),
                                field("mae", &T::mae, may_lack, "mean of the absolute differences")};
  return all;
}

const Fields<PlaneReading>& fields(const PlaneReading*) {
  using T = PlaneReading;
  static const Fields<T> all = {
      field("technique", &T::technique, needed, ""),
      field("plane", &T::plane, needed, "`ao` or `ao_raw`"),
      field("least", &T::least, needed, "over all pixels of all bare planes; 1: open"),
      field("mean", &T::mean, may_lack, "over the same"),
      field("tilt", &T::tilt, may_lack, "degrees, of the plane of the least value", "degrees"),
      field("direction", &T::direction, may_lack, "degrees, of the tilt in the image", "degrees"),
      field("camera", &T::camera, may_lack, "`perspective`, `off-axis` or `orthographic`"),
      field("x", &T::x, whole, "pixel of the least value", "pixels"),
      field("y", &T::y, whole, "", "pixels")};
  return all;
}

const Fields<Skipped>& fields(const Skipped*) {
  using T = Skipped;
  static const Fields<T> all = {
      field("technique", &T::technique, may_lack, ""), field("preset", &T::preset, null_if_empty, "null: all"),
      field("scene", &T::scene, null_if_empty, "null: all"), field("why", &T::why, may_lack, "")};
  return all;
}

const Fields<LeftOut>& fields(const LeftOut*) {
  using T = LeftOut;
  static const Fields<T> all = {field("technique", &T::technique, null_if_empty, "null: all"),
                                field("preset", &T::preset, null_if_empty, "null: all"),
                                field("variant", &T::variant, may_lack, ""),
                                field("scene", &T::scene, may_lack, ""),
                                field("effect", &T::effect, may_lack, ""),
                                field("what", &T::what, may_lack, "[what a time limit left out](#a-minute)")};
  return all;
}

const Fields<PaperFigure>& fields(const PaperFigure*) {
  using T = PaperFigure;
  static const Fields<T> all = {field("table", &T::table, may_lack, ""),
                                field("row", &T::row, may_lack, ""),
                                field("column", &T::column, may_lack, ""),
                                field("ms", &T::ms, may_lack, "median of the rounds", "ms"),
                                field("ratio", &T::ratio, may_lack, "to `base`, median of the rounds' ratios"),
                                field("paper_ms", &T::paper_ms, may_lack, "the paper's own", "ms"),
                                field("paper_ratio", &T::paper_ratio, may_lack, "of the paper's own figures"),
                                field("base", &T::base, may_lack, "the row that ratios are to")};
  return all;
}

const Fields<SetFacts>& fields(const SetFacts*) {
  using T = SetFacts;
  static const Fields<T> all = {field("name", &T::name, may_lack, ""), field("part", &T::part, may_lack, ""),
                                field("seed", &T::seed, whole, ""), field("hash", &T::hash, may_lack, "")};
  return all;
}

const Fields<Worst>& fields(const Worst*) {
  using T = Worst;
  static const Fields<T> all = {field("frame", &T::frame, whole, ""), field("rmse", &T::rmse, may_lack, "")};
  return all;
}

const Fields<SequenceRow>& fields(const SequenceRow*) {
  using T = SequenceRow;
  static const Fields<T> all = {
      field("technique", &T::technique, needed, ""),
      field("preset", &T::preset, may_lack, ""),
      field("temporal", &T::temporal, may_lack, "accumulated over the frames"),
      field("ms", &T::ms, needed, "[times](#fields-of-times) of the kernels of a frame"),
      field("ratio_to_hbao_plus", &T::ratio_to_hbao_plus, may_lack, "on the same frame: the median over the frames"),
      field("rmse", &T::rmse, may_lack, "mean over the frames"),
      field("worst", &T::worst, may_lack, "the `frame` with the largest `rmse`"),
      field("ssim", &T::ssim, may_lack, "mean over the frames"),
      field("flicker", &T::flicker, may_lack, "null: no two frames follow one another"),
      field("new_rmse", &T::new_rmse, may_lack, "of surfaces that came into view within 8 frames"),
      field("old_rmse", &T::old_rmse, may_lack, "of all others")};
  return all;
}

const Fields<Sequence>& fields(const Sequence*) {
  using T = Sequence;
  static const Fields<T> all = {
      field("shot", &T::shot, may_lack, "name or pattern"),
      field("class", &T::scene_class, may_lack, "as of scenes"),
      field("frames", &T::frames, whole, ""),
      size_field<T>(),
      field("radius", &T::radius, may_lack, "", "scene units"),
      field("radius_from", &T::radius_from, may_lack, "as of scenes"),
      field("truth_rays", &T::truth_rays, may_lack, "fewest per pixel"),
      field("truth_noise", &T::truth_noise, may_lack, "largest RMS"),
      field("truth_change", &T::truth_change, may_lack, "of the truth, from frame to frame"),
      field("comparable", &T::comparable, may_lack, "share of the foreground that two frames show"),
      field("motion", &T::motion, may_lack, "how surfaces were found in the frame before"),
      field("made", &T::made, may_lack, "files that were traced"),
      field("reused", &T::reused, may_lack, "files of an earlier run"),
      field("rows", &T::rows, may_lack, "[rows of a sequence](#fields-of-rows-of-sequence)")};
  return all;
}

const Fields<Measurements>& fields(const Measurements*) {
  using T = Measurements;
  static const Fields<T> all = {
      field("device", &T::device, null_if_empty, "null: nothing was computed here"),
      field("cpu", &T::cpu, may_lack, ""),
      field("cores", &T::cores, whole, ""),
      field("driver", &T::driver, null_if_empty, ""),
      field("date", &T::date, may_lack, "UTC"),
      field("commit", &T::commit, may_lack, "of the build; `-changed` where files differed from it"),
      field("gloam", &T::gloam, may_lack, "the version"),
      field("command", &T::command, may_lack, "as given; of absolute paths the last folder and the name"),
      field("set", &T::set, null_if_empty, "the frozen set that was measured on: `name`, `part`, `seed`, `hash`"),
      field("rounds", &T::rounds, whole | of_frames, "that were asked for"),
      field("rays", &T::rays, of_frames, "per pixel of the truths, where all have as many"),
      field("peaks", &T::peaks, of_frames, "those of the largest scene"),
      field("scenes", &T::scenes, of_frames, "[scenes](#fields-of-scenes)"),
      field("results", &T::rows, needed, "[results](#fields-of-results)"),
      field("growth", &T::growth, of_frames, "[growth](#fields-of-growth)"),
      field("converged", &T::converged, of_frames, "[converged](#fields-of-converged)"),
      field("scales", &T::scales, of_frames, "[scales](#fields-of-scales)"),
      field("planes", &T::planes, of_frames, "[planes](#fields-of-planes)"),
      field("sequence", &T::sequence, left_out, "[a sequence](#fields-of-sequence), with `--sequence`"),
      field("skipped", &T::skipped, may_lack,
            "what a frame or device does not allow: `technique`, `preset`, `scene`, `why`"),
      field("left_out", &T::left_out, of_frames, "[what a time limit left out](#fields-of-left_out)"),
      field("paper", &T::paper, may_lack, "[figures of a paper](#fields-of-paper), with `--paper`")};
  return all;
}

namespace {

template <typename Thing>
std::string table_of(const char* title) {
  std::string text =
      fmt::format("### Fields of {}\n\n| field | type | unit | null | what |\n|---|---|---|---|---|\n", title);
  for (const Field<Thing>& field : fields(static_cast<const Thing*>(nullptr))) {
    const char* null = field.rules & left_out ? "may be missing" : field.may_be_null ? "yes" : "";
    std::string meaning = field.meaning;
    if (field.rules & of_frames && !std::is_same_v<Thing, Measurements>)
      meaning += meaning.empty() ? "of frames" : "; of frames";
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", field.key, field.type, field.unit, null, meaning);
  }
  return text + "\n";
}

}  // namespace

std::string fields_as_markdown() {
  return table_of<Measurements>("the document") + table_of<Scene>("scenes") + table_of<Row>("results") +
         table_of<Milliseconds>("times") + table_of<Pass>("passes") + table_of<AgainstNaive>("naive") +
         table_of<Growth>("growth") + table_of<Converged>("converged") + table_of<ScaleChange>("scales") +
         table_of<PlaneReading>("planes") + table_of<LeftOut>("left_out") + table_of<PaperFigure>("paper") +
         table_of<Sequence>("sequence") + table_of<SequenceRow>("rows of sequence");
}

}  // namespace gloam::report
