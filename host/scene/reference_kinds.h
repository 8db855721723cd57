// All kinds of reference: what the command and the Python module ask for by name.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/color_holds.h"
#include "gloam/environment_map.h"
#include "gloam/parameters.h"
#include "gloam/scene/reference.h"

namespace gloam {

/// What a user asks for, by flags or keywords; empty: not given.
struct ReferenceRequest {
  std::string what;  ///< a name of `reference_kinds`
  std::optional<int> samples;
  std::optional<double> radius;  ///< scene units; may be infinite
  std::string falloff = "none";
  Settings falloff_settings = {};  ///< {"hbao+.bias", "0.2"}
  std::optional<int> bounces;
  std::optional<double> length;  ///< scene units; may be infinite
  std::optional<glm::dvec3> light_direction = {}, light_position = {};
  std::optional<double> light_angle;  ///< degrees
  std::string environment;            ///< path of a lat-long map
  std::optional<EnvironmentAxes> environment_axes;
  std::optional<double> environment_turn;  ///< degrees
  std::optional<ColorHolds> color_holds;
  std::optional<std::array<double, 3>> ambient;  ///< radiance
};

/// How a user spells an option's name: "light_angle" as "--light-angle" or as it is.
using OptionSpelling = std::function<std::string(const std::string& name)>;
std::string as_flag(const std::string& name);
std::string as_keyword(const std::string& name);

/// A request made ready to trace frames.
struct ReferenceJob {
  std::string plane;  ///< where the kind's is of another name than the kind
  std::vector<std::string> reads;
  std::string heading;                                            ///< "falloff none"
  std::map<std::string, std::string> words;                       ///< settings, for JSON
  std::map<std::string, double> numbers = {};                     ///< likewise
  std::string identity = {};                                      ///< of files that were read, by what is in them
  std::string noise_from = "two independent halves of the rays";  ///< for people
  bool has_radius = true;
  std::optional<double> radius;  ///< given; of contact the length
  /// `options`: with the radius of this frame, a seed, a checkpoint and what to call; its samples do not count.
  std::function<Reference(const Tracer& tracer, const Frame& frame, const ReferenceOptions& options)> trace;
};

/// A kind of reference.
struct ReferenceKind {
  std::string name;                  ///< of its plane; of `composite` that is color
  std::string help;                  ///< one line
  int samples;                       ///< default
  std::vector<std::string> options;  ///< that not all kinds take
  ReferenceJob (*job)(const ReferenceRequest& request, const OptionSpelling& spelled);
};

/// In the order in which they are shown.
const std::vector<ReferenceKind>& reference_kinds();
std::vector<std::string> reference_names();

/// Throws UsageError for an unknown kind (with the nearest name), and for options that the kind does not take or that are not allowed.
ReferenceJob job_of(const ReferenceRequest& request, const OptionSpelling& spelled);

}  // namespace gloam
