#!/usr/bin/env python3
"""Errors of indirect light on the built-in scenes, against the traced truth: the table of kernels/gtao/README.md.

python3 bench/indirect_errors.py FOLDER [GLOAM [SIZE [SAMPLES [SCENE ...]]]]    by default build/gloam, 480x270, 256 rays, all scenes

Frames and truths are kept in FOLDER and made once. RMSE over the foreground, mean of the three components. "black" is the error of no
indirect light at all; "all layers" reads eight peeled layers.
"""
from error_table import all_scenes, call, figures, print_table, run

CONVERGED = ["--directions", "32", "--steps", "64", "--rays", "4"]
# A radius that reaches no pixel finds no light.
ROWS = [("black", "indirect", ["--radius", "0"]), ("low", "indirect", ["--preset", "low"]), ("medium", "indirect", ["--preset", "medium"]),
        ("high", "indirect", ["--preset", "high"]), ("ultra", "indirect", ["--preset", "ultra"]),
        ("converged", "indirect", CONVERGED), ("all layers, medium", "dp-indirect", ["--preset", "medium"]),
        ("all layers, converged", "dp-indirect", CONVERGED)]


def rmse(gloam, test, truth):
    return f"{figures(gloam, test, truth, 'indirect')['rmse']:.4f}"


def errors_of(gloam, folder, scene, size, samples):
    frame, truth, result = (folder / f"{scene}{ending}.exr" for ending in ("", "_truth", "_result"))
    if not frame.exists():
        call(gloam, "capture", scene, "-o", frame, "--size", size, "--peel", 8, "--peel-light")
    if not truth.exists():
        call(gloam, "reference", "indirect", frame, "-o", truth, "--samples", samples)
    errors = {}
    for name, technique, settings in ROWS:
        call(gloam, "run", technique, frame, "-o", result, *settings)
        errors[name] = rmse(gloam, result, truth)
    return errors


def main(folder, gloam="build/gloam", size="480x270", samples="256", *scenes):
    print_table(folder, scenes or all_scenes(gloam), lambda folder, scene: errors_of(gloam, folder, scene, size, samples))


if __name__ == "__main__":
    run(main, __doc__)
