"""kernels/hbao/README.md"""
from catalogue import table
from recipes import capture

# The registry's own limit of hbao: as many samples as bring the image no nearer to anything.
CONVERGED = ("--directions", 32, "--steps", 64, "--filter", "none")
SETTINGS = ((), ("--falloff", "none"), ("--falloff", "none", "--bias", 0), ("--falloff", "none", "--bias", 0, "--weighting", "cosine"))


@table("kernels/hbao/README.md", "What to expect", minutes=2)
def interiors(lab):
    frames = ((capture(lab, "kitchen/kitchen_exact.exr"), capture(lab, "kitchen/kitchen_ao_ref.exr"), "--radius", 0.3),
              (capture(lab, "apartment_stereo/apartment_stereo_exact.exr"), capture(lab, "apartment_stereo/apartment_stereo_ao_ref_left.exr"),
               "--radius", 0.4, "--view", "left"))
    rows = []
    for settings in SETTINGS:
        found = [lab.compared(lab.result("hbao", frame, *flags, *CONVERGED, *settings), truth, "--plane", "ao_raw")
                 for frame, truth, *flags in frames]
        rows.append([(f["rmse"], f["bias"]) for f in found])
    return rows
