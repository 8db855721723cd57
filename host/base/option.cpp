#include "gloam/option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace gloam {
namespace {

Caller the_caller = Caller::program;

/// Options whose names are not those of their flags. Empty: the flag's name, with _ for -.
struct Spelling {
  std::string_view flag, python, program;
};

constexpr Spelling spellings[] = {
    {"camera", "", "ReadOptions::camera_file"},
    {"fov", "", "ReadOptions::fov_degrees"},
    {"depth", "depth_is", "ReadOptions::depth"},
    {"near", "", "ReadOptions::near"},
    {"far", "", "ReadOptions::far"},
    {"background", "", "ReadOptions::background"},
    {"normal-space", "", "NormalConvention::space"},
    {"normal-range", "", "NormalConvention::range"},
    {"normal-axes", "", "NormalConvention::axes"},
    {"plane", "channels", "ReadOptions::channels"},
    {"view", "views", "ReadOptions::views"},
    {"views", "", "ReadOptions::views"},
    {"frames", "", "FrameChoice::frames"},
    {"missing", "", "FrameChoice::missing"},
    {"filter", "", "PlanRequest::filter"},
    {"outputs", "", "PlanRequest::only_outputs"},
    {"with", "extras", "PlanRequest::with"},
    {"only", "", "PlanRequest::only"},
    {"elsewhere", "", "PlanRequest::elsewhere"},
    {"adaptive", "", "PlanRequest::adaptive"},
    {"resolution", "", "PlanRequest::resolution"},
    {"temporal", "", "PlanRequest::temporal"},
    {"real", "", "RunOptions::real"},
    {"set", "settings", "settings"},
    {"budget", "", "Goal::ms"},
    {"error", "", "Goal::error"},
    {"ambient", "", "ComposeOptions::ambient"},
    {"color-holds", "", "ComposeOptions::holds"},
    {"peel", "", "CaptureOptions::peel"},
};

std::string name_of_option(std::string_view flag) {
  const auto known =
      std::find_if(std::begin(spellings), std::end(spellings), [&](const Spelling& s) { return s.flag == flag; });
  const bool in_python = the_caller == Caller::python;
  if (known != std::end(spellings))
    if (const std::string_view name = in_python ? known->python : known->program; !name.empty())
      return std::string(name);
  std::string name(flag);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// A word as Python has it: in quotes, but for numbers and for capitals that stand for a value.
std::string in_python(std::string_view word) {
  const bool is_quoted = word.starts_with('\'') || word.starts_with('{');
  const bool is_number = word.find_first_not_of("0123456789.+-e") == std::string_view::npos;
  const bool is_plain =
      is_number || std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::islower(c); });
  return is_plain || is_quoted ? std::string(word) : fmt::format("'{}'", word);
}

}  // namespace

void set_caller(Caller caller) { the_caller = caller; }

std::string option(std::string_view name, std::string_view value) {
  const std::string between = value.empty() ? "" : " ";
  if (the_caller == Caller::command) return fmt::format("--{}{}{}", name, between, value);
  const std::string spelled = name_of_option(name);
  if (the_caller == Caller::python) return fmt::format("{}={}", spelled, value.empty() ? "" : in_python(value));
  return value.empty() ? spelled : fmt::format("{} = {}", spelled, value);
}

std::string channels_option(std::string_view plane, std::string_view channels) {
  if (the_caller == Caller::command) return fmt::format("--plane {}={}", plane, channels);
  if (the_caller == Caller::python) return option("plane", fmt::format("{{'{}': '{}'}}", plane, channels));
  return fmt::format("{}[\"{}\"] = {}", option("plane"), plane, channels);
}

}  // namespace gloam
