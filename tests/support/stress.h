// The frames of `gloam stress`, and what techniques make of them, by the names that tests have for them.
#pragma once

#include "stress/eyes.h"
#include "stress/frames.h"
#include "stress/outputs.h"
#include "stress/surfaces.h"

namespace gloam::test {

using namespace stress;
using stress::Scene;  // beside those of gloam
using stress::Surface;

}  // namespace gloam::test
