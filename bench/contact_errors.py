#!/usr/bin/env python3
"""Errors of contact shadows on built-in scenes, against the traced truth: the table of kernels/contact_shadow/README.md.

python3 bench/contact_errors.py FOLDER [GLOAM [SIZE [LENGTH [SCENE ...]]]]    by default build/gloam, 960x540, 0.5, gallery courtyard lounge

Frames and truths are kept in FOLDER and made once. RMSE over the foreground, with the scene's sun as a point. "unshaded" is the error of 1
where the surface faces the light and 0 where it faces away: a length of 0.
"""
from error_table import call, figures, print_table, run

ROWS = [("unshaded", ["--length", 0])] + [(name, ["--preset", name]) for name in ("low", "medium", "high", "ultra")] + [
    ("converged", ["--steps", 1024])]


def errors_of(gloam, folder, scene, size, length):
    frame, truth, result = (folder / f"{scene}{ending}.exr" for ending in ("", "_ref", "_result"))
    if not frame.exists():
        call(gloam, "capture", scene, "-o", frame, "--size", size)
    if not truth.exists():
        call(gloam, "reference", "contact", frame, "-o", truth, "--length", length)
    errors = {}
    for name, settings in ROWS:
        call(gloam, "run", "contact-shadow", frame, "-o", result, *(settings if "--length" in settings else ["--length", length, *settings]))
        found = figures(gloam, result, truth, "contact")
        errors[name] = f"{found['rmse']:.4f} ({found['bias']:+.3f})"
    return errors


def main(folder, gloam="build/gloam", size="960x540", length="0.5", *scenes):
    print_table(folder, scenes or ["gallery", "courtyard", "lounge"],
                lambda folder, scene: errors_of(gloam, folder, scene, size, length))


if __name__ == "__main__":
    run(main, __doc__)
