// A technique's parameters, written once as a list and used three times: as the host's struct with defaults, for the check of its
// size, and as the table behind flags, JSON, range errors, docs and the kernels' struct.
//
//   #define NAME_PARAMS(P)
//     P(float,  radius,     0.5f, 0, INFINITY, "scene units", "reach of an occluder")
//     P(int,    directions, 8, 1, 32, "", "directions searched per pixel")
//     P(bool,   jitter,     on, "turn the directions from pixel to pixel")
//     P(file,   points,     "a file with points of your own; none: those that are built in")
//     P(choice, falloff,    quadratic, (quadratic, none), "how an occluder fades towards the radius")
//   PARAMS(NameParams, NAME_PARAMS)
//
// Kernels name the struct Params, whichever technique runs. The host writes it before a kernel's text, from the table (struct_of,
// technique/kernel_sources.h): OpenCL C has no variadic macros, without which a list of entries of different lengths cannot become a struct.
// Every value is a 4-byte scalar, so that both sides agree on the layout; bool and choice are ints, and a file is the number of its
// name (file_name, gloam/parameters.h), which only the host reads.
#ifndef GLOAM_PARAMS_H
#define GLOAM_PARAMS_H

#ifdef __OPENCL_C_VERSION__

#define PARAMS(Type, LIST)

#else

#include <cmath>

#include "gloam/parameters.h"

#define PARAM_ONE(...) +1
#define PARAM_CHOICES(...) __VA_ARGS__
#define PARAM_FIELD_float(name, value, ...) float name = value;
#define PARAM_FIELD_int(name, value, ...) int name = value;
#define PARAM_FIELD_bool(name, value, ...) int name = ::gloam::value;
#define PARAM_FIELD_choice(name, value, choices, ...) \
  struct name##_values {                              \
    enum { PARAM_CHOICES choices };                   \
  };                                                  \
  int name = name##_values::value;
#define PARAM_FIELD_file(name, ...) int name = 0;
#define PARAM_FIELD(type, name, ...) PARAM_FIELD_##type(name, __VA_ARGS__)

#define PARAM_ENTRY_float(name, value, min, max, unit, help) \
  ::gloam::float_parameter(#name, value, min, max, unit, help)
#define PARAM_ENTRY_int(name, value, min, max, unit, help) ::gloam::int_parameter(#name, value, min, max, unit, help)
#define PARAM_ENTRY_bool(name, value, help) ::gloam::bool_parameter(#name, ::gloam::value, help)
#define PARAM_ENTRY_choice(name, value, choices, help) ::gloam::choice_parameter(#name, #value, #choices, help)
#define PARAM_ENTRY_file(name, help) ::gloam::file_parameter(#name, help)
#define PARAM_ENTRY(type, name, ...) PARAM_ENTRY_##type(name, __VA_ARGS__),

#define PARAMS(Type, LIST)                                                         \
  struct Type {                                                                    \
    LIST(PARAM_FIELD)                                                              \
    static ::gloam::ParameterList table() { return {LIST(PARAM_ENTRY)}; }          \
  };                                                                               \
  static_assert(sizeof(Type) == 4 * (0 LIST(PARAM_ONE)), #Type ": parameters are 4-byte scalars only");

#endif
#endif
