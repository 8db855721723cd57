// The fields of bench.json in docs/benchmarking.md: result_fields [--check] docs/benchmarking.md
#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "base/files.h"
#include "gloam/error.h"
#include "results/fields.h"

namespace {

const std::string begin = "<!-- fields: build/bench/result_fields writes these tables -->\n\n",
                  end = "<!-- /fields -->\n";

/// The page with the tables as they are now.
std::string rewritten(const std::string& page, const std::string& name) {
  const size_t first = page.find(begin), last = page.find(end);
  if (first == std::string::npos || last == std::string::npos || last < first)
    throw gloam::Error("{}: has no place for the fields of bench.json", name);
  return page.substr(0, first) + begin + gloam::report::fields_as_markdown() + page.substr(last);
}

}  // namespace

int main(int count, char** words) try {
  const bool is_check = count == 3 && std::string_view(words[1]) == "--check";
  if (count != 2 && !is_check) throw gloam::Error("usage: result_fields [--check] docs/benchmarking.md");
  const std::string name = words[count - 1], page = gloam::read_text(name), now = rewritten(page, name);
  if (!is_check) gloam::write_text(name, now);
  if (is_check && page != now)
    throw gloam::Error("{}: the fields of bench.json are others; {} {}", name, words[0], name);
} catch (const gloam::Error& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
