// Writes the kernels of all techniques and plans, with the options that they are compiled with, for tests/spirv/check.
#include "run/kernels.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <vector>

#include "gloam/error.h"
#include "measure/floors.h"
#include "measure/naive.h"
#include "plan/layouts.h"
#include "run/arguments.h"
#include "support/kernel_runs.h"
#include "support/long.h"

namespace gloam::test {
namespace {

// What OpenCL 1.2 promises of every device in its full profile, bytes: CL_DEVICE_MAX_PARAMETER_SIZE and
// CL_DEVICE_MAX_CONSTANT_BUFFER_SIZE.
constexpr size_t parameters_promised = 1024, constants_promised = 64 << 10;

/// A kernel with the constants that some plan compiles it with, and its text.
struct Constants {
  std::string name, text;
  PlannedPass planned;
};

/// The largest of all kernels, bytes.
struct Sizes {
  size_t arguments = 0, table = 0;
};

/// Kernels by file, name and constants: each once, whichever plans have it.
struct Kernels {
  std::map<std::string, Constants> all;
  Sizes largest;
};

/// Precise mathematics on a device that has all options.
std::string options_of(const PlannedPass& planned, const RunOptions& options) {
  return build_options(planned, {.rounds_correctly = true}, options, {.lanes = options.lanes});
}

/// Bytes of a kernel's arguments in double precision and with pointers of 64 bits.
size_t argument_bytes(const PlannedPass& planned, const std::vector<Argument>& arguments) {
  constexpr size_t frame = 4 * sizeof(int) + 6 * sizeof(double), neighbour = frame + 12 * sizeof(double);
  size_t bytes = 0;
  for (const Argument& argument : arguments) {
    bytes += argument.type == "Frame"       ? frame
             : argument.type == "Neighbour" ? neighbour
             : argument.type == "Params"    ? 4 * planned.technique->parameters.size()
                                            : 8;
  }
  return bytes;
}

/// Throws Error for a pass whose arguments or tables are larger than every device takes.
void check_sizes(const PlannedPass& planned, const std::vector<Argument>& arguments, Sizes& largest) {
  const size_t bytes = argument_bytes(planned, arguments);
  if (bytes > parameters_promised)
    throw Error("{}: {} bytes of arguments; not every device takes more than {}", planned.label(), bytes,
                parameters_promised);
  largest.arguments = std::max(largest.arguments, bytes);
  for (const auto& [name, numbers] : planned.pass.tables) {
    const size_t table = numbers.size() * sizeof(float);
    if (table > constants_promised)
      throw Error("{}: a table of {} bytes; not every device takes more than {}", planned.label(), table,
                  constants_promised);
    largest.table = std::max(largest.table, table);
  }
}

void add_kernels(Kernels& kernels, const std::vector<KernelRun>& runs) {
  for (const KernelRun& each : runs) {
    const Layouts layouts(each.plan, each.frame.views[0].planes.begin()->second.channels[0].layout());
    for (const PlannedPass& planned : each.plan.passes) {
      check_sizes(planned, declared_arguments(planned, layouts), kernels.largest);
      const std::string name = source_of(*planned.technique, planned.pass) + " " + planned.pass.kernel;
      const std::string declaration = declaration_of(planned, layouts);
      const auto [added, is_new] =
          kernels.all.try_emplace(name + declaration + options_of(planned, {.lanes = 1}), Constants{name, "", planned});
      if (is_new) added->second.text = kernel_text(planned, layouts);
    }
  }
}

Kernels all_kernels() {
  Kernels kernels;
  const Coverage coverage{.width = 8, .height = 4, .every_setting = true};
  for (const Technique& technique : registry()) {
    add_kernels(kernels, runs_of(technique, coverage));
    add_kernels(kernels, runs_of_presets(technique, coverage));
  }
  add_kernels(kernels, runs_of_plans(coverage));
  return kernels;
}

/// How a kernel is compiled: for which target, with which options of a run.
struct Way {
  const char* target;
  RunOptions options;
};

/// What GPUs get by default.
const Way usual{"spir64", {.lanes = 1}};

/// Each target, precision, mode and number of lanes once or more.
std::vector<Way> further_ways() {
  return {{"spir64", {.math = Math::precise, .lanes = 1}},
          {"spir64", {.math = Math::precise, .real = Real::float64, .lanes = 1}},
          {"spir", {.lanes = 1}},
          {"spir64", {.lanes = 4}},
          {"spir", {.math = Math::precise, .lanes = 8}},
          {"spir64", {.lanes = 16}},
          {"spir64", {.real = Real::float64, .lanes = 8}},
          {"spir64", {.lanes = 1, .gathers_only = true}}};
}

/// Every `n`-th of the sets of constants of one kernel, so that at most so many are left; in the long run all.
std::vector<const Constants*> some_of(const std::vector<const Constants*>& all) {
  constexpr size_t most = 4;
  if (is_long_run() || all.size() <= most) return all;
  std::vector<const Constants*> some;
  for (size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

/// Writes texts and "list", a line for each compilation, into a folder.
class Listing {
 public:
  explicit Listing(const std::string& folder) : folder_(folder), list_(folder + "/list") {}

  void add(const std::string& text, const Way& way, const std::string& options) {
    list_ << fmt::format("{} {} {} {} {}\n", add_text(text), way.target, way.options.lanes,
                         way.options.real == Real::float64 ? "double" : "float", options);
  }

 private:
  /// Returns the text's file.
  std::string add_text(const std::string& text) {
    const auto [known, is_new] = names_.try_emplace(text, fmt::format("{}.cl", names_.size() + 1));
    if (is_new) std::ofstream(folder_ + "/" + known->second) << text;
    return known->second;
  }

  std::string folder_;
  std::ofstream list_;
  std::map<std::string, std::string> names_;  ///< files by text
};

/// Lists the kernels that `gloam bench` compares with.
void list_baselines(Listing& listing) {
  std::vector<bench::KernelText> texts = bench::naive_texts();
  for (bench::KernelText& floor : bench::floor_texts({.lanes = 1})) texts.push_back(std::move(floor));
  for (const bench::KernelText& each : texts) listing.add(each.text, usual, each.options);
}

/// Lists the kernels whose number, divided by `parts`, leaves `part`.
void list_kernels(const std::string& folder, size_t part, size_t parts) {
  const Kernels kernels = all_kernels();
  std::map<std::string, std::vector<const Constants*>> by_name;
  for (const auto& [unused, constants] : kernels.all) by_name[constants.name].push_back(&constants);
  Listing listing(folder);
  size_t number = 0;
  for (const auto& [unused, all] : by_name) {
    if (number++ % parts != part) continue;
    const std::vector<const Constants*> some = some_of(all);
    for (const Constants* constants : some)
      listing.add(constants->text, usual, options_of(constants->planned, usual.options));
    for (const Way& way : further_ways()) {
      for (const Constants* constants : some) {
        listing.add(constants->text, way, options_of(constants->planned, way.options));
        if (!is_long_run()) break;
      }
    }
  }
  if (part == 0) list_baselines(listing);
  std::printf(
      "%zu kernels with %zu sets of constants, of which this is part %zu of %zu\n"
      "at most %zu bytes of arguments and %zu of a table\n",
      by_name.size(), kernels.all.size(), part + 1, parts, kernels.largest.arguments, kernels.largest.table);
}

}  // namespace
}  // namespace gloam::test

/// Arguments: a folder, the part of the kernels, the number of parts.
int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    gloam::test::list_kernels(argv[1], size_t(std::atoi(argv[2])), size_t(std::atoi(argv[3])));
  } catch (const gloam::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
