#!/usr/bin/env python3
"""Errors of indirect light on the built-in scenes, against the traced truth: the table of docs/accuracy.md.

python3 bench/indirect_errors.py FOLDER [GLOAM [SIZE [SAMPLES [SCENE ...]]]]    by default build/gloam, 480x270, 256 rays, all scenes

Frames and truths are kept in FOLDER and made once. RMSE over the foreground, mean of the three components. "black" is the error of no
indirect light at all; "all layers" reads eight peeled layers.
"""
import json
import pathlib
import subprocess
import sys

CONVERGED = ["--directions", "32", "--steps", "64", "--rays", "4"]
ROWS = [("low", "indirect", ["--preset", "low"]), ("medium", "indirect", ["--preset", "medium"]),
        ("high", "indirect", ["--preset", "high"]), ("ultra", "indirect", ["--preset", "ultra"]),
        ("converged", "indirect", CONVERGED), ("all layers, medium", "dp-indirect", ["--preset", "medium"]),
        ("all layers, converged", "dp-indirect", CONVERGED)]


def call(gloam, *arguments):
    done = subprocess.run([gloam, *map(str, arguments), "-q"], stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def rmse(gloam, test, truth):
    return json.loads(call(gloam, "compare", test, truth, "--plane", "indirect", "--json", "-"))["rmse"]


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
        if name == "low":
            # A radius that reaches no pixel finds no light.
            call(gloam, "run", technique, frame, "-o", result, "--radius", 0)
            errors = {"black": rmse(gloam, result, truth), **errors}
    return errors


def main(folder, gloam="build/gloam", size="480x270", samples="256", *scenes):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    if not scenes:
        scenes = [scene["name"] for scene in json.loads(call(gloam, "list", "scenes", "--json", "-"))]
    for number, scene in enumerate(scenes):
        errors = errors_of(gloam, folder, scene, size, samples)
        if number == 0:
            print("| scene | " + " | ".join(errors) + " |\n|---|" + "---:|" * len(errors))
        print(f"| {scene} | " + " | ".join(f"{error:.4f}" for error in errors.values()) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
