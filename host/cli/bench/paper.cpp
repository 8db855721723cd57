#include "cli/bench/paper.h"

#include <algorithm>
#include <fstream>

#include "base/files.h"
#include "base/lists.h"
#include "cli/bench/file.h"
#include "cli/bench/subjects.h"
#include "cli/flags/options.h"
#include "gloam/error.h"
#include "papers/paper.h"
#include "papers/paper_document.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

const Paper& find_paper(const std::string& name) {
  for (const Paper& paper : papers()) {
    if (paper.name == name) return paper;
  }
  throw UsageError("--paper {}: no such paper{}; there is {}", name, suggestion(name, paper_names()),
                   enumerate(paper_names()));
}

}  // namespace

std::vector<std::string> paper_names() {
  std::vector<std::string> names;
  for (const Paper& paper : papers()) names.push_back(paper.name);
  return names;
}

void bench_paper(const PaperFlags& flags, const JsonFlag& json) {
  const Paper& paper = find_paper(flags.paper);
  Device device = flags.device.open();
  PaperOptions options{.folder = flags.folder,
                       .width = paper.width,
                       .height = paper.height,
                       .rays = paper.rays,
                       .progress = show_status};
  if (flags.size) std::tie(options.width, options.height) = *flags.size;
  options.rounds = flags.rounds;
  options.rays = flags.rays.value_or(options.rays);
  make_output_folder(options.folder);
  const std::filesystem::path document = options.folder / "bench.json", page = options.folder / (paper.name + ".md");
  check_paths({}, {{"-o", page.string()}, {"--json", json.file()}}, {{"-o", document.string()}});
  const BenchFile file(options.folder);
  const PaperResult result = paper.reproduce(device, options);
  erase_status();
  const std::string text = page_of(paper, result, options, device.info());
  write_text(page, text);
  const Json measured = document_of(result, options, device.info());
  file.write(measured);
  json.write(measured);
  if (json.only_json()) return;
  fmt::print("{}\nwrote {} and {}\n", text, printable(page.string()), printable(document.string()));
}

}  // namespace gloam::cli
