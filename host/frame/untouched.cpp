#include "frame/untouched.h"

#include <algorithm>

#include "base/lists.h"
#include "base/words.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

/// In how many pixels a plane is any light that counts, and in how many it is more than the colour in some component.
struct LightShare {
  bool is_any = false;  ///< there is light, however little
  long long lit = 0, more = 0;
  void add(const Plane& light, const Plane& color);
  bool is_other_light() const { return 2 * more > lit; }
  double percent() const { return 100 * double(more) / double(lit); }
};

void LightShare::add(const Plane& light, const Plane& color) {
  constexpr float rounding = 1.02f, noise = 1e-3f;
  const Layout& layout = color.channels.front().layout();
  std::vector<const Channel*> components;
  for (size_t i = 0; i < color.channels.size(); ++i) components.push_back(channel_for(&light, i, layout));
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      bool is_lit = false, is_more = false;
      for (size_t i = 0; i < components.size(); ++i) {
        const float value = components[i]->at(x, y);
        is_any |= value != 0;
        is_lit |= value > noise;
        is_more |= value > rounding * color.channels[i].at(x, y) + noise;
      }
      lit += is_lit, more += is_more;
    }
  }
}

LightShare share_of(const std::string& plane, const Frame& colour) {
  LightShare share;
  for (const View& view : colour.views)
    if (const Plane* light = view.find(plane)) share.add(*light, view.planes.at("color"));
  return share;
}

void drop_light(const std::vector<std::string>& planes, Frame& frame) {
  for (View& view : frame.views)
    for (const std::string& plane : planes) view.planes.erase(plane);
}

}  // namespace

const std::vector<std::string>& untouched_planes() {
  static const std::vector<std::string> planes = {"emission", "backdrop", "volume", "transmission"};
  return planes;
}

std::vector<std::string> untouched_of(const std::vector<std::string>& frame) {
  std::vector<std::string> planes = untouched_planes();
  std::erase_if(planes, [&](const std::string& plane) { return !contains(frame, plane); });
  return planes;
}

bool has_illumination(const std::vector<std::string>& frame) {
  return contains(frame, "illumination") && contains(frame, "albedo");
}

const std::vector<std::string>& planes_of_darkened_light() {
  static const std::vector<std::string> planes = [] {
    std::vector<std::string> all = untouched_planes();
    all.insert(all.end(), {"illumination", "albedo"});
    return all;
  }();
  return planes;
}

std::string called_in_file(const std::string& plane, const std::map<std::string, std::string>& names) {
  const auto name = names.find(plane);
  return name == names.end() || name->second == plane ? plane : fmt::format("{} ({})", plane, name->second);
}

std::string note_on_untouched(const std::vector<std::string>& planes, const std::map<std::string, std::string>& names) {
  std::vector<std::string> called;
  for (const std::string& plane : planes) called.push_back(called_in_file(plane, names));
  return fmt::format("{} {} not darkened, as light that occlusion does not reach; {} darkens {} too", enumerate(called),
                     planes.size() == 1 ? "is" : "are", channels_option(planes.front(), "none"), planes.front());
}

std::string note_on_illumination(const std::map<std::string, std::string>& names) {
  return fmt::format("ambient occlusion darkens {} times {}, and leaves the rest of the colour; {} darkens all of it",
                     called_in_file("illumination", names), called_in_file("albedo", names),
                     channels_option("illumination", "none"));
}

void leave_out_other_light(Frame& colour, std::vector<std::string>& notes) {
  for (const std::string& plane : untouched_planes()) {
    const LightShare share = share_of(plane, colour);
    if (!share.is_any) {
      drop_light({plane}, colour);
    } else if (share.is_other_light() && plane == "backdrop") {
      drop_light({plane}, colour);
      notes.push_back(
          fmt::format("backdrop: is more than the colour in {:.0f} % of the pixels that it lights, so it is no "
                      "part of this colour, and left out",
                      share.percent()));
    } else if (share.is_other_light()) {
      std::vector<std::string> others = untouched_planes();
      others.emplace_back("illumination");
      drop_light(others, colour);
      notes.push_back(
          fmt::format("color: {} is more than it in {:.0f} % of the pixels that it lights, so this colour is not "
                      "the sum of the passes, and occlusion darkens all of it",
                      plane, share.percent()));
      return;
    }
  }
}

const Channel* channel_for(const Plane* plane, size_t component, const Layout& layout) {
  if (!plane) return nullptr;
  const Channel& channel = plane->channels[plane->channels.size() == 1 ? 0 : component];
  if (channel.layout().width != layout.width || channel.layout().height != layout.height)
    throw Error("color is {} x {}, and {} {} x {}", layout.width, layout.height, plane->name, channel.layout().width,
                channel.layout().height);
  return &channel;
}

DarkenedLight::DarkenedLight(const View& view, size_t component)
    : layout_(view.planes.at("color").channels.front().layout()) {
  for (const std::string& plane : untouched_planes())
    if (const Channel* channel = channel_for(view.find(plane), component, layout_)) untouched_.push_back(channel);
  const Plane *illumination = view.find("illumination"), *albedo = view.find("albedo");
  if (!illumination || !albedo) return;
  illumination_ = channel_for(illumination, component, layout_);
  albedo_ = channel_for(albedo, component, layout_);
}

void DarkenedLight::untouched(int y, float* to) const {
  const int width = layout_.width;
  std::fill_n(to, width, 0.0f);
  for (const Channel* channel : untouched_) {
    const float* row = channel->row(y);
    for (int x = 0; x < width; ++x) to[x] += row[x];
  }
  for (int x = 0; x < width; ++x) to[x] = to[x] < 0 ? 0.0f : to[x];
}

void DarkenedLight::illuminated(int y, float* to) const {
  const float *illumination = illumination_->row(y), *albedo = albedo_->row(y);
  for (int x = 0; x < layout_.width; ++x) to[x] = illumination[x] * albedo[x];
}

void DarkenedLight::darkened(int y, const float* colour, float* to) const {
  const int width = layout_.width;
  untouched(y, to);
  for (int x = 0; x < width; ++x) to[x] = std::min(colour[x], std::max(colour[x] - to[x], 0.0f));
  if (!illumination_) return;
  const float *illumination = illumination_->row(y), *albedo = albedo_->row(y);
  for (int x = 0; x < width; ++x) to[x] = std::min(to[x], std::max(illumination[x] * albedo[x], 0.0f));
}

}  // namespace gloam
