// Tunings as JSON, in the table of devices and in what `gloam doctor` keeps.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "gloam/device.h"
#include "gloam/technique.h"

namespace gloam {

/// {"lanes": 1, "group": 256, "group_of_others": 256, "registers": 64, "gathers_by_loads": false}
nlohmann::ordered_json document_of(const Tuning& tuning);

/// The tuning of such an object, in which the last three may be missing; none if kernels cannot run with it. Older gloams kept no
/// `gathers_by_loads`: then it is the usual one.
std::optional<Tuning> tuning_in(const nlohmann::ordered_json& document, const Tuning& usual = {});

/// What compilers are told of it, for all kernels: "-D LANES=16 -D GATHERS_BY_LOADS=1".
std::string options_of(const Tuning& tuning);

/// What suits a pass's kernel.
const KernelTuning& of_kind(const Tuning& tuning, const Pass& pass);

}  // namespace gloam
