// Flags that several commands share, and the output of results.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/command_line.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "cli/flags/frame_flags.h"
#include "cli/flags/notes.h"
#include "cli/flags/technique_flags.h"
#include "exr/holdings.h"
#include "flags/typed.h"
#include "gloam/error.h"
#include "picture/picture_path.h"

namespace gloam::cli {

using Json = nlohmann::ordered_json;

/// "--compression zip", for the EXR file that a command writes.
void add_compression(CLI::App& app, std::string& name);

/// "--json FILE|-"
struct JsonFlag {
  std::string path;
  void add_to(CLI::App& app);
  /// Whether standard output gets the document and nothing else.
  bool only_json() const { return path == "-"; }
  /// The file, if any.
  std::string file() const { return only_json() ? "" : path; }
  /// Writes the document last of all files; an object gets the notes as "notes". `complete`: files that stay if writing fails; the
  /// message names them.
  void write(const Json& document, const std::vector<std::string>& complete = {}) const;
};

/// Call it before computing anything, with all files that flags name: tells the ledger of files (base/file_ledger.h), which throws if an
/// output is also an input or another output; inputs that the command finds itself it hears of where they are opened. Throws too if
/// an output's folder cannot be written to, or if it is a folder or a device itself. Empty paths are ignored. `growing`: outputs that
/// the command goes on from and writes again, such as bench.json.
void check_paths(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs,
                 const std::vector<NamedPath>& growing = {});

/// "1 file", "3 files"
std::string counted(size_t count, const char* what);

/// JSON of a plan, as documented.
Json plan_document(const Plan& plan, const std::vector<std::string>& decoded);

/// Full channel names of the planes that a plan decodes; for two files, after the file's name: "pair_L.exr: Z".
std::vector<std::string> decoded_channels(const std::vector<std::string>& planes, const FrameFiles& files);

/// Whether a plan reads anything of the frame before.
bool reads_history(const Plan& plan);

/// Adds a note for a history that no pass reads: most likely it was meant for another technique.
void check_history(const Plan& plan, const FrameFiles& files);

/// `plan_for_files`, with `check_history`.
Plan plan_for(const FrameFiles& files, const PlanRequest& request);

/// A request that goes on over time if the frame has a history, or with --temporal. Adds a note where the latter begins a sequence.
PlanRequest going_on(PlanRequest request, const FrameFiles& files, bool temporal);

/// Throws UsageError for a frame that does not end in .exr.
void check_frame_name(const std::string& path, const std::string& flag);
/// Throws UsageError for a picture that does not end in .png; an empty name is allowed.
void check_picture_name(const std::string& path, const std::string& flag);
/// Tells the ledger of files of the pictures of all views, once these are known: `check_paths` has the name on the command line alone.
void check_pictures(const NamedPath& picture, const std::vector<std::string>& views);

/// Rows of text in aligned columns; the first row is the heading. Columns from `first_number` on are aligned right. A last column of
/// text goes on in further lines where it passes the terminal's width.
void print_table(const std::vector<std::vector<std::string>>& rows, size_t first_number);

/// Prints the names of files that were written, one a line.
void print_written(const std::vector<std::string>& files);

/// name=value items as pairs; throws UsageError for items of another form.
Settings parse_settings(const std::vector<std::string>& items, const std::string& flag);

// One function per command: adds it to the app.
void add_list(CLI::App& app);
void add_info(CLI::App& app);
void add_plan(CLI::App& app);
void add_run(CLI::App& app);
void add_compare(CLI::App& app);
void add_capture(CLI::App& app);
void add_reference(CLI::App& app);
void add_bench(CLI::App& app);
void add_score(CLI::App& app);
void add_pick(CLI::App& app);
void add_auto(CLI::App& app);
void add_report(CLI::App& app);
void add_leaderboard(CLI::App& app);
void add_view(CLI::App& app);
void add_set(CLI::App& app);
void add_stress(CLI::App& app);
void add_doctor(CLI::App& app);

}  // namespace gloam::cli
