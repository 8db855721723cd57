#include "plan/stacks.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "base/lists.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// All layers up to the last available one, front to back.
std::vector<std::string> layers_of(const std::string& stack, const std::vector<std::string>& available) {
  int last = 0;
  for (const std::string& plane : available) {
    const std::optional<StackLayer> layer = stack_layer(plane);
    if (layer && layer->stack == stack) last = std::max(last, layer->number);
  }
  std::vector<std::string> layers;
  for (int number = 0; number <= last; ++number) layers.push_back(layer_name(stack, number));
  return layers;
}

std::string layer_count_define(const Binding& binding) { return upper_case(binding.argument) + "_LAYERS"; }

/// Number of layers of a stack that the frame has or an earlier pass writes.
int layers_at_hand(const Plan& plan, const std::string& stack) {
  if (const auto known = plan.stacks.find(stack); known != plan.stacks.end()) return int(known->second.size());
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& written : planned.pass.writes) {
      if (written.plane == stack) return written.layers;
    }
  }
  return 0;
}

[[noreturn]] void throw_too_few_layers(const Technique& technique, const Binding& binding, int layers, bool are_made) {
  const std::string few = fmt::format("{}: needs {} layers of '{}', and there are {}; ", technique.name, binding.layers,
                                      binding.plane, layers);
  if (are_made) throw UsageError("{}make more, or ask for fewer", few);
  throw MissingPlanes(few + stack_kind(binding.plane).source + " makes them", {layer_name(binding.plane, layers)});
}

}  // namespace

std::string upper_case(std::string name) {
  for (char& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::vector<std::string> with_stacks(std::vector<std::string> planes) {
  for (const StackKind& stack : stack_kinds()) {
    if (contains(planes, layer_name(stack.name, 0))) add_new(planes, stack.name);
  }
  return planes;
}

void take_inputs(Plan& plan, const std::vector<std::string>& inputs, const std::vector<std::string>& available,
                 std::vector<std::string>& missing) {
  for (const std::string& input : inputs) {
    if (is_stack(input)) plan.stacks[input] = layers_of(input, available);
    for (const std::string& plane : is_stack(input) ? plan.stacks[input] : std::vector<std::string>{input}) {
      add_new(plan.inputs, plane);
      if (!contains(available, plane)) add_new(missing, plane);
    }
  }
}

void define_layers(Pass& pass, const Plan& plan, const Technique& technique) {
  for (const Binding& binding : pass.reads) {
    if (!is_stack(binding.plane)) continue;
    const int layers = layers_at_hand(plan, binding.plane);
    if (binding.layers > layers)
      throw_too_few_layers(technique, binding, layers, plan.stacks.count(binding.plane) == 0);
    pass.defines.emplace_back(layer_count_define(binding), binding.layers > 0 ? binding.layers : layers);
  }
}

void trim_stacks(Plan& plan) {
  for (auto& [stack, layers] : plan.stacks) {
    size_t needed = 0;
    for (const PlannedPass& planned : plan.passes) {
      for (const Binding& binding : planned.pass.reads) {
        if (binding.plane == stack)
          needed = std::max(needed, binding.layers > 0 ? size_t(binding.layers) : layers.size());
      }
    }
    for (size_t i = needed; i < layers.size(); ++i) std::erase(plan.inputs, layers[i]);
    layers.resize(needed);
  }
  std::erase_if(plan.stacks, [](const auto& stack) { return stack.second.empty(); });
}

}  // namespace gloam
