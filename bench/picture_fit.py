#!/usr/bin/env python3
"""What gloam auto expects of a picture's errors: fits data/effect_errors.json to traced pictures of built-in scenes.

python3 bench/picture_fit.py FOLDER [GLOAM [VIEWS]]           by default build/gloam, 8 views of each scene
python3 bench/picture_fit.py FOLDER --each [GLOAM [VIEWS]]    FOLDER/without-SCENE.json for each scene, fitted to the others, instead

Each scene is seen by its own camera and by others near it, made by numbers that its name starts. Of each view the look of gloam auto is taken (each
effect with its lowest preset on every fourth pixel), the best option of each effect, and traced planes, 64 rays a pixel. Of each scene's own view
every option is run. GLOAM_EFFECT_ERRORS=FILE has gloam auto take another file. Frames and planes stay in FOLDER and are used again. Needs the
Python module (PYTHONPATH=build/python). An hour and a half on two cores.
"""
import json
import math
import pathlib
import sys

import numpy

import gloam
from error_table import call

SCENES = ["gallery", "courtyard", "lounge", "temple", "corridor", "colonnade", "banquet", "statue", "clockwork", "fence", "foliage", "hairball",
          "pillar", "slab"]
PRESETS, RESOLUTIONS = ["low", "medium", "high", "ultra"], ["full", "half", "quarter"]
TECHNIQUES = {"ao": "evidence", "bounces": "multi-bounce", "indirect": "indirect", "reflection": "sssr"}
LIGHT = ["hidden_light", "hidden_even_light", "light_not_found"]
LOOK, BEST = ("low", "quarter"), ("ultra", "full")
OWN = ["depth", "color", "ambient", "albedo", "metallic", "reflectance"]
STEP = 4  # of a look, pixels
SIZE, RAYS = "480x270", 64
# Shares of a view that say little: nearly all of it is background, a wall before the eyes, or one flat plane.
LEAST_SURFACE, LEAST_DEPTH, LEAST_RANGE = 0.35, 0.12, 0.02


def random_camera(base, random):
    """A place and a target near those of a scene's own camera."""
    depth = base["depth"]
    depth = depth[numpy.isfinite(depth)]
    middle, near = float(numpy.median(depth)), float(numpy.quantile(depth, 0.05))
    pose = numpy.array(base.camera.camera_to_world)
    eye, right, up, forward = pose[:3, 3], pose[:3, 0], pose[:3, 1], -pose[:3, 2]
    place = eye + forward * near * random.uniform(-0.4, 0.7) + right * middle * random.uniform(-0.5, 0.5) + up * near * random.uniform(-0.2, 0.3)
    target = eye + forward * middle * random.uniform(0.6, 1.4) + right * middle * random.uniform(-0.6, 0.6) + up * middle * random.uniform(-0.2, 0.2)
    return [f"--{name}={','.join(f'{x:.5f}' for x in point)}" for name, point in (("eye", place), ("target", target))]


def shows_something(frame, near):
    depth = frame["depth"]
    surface = depth[numpy.isfinite(depth)]
    return (surface.size >= LEAST_SURFACE * depth.size and numpy.quantile(surface, 0.02) >= LEAST_DEPTH * near
            and numpy.std(numpy.log(surface)) >= LEAST_RANGE)


def planes_of(program, frame, folder, options):
    """Traced planes, and those of options, as arrays by name: ("ao", "low", "quarter") or ("ao", "true")."""
    out, planes = folder / "made.exr", {}
    for plane in ("ao", "indirect", "reflection"):
        call(program, "reference", plane, frame, "-o", out, "--samples", RAYS)
        planes[plane, "true"] = gloam.read(out, planes=[plane])[plane]
    for plane, technique in TECHNIQUES.items():
        for preset, resolution in options:
            call(program, "run", technique, frame, "-o", out, "--preset", preset, "--resolution", resolution, "--outputs", plane)
            planes[plane, preset, resolution] = gloam.read(out, planes=[plane])[plane].astype(numpy.float16)
    return planes


