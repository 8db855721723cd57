#include "cli/auto/composite.h"

#include <utility>

#include "auto/automatic.h"
#include "cli/flags/memory.h"
#include "gloam/exr_copy.h"
#include "sequence/auto_files.h"

namespace gloam::cli {
namespace {

std::array<double, 3> parse_radiance(const std::string& text, const std::string& flag) {
  const std::vector<std::string> words = split_list(text, flag);
  if (words.size() != 3)
    throw UsageError("{} {}: takes three numbers, for red, green and blue; write {} 0.5,0.6,0.8", flag, text, flag);
  std::array<double, 3> radiance{};
  for (size_t i = 0; i < 3; ++i) radiance[i] = parse_number(words[i], flag, Range<double>{0, 1e30});
  return radiance;
}

ColorHolds holds_of(const LightFlags& flags, const FrameFiles& files, std::vector<std::string>& notes) {
  return flags.holds ? *flags.holds : gloam::holds_of(files, notes);
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

void add_color_holds(CLI::App& app, std::optional<ColorHolds>& holds, const std::string& of) {
  add_parsed(app, "--color-holds", holds, parse_color_holds,
             of + "what colour holds beside direct light, so that nothing counts twice: of ambient, shadows, ao, "
                  "indirect, reflection, or none; default: as the file says, else ambient,shadows")
      ->type_name("LIST");
}

void add_ambient(CLI::App& app, std::optional<std::array<double, 3>>& ambient, const std::string& of) {
  add_parsed(app, "--ambient", ambient, parse_radiance,
             of + "radiance of an even sky, for frames without a plane 'ambient': times albedo it is what AO darkens")
      ->type_name("R,G,B");
}

void AutoCompositeFlags::add_to(CLI::App& app) {
  const char* group = "Composite";
  app.add_option("--composite", path,
                 "EXR file to write: the frame's colour with all effects, scene-linear, no light counted twice")
      ->type_name("OUT.exr")
      ->group(group);
  add_color_holds(app, light.holds);
  add_ambient(app, light.ambient);
  for (const char* flag : {"--color-holds", "--ambient"}) app.get_option(flag)->group(group);
}

ComposeOptions compose_options(const LightFlags& flags, const FrameFiles& files, std::vector<std::string>& notes) {
  if (!contains(files.common_planes(), "color")) {
    if (flags.holds)
      throw UsageError("--color-holds: {} has no colour; name it with --plane color=LAYER", files.name());
    if (flags.ambient) throw UsageError("--ambient: {} has no colour; name it with --plane color=LAYER", files.name());
    return {};
  }
  return {holds_of(flags, files, notes), flags.ambient};
}

std::optional<CompositeSource> open_composite(const AutoCompositeFlags& flags, const std::vector<std::string>& paths,
                                              const ReadOptions& options) {
  if (flags.path.empty()) return {};
  CompositeSource source{open_layer(paths, options), {}, {}, {}};
  const std::vector<std::string> available = source.layer.files.common_planes();
  for (const std::string& plane : planes_to_compose()) {
    if (contains(available, plane)) add_new(source.layer.planes, plane);
  }
  source.options = {holds_of(flags.light, source.layer.files, source.notes), flags.light.ambient};
  composition_of(available, {}, source.options);  // throws before anything is computed
  return source;
}

void leave_out(std::optional<CompositeSource>& source, const std::vector<Unfit>& unfit) {
  if (!source) return;
  for (const Unfit& each : unfit) {
    if (each.plane == "color")
      throw Error("--composite: color is unfit: {}; --plane color=CHANNELS has it taken", each.why);
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

void write_composite(const std::string& path, const Composite& composite, const std::string& compression) {
  write_frame_like(path, composite.like, composite.part, composite.picture,
                   {false, compression, composite.half_planes});
}

}  // namespace gloam::cli
