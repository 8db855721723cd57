#!/usr/bin/env python3
"""Errors of an effect of light on built-in scenes, against its traced truth: the tables in the techniques' READMEs.

RMSE over the foreground, of all components, by `gloam compare`. Frames and truths are kept in FOLDER and made once. The first column is
what no technique at all gives. `gloam bench --effects` measures the same at presets, with times.
"""
import argparse
import dataclasses
import pathlib

from error_table import all_scenes, call, figures


def with_preset(technique, *more):
    return [(name, [technique, "--preset", name, *more]) for name in ("low", "medium", "high", "ultra")]


@dataclasses.dataclass
class Effect:
    """A column: its name, the arguments of `gloam run`, and the channels to compare (none: those of the plane)."""
    readme: str
    plane: str
    size: str
    samples: int
    columns: list
    scenes: tuple = ()  # empty: all
    capture: tuple = ()
    reference: tuple = ()
    digits: int = 3
    with_bias: bool = False


SLICES = ["--directions", "32", "--steps", "64", "--rays", "4"]
CONVERGED_AO = ["--set", "evidence.directions=32", "--set", "evidence.steps=64"]
# A radius, or a length, that reaches no pixel finds neither light nor occluders.
NONE = ["--radius", "0"]


def methods(technique, parameter, values):
    """Each method with the default preset of ambient occlusion, then converged."""
    return [(f"{value}{ending}", [technique, "--set", f"{parameter}={value}", *settings])
            for ending, settings in (("", []), (", converged", CONVERGED_AO)) for value in values]


EFFECTS = {
    "indirect": Effect(
        "gtao", "indirect", "480x270", 256, digits=4, capture=("--peel", 8, "--peel-light"),
        columns=[("black", ["indirect", *NONE]), *with_preset("indirect"), ("converged", ["indirect", *SLICES]),
                 ("all layers, medium", ["dp-indirect", "--preset", "medium"]),
                 ("all layers, converged", ["dp-indirect", *SLICES])]),
    "bounces": Effect(
        "multi_bounce", "bounces", "320x180", 128,
        columns=[("white", ["multi-bounce", *NONE]), ("AO itself", ["ao"], "AO,AO,AO"),
                 *methods("multi-bounce", "fit", ("jimenez", "own"))]),
    "specular-occlusion": Effect(
        "specular_occlusion", "specular_occlusion", "320x180", 128,
        columns=[("white", ["ao", *NONE], "AO"), ("AO", ["ao"], "AO"), ("AO, converged", ["ao", *CONVERGED_AO], "AO"),
                 *methods("specular-occlusion", "method", ("lagarde", "cone", "sectors"))]),
    # Lit wherever the surface faces the light is what a renderer without shadows has.
    "contact": Effect(
        "contact_shadow", "contact", "960x540", 1, scenes=("gallery", "courtyard", "lounge"), with_bias=True,
        reference=("--length", 0.5),
        columns=[("unshaded", ["contact-shadow", "--length", 0]), *with_preset("contact-shadow", "--length", 0.5),
                 ("converged", ["contact-shadow", "--length", 0.5, "--steps", 1024])]),
}


class Files:
    """The files of one scene, made when they are asked for."""

    def __init__(self, effect, scene, options):
        self.effect, self.scene, self.options = effect, scene, options

    def path(self, ending):
        return self.options.folder / f"{self.scene}{ending}.exr"

    def call(self, *arguments):
        return call(self.options.gloam, *arguments)

    def frame(self):
        path = self.path("")
        if not path.exists():
            self.call("capture", self.scene, "-o", path, "--size", self.options.size, *self.effect.capture)
        return path

    def truth(self):
        path = self.path(f"_{self.effect.plane}_truth")
        if not path.exists():
            self.call("reference", self.effect.plane, self.frame(), "-o", path, "--samples", self.options.samples, *self.effect.reference)
        return path

    def made(self, technique, *settings):
        self.call("run", technique, self.frame(), "-o", self.path("_result"), "--float", *settings)
        return self.path("_result")

    def figures(self, command, channels=""):
        plane = f"{self.effect.plane}={channels}" if channels else self.effect.plane
        return figures(self.options.gloam, self.made(*command), self.truth(), plane)


def text_of(value, effect, sign=""):
    """.084: a share below 1 needs no zero before the point."""
    return f"{value:{sign}.{effect.digits}f}".replace("0.", ".", 1)


def print_row(name, found, effect):
    cells = [text_of(each["rmse"], effect) + (f" ({text_of(each['bias'], effect, '+')})" if effect.with_bias else "") for each in found]
    print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def print_table(effect, scenes, options):
    print("| scene | " + " | ".join(name for name, *_ in effect.columns) + " |\n|---|" + "---:|" * len(effect.columns))
    rows = []
    for scene in scenes:
        files = Files(effect, scene, options)
        rows.append([files.figures(*column) for _, *column in effect.columns])
        print_row(scene, rows[-1], effect)
    if len(rows) > 1:
        means = [{key: sum(each[key] for each in column) / len(rows) for key in ("rmse", "bias")} for column in zip(*rows)]
        print_row("mean", means, effect)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("effect", choices=EFFECTS)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", help="default: those of the README's table")
    parser.add_argument("--gloam", default="build/gloam")
    parser.add_argument("--size", help="default: that of the README's table")
    parser.add_argument("--samples", type=int, help="rays per pixel of the truth; default: those of the README's table")
    options = parser.parse_intermixed_args()
    effect = EFFECTS[options.effect]
    options.size = options.size or effect.size
    options.samples = options.samples or effect.samples
    options.folder.mkdir(parents=True, exist_ok=True)
    print_table(effect, options.scenes or effect.scenes or all_scenes(options.gloam), options)


if __name__ == "__main__":
    main()
