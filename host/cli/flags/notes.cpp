#include "cli/flags/notes.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <mutex>

#include "base/lists.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

std::vector<std::string> kept_notes;
std::mutex kept_notes_mutex;
bool quiet = false;

}  // namespace

void add_quiet_flag(CLI::App& command) {
  command.add_flag("-q,--quiet", quiet, "no notes and no progress on standard error; errors are still told")
      ->group("Writing");
}

bool is_quiet() { return quiet; }

void note(const std::vector<std::string>& notes) {
  const std::lock_guard lock(kept_notes_mutex);
  add_new(kept_notes, notes);
}

std::vector<std::string> notes_so_far() {
  const std::lock_guard lock(kept_notes_mutex);
  return kept_notes;
}

nlohmann::ordered_json noted(nlohmann::ordered_json document) {
  if (document.is_object() && !document.contains("notes")) document["notes"] = notes_so_far();
  return document;
}

void print_notes() {
  if (quiet) return;
  for (const std::string& note : notes_so_far()) {
    std::fputs(("note: " + printable(note) + "\n").c_str(), stderr);  // a closed standard error is no failure
  }
}

bool shows_progress() { return !quiet && isatty(STDERR_FILENO); }

std::function<void(int, int)> progress_bar() {
  if (!shows_progress()) return {};
  const auto start = std::chrono::steady_clock::now();
  return [start](int done, int of) {
    if (std::chrono::steady_clock::now() - start < std::chrono::seconds(1)) return;
    const int width = 40, filled = int(double(width) * done / of);
    fmt::print(stderr, "\r[{:=<{}}{:<{}}] {}/{}{}", "", filled, "", width - filled, done, of,
               done == of ? "\r\033[K" : "");
    std::fflush(stderr);
  };
}

}  // namespace gloam::cli
