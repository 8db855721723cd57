// The comment before each kernel, held to what passes declare.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "gloam/error.h"
#include "support/kernel_runs.h"
#include "technique/kernel_sources.h"

namespace gloam::test {
namespace {

using Names = std::vector<std::string>;

/// What the passes of one kernel read, or write: by name, in how many of them.
struct Bound {
  Names names;  ///< in the order in which passes declare them
  std::map<std::string, size_t> count;

  void add(const std::string& name) {
    if (count[name]++ == 0) names.push_back(name);
  }
  /// What all of `passes` bind; then after a semicolon what some of them bind.
  std::string in_words(size_t passes) const {
    Names always, sometimes;
    for (const std::string& name : names) (count.at(name) == passes ? always : sometimes).push_back(name);
    return fmt::format("{}{}{}", fmt::join(always, ", "), sometimes.empty() ? "" : "; ", fmt::join(sometimes, ", "));
  }
};

struct Declared {
  std::string source;  ///< one of the files that have the kernel
  size_t passes = 0;
  Bound reads, writes;
};

/// By kernel, whichever files include it.
using AllDeclared = std::map<std::string, Declared>;

void add(AllDeclared& all, const PlannedPass& planned) {
  const Pass& pass = planned.pass;
  Declared& declared = all[pass.kernel];
  declared.source = source_of(*planned.technique, pass);
  ++declared.passes;
  for (const auto& [name, unused] : pass.tables) declared.reads.add(name);
  for (const auto& [name, unused] : pass.view_tables) declared.reads.add(name);
  for (const Binding& binding : pass.reads) declared.reads.add(binding.argument);
  for (const Binding& binding : pass.writes) declared.writes.add(binding.argument);
}

AllDeclared all_declared() {
  AllDeclared all;
  const Coverage coverage{.width = 8, .height = 4, .every_setting = true};
  const auto add_runs = [&](const std::vector<KernelRun>& runs) {
    for (const KernelRun& run : runs) {
      for (const PlannedPass& planned : run.plan.passes) add(all, planned);
    }
  };
  for (const Technique& technique : registry()) {
    add_runs(runs_of(technique, coverage));
    add_runs(runs_of_presets(technique, coverage));
  }
  add_runs(runs_of_plans(coverage));
  return all;
}

/// What the comment right before a kernel says after `word`, "in : " or "out: ", on one line; empty where it does not have it.
std::string said(const std::string& text, const std::string& kernel, const std::string& word) {
  std::istringstream lines(text);
  std::string found;
  bool goes_on = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("kernel void " + kernel + "(", 0) == 0) return found;
    if (line.rfind("//", 0) != 0) found.clear();
    const bool begins = line.rfind("// " + word, 0) == 0;
    goes_on = begins || (goes_on && line.rfind("//      ", 0) == 0);
    if (begins) found.clear();
    if (goes_on) found += (begins || found.empty() ? "" : " ") + line.substr(8);
  }
  return "no such kernel";
}

/// "a, b; c": the names before and after the semicolon, in any order.
std::pair<std::set<std::string>, std::set<std::string>> sorted(const std::string& words) {
  std::pair<std::set<std::string>, std::set<std::string>> names;
  std::set<std::string>* to = &names.first;
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const bool is_last = word.back() == ';';
    word.erase(word.find_last_not_of(",;") + 1);
    if (!word.empty()) to->insert(word);
    if (is_last) to = &names.second;
  }
  return names;
}

/// What the comment of a kernel in a text should say and does not; empty where it is right.
std::string wrong_comment(const std::string& text, const std::string& kernel, const Declared& declared) {
  std::string wrong;
  for (const auto& [word, bound] : {std::pair{"in : ", &declared.reads}, std::pair{"out: ", &declared.writes}}) {
    const std::string right = bound->in_words(declared.passes);
    if (sorted(said(text, kernel, word)) != sorted(right)) wrong += fmt::format("// {}{}\n", word, right);
  }
  return wrong;
}

TEST(KernelArguments, TheCommentOfEachKernelSaysWhatItsPassesDeclare) {
  const AllDeclared all = all_declared();
  EXPECT_GT(all.size(), 70u);
  for (const auto& [kernel, declared] : all)
    EXPECT_EQ(wrong_comment(flatten(declared.source), kernel, declared), "") << "is right before " << kernel;
}

TEST(KernelArguments, ACommentThatDiffersIsNoticed) {
  const auto wrong = [](const std::string& comment) {
    PlannedPass planned{.technique = &find_technique("hbao"), .pass = {.kernel = "made_up", .source = "made_up.cl"}};
    AllDeclared all;
    planned.pass.reads = {"depth", "normal"};
    planned.pass.writes = {{"result", "ao"}};
    add(all, planned);
    planned.pass.reads.push_back("wanted");
    add(all, planned);
    return wrong_comment("// in : other\n\n" + comment + "kernel void made_up(ARGUMENTS) {\n}\n", "made_up",
                         all.at("made_up"));
  };
  const std::string in = "// in : depth, normal; wanted\n", out = "// out: result\n";
  EXPECT_EQ(wrong("// A comment.\n" + in + out), "");
  EXPECT_EQ(wrong("// in : depth,\n//      normal;\n//      wanted\n" + out), "");
  EXPECT_EQ(wrong(in), out);
  EXPECT_EQ(wrong(""), in + out);
  EXPECT_EQ(wrong("// in : depth, normal, wanted\n" + out), in) << "not always";
  EXPECT_EQ(wrong("// in : depth; wanted\n" + out), in) << "missing";
  EXPECT_EQ(wrong("// in : depth, normal, roughness; wanted\n" + out), in) << "too many";
  EXPECT_EQ(wrong(in + "// out: ao\n"), out) << "the argument's name, not the plane's";
}

}  // namespace
}  // namespace gloam::test
