// gloam compare TEST.exr REF.exr [-o difference.png]
#include <algorithm>
#include <cmath>
#include <memory>

#include "gloam/error.h"
#include "gloam/metrics.h"
#include "gloam/visualise.h"
#include "options.h"

namespace gloam::cli {
namespace {

struct CompareCommand {
  std::string test, reference, picture, frame, plane;
  FrameFlags frame_flags;
  JsonFlag json;
};

/// The plane to compare: the one asked for, else the first that both files have, results before inputs.
std::string choose_plane(const FrameFile& test, const FrameFile& reference, const std::string& asked) {
  const std::vector<std::string> a = test.common_planes(), b = reference.common_planes();
  const auto lacks = [&](const FrameFile& file, const std::vector<std::string>& planes) {
    if (!contains(planes, asked))
      throw Error("{}: no plane '{}'{}; {}", file.path().string(), asked, suggestion(asked, planes), holdings(file));
  };
  if (!asked.empty()) {
    lacks(test, a);
    lacks(reference, b);
    return asked;
  }
  for (const char* plane : {"ao", "reflection", "color", "normal", "depth"}) {
    if (contains(a, plane) && contains(b, plane)) return plane;
  }
  for (const std::string& plane : a) {
    if (contains(b, plane)) return plane;
  }
  throw Error("{} and {} have no plane in common: {}; {}", test.path().string(), reference.path().string(),
              holdings(test), holdings(reference));
}

bool ends_with_word(const std::string& stem, const std::string& word) {
  if (word.empty() || stem.size() <= word.size() || stem.compare(stem.size() - word.size(), word.size(), word) != 0)
    return false;
  return !std::isalnum((unsigned char)stem[stem.size() - word.size() - 1]);
}

using ViewPairs = std::vector<std::pair<std::string, std::string>>;

/// The view of a file of several that another file's name ends in: "truth_left" goes with "left".
std::optional<std::string> view_by_name(const FrameFile& several, const FrameFile& one) {
  for (const std::string& name : several.views()) {
    if (ends_with_word(one.path().stem().string(), name)) return name;
  }
  return {};
}

/// Pairs of views (test, reference): the only two there are; the one that a file of one view is named after; those of
/// the same name. A file's name wins over its view's: a file that lists both eyes and holds one is read as the first.
ViewPairs pair_views(const FrameFile& test, const FrameFile& reference) {
  const std::vector<std::string>&a = test.views(), &b = reference.views();
  if (a.size() == 1 && b.size() == 1) return {{a[0], b[0]}};
  const FrameFile& one = b.size() == 1 ? reference : test;
  const std::optional<std::string> named =
      a.size() == 1 || b.size() == 1 ? view_by_name(&one == &reference ? test : reference, one) : std::nullopt;
  if (named) {
    note({fmt::format("{} goes with view '{}', which its name ends in; --view chooses another",
                      one.path().filename().string(), *named)});
    return {b.size() == 1 ? std::pair(*named, b[0]) : std::pair(a[0], *named)};
  }
  ViewPairs pairs;
  for (const std::string& name : a) {
    if (contains(b, name)) pairs.emplace_back(name, name);
  }
  if (!pairs.empty()) return pairs;
  const auto words = [](const std::vector<std::string>& views) {
    return views.size() == 1 && views[0].empty() ? "one without a name" : enumerate(views);
  };
  throw Error("{} has the views {} and {} has {}; --view NAME says which to compare", test.path().string(), words(a),
              reference.path().string(), words(b));
}

/// The part of a channel that a window covers.
Channel crop(const Channel& channel, const Window& from, const Window& to) {
  Channel out{Layout(to.width(), to.height())};
  for (int y = 0; y < to.height(); ++y) {
    const float* source = channel.row(y + to.y0 - from.y0) + (to.x0 - from.x0);
    std::copy(source, source + to.width(), out.row(y));
  }
  return out;
}

/// Both frames over the same pixels: their windows, or the display window where they share one and the windows differ.
Window common_window(const FrameFile& test, const Frame& a, const FrameFile& reference, const Frame& b) {
  if (a.window == b.window) return a.window;
  if (a.display == b.display) return a.display;
  if (a.width() == b.width() && a.height() == b.height()) return {};  // same size, other origin
  throw Error("{} is {}x{} and {} is {}x{}; only images of one size can be compared", test.path().string(), a.width(),
              a.height(), reference.path().string(), b.width(), b.height());
}

Plane cropped(const Plane& plane, const Window& from, const Window& to) {
  if (to == Window{} || from == to) return plane.clone();
  Plane out{plane.name, {}};
  for (const Channel& channel : plane.channels) out.channels.push_back(crop(channel, from, to));
  return out;
}

/// Foreground by the first frame that has depth for the view; everything where none has.
Mask foreground(const std::vector<std::pair<const Frame*, std::string>>& frames, const Window& window, int width,
                int height, bool& known) {
  for (const auto& [frame, name] : frames) {
    const auto view =
        std::find_if(frame->views.begin(), frame->views.end(), [&, n = name](const View& v) { return v.name == n; });
    const Plane* depth = view == frame->views.end() ? nullptr : view->find("depth");
    if (!depth) continue;
    const Plane z = cropped(*depth, frame->window, window);
    if (z.channels[0].layout() != Layout(width, height)) continue;
    Mask mask(size_t(width) * size_t(height));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x)
        mask[size_t(y) * size_t(width) + size_t(x)] = !is_background(z.channels[0].at(x, y));
    }
    known = true;
    return mask;
  }
  known = false;
  return Mask(size_t(width) * size_t(height), 1);
}

