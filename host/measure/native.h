// The native baseline: HBAO+ 8 x 4 as a C++/OpenMP loop, vectorised for the CPU by its author.
#pragma once

#include "measure/estimate.h"

namespace gloam::bench {

enum class Instructions { scalar, avx2, avx512 };

/// Makes OpenMP threads wait passively: threads that spin after a loop would take the cores from OpenCL, and from each other if
/// other programs run. OpenMP reads its waiting policy before main, so if OMP_WAIT_POLICY is not set, this sets it to passive and
/// restarts the program with the same arguments. Call it first. Returns false if that failed.
bool make_openmp_wait_passively();

/// The widest instruction set of this CPU.
Instructions widest_instructions();
const char* name_of(Instructions instructions);

struct Job;
using RowLoop = void (*)(const Job&, int y);

/// A plain version, or a tuned one that does not clamp if all samples of a block of pixels lie in the frame, as in gloam's kernel.
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