def make_views(program, folder, scene, count):
    """Files of a scene's views, made as far as they are not there."""
    captured = ["--size", SIZE, "--planes", ",".join([*OWN, "normal", "roughness", "back_depth"])]
    files = [folder / f"{scene}-{k}.npz" for k in range(count)]
    base = folder / f"{scene}.exr"
    if not base.exists():
        call(program, "capture", scene, "-o", base, *captured)
    own = gloam.read(base)
    near = float(numpy.quantile(own["depth"][numpy.isfinite(own["depth"])], 0.05))
    for k, file in enumerate(files):
        random, frame = numpy.random.default_rng([*scene.encode(), k]), base
        if file.exists():
            continue
        for _ in range(10 if k else 0):
            frame = folder / "view.exr"
            call(program, "capture", scene, "-o", frame, *captured, *random_camera(own, random))
            if shows_something(gloam.read(frame), near):
                break
            frame = None
        if frame is None:
            continue
        options = [(preset, resolution) for preset in PRESETS for resolution in RESOLUTIONS] if k == 0 else [LOOK, BEST]
        planes = planes_of(program, frame, folder, options)
        read = gloam.read(frame)
        numpy.savez(file, **{name: read[name].astype(numpy.float32) for name in OWN}, **{".".join(key): plane for key, plane in planes.items()})
        print(f"made {file.stem}", flush=True)
    return [file for file in files if file.exists()]


def mean_around(image, surface, reach=4):
    """The mean over surfaces of each pixel's neighbours, as host/auto/changes.cpp has it."""
    def sums(values):
        for axis in (0, 1):
            padded = numpy.insert(numpy.cumsum(values, axis), 0, 0, axis)
            at = numpy.arange(values.shape[axis])
            high, low = numpy.minimum(at + reach + 1, values.shape[axis]), numpy.maximum(at - reach, 0)
            values = padded.take(high, axis) - padded.take(low, axis)
        return values
    count = sums(surface[..., None].astype(float))
    return sums(numpy.where(surface[..., None], image, 0)) / numpy.maximum(count, 1)


class View:
    """Changes of the picture at the pixels of a look: as the look sees them, by the best options, and the true one."""

    def __init__(self, file):
        self.scene = file.stem.rsplit("-", 1)[0]
        with numpy.load(file) as stored:
            planes = self.planes = {name: stored[name].astype(float) for name in stored.files}
        surface = self.surface = numpy.isfinite(planes["depth"])
        seen = surface[::STEP, ::STEP]
        look = self.changes(".".join(LOOK), STEP)
        light = mean_around(numpy.nan_to_num(planes["color"][::STEP, ::STEP]), seen)
        at = {name: numpy.nan_to_num(planes[name][::STEP, ::STEP]) for name in OWN}
        closed, found = (planes[f"{plane}.{'.'.join(LOOK)}"][::STEP, ::STEP] for plane in ("ao", "reflection"))
        hidden = self.diffuse[::STEP, ::STEP] * (1 - closed)[..., None]
        look["hidden_light"], look["hidden_even_light"] = hidden * light, hidden * at["color"][seen].mean(axis=0)
        look["light_not_found"] = at["reflectance"].reshape(*seen.shape, -1) * (1 - found[..., 3:]) * light
        self.seen = self.flat(look, seen)
        self.best = self.flat(self.changes(".".join(BEST), STEP), seen)
        self.true = sum(self.flat(self.true_changes(STEP), seen).values())
        # With the true change, since where nothing is seen, the rest tells nothing.
        self.power = sum(numpy.mean(self.best[plane] ** 2) for plane in ("ao", "indirect", "reflection")) + numpy.mean(self.true ** 2)
        self.kept_when_coarser = {plane: kept_when_coarser(numpy.where(seen[..., None], look[plane], 0), seen) for plane in TECHNIQUES}
        # Of a scene's own view: by plane and option.
        self.kept_and_noise = {name: self.compared(*name.split(".", 1)) for name in planes
                               if name.split(".")[0] in TECHNIQUES and not name.endswith("true") and "ao.high.full" in planes}
        del self.planes

    @staticmethod
    def flat(changes, surface):
        return {name: change[surface].ravel() for name, change in changes.items()}

    @property
    def diffuse(self):
        metallic = numpy.nan_to_num(self.planes["metallic"]).reshape(*self.surface.shape, -1)[..., :1]
        return numpy.nan_to_num(self.planes["albedo"]) * (1 - metallic)

    def change(self, plane, values, step):
        ambient, diffuse = numpy.nan_to_num(self.planes["ambient"])[::step, ::step], self.diffuse[::step, ::step]
        values = values[::step, ::step]
        if plane in ("ao", "bounces"):
            return (values.reshape(*values.shape[:2], -1) - 1) * ambient
        return diffuse * values if plane == "indirect" else values[..., :3]

    def changes(self, option, step=1):
        """As host/frame/composition.cpp has them."""
        return {plane: self.change(plane, self.planes[f"{plane}.{option}"], step) for plane in TECHNIQUES}

    def true_changes(self, step):
        return {plane: self.change(plane, self.planes[f"{plane}.true"], step) for plane in ("ao", "indirect", "reflection")}

    def compared(self, plane, option):
        """What an option keeps of the best one's change, and its noise in shares of that; None where the effect hardly changes the picture."""
        best, change = (self.change(plane, self.planes[f"{plane}.{name}"], 1)[self.surface].ravel() for name in (".".join(BEST), option))
        power = best @ best
        if power < 0.02 * self.power * len(best):
            return None
        kept = change @ best / power
        return numpy.array([kept, max(0.0, change @ change / power - kept * kept)])

    def seen_product(self, a, b):
        return numpy.mean(self.seen[a] * self.seen[b])


