#include "technique/kernel_sources.h"

#include <set>
#include <sstream>

#include "gloam/error.h"

namespace gloam {
namespace {

/// The file named by `#include "file"`; empty for any other line.
std::string included(const std::string& line) {
  const std::string word = "#include \"";
  const size_t start = line.find(word);
  if (start == std::string::npos || line.find_first_not_of(" \t") != start) return "";
  const size_t end = line.find('"', start + word.size());
  return end == std::string::npos ? "" : line.substr(start + word.size(), end - start - word.size());
}

void append(const std::string& file, std::set<std::string>& seen, std::string& out) {
  if (!seen.insert(file).second) return;
  out += fmt::format("#line 1 \"{}\"\n", file);
  std::istringstream lines(kernel_sources().at(file));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string inner = included(line);
    if (inner.empty() || kernel_sources().count(inner) == 0) {
      out += line + "\n";  // an include for the host, or a missing file, which the kernel compiler will report
      continue;
    }
    append(inner, seen, out);
    out += fmt::format("#line {} \"{}\"\n", number + 1, file);
  }
}

}  // namespace

std::string flatten(const std::string& file) {
  std::set<std::string> seen;
  std::string out;
  if (kernel_sources().count(file) == 0) throw Error("no kernel file kernels/{}", file);
  append(file, seen, out);
  return out;
}

std::string struct_of(const ParameterList& parameters) {
  if (parameters.empty()) return "";
  std::string fields;
  for (const Parameter& parameter : parameters)
    fields += fmt::format("  {} {};\n", parameter.type == Parameter::Type::floating ? "float" : "int", parameter.name);
  return fmt::format("typedef struct {{\n{}}} Params;\n", fields);
}

std::string with_one_kernel(const std::string& source, const std::string& kernel) {
  const std::string start = "kernel void ", own = start + kernel + "(ARGUMENTS)", place = "#line ";
  std::istringstream lines(source);
  std::string out, file;
  int number = 0;
  bool drops = false;
  for (std::string line; std::getline(lines, line); ++number) {
    if (line.rfind(place, 0) == 0) {
      const size_t space = line.find(' ', place.size());
      number = std::stoi(line.substr(place.size())) - 1;
      file = line.substr(space);
    }
    drops |= line.rfind(start, 0) == 0 && line.rfind(own, 0) != 0;
    if (!drops) out += line + "\n";
    if (!drops || line != "}") continue;
    drops = false;
    out += fmt::format("#line {}{}\n", number + 1, file);
  }
  return out;
}

std::string kernel_text(const std::string& file, const std::string& kernel, const std::string& declaration) {
  return declaration + with_one_kernel(flatten(file), kernel);
}

}  // namespace gloam
