#!/usr/bin/env python3
"""Errors of contact shadows on built-in scenes, against the traced truth: the table of kernels/contact_shadow/README.md.

python3 bench/contact_errors.py FOLDER [GLOAM [SIZE [LENGTH [SCENE ...]]]]    by default build/gloam, 960x540, 0.5, gallery courtyard lounge

Frames and truths are kept in FOLDER and made once. RMSE over the foreground, with the scene's sun as a point. "unshaded" is the error of 1
where the surface faces the light and 0 where it faces away: a length of 0.
"""
import json
import pathlib
import subprocess
import sys

ROWS = [("unshaded", ["--length", 0])] + [(name, ["--preset", name]) for name in ("low", "medium", "high", "ultra")] + [
    ("converged", ["--steps", 1024])]


def call(gloam, *arguments):
    done = subprocess.run([gloam, *map(str, arguments), "-q"], stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def errors_of(gloam, folder, scene, size, length):
    frame, truth, result = (folder / f"{scene}{ending}.exr" for ending in ("", "_ref", "_result"))
    if not frame.exists():
        call(gloam, "capture", scene, "-o", frame, "--size", size)
    if not truth.exists():
        call(gloam, "reference", "contact", frame, "-o", truth, "--length", length)
    errors = {}
    for name, settings in ROWS:
        call(gloam, "run", "contact-shadow", frame, "-o", result, *(settings if "--length" in settings else ["--length", length, *settings]))
        found = json.loads(call(gloam, "compare", result, truth, "--plane", "contact", "--json", "-"))
        errors[name] = found["rmse"], found["bias"]
    return errors


def main(folder, gloam="build/gloam", size="960x540", length="0.5", *scenes):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for number, scene in enumerate(scenes or ["gallery", "courtyard", "lounge"]):
        errors = errors_of(gloam, folder, scene, size, length)
        if number == 0:
            print("| scene | " + " | ".join(errors) + " |\n|---|" + "---:|" * len(errors))
        print(f"| {scene} | " + " | ".join(f"{rmse:.4f} ({bias:+.3f})" for rmse, bias in errors.values()) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