def mean_of_scenes(views, of):
    """The mean over scenes of the mean over a scene's views of a number or an array; None is passed over."""
    scenes = {}
    for view in views:
        value = of(view)
        if value is not None:
            scenes.setdefault(view.scene, []).append(value)
    return sum(sum(values) / len(values) for values in scenes.values()) / len(scenes)


def regression(views, rows, target, prior, strength):
    """Least squares over views, scenes alike in weight. `rows`, `target`: of a view, in shares of its power."""
    products = mean_of_scenes(views, lambda view: rows(view).T @ rows(view))
    with_target = mean_of_scenes(views, lambda view: rows(view).T @ target(view))
    hold = strength * numpy.trace(products) / len(prior) * numpy.eye(len(prior))
    return numpy.linalg.solve(products + hold, with_target + hold @ prior)


def fit_truth(views, names):
    """Shares of the changes seen that make up the true one, pixel by pixel."""
    def rows(view):
        return numpy.stack([view.seen[name] for name in names], 1) / math.sqrt(view.power * len(view.true))
    return regression(views, rows, lambda view: view.true / math.sqrt(view.power * len(view.true)), numpy.zeros(len(names)), 1e-3)


def seen_products(view, plane, names):
    """What tells of an effect's product with the true change. The last is the part of its own that is no noise: neighbours have it too."""
    return numpy.array([*(view.seen_product(plane, name) for name in names), view.kept_when_coarser[plane] * view.seen_product(plane, plane)])


def fit_with_truth(views, plane, names):
    """The mean product of the best option's change and the true one, from those that are seen: one number a view."""
    prior = numpy.array([0.5 * (name == plane or (name, plane) == ("ao", "bounces")) for name in names] + [0.5])
    return regression(views, lambda view: seen_products(view, plane, names)[None] / view.power,
                      lambda view: numpy.array([numpy.mean(view.best[plane] * view.true)]) / view.power, prior, 0.003)


def ratio_of_products(views, a, b):
    """The best options' product over the one seen: of the means over views, where the two have anything in common."""
    best = mean_of_scenes(views, lambda view: numpy.mean(view.best[a] * view.best[b]) / view.power)
    seen = mean_of_scenes(views, lambda view: view.seen_product(a, b) / view.power)
    return float(numpy.clip(best / seen, 0.5, 3)) if abs(seen) > 1e-4 else 1.0


def kept_when_coarser(field, surface):
    """What every second pixel of every second row tells of the others, as host/auto/changes.cpp has it."""
    shape = surface.shape
    weights, values = (numpy.zeros((*shape, 1)), numpy.zeros((*shape, 3)))
    coarse = numpy.zeros(shape, bool)
    coarse[::2, ::2] = surface[::2, ::2]
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            moved = numpy.zeros(shape, bool)
            target = tuple(slice(max(d, 0), n + min(d, 0)) for d, n in zip((down, right), shape))
            source = tuple(slice(max(-d, 0), n + min(-d, 0)) for d, n in zip((down, right), shape))
            moved[target] = coarse[source]
            shifted = numpy.zeros((*shape, 3))
            shifted[target] = field[source]
            weights += moved[..., None]
            values += numpy.where(moved[..., None], shifted, 0)
    at = surface & (weights[..., 0] > 0)
    at[::2, ::2] = False
    filled, own = (values / numpy.maximum(weights, 1))[at].ravel(), field[at].ravel()
    return float(filled @ own / max(own @ own, 1e-30))


def fit_kept(views, plane, option):
    """What an option does not keep, and its noise, against what the look's own pixels say of detail: [lost, lost per loss seen, noise, noise per loss
    seen]. Views count by how much of their change the effect makes."""
    rows, lost, noise, weights = [], [], [], []
    for view in views:
        figures = view.kept_and_noise.get(f"{plane}.{option}")
        if figures is None:
            continue
        rows.append([1, 1 - view.kept_when_coarser[plane]])
        lost.append(1 - figures[0])
        noise.append(figures[1])
        weights.append(numpy.mean(view.best[plane] ** 2) / view.power)
    rows, weights = numpy.array(rows), numpy.array(weights)[:, None] / sum(weights)
    products, hold = (weights * rows).T @ rows, numpy.diag([0.02, 0.006])
    return [float(x) for values in (lost, noise) for x in numpy.linalg.solve(products + hold, (weights * rows).T @ numpy.array(values))]


