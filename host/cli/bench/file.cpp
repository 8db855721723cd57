#include "cli/bench/file.h"

#include "cli/flags/notes.h"

namespace gloam::cli {

BenchFile::BenchFile(const std::filesystem::path& folder, const report::SetFacts& set)
    : alone_(folder), file_(folder, set) {}

void BenchFile::check(const bench::Subject& subject) const {
  file_.found().check_scene({{"name", subject.name},
                             {"effect", subject.effect},
                             {"size", {subject.frame.width(), subject.frame.height()}},
                             {"radius", subject.radius.value}});
}

void BenchFile::write(const Json& measured) const {
  file_.update([&](score::Results& results) { results.put_measured(noted(measured)); });
  if (const size_t before = file_.found().measured_rows(); before > 0)
    note({fmt::format("{}: had {} of an earlier measurement, which the new ones replace", path().string(),
                      counted(before, "row"))});
}

}  // namespace gloam::cli
