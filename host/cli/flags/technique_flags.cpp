#include "cli/flags/technique_flags.h"

#include <map>

#include "cli/flags/options.h"
#include "cli/flags/wrap.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "run/kept_folders.h"
#include "run/kernel_cache.h"
#include "technique/variant_words.h"

namespace gloam::cli {
namespace {

/// "bent_normal (mean unoccluded direction, view space), by bitmask and gtao; cone (...), by the same". A variant makes what its method
/// makes, and is not named.
std::string extras_in_words() {
  std::map<std::string, std::vector<std::string>> makers;
  for (const Technique& t : registry()) {
    for (const std::string& plane : t.extras)
      if (t.variant.of.empty()) makers[plane].push_back(t.name);
  }
  std::vector<std::string> words;
  std::string last;
  for (const auto& [plane, names] : makers) {
    const std::string by = enumerate(names);
    words.push_back(fmt::format("{} ({}), by {}", plane, plane_kind(plane).help, by == last ? "the same" : by));
    last = by;
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

/// To a person who waits: a first run takes seconds, in which nothing moves. Kernels that are kept say that it was told.
void tell_of_first_run(const DeviceInfo& info) {
  if (!shows_progress() || !keeps_no_kernels_yet(info)) return;
  const std::string text = fmt::format(
      "first run on '{}': kernels are compiled, about a second for each that a technique has, and kept: later runs "
      "start at "
      "once",
      printable(info.name));
  fmt::print(stderr, "{}\n", wrapped(text, 0, 2));
  std::fflush(stderr);
}

}  // namespace

void VariantFlags::add_to(CLI::App& app) {
  const Heading heading(app, "Technique");
  add_choice(
      app, "--layers", layers, layers_words,
      "which depths a technique reads: the one that is seen, stochastic or peeled layers; default: as its name says");
  add_choice(app, "--eyes", both_eyes, eyes_words,
             "both: for two views that agree on what both of them see; default: as the technique's name says");
}

void TechniqueFlags::add_to(CLI::App& app, bool with_mask) {
  const Heading heading(app, "Technique");
  add_text(app, "--set", settings, "NAME=VALUE",
           "set a parameter; --radius 0.3 is short for --set radius=0.3 (repeatable)")
      ->expected(1)
      ->take_all();
  add_text(app, "--preset", preset, "NAME", "low, medium, high or ultra, where the technique has presets");
  add_text(app, "--filter", filter, "NAME", "the technique that follows, or none; default: what the technique names");
  add_text(app, "--with", with, "A,B", "planes to make beside the usual ones: " + extras_in_words());
  add_choice(app, "--resolution", resolution, resolution_words,
             "estimate and filter every pixel, every 2nd or every 4th each way, then upsample");
  add_text(
      app, "--adaptive", adaptive, "NAME",
      "spend samples where AO varies: a first, coarse pass finds the tiles where it hardly does, and these get this "
      "cheaper preset: --preset ultra --adaptive medium");
  if (!with_mask) return;
  add_text(
      app, "--only", only, "MASK",
      "save time: compute only where this mask is above 0, and leave the rest open (AO of 1); a technique that makes "
      "a mask, such as corner-mask, where something near may occlude, or a plane of the frame");
  app.add_flag("--temporal", temporal,
               "AO and reflections become means over the frames of a sequence that showed each surface; a frame by "
               "itself goes on "
               "from --history");
  add_text(
      app, "--elsewhere", elsewhere, "TECHNIQUE",
      "with --only: a second, cheaper technique for the pixels that the mask leaves out, which stay open otherwise: "
      "run sd-gtao --only hidden-mask --elsewhere gtao");
  variant.add_to(app);
}

PlanRequest TechniqueFlags::request(const std::vector<std::string>& outputs) const {
  PlanRequest request{.outputs = outputs, .filter = filter, .preset = preset};
  request.settings = parse_settings(settings, "--set");
  request.only = only;
  request.elsewhere = elsewhere;
  request.adaptive = adaptive;
  if (!with.empty()) request.with = split_list(with, "--with");
  request.resolution = resolution;
  return request;
}

void DeviceFlags::add_to(CLI::App& app, const std::string& group) {
  add_text(app, "--device", device, "TEXT", "part of a device's or platform's name (gloam list devices)")->group(group);
  app.add_flag("--no-tuning", no_tuning, "lanes and groups as for any device of its kind, not as gloam doctor measured")
      ->group(group);
}

Device DeviceFlags::open() const {
  Device opened(device, !no_tuning);
  tell_of_first_run(opened.info());
  if (const std::string foreign = foreign_folders_note(); !foreign.empty()) note({foreign});
  return opened;
}

std::string DeviceFlags::as_text() const {
  return (device.empty() ? "" : " --device " + quoted_for_shell(device)) + (no_tuning ? " --no-tuning" : "");
}

void RunFlags::add_to(CLI::App& app) {
  const Heading heading(app, "Device");
  DeviceFlags::add_to(app, "Device");
  add_choice(
      app, "--lanes", lanes, {{"auto", 0}, {"1", 1}, {"4", 4}, {"8", 8}, {"16", 16}},
      "pixels that one work-item computes together, by a CPU's vector instructions (a GPU: 1); it changes the time, "
      "and with --math fast the last digits; auto: what suits the device");
  add_choice(app, "--math", math, math_words, "precise: the same bits at every lane width; default fast");
  add_choice(app, "--real", real, real_words, "what kernels compute in; default float");
  add_number(app, "--seed", seed, allowed_seeds, "of the random numbers; default: 0, or one more than --history had",
             "N");
  add_number(app, "--repeat", repeat, {1, 10000}, "timed runs; more than one: after a warm-up", "N");
}

RunOptions RunFlags::run_options() const {
  RunOptions options;
  options.lanes = lanes;
  options.math = math;
  options.real = real;
  options.seed = seed.value_or(options.seed);
  options.repeat = repeat;
  return options;
}

}  // namespace gloam::cli
