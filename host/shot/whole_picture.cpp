#include "shot/whole_picture.h"

#include <utility>

#include "auto/automatic.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/exr_copy.h"
#include "gloam/option.h"
#include "sequence/auto_files.h"
#include "shot/memory.h"

namespace gloam {
namespace {

ColorHolds holds_of(const LightChoice& light, const FrameFiles& files, std::vector<std::string>& notes) {
  return light.holds ? *light.holds : gloam::holds_of(files, notes);
}

/// The names of effects that read colour.
std::vector<std::string> effects_of_colour() {
  std::vector<std::string> names;
  for (const Technique* technique : techniques_with_effects()) {
    if (contains(technique->reads, "color")) add_new(names, technique->effect.name);
  }
  return names;
}

ColourLayer open_layer(const std::vector<std::string>& paths, const ReadOptions& options) {
  try {
    return open_colour(paths, options);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw Error("{}; without colour, effects fall away too: {}", error.what(), enumerate(effects_of_colour()));
  }
}

}  // namespace

ComposeOptions compose_options(const LightChoice& light, const FrameFiles& files, std::vector<std::string>& notes) {
  if (!contains(files.common_planes(), "color")) {
    if (light.holds || light.ambient)
      throw UsageError("{}: {} has no colour; name it with {}", option(light.holds ? "color-holds" : "ambient"),
                       files.name(), channels_option("color", "LAYER"));
    return {};
  }
  return {holds_of(light, files, notes), light.ambient, {}};
}

std::optional<CompositeSource> open_composite(const std::optional<LightChoice>& light,
                                              const std::vector<std::string>& paths, const ReadOptions& options) {
  if (!light) return {};
  CompositeSource source{open_layer(paths, options), {}, {}, {}};
  const std::vector<std::string> available = source.layer.files.common_planes();
  for (const std::string& plane : planes_to_compose()) {
    if (contains(available, plane)) add_new(source.layer.planes, plane);
  }
  source.options = {holds_of(*light, source.layer.files, source.notes), light->ambient,
                    names_of_light(source.layer.files)};
  add_new(source.notes, notes_on_cryptomattes(source.layer.files.files().front().path()));
  composition_of(available, {}, source.options);  // throws before anything is computed
  return source;
}

void leave_out(std::optional<CompositeSource>& source, const std::vector<Unfit>& unfit) {
  if (!source) return;
  for (const Unfit& each : unfit) {
    if (each.plane == "color")
      throw Error("{}: color is unfit: {}; {} has it taken", option("composite"), each.why,
                  channels_option("color", "CHANNELS"));
  }
  source->layer.planes = fit_planes(source->layer.planes, unfit);
}

unsigned long long bytes_of(const std::optional<CompositeSource>& source) {
  return source ? bytes_to_read(source->layer.files, source->layer.planes) : 0;
}

void read_colour(CompositeSource& source) { source.colour = read_layer(source.layer, source.notes); }

Composite make_composite(CompositeSource& source, const Frame& computed) {
  Composite composite;
  composite.like = source.layer.files.files().front().path().string();
  composite.part = source.layer.part;
  composite.half_planes = source.layer.half_planes;
  composite.picture = std::move(source.colour);
  composite.composition = compose(composite.picture, computed, source.options);
  composite.composition.notes.insert(composite.composition.notes.begin(), source.notes.begin(), source.notes.end());
  keep_planes(composite.picture, {"color", "alpha"});
  composite.picture.attributes = computed.attributes;
  composite.picture.attributes.merge(attributes_of(composite.composition));
  return composite;
}

void write_composite(const std::string& path, const Composite& composite, const WriteOptions& writing) {
  write_frame_like(
      path, composite.like, composite.part, composite.picture,
      {.compression = writing.compression, .half_planes = composite.half_planes, .keeps_margin = writing.keeps_margin});
}

}  // namespace gloam