Json metrics_document(const Metrics& m) {
  return {{"pixels", m.pixels},
          {"mae", m.mae},
          {"rmse", m.rmse},
          {"bias", m.bias},
          {"psnr", m.psnr ? Json(*m.psnr) : Json()},
          {"max", m.max},
          {"over_1_255", m.over_1_255},
          {"over_0_05", m.over_0_05},
          {"ssim", m.ssim},
          {"gmsd", m.gmsd}};
}

/// Several views as one: sums over all their pixels.
Metrics pooled(const std::vector<Metrics>& views) {
  if (views.size() == 1) return views.front();
  Metrics all;
  for (const Metrics& m : views) all.pixels += m.pixels;
  for (const Metrics& m : views) {
    const double share = double(m.pixels) / double(all.pixels);
    all.mae += share * m.mae;
    all.rmse += share * m.rmse * m.rmse;
    all.bias += share * m.bias;
    all.max = std::max(all.max, m.max);
    all.over_1_255 += share * m.over_1_255;
    all.over_0_05 += share * m.over_0_05;
    all.ssim += share * m.ssim;
    all.gmsd += share * m.gmsd;
  }
  all.rmse = std::sqrt(all.rmse);
  if (all.rmse > 0) all.psnr = -20 * std::log10(all.rmse);
  return all;
}

void print_metrics(const std::string& view, const Metrics& m) {
  if (!view.empty()) fmt::print("view {}\n", view);
  print_table({{"pixels", std::to_string(m.pixels)},
               {"RMSE", fmt::format("{:.5f}", m.rmse)},
               {"MAE", fmt::format("{:.5f}", m.mae)},
               {"bias", fmt::format("{:+.5f}  ({})", m.bias,
                                    m.bias > 0   ? "too bright"
                                    : m.bias < 0 ? "too dark"
                                                 : "none")},
               {"PSNR", m.psnr ? fmt::format("{:.2f} dB", *m.psnr) : "identical"},
               {"max", fmt::format("{:.5f}", m.max)},
               {"over 1/255", fmt::format("{:.2f} %", 100 * m.over_1_255)},
               {"over 0.05", fmt::format("{:.2f} %", 100 * m.over_0_05)},
               {"SSIM", fmt::format("{:.4f}", m.ssim)},
               {"GMSD", fmt::format("{:.4f}", m.gmsd)}},
              2);
}

