// The spectrum of AO's error over flat, evenly lit surfaces: RMS by wavelength, and how strong the strongest single frequency is. The
// truth is a file of `gloam reference`; the images are written by `gloam run`, with depth.
//
// bench_spectrum TRUTH.exr AO.exr [AO.exr ...]
#include <string>
#include <vector>

#include "base/lists.h"
#include "bench/bench_frame.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "spectrum/spectrum.h"

namespace gloam::bench {
namespace {

Frame read_as_stored(const std::string& path, const std::vector<std::string>& planes) {
  ReadOptions options;
  options.only_looks = true;
  FrameFile file(path, options);
  for (const std::string& plane : planes) {
    if (!contains(file.common_planes(), plane)) throw Error("{}: has no '{}'", path, plane);
  }
  return file.read(planes);
}

const Channel& first_channel(const Frame& frame, const std::string& plane) {
  return frame.views[0].planes.at(plane).channels[0];
}

int bench_main(int argc, char** argv) {
  if (argc < 3) throw UsageError("give the truth and at least one image: bench_spectrum TRUTH.exr AO.exr");
  const Frame truth = read_as_stored(argv[1], {"ao"});
  std::string rows;
  for (int i = 2; i < argc; ++i) {
    const Frame test = read_as_stored(argv[i], {"ao", "depth"});
    const Spectrum s =
        spectrum_over_flat(first_channel(test, "ao"), first_channel(truth, "ao"), first_channel(test, "depth"));
    rows += fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {:.1f} |\n", argv[i], s.windows, s.rms[0],
                        s.rms[1], s.rms[2], s.rms[3], s.peak);
  }
  fmt::print(
      "RMS of the error over flat surfaces by wavelength in pixels, and the strongest frequency over the median\n\n"
      "| image | windows | 2 to 4 | 4 to 8 | 8 to 16 | 16 to 32 | strongest |\n|---|---|---|---|---|---|---|\n{}",
      rows);
  return 0;
}

}  // namespace
}  // namespace gloam::bench

int main(int argc, char** argv) {
  return gloam::bench::run_program("bench_spectrum", argc, argv, gloam::bench::bench_main);
}
