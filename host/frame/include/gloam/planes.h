// The planes that gloam knows: their components, the channels written for them, their bounds.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// The meaning of a plane's values, for readers and for the checks that run over every technique.
struct PlaneKind {
  std::string name;                     ///< "depth"
  std::vector<std::string> components;  ///< kernel argument suffixes: {""} or {"x", "y", "z"}
  std::vector<std::string> channels;    ///< EXR channels written, one per component: "Z", or "N.X", "N.Y", "N.Z"
  float outside;                        ///< value of pixels outside all data windows, and of the row padding
  enum Meaning { value, unit_interval, unit_vector, view_depth, length } meaning;  ///< length: scene units, not below 0
  std::string help;
  std::string source = "";  ///< for messages: what makes this plane, if no technique does; may be empty
};

/// All planes with a fixed meaning, in the order in which they are shown.
const std::vector<PlaneKind>& plane_kinds();

/// The kind of a plane. A name that is not in the table has one component, a channel of the same name, and any value: a new
/// technique needs no entry here.
PlaneKind plane_kind(std::string_view name);

/// A plane with the value outside at every pixel.
Plane empty_plane(const std::string& name, const Layout& layout);

/// 4 for "ao@4", a plane of every 4th pixel of every 4th row; 1 for one of all pixels.
int resolution_in(std::string_view name);

/// Layers of one meaning that a kernel reads as one argument. In a frame each layer is a plane of its own, of one component:
/// "peel.00", "peel.01", ... A technique reads the stack: "peel".
struct StackKind {
  std::string name;  ///< "peel", "peel_color_r"
  std::string
      group;  ///< its layers' channels: "peel" with component "Z": "peel.00.Z"; "peel_color" with "R": "peel_color.00.R"
  std::string component;
  std::string help;    ///< meaning of its layers
  std::string source;  ///< for messages: what makes one ("gloam capture --peel N")
  float outside;       ///< value outside the image and of layers that are not there
  PlaneKind::Meaning meaning;
};

const std::vector<StackKind>& stack_kinds();

bool is_stack(std::string_view name);
/// Throws std::out_of_range for an unknown name.
const StackKind& stack_kind(std::string_view name);

/// The names of all planes with a fixed meaning, and of the first layers of every stack.
std::vector<std::string> all_plane_names(int layers);

/// A plane that is one layer of a stack.
struct StackLayer {
  std::string stack;
  int number;  ///< 0 to 99
};

/// None if the plane is not a layer.
std::optional<StackLayer> stack_layer(std::string_view plane);

/// The plane that a channel of a layer is, by the lower-case path before its component: ("peel_color.00", "r"): "peel_color_r.00".
/// Empty if there is none.
std::string plane_of_layer(std::string_view path, std::string_view component);

/// ("peel", 7): "peel.07".
std::string layer_name(const std::string& stack, int number);

}  // namespace gloam
