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

/// Macros are in capitals: ESTIMATE_NAME.
bool is_macro(const std::string& name) { return name.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") != std::string::npos; }

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
  return fmt::format("typedef struct {{\n{}}} {};\n", fields, parameters.type);
}

std::string with_one_kernel(const std::string& source, const std::string& kernel) {
  const std::string start = "kernel void ";
  std::istringstream lines(source);
  std::string line, out;
  while (std::getline(lines, line)) {
    if (line.rfind(start, 0) == 0) {
      const std::string name = line.substr(start.size(), line.find('(') - start.size());
      if (name != kernel && !is_macro(name)) line.replace(0, start.size(), "static void ");
    }
    out += line + "\n";
  }
  return out;
}

std::string kernel_text(const std::string& file, const std::string& kernel, const ParameterList& parameters) {
  return struct_of(parameters) + with_one_kernel(flatten(file), kernel);
}

}  // namespace gloam