def rounded(value):
    if isinstance(value, dict):
        return {name: rounded(each) for name, each in value.items()}
    if isinstance(value, list):
        return [rounded(each) for each in value]
    return round(float(value), 4)


def table_of(views):
    planes, own = list(TECHNIQUES), [view for view in views if view.kept_and_noise]
    names = ["ao", "indirect", "reflection", *LIGHT]
    truth = fit_truth(views, names)
    def unforeseen(view):
        expected = sum(truth[i] * view.seen[name] for i, name in enumerate(names))
        return numpy.mean((view.true - expected) ** 2) / max(numpy.mean(expected ** 2), 1e-30)
    table = {"truth": dict(zip(names, truth)), "unforeseen": float(numpy.median([unforeseen(view) for view in views])),
             "truth_uncertainty": truth_uncertainty_of(views, names),
             "unreached": float(numpy.quantile([unreached(view) for view in views], 0.1)),
             "with_truth": {plane: dict(zip([*names, "not_noise"], fit_with_truth(views, plane, names))) for plane in planes}}
    table["best_over_seen"] = {a: {b: ratio_of_products(views, a, b) for b in planes if b >= a} for a in planes}
    table["uncertainty"] = {plane: uncertainty_of(views, plane, names) for plane in planes}
    table["presets"] = {plane: {preset: fit_kept(own, plane, f"{preset}.full") for preset in PRESETS} for plane in planes}
    table["resolutions"] = {plane: {resolution: fit_kept(own, plane, f"ultra.{resolution}") for resolution in RESOLUTIONS[1:]} for plane in planes}
    return rounded(table)


def unreached(view):
    """The share of the true change's mean square that the best options leave, whichever of them are taken."""
    best = view.best
    pictures = [sum((best[plane] for plane in planes), 0 * view.true) for planes in
                ([*ambient, *mirrored] for ambient in ([], ["ao"], ["bounces"], ["indirect"], ["ao", "indirect"]) for mirrored in ([], ["reflection"]))]
    return min(numpy.mean((view.true - picture) ** 2) for picture in pictures) / max(numpy.mean(view.true ** 2), 1e-30)


def truth_uncertainty_of(views, names):
    """Standard deviation of the mean square that is expected of the true change, in shares of it, of each scene by the fit of the others."""
    logarithms = []
    for scene in sorted({view.scene for view in views}):
        truth = fit_truth([view for view in views if view.scene != scene], names)
        logarithms += [math.log(numpy.mean(sum(truth[i] * view.seen[name] for i, name in enumerate(names)) ** 2) / numpy.mean(view.true ** 2))
                       for view in views if view.scene == scene and numpy.mean(view.true ** 2) > 0.01 * view.power]
    return float(numpy.std(logarithms))


def uncertainty_of(views, plane, names):
    """Of each scene by the fit of the others: how far the product with the true change is off, in shares of both, root of the mean square."""
    squares = []
    for scene in sorted({view.scene for view in views}):
        shares = fit_with_truth([view for view in views if view.scene != scene], plane, names)
        for view in views:
            if view.scene != scene:
                continue
            expected = shares @ seen_products(view, plane, names)
            power = numpy.mean(view.best[plane] ** 2) * numpy.mean(view.true ** 2)
            if power > 1e-4 * view.power ** 2:
                squares.append((expected - numpy.mean(view.best[plane] * view.true)) ** 2 / power)
    return math.sqrt(sum(squares) / len(squares))


def main(folder, *arguments):
    each = arguments[:1] == ("--each",)
    program, count = (*arguments[each:], *("build/gloam", "8")[len(arguments[each:]):])
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    files = [file for scene in SCENES for file in make_views(program, folder, scene, int(count))]
    views = [view for view in map(View, files) if view.power > 0]
    for scene in SCENES if each else [""]:
        path = folder / f"without-{scene}.json" if each else pathlib.Path(__file__).parent.parent / "data" / "effect_errors.json"
        path.write_text(json.dumps(table_of([view for view in views if view.scene != scene]), indent=2) + "\n")
        print(f"wrote {path}")


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) > 1 else sys.exit(__doc__)
