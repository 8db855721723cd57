#include "papers/doronin2017.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "measure/timing.h"
#include "papers/display_stage.h"
#include "papers/neighbouring_views.h"
#include "papers/timed_table.h"

namespace gloam::bench {
namespace {

constexpr const char* scene = "statue";

Asked ssao() { return {.technique = "lightfield-ssao", .settings = {}}; }

// --- Table 1: does the time depend on the model?

struct Model {
  const char *faces, *of;
  double ms;  ///< in the paper: time with SSAO minus time without
};
constexpr std::array<Model, 3> models = {
    {{"5011", "Statue", 6.46}, {"29520", "Ammonite", 6.43}, {"212574", "Armadillo", 6.48}}};

/// A column of the table: some passes of a model's time.
struct Column {
  const char* name;
  std::vector<std::string> passes;
};
const std::array<Column, 4> columns = {{{"all passes", {"estimate", "horizontal", "vertical"}},
                                        {"estimate", {"estimate"}},
                                        {"Gaussian along rows", {"horizontal"}},
                                        {"Gaussian along columns", {"vertical"}}}};

/// A model in one module's image.
struct Shown {
  std::string name;
  Stage stage;
  std::optional<double> paper_ms;
};

/// The quantile of some values.
double quantile(Series values, double share) {
  std::sort(values.begin(), values.end());
  return values[size_t(share * double(values.size() - 1) + 0.5)];
}

void state_spread(Study& study, const std::string& table, const Shown& model, const Series& ms, const Series& of_base) {
  Series ratios;
  for (size_t i = 0; i < ms.size(); ++i) ratios.push_back(ms[i] / of_base[i]);
  const std::string figure = table + ": ratios of the rounds, all passes";
  for (const auto& [name, share] :
       {std::pair{"a quarter is below", 0.25}, {"half are below", 0.5}, {"three quarters are below", 0.75}})
    study.fact(figure, model.name, name, quantile(ratios, share), "ratio, of the rounds");
}

/// Measures three models, and the first one twice: its ratio to itself shows the machine's own noise.
void measure_models(Study& study, const std::string& table, const std::vector<Shown>& shown) {
  // The differences sought are a few per cent.
  constexpr int more_rounds = 7;
  std::vector<std::unique_ptr<TimedPlan>> timed;
  std::vector<Contender> contenders;
  for (const Shown& model : shown) {
    timed.push_back(
        std::make_unique<TimedPlan>(study.plan_of(model.stage, filtered(ssao())), model.stage.frame, study.device()));
    contenders.push_back({model.name, [plan = timed.back().get()] { return plan->run(); }});
  }
  interleaved(contenders, more_rounds * study.options().rounds,
              [&](int done, int of) { study.tell(table + ": in turn", double(done) / of); });
  for (const Column& column : columns) {
    const bool is_all = &column == &columns.front();
    const Series of_base = series_of(*timed[0], passes_named(column.passes));
    for (size_t i = 0; i < shown.size(); ++i) {
      const Series ms = series_of(*timed[i], passes_named(column.passes));
      report::PaperFigure time{table, shown[i].name, column.name, median(ms), {}, {}, {}, "the first model"};
      if (is_all) time.paper_ms = shown[i].paper_ms;
      if (i > 0) time.ratio = ratio(ms, of_base);
      if (i > 0 && time.paper_ms) time.paper_ratio = *time.paper_ms / *shown[0].paper_ms;
      study.result.times.push_back(time);
      if (is_all && i > 0) state_spread(study, table, shown[i], ms, of_base);
    }
  }
}

double share_of_surfaces(const Stage& s) {
  const Mask& mask = s.surfaces.begin()->second;
  return pixels_of(mask) / double(mask.size());
}

void table_1(Study& study, const LightFieldDisplay& display) {
  const std::string table = "Table 1: AO of one module";
  const size_t middle = middle_module(display);
  const int width = study.options().width, height = study.options().height;
  std::vector<Shown> shown;
  const auto show = [&](const Model& model, const std::string& name, std::optional<double> paper_ms) {
    study.tell(fmt::format("capturing {} with {} faces", scene, model.faces));
    shown.push_back({name, stage_of(display, scene, {{"faces", model.faces}}, width, height, {middle}), paper_ms});
  };
  for (const Model& model : models) {
    show(model, fmt::format("{} faces, for {}", model.faces, model.of), model.ms);
    const Stage& s = shown.back().stage;
    study.fact("Table 1: faces of the scene", shown.back().name, "in all", double(s.scene.faces()), "triangles");
    study.fact("Table 1: pixels that show a surface", shown.back().name, "of the module", share_of_surfaces(s),
               "share");
    study.fact("Table 1: rays in place of the z-prepass and the G-buffer, on the CPU", shown.back().name, "capture",
               1e3 * s.capture_seconds, "milliseconds");
  }
  show(models[0], fmt::format("{} faces, once more", models[0].faces), {});
  measure_models(study, table, shown);
}

// --- Section 6: points, shells, radii, the filter

constexpr std::array<const char*, 5> point_sets = {"spiral", "random", "jittered", "latin_square", "poisson_disk"};

/// The volume over which points are spread.
struct Shape {
  const char *name, *radii, *hemisphere, *inner, *range = "2";
};
constexpr std::array<Shape, 9> shapes = {{{"5 radii, half ball", "5", "on", "0"},
                                          {"5 radii, half shell", "5", "on", "0.8"},
                                          {"5 radii, ball", "5", "off", "0"},
                                          {"5 radii, shell", "5", "off", "0.8"},
                                          {"1 radius, half ball", "1", "on", "0"},
                                          {"1 radius, half shell", "1", "on", "0.8"},
                                          {"1 radius, ball", "1", "off", "0"},
                                          {"1 radius, shell", "1", "off", "0.8"},
                                          {"the paper: 5 radii, shell, any range", "5", "off", "0.8", "inf"}}};
const Shape &usual = shapes[0], &one_radius = shapes[4], &of_the_paper = shapes[8];

Asked asked_of(const Shape& shape, const char* points) {
  Asked asked = ssao();
  asked.settings = {{"radii", shape.radii},
                    {"hemisphere", shape.hemisphere},
                    {"inner", shape.inner},
                    {"range", shape.range},
                    {"points", points}};
  return asked;
}

Asked converged(Asked asked) {
  for (const auto& [name, value] : find_technique(asked.technique).converged) asked = with(asked, name, value);
  return asked;
}

void section_6_times(Study& study, const Stage& s) {
  std::vector<Entry> entries;
  for (const char* points : point_sets) {
    for (const Shape& shape : shapes)
      entries.push_back(
          {shape.name, points, filtered(asked_of(shape, points)), &s, {}, &shape == &usual && points == point_sets[0]});
  }
  measure(study,
          {.name = "Section 6: time",
           .base = fmt::format("{}, {}", usual.name, point_sets[0]),
           .parts_name = "Section 6: time of the passes",
           .parts = {{"estimate", passes_named({"estimate"})}, {"Gaussian", passes_named({"horizontal", "vertical"})}}},
          entries);
}

/// States the errors of one row and column, with or without the filter.
void state_errors(Study& study, const Stage& s, const Asked& asked, const Shape& shape, const char* points,
                  const Image& truth) {
  const char* filter = asked.plane == "ao" ? "with Gaussian" : "without Gaussian";
  const Image ao = study.images(s, asked);
  const auto state = [&](const std::string& what, double value, const std::string& unit) {
    study.fact(fmt::format("Section 6: {}, {}", what, filter), shape.name, points, value, unit);
  };
  state("RMSE to rays", study.error(s, ao, truth), "RMSE");
  state("mean difference to rays", bias(ao, truth, s.surfaces), "bias");
  state("noise, RMSE to the same of 256 points", study.error(s, ao, study.images(s, converged(asked))), "RMSE");
}

void section_6_errors(Study& study, const Stage& s, const Image& truth) {
  double done = 0;
  for (const Shape& shape : shapes) {
    for (const char* points : point_sets) {
      study.tell("section 6: errors", done++ / double(shapes.size() * point_sets.size()));
      const Asked raw = asked_of(shape, points);
      state_errors(study, s, raw, shape, points, truth);
      state_errors(study, s, filtered(raw), shape, points, truth);
    }
  }
}

struct NamedSet {
  std::string name;
  Asked asked;
};

std::vector<Panel> panels_of(const Study& study, const Stage& s, const std::vector<NamedSet>& all) {
  std::vector<Panel> panels;
  for (const NamedSet& named : all) panels.push_back({named.name, study.image(s, named.asked)});
  return panels;
}

void draw(Study& study, const Stage& s, const Image& truth) {
  const std::string module = fmt::format("AO of {}.", s.frame.views[0].name);
  const Asked as_usual = asked_of(usual, "spiral"), as_the_paper = asked_of(of_the_paper, "random");
  std::vector<Panel> estimates =
      panels_of(study, s,
                {{"lightfield-ssao", filtered(as_usual)},
                 {"lightfield-hbao+", filtered({.technique = "lightfield-hbao+", .settings = {}})},
                 {"the paper: shell, random points", filtered(as_the_paper)}});
  estimates.push_back({fmt::format("{} rays", study.options().rays), truth.begin()->second.clone()});
  study.picture("Figure 10: one module", module, "figure_10.png", estimates, 2);
  study.picture("Figure 11: before and after the Gaussian", module, "figure_11.png",
                panels_of(study, s,
                          {{"lightfield-ssao, before", as_usual},
                           {"lightfield-ssao, after", filtered(as_usual)},
                           {"the paper, before", as_the_paper},
                           {"the paper, after", filtered(as_the_paper)}}),
                2);
  study.picture(
      "Figure 13: one radius and five", module, "figure_13.png",
      panels_of(study, s, {{"1 radius", filtered(asked_of(one_radius, "spiral"))}, {"5 radii", filtered(as_usual)}}),
      2);
  std::vector<NamedSet> sets;
  for (const char* points : point_sets) sets.push_back({points, asked_of(usual, points)});
  study.picture("Section 6: how points are spread", module + " Before the Gaussian.", "section_6_points.png",
                panels_of(study, s, sets), 2);
}

std::vector<std::string> notes_of(const PaperOptions& options) {
  return {
      fmt::format("One built-in scene, `{}`, with about the faces of the paper's three models stands for them: so the "
                  "model's size alone differs. All three are on display as the first is.",
                  scene),
      "The display has 80 modules in a line behind a flat screen, as data/displays/eighty.json; where one module is "
      "measured, it is the middle one. Each module's image has the size that is stated above.",
      "gloam does not rasterise, so the paper's times without SSAO have no counterpart. Beside the paper's differences "
      "stand the times of all AO passes, filter included; the time of the rays that take the place of its G-buffer is "
      "stated apart.",
      "The paper names neither its radius nor, of its five radii, how they follow one another. Here the largest is the "
      "scene's own, and each is half of the one before.",
      fmt::format("Truths are traced with {} rays per pixel, over the whole scene within the radius, without falloff.",
                  options.rays),
      "In the whole ball a plane is half closed, and of several radii the one that takes most counts: so the paper's "
      "AO is darker than what rays find. Each pixel turns the points of the spiral its own way; of the other sets each "
      "pixel has points of its own.",
      "Section 5 has `lightfield-ssao` and `lightfield-hbao+` as they are when nothing is set. Key views are computed "
      "in full; the others take over what these show."};
}

PaperResult remake_doronin(Device& device, const PaperOptions& options) {
  Study study(device, options);
  study.result.notes = notes_of(options);
  const Settings of_the_first = {{"faces", models.front().faces}}, of_the_last = {{"faces", models.back().faces}};
  const LightFieldDisplay display = showing(eighty_modules(), scene, of_the_first);
  const size_t middle = middle_module(display);
  table_1(study, display);
  study.tell(fmt::format("capturing {}", scene));
  const Stage one = stage_of(display, scene, of_the_last, options.width, options.height, {middle});
  AoReferenceOptions rays{.samples = options.rays};
  rays.progress = [&](double share) { study.tell("rays of the middle module", share); };
  const Image truth = study.traced(one, rays);
  section_6_times(study, one);
  section_6_errors(study, one, truth);
  draw(study, one, truth);
  study.tell(fmt::format("capturing {} modules", display.modules.size()));
  neighbouring_views(study, stage_of(display, scene, of_the_last, options.width, options.height), middle, truth);
  return std::move(study.result);
}

}  // namespace

Paper doronin2017() {
  return {.name = "doronin2017",
          .title = "Screen-space ambient occlusion for light field displays (Doronin, Kara, Barsi, Martini 2017)",
          .rays = 1024,
          .reproduce = remake_doronin,
          .width = 1024,
          .height = 768};
}

}  // namespace gloam::bench