void compare_command(const CompareCommand& flags) {
  check_picture_name(flags.picture, "-o");
  const ReadOptions reading = flags.frame_flags.read_options();
  FrameFile test(flags.test, reading);
  ReadOptions reference_reading = reading;
  reference_reading.channels.clear();
  if (!reading.views.empty()) {
    // A reference of one unnamed view has no view to choose from.
    ReadOptions any = reference_reading;
    any.views.clear();
    const FrameFile look(flags.reference, any);
    if (look.views().size() == 1) reference_reading.views.clear();
  }
  FrameFile reference(flags.reference, reference_reading);
  const std::string plane = choose_plane(test, reference, flags.plane);
  const auto pairs = pair_views(test, reference);
  const auto with_depth = [&](const FrameFile& file, std::vector<std::string> planes) {
    if (contains(file.common_planes(), "depth") && !contains(planes, "depth")) planes.push_back("depth");
    return planes;
  };
  const Frame a = test.read(with_depth(test, {plane})), b = reference.read(with_depth(reference, {plane}));
  Frame extra;
  if (!flags.frame.empty()) {
    FrameFile file(flags.frame, reading);
    if (!contains(file.common_planes(), "depth"))
      throw Error("{}: no depth to tell the background by; {}", flags.frame, holdings(file));
    extra = file.read({"depth"});
  }
  const Window window = common_window(test, a, reference, b);
  std::vector<Metrics> all;
  Json views = Json::object();
  bool background_known = false;
  std::vector<std::string> pictures;
  for (const auto& [name, reference_name] : pairs) {
    const Plane left = cropped(*a.view(name).find(plane), a.window, window);
    const Plane right = cropped(*b.view(reference_name).find(plane), b.window, window);
    const Layout layout = left.channels[0].layout();
    // --frame first, since the user named it.
    const Mask mask = foreground({{&extra, name}, {&a, name}, {&b, reference_name}}, window, layout.width,
                                 layout.height, background_known);
    all.push_back(compare(left, right, mask));
    views[name] = metrics_document(all.back());
    if (!flags.picture.empty()) {
      const std::filesystem::path path = picture_path(flags.picture, name, pairs.size() > 1);
      write_difference_picture(path, left, right, mask, all.back(),
                               {test.path().filename().string(), reference.path().filename().string(), 0});
      pictures.push_back(path.string());
    }
  }
  if (!background_known) note({"no depth in either file: every pixel counts; --frame FRAME.exr tells the background"});
  Json document = metrics_document(pooled(all));
  document["plane"] = plane;
  if (pairs.size() > 1) document["views"] = views;
  flags.json.write(document);
  if (flags.json.only_json()) return;
  fmt::print("{}: {} against {} (test - truth)\n", plane, flags.test, flags.reference);
  for (size_t i = 0; i < all.size(); ++i) print_metrics(pairs.size() > 1 ? pairs[i].first : "", all[i]);
  for (const std::string& path : pictures) fmt::print("wrote {}\n", path);
}

}  // namespace

void add_compare(CLI::App& app) {
  auto flags = std::make_shared<CompareCommand>();
  CLI::App* command = app.add_subcommand("compare", "how far an image is from the truth: figures and a picture");
  command->add_option("test", flags->test, "EXR file, such as gloam run writes")->required()->type_name("TEST.exr");
  command->add_option("reference", flags->reference, "EXR file with the truth")->required()->type_name("REF.exr");
  command->add_option("-o,--output", flags->picture, "picture of test, truth, difference and histogram")
      ->type_name("DIFFERENCE.png");
  command->add_option("--what", flags->plane, "plane to compare; default: the first that both have, results first")
      ->type_name("PLANE");
  command->add_option("--frame", flags->frame, "frame whose depth tells the background")->type_name("FRAME.exr");
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Background never counts. Examples:\n"
      "  gloam compare ao.exr truth.exr -o difference.png\n"
      "  gloam compare ao.exr truth_left.exr --view left --json -\n"
      "  gloam compare ao.exr truth.exr --what ao_raw --plane ao_raw=AO_raw");
  command->callback([flags] { compare_command(*flags); });
}

}  // namespace gloam::cli
