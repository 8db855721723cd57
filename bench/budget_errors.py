#!/usr/bin/env python3
"""What `gloam auto --budget` and `--error` choose against the best fixed settings of equal time or error: the tables of docs/choosing.md.

python3 bench/budget_errors.py FOLDER [GLOAM [SIZE [SAMPLES [SCENE|FRAME ...]]]]    by default build/gloam, 480x270, 256 rays, eight scenes
python3 bench/budget_errors.py FOLDER --without TABLES [GLOAM ...]                  of each scene by TABLES/without-SCENE.json (bench/picture_fit.py)

Every preset and resolution of every effect is run once for itself. Pictures of all combinations are composed from these planes, and the nearest to
the picture of traced planes within the budget is the best fixed setting: found by brute force. Budgets are shares of the time of everything
everywhere at the preset medium; errors lie between those of the colour alone and of the best combination. Needs the Python module (PYTHONPATH=build/python). RMSE over the surfaces of a frame.
"""
import itertools
import json
import math
import os
import pathlib
import sys

import numpy

import gloam
from error_table import call

SCENES = ["gallery", "courtyard", "lounge", "temple", "corridor", "colonnade", "banquet", "statue"]
PRESETS, RESOLUTIONS = ["low", "medium", "high", "ultra"], ["full", "half", "quarter"]
# By effect: the techniques that gloam auto chooses from, and the plane that each gives to the picture. multi-bounce runs evidence first.
EFFECTS = {"ambient": [("evidence", "ao"), ("multi-bounce", "bounces")], "indirect": [("indirect", "indirect")],
           "reflection": [("sssr", "reflection")]}
BUDGETS = [0.25, 0.5, 1]
# Shares of the way from the error of the colour alone to the least that any combination has.
GAINS = [0.25, 0.5, 0.75]


class Scene:
    """A frame with its truth, and the planes and times of every option."""

    def __init__(self, gloam_path, folder, name, size, samples):
        self.gloam, self.folder, self.name = gloam_path, folder, name
        self.frame = folder / f"{name}.exr"
        if not self.frame.exists():
            planes = "depth,normal,color,albedo,metallic,ambient,roughness,reflectance,back_depth,instance"
            call(gloam_path, "capture", name, "-o", self.frame, "--size", size, "--planes", planes)
        self.truth = {}
        for kind in ("ao", "indirect", "reflection"):
            path = folder / f"{name}_{kind}.exr"
            if not path.exists():
                call(gloam_path, "reference", kind, self.frame, "-o", path, "--samples", samples)
            self.truth[kind] = gloam.read(path, planes=[kind])[kind]
        own = gloam.read(self.frame, planes=["depth", "color", "albedo", "metallic", "ambient"])
        self.surface = numpy.isfinite(own["depth"])
        self.color, self.albedo, self.ambient, metallic = (self.at_surfaces(own[plane]) for plane in ("color", "albedo", "ambient", "metallic"))
        self.albedo *= 1 - metallic[:, None]
        self.true = {kind: self.at_surfaces(plane) for kind, plane in self.truth.items()}
        self.picture_of_truth = self.picture(self.true)

    def at_surfaces(self, plane):
        return plane[self.surface].astype(float)

    def picture(self, parts):
        """As host/frame/composition.cpp has it."""
        picture = self.color.copy()
        if "bounces" in parts and "indirect" not in parts:
            picture += (parts["bounces"] - 1) * self.ambient
        elif "ao" in parts:
            picture += (parts["ao"][:, None] - 1) * self.ambient
        if "indirect" in parts:
            picture += self.albedo * parts["indirect"]
        if "reflection" in parts:
            picture += parts["reflection"][:, :3]
        return picture

    def error(self, parts):
        return math.sqrt(numpy.mean((self.picture(parts) - self.picture_of_truth) ** 2))

    def run(self, technique, plane, preset, resolution):
        """The plane at surfaces, and the median time of seven runs, milliseconds on the device."""
        out = self.folder / f"{self.name}_result.exr"
        done = json.loads(call(self.gloam, "run", technique, self.frame, "-o", out, "--float", "--preset", preset, "--resolution", resolution,
                               "--outputs", plane, "--repeat", 7, "--json", "-"))
        return self.at_surfaces(gloam.read(out, planes=[plane])[plane]), done["total_ms"]["median"]

    def options(self):
        """By effect: a list of (setting, time, planes), the first of them without the effect."""
        options = {}
        for effect, techniques in EFFECTS.items():
            options[effect] = [("left out", 0, {})]
            for technique, plane in techniques:
                for preset, resolution in itertools.product(PRESETS, RESOLUTIONS):
                    values, ms = self.run(technique, plane, preset, resolution)
                    options[effect].append((f"{technique}, {preset}, {resolution}", ms, {plane: values}))
        return options

    def combinations(self, options):
        """Of all combinations of options: (error, time, settings).

        A picture is a sum of one term per effect, so the squared error of a combination is a sum of inner products of terms."""
        listed = [(number, *option) for number, of_effect in enumerate(options.values()) for option in of_effect]
        terms = numpy.array([(self.picture(option[3]) - self.color).ravel() for option in listed] +
                            [(self.color - self.picture_of_truth).ravel()])
        products = terms @ terms.T
        of_effects = [[k for k, option in enumerate(listed) if option[0] == number] for number in range(len(options))]
        found = []
        for combination in itertools.product(*of_effects):
            planes = {plane for k in combination for plane in listed[k][3]}
            if {"bounces", "indirect"} <= planes:
                continue  # the picture takes ao then, which evidence alone makes
            time = sum(listed[k][2] for k in combination)
            chosen = [*combination, len(listed)]
            error = math.sqrt(max(0, products[numpy.ix_(chosen, chosen)].sum()) / terms.shape[1])
            found.append((error, time, "; ".join(listed[k][1] for k in combination)))
        return found

    def automatic(self, *goal):
        """gloam auto: error of its picture, and what it tells."""
        out = self.folder / f"{self.name}_auto.exr"
        told = json.loads(call(self.gloam, "auto", self.frame, "-o", out, *goal, "--json", "-"))
        frame = gloam.read(out)
        made = [plane for plane in ("ao", "bounces", "indirect", "reflection") if plane in frame.planes]
        return self.error({plane: self.at_surfaces(frame[plane]) for plane in made}), told


