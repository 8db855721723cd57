#include "gloam/scene/composite_reference.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/scene/bounces_reference.h"
#include "gloam/scene/contact_reference.h"
#include "gloam/scene/environment_reference.h"
#include "gloam/scene/indirect_reference.h"
#include "gloam/scene/reflection_reference.h"
#include "scene/reference_rows.h"

namespace gloam {
namespace {

using Names = std::vector<std::string>;

/// What all references take, for a part of several.
template <typename Options>
Options options_for(const std::string& part, const CompositeReferenceOptions& all,
                    const std::function<void(double)>& progress) {
  Options options;
  if constexpr (requires { options.radius; }) options.radius = all.radius;
  options.samples = part == "reflection" ? all.reflection_samples : all.samples;
  options.seed = all.seed;
  if (!all.checkpoint.empty()) options.checkpoint = all.checkpoint.string() + "." + part;
  options.checkpoint_seconds = all.checkpoint_seconds;
  options.progress = progress;
  options.poll = all.poll;
  return options;
}

Reference trace_part(const std::string& part, const Tracer& tracer, const Frame& frame,
                     const CompositeReferenceOptions& all, const std::function<void(double)>& progress) {
  const auto options = [&]<typename Options>(Options) { return options_for<Options>(part, all, progress); };
  if (part == "ao") return ao_reference(tracer, frame, options(AoReferenceOptions()));
  if (part == "bounces") return bounces_reference(tracer, frame, options(BouncesReferenceOptions()));
  if (part == "indirect") return indirect_reference(tracer, frame, options(ReferenceOptions()));
  if (part == "reflection") return reflection_reference(tracer, frame, options(ReflectionReferenceOptions()));
  if (part == "contact") return contact_reference(tracer, frame, options(ContactReferenceOptions()));
  return environment_reference(tracer, frame, *all.environment, options(ReferenceOptions()));
}

ColorHolds holds_of(const Frame& frame, const CompositeReferenceOptions& options, Names& notes) {
  if (options.holds) return *options.holds;
  const auto stated = frame.attributes.find(color_holds_attribute);
  if (stated != frame.attributes.end() && !stated->second.empty())
    return parse_color_holds(stated->second, color_holds_attribute);
  notes.push_back(note_on_assumed_holds());
  return {};
}

/// The parts that can be traced, whether or not the picture takes them.
Names parts_of(const Scene& scene, const CompositeReferenceOptions& options) {
  Names parts = part_planes();
  if (!options.environment) std::erase(parts, "environment");
  if (scene.light.sun == glm::vec3(0)) std::erase(parts, "contact");
  return parts;
}

Composition composition_for(const Tracer& tracer, const Frame& frame, const CompositeReferenceOptions& options,
                            Names& notes) {
  const Names planes = common_planes(frame);
  if (!contains(planes, "color"))
    throw Error("reference composite: the frame has no 'color', which the picture begins with; it has {}",
                enumerate(planes));
  return composition_of(planes, parts_of(tracer.scene(), options), {holds_of(frame, options, notes), options.ambient});
}

/// Adds the planes of a part, and what its header says.
void take_part(Reference& part, Reference& result) {
  for (View& view : part.frame.views)
    for (auto& [name, plane] : view.planes)
      result.frame.view(view.name).planes.insert_or_assign(name, std::move(plane));
  result.frame.attributes.merge(part.frame.attributes);
  result.frame.numbers.merge(part.frame.numbers);
  add_new(result.notes, part.notes);
  result.rays += part.rays;
  result.seconds += part.seconds;
  result.unlike_share = std::max(result.unlike_share, part.unlike_share);
}

View composed(const View& frame, const View& parts, const Composition& composition) {
  View view = without_planes(frame);
  for (const std::string& plane : planes_to_compose())
    if (const Plane* own = frame.find(plane)) view.planes[plane] = own->clone();
  compose(view, parts, composition);
  return view;
}

/// The part with its noise added to every component.
View with_noise(const View& parts, const std::string& part) {
  View view = without_planes(parts);
  for (const auto& [name, plane] : parts.planes) view.planes[name] = plane.clone();
  const Channel& noise = parts.planes.at(part + "_noise").channels[0];
  for (Channel& channel : view.planes.at(part).channels) {
    const Layout& layout = channel.layout();
    for (int y = 0; y < layout.height; ++y)
      std::transform(channel.row(y), channel.row(y) + layout.width, noise.row(y), channel.row(y), std::plus<>());
  }
  return view;
}

/// Adds the squares of what a part's noise changes of the picture, as the mean over the components.
void add_squares(const Plane& picture, const Plane& changed, Channel& squares) {
  const Layout& layout = squares.layout();
  for (int y = 0; y < layout.height; ++y) {
    float* to = squares.row(y);
    for (int x = 0; x < layout.width; ++x) {
      float change = 0;
      for (size_t i = 0; i < picture.channels.size(); ++i)
        change += changed.channels[i].at(x, y) - picture.channels[i].at(x, y);
      change /= float(picture.channels.size());
      if (std::isfinite(change)) to[x] += change * change;
    }
  }
}

/// The noise of the picture, from the noises of its parts: squares add, as if the parts were independent.
Plane noise_of(const View& frame, const View& parts, const Plane& picture, const Composition& composition) {
  Plane noise{"color_noise", {}};
  Channel& squares = noise.channels.emplace_back(picture.channels.front().layout(), 0.0f);
  for (const ComposedPart& part : composition.parts) {
    if (!part.is_used) continue;
    const View changed = composed(frame, with_noise(parts, part.plane), composition);
    add_squares(picture, changed.planes.at("color"), squares);
  }
  const Layout& layout = squares.layout();
  for (int y = 0; y < layout.height; ++y)
    std::transform(squares.row(y), squares.row(y) + layout.width, squares.row(y), [](float s) { return std::sqrt(s); });
  return noise;
}

/// RMS over the foreground, and the largest.
void summarise_noise(const Frame& frame, Reference& result) {
  double squares = 0;
  long long count = 0;
  for (const View& view : result.frame.views) {
    const Channel &noise = view.planes.at("color_noise").channels[0],
                  &depth = frame.view(view.name).planes.at("depth").channels[0];
    for (int y = 0; y < noise.layout().height; ++y)
      for (int x = 0; x < noise.layout().width; ++x) {
        if (is_background(depth.at(x, y))) continue;
        const double value = noise.at(x, y);
        squares += value * value, ++count;
        result.largest_noise = std::max(result.largest_noise, value);
      }
  }
  result.noise = count > 0 ? std::sqrt(squares / double(count)) : 0;
}

Names used_parts(const Composition& composition) {
  Names used;
  for (const ComposedPart& part : composition.parts)
    if (part.is_used) used.push_back(part.plane);
  return used;
}

void trace_parts(const Names& parts, const Tracer& tracer, const Frame& frame, const CompositeReferenceOptions& options,
                 Reference& result) {
  for (size_t i = 0; i < parts.size(); ++i) {
    const std::function<void(double)> progress = [&, i](double share) {
      if (options.progress) options.progress((double(i) + share) / double(parts.size()));
    };
    Reference part = trace_part(parts[i], tracer, frame, options, progress);
    result.resumed_share += part.resumed_share / double(parts.size());
    take_part(part, result);
  }
}

void remove_checkpoints(const Names& parts, const CompositeReferenceOptions& options) {
  std::error_code gone;
  if (options.checkpoint.empty()) return;
  for (const std::string& part : parts) std::filesystem::remove(options.checkpoint.string() + "." + part, gone);
}

}  // namespace

Reference composite_reference(const Tracer& tracer, const Frame& frame, const CompositeReferenceOptions& options) {
  check_samples(options.samples);
  check_samples(options.reflection_samples);
  check_views(frame);
  Reference result;
  const Composition composition = composition_for(tracer, frame, options, result.notes);
  const Names parts = used_parts(composition);
  result.frame = without_planes(frame);
  trace_parts(parts, tracer, frame, options, result);
  for (const View& view : frame.views) {
    View& out = result.frame.view(view.name);
    View picture = composed(view, out, composition);
    out.planes["color_noise"] = noise_of(view, out, picture.planes.at("color"), composition);
    out.planes["color"] = std::move(picture.planes.at("color"));
    out.planes["depth"] = view.planes.at("depth").clone();
  }
  summarise_noise(frame, result);
  result.frame.attributes["gloamScene"] = tracer.scene().name;
  for (const auto& [name, text] : attributes_of(composition)) result.frame.attributes[name] = text;
  describe(result, "color", rounded_samples(options.samples),
           "the frame's color with the parts that gloamComposite names, each light once");
  add_new(result.notes, composition.notes);
  remove_checkpoints(parts, options);
  return result;
}

}  // namespace gloam
