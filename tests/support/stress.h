// The frames of `gloam stress`, and techniques' results on them, under the names that tests use.
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
