"""The two numbers of multi-bounce's own fit, fitted to traced bounces; and the errors of the fits alone, with the truth's AO.

PYTHONPATH=build/python python3 bench/bounces_fit.py FOLDER [SCENE ...]    by default all scenes

For kernels/multi_bounce/README.md. Frames and truths are kept in FOLDER and made once: 320x180, 256 rays for AO, 128 paths for bounces;
`bench/effect_errors.py bounces FOLDER` uses the same. RMSE over the foreground, of red, green and blue. "Left out": both numbers are fitted
to the other scenes, which count alike.
"""
import pathlib
import subprocess
import sys

import numpy

import gloam

GLOAM = "build/gloam"


def made(path, *command):
    if not path.exists():
        subprocess.run([GLOAM, *map(str, command), "-o", str(path), "-q"], check=True, stdout=subprocess.DEVNULL)
    return gloam.read(str(path))


class Scene:
    def __init__(self, folder, name):
        path = folder / f"{name}.exr"
        frame = made(path, "capture", name, "--size", "320x180")
        ao = made(folder / f"{name}_ao_truth.exr", "reference", "ao", path, "--samples", 256)["ao"]
        truth = made(folder / f"{name}_bounces_truth.exr", "reference", "bounces", path, "--samples", 128)["bounces"]
        shown = numpy.isfinite(frame["depth"])
        self.ao = numpy.repeat(ao[shown].astype(float)[:, None], 3, axis=1)
        self.truth = truth[shown].astype(float)
        self.albedo = frame["albedo"][shown].astype(float).clip(0, 1)

    def terms(self):
        """What the two numbers are multiplied with: A + u first + v second."""
        reflected = self.albedo * (1 - self.ao) * numpy.sqrt(self.ao)
        return numpy.stack([reflected.ravel(), (reflected * self.albedo).ravel()], axis=1)

    def rmse(self, image):
        return numpy.sqrt(numpy.mean((image - self.truth) ** 2))

    def own(self, numbers):
        return self.ao + (self.terms() @ numbers).reshape(self.ao.shape)

    def jimenez(self):
        r, a = self.albedo, self.ao
        cubic = (((2.0404 * r - 0.3324) * a - 4.7951 * r + 0.6417) * a + 2.7552 * r + 0.6903) * a
        return numpy.clip(numpy.maximum(a, cubic), 0, 1)


def fitted(scenes):
    """Least squares; every scene has the same weight."""
    left, right = numpy.zeros((2, 2)), numpy.zeros(2)
    for scene in scenes:
        terms = scene.terms()
        left += terms.T @ terms / len(terms)
        right += terms.T @ (scene.truth - scene.ao).ravel() / len(terms)
    return numpy.linalg.lstsq(left, right, rcond=None)[0]


def print_row(name, errors):
    print(f"| {name} | " + " | ".join(f"{error:.3f}".replace("0.", ".", 1) for error in errors) + " |", flush=True)


def main(folder, *names):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    scenes = {name: Scene(folder, name) for name in names or gloam.scenes()}
    numbers = fitted(scenes.values())
    print(f"A + rho (1 - A) sqrt(A) ({numbers[0]:.2f} {numbers[1]:+.2f} rho)\n")
    print("| scene | truth's AO itself | jimenez | own | own, left out |\n|---|---:|---:|---:|---:|")
    rows = []
    for name, scene in scenes.items():
        others = [other for other in scenes.values() if other is not scene] or [scene]
        rows.append([scene.rmse(scene.ao), scene.rmse(scene.jimenez()), scene.rmse(scene.own(numbers)), scene.rmse(scene.own(fitted(others)))])
        print_row(name, rows[-1])
    print_row("mean", numpy.mean(rows, axis=0))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