def told_in_words(told):
    """What gloam auto has chosen."""
    if "chosen" not in told:
        return "; ".join(effect["runs"] for effect in told["effects"] if effect["runs"])
    return "; ".join(f"{' + '.join(c['outputs'])}, {c['preset']}, {RESOLUTIONS[c['resolution'] // 2]}" for c in told["chosen"]) or "nothing"


def rows_of_budgets(scene, options, combinations):
    """A row for no budget, and one for each."""
    everything = [option for effect, (technique, _) in zip(options, (t[0] for t in EFFECTS.values())) for option in options[effect]
                  if option[0] == f"{technique}, medium, full"]
    all_ms = sum(option[1] for option in everything)
    all_error = scene.error({plane: values for option in everything for plane, values in option[2].items()})
    error, told = scene.automatic("--repeat", "7")
    yield (f"| {scene.name} | {all_ms:.1f} | {all_error:.4f} | none | {error:.4f} | {told['total_ms']:.1f} | "
           f"{told['classify_ms'] + told['glance_ms']:.1f} | | | | | {told_in_words(told)}, {100 * (1 - told['total_ms'] / all_ms):.0f} % saved |")
    for budget in (share * all_ms for share in BUDGETS):
        best = min(c for c in combinations if c[1] <= budget)
        error, told = scene.automatic("--budget", f"{budget:.4f}ms")
        yield (f"| {scene.name} | {all_ms:.1f} | {all_error:.4f} | {budget:.1f} | {error:.4f} | {told['total_ms']:.1f} | "
               f"{told['classify_ms'] + told['glance_ms']:.1f} | {told['expected_error']:.4f} | {best[0]:.4f} | {best[1]:.1f} | "
               f"{100 * (error / best[0] - 1):.0f} % | {told_in_words(told)} (best: {best[2]}) |")


def rows_of_errors(scene, combinations):
    """A row for each error that is asked for."""
    least = min(combinations)[0]
    alone = max(scene.error({}), least)  # two ways to compute one figure
    for goal in (alone + gain * (least - alone) for gain in GAINS):
        fastest = min(c[1::-1] + c[2:] for c in combinations if c[0] <= goal)
        error, told = scene.automatic("--error", f"{goal:.6f}")
        says = "yes" if told["goal_met"] else "no"
        yield (f"| {scene.name} | {goal:.4f} | {says} | {told['expected_error']:.4f} | {error:.4f} | {'yes' if error <= goal else 'no'} | "
               f"{told['total_ms']:.1f} | {told['classify_ms'] + told['glance_ms']:.1f} | {fastest[0]:.1f} | "
               f"{100 * (told['total_ms'] / max(fastest[0], 1e-3) - 1):.0f} % | {told_in_words(told)} (fastest: {fastest[2]}) |")


def print_tables(scenes, tables):
    of_errors = []
    print("| frame | everything, ms | error | budget, ms | auto: error | ms | looking, ms | expected | best fixed: error | ms | more than best | choice |")
    print("|---|" + "---:|" * 10 + "---|")
    for scene in scenes:
        options = scene.options()
        if tables:
            os.environ["GLOAM_EFFECT_ERRORS"] = str(tables / f"without-{scene.name}.json")
        combinations = scene.combinations(options)
        for row in rows_of_budgets(scene, options, combinations):
            print(row, flush=True)
        of_errors += rows_of_errors(scene, combinations)
    print("\n| frame | error asked for | said to be reached | expected | error | reached | ms | looking, ms | fastest fixed, ms | more | choice |")
    print("|---|---:|---|---:|---:|---|---:|---:|---:|---:|---|")
    print("\n".join(of_errors))


def main(folder, *arguments):
    tables = pathlib.Path(arguments[1]) if arguments[:1] == ("--without",) else None
    arguments = arguments[2:] if tables else arguments
    gloam_path, size, samples, *names = (*arguments, *("build/gloam", "480x270", "256")[len(arguments):])
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    print_tables((Scene(gloam_path, folder, name, size, samples) for name in names or SCENES), tables)


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) > 1 else sys.exit(__doc__)
