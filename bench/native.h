// The native baseline: HBAO+ 8 x 4 as a C++/OpenMP loop written by hand for the CPU's vectors.
#pragma once

#include "bench/estimate.h"

namespace gloam::bench {

enum class Instructions { scalar, avx2, avx512 };

/// OpenMP threads that spin after a loop would take the cores from OpenCL's, and each other's where other programs run.
/// How they wait is read before main: where OMP_WAIT_POLICY is not set, sets it to passive and starts the program again
/// with the same arguments. To be called before anything is done. Returns false where that did not work.
bool make_openmp_wait_passively();

/// The widest that this CPU has.
Instructions widest_instructions();
const char* name_of(Instructions instructions);

struct Job;
using RowLoop = void (*)(const Job&, int y);

/// Plain, or tuned: without clamping where all samples of a block of pixels lie in the frame, as gloam's kernel does.
class Native {
 public:
  Native(const Frame& frame, const HbaoPlusParams& params, Instructions instructions, bool tuned = false);
  double run();  ///< milliseconds of wall clock
  const Channel& result() const { return result_; }

 private:
  const View& view_;
  PixelCamera camera_;
  HbaoPlusParams params_;
  RowLoop row_;
  Channel result_;
};

}  // namespace gloam::bench
