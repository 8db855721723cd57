"""The command line: blender -b scene.blend --python gloam_ao.py -- --technique gtao --animation --save with_ao.blend"""
import argparse
import os
import sys
import time

import bpy

from . import job
from .errors import Problem


class Parser(argparse.ArgumentParser):
    def error(self, message):
        print(f"gloam_ao: {message} (--help)", file=sys.stderr)
        sys.exit(2)


def percent(text):
    value = float(text)
    if not 0 <= value <= 50:
        raise argparse.ArgumentTypeError(f"{text} percent is not allowed; 0 to 50 is")
    return value / 100


def radius(text):
    value = float(text)
    if not 0 <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"a radius of {text} is not allowed; 0 (from the frame) or more is")
    return value


def parameter(text):
    if "=" not in text.strip("="):
        raise argparse.ArgumentTypeError(f"'{text}' is no parameter; NAME=VALUE is")
    return text


def frames(text):
    """1-10, 1-99x2, 1,5,9-12: as gloam's --frames."""
    numbers = set()
    try:
        for part in text.split(","):
            span, _, step = part.partition("x")
            first, _, last = span.partition("-")
            last, step = int(last or first), int(step or 1)
            if last < int(first) or step < 1:
                raise ValueError
            numbers.update(range(int(first), last + 1, step))
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' are no frames; 1-10, 1-99x2 or 1,5,9-12 are") from None
    return sorted(numbers)


def parser():
    one = Parser(prog="blender -b SCENE.blend --python gloam_ao.py --", formatter_class=argparse.RawDescriptionHelpFormatter,
                 description="Ambient occlusion of a Blender scene by gloam: passes, cameras, gloam, image and compositor group.",
                 epilog="example: blender -b shot.blend --python gloam_ao.py -- --technique gtao --preset high --animation --save shot_ao.blend")
    one.add_argument("--technique", default="ao", metavar="NAME", help="gloam list techniques shows them; ao: the default of gloam")
    one.add_argument("--preset", default="", metavar="NAME", help="low, medium, high or ultra, where the technique has presets")
    one.add_argument("--radius", type=radius, default=0.0, metavar="R", help="in scene units; 0 (the default): from the first frame's depths")
    one.add_argument("--set", dest="parameters", action="append", default=[], type=parameter, metavar="NAME=VALUE",
                     help="a parameter of the technique (repeatable)")
    one.add_argument("--temporal", action="store_true", help="the mean over the frames of an animation that showed each surface")
    which = one.add_mutually_exclusive_group()
    which.add_argument("--frames", type=frames, metavar="A-B", help="1-10, 1-99x2 or 1,5,9-12; default: the current frame")
    which.add_argument("--animation", action="store_true", help="all frames from the scene's start to its end")
    one.add_argument("--scene", metavar="NAME", help="default: the scene that the file was saved in")
    one.add_argument("--layer", metavar="NAME", help="view layer; default: the first that is rendered")
    one.add_argument("--engine", choices=("cycles", "scene"), default="cycles",
                     help="that renders the passes: Cycles (float depth), or the scene's own (EEVEE's depth is half)")
    one.add_argument("--overscan", type=percent, default=0.0, metavar="PERCENT", help="of the image's size to render on each side, 0 to 50")
    one.add_argument("--output", default="//gloam", metavar="FOLDER", help="default: //gloam, a folder beside the .blend")
    one.add_argument("--no-compositor", action="store_true", help="load image and group, and leave the compositor as it is")
    one.add_argument("--gloam", default="", metavar="FILE", help="the gloam command; default: in PATH, or where this was installed")
    one.add_argument("--save", metavar="FILE.blend", help="write the .blend with image and group; without, no .blend is changed")
    return one


def scene_of(name):
    if not name:
        return bpy.context.scene
    if name not in bpy.data.scenes:
        raise Problem(f"the file has no scene '{name}'; it has {', '.join(scene.name for scene in bpy.data.scenes)}")
    return bpy.data.scenes[name]


def first_layer(scene):
    return next((layer.name for layer in scene.view_layers if layer.use), scene.view_layers[0].name)


def settings_of(flags, scene):
    numbers = [scene.frame_current]
    if flags.animation:
        numbers = list(range(scene.frame_start, scene.frame_end + 1, scene.frame_step))
    return job.Settings(frames=flags.frames or numbers, output=flags.output, layer=flags.layer or first_layer(scene),
                        program=flags.gloam, technique=flags.technique, preset=flags.preset, radius=flags.radius,
                        parameters=tuple(flags.parameters), temporal=flags.temporal, engine=flags.engine.upper(),
                        overscan=flags.overscan, insert=not flags.no_compositor)


def check_save(path):
    folder = os.path.dirname(os.path.abspath(path)) if path else "."
    if not path or os.path.isdir(folder) and os.access(folder, os.W_OK):
        return
    raise Problem(f"'{path}' cannot be written: the folder '{folder}' is not there or is not yours; name another one with --save")


def run(flags):
    check_save(flags.save)
    scene = scene_of(flags.scene)
    settings, outcome = settings_of(flags, scene), job.Outcome()
    for progress in job.steps(scene, settings, outcome):
        if progress.is_waiting:
            time.sleep(0.02)
    for note in outcome.notes + outcome.done:
        print(f"gloam_ao: {note}")
    print(f"gloam_ao: radius {outcome.radius:g}; wrote {len(outcome.files)} files: {', '.join(map(os.path.basename, outcome.files))}")
    print(f"gloam_ao: in '{outcome.folder}'; image '{outcome.image.name}', compositor group '{outcome.group.name}'")
    if flags.save:
        try:
            bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(flags.save), copy=True, check_existing=False)
        except RuntimeError as error:
            raise Problem(f"'{flags.save}' was not written: {str(error).strip()}") from error
        print(f"gloam_ao: saved '{flags.save}'")
    else:
        print("gloam_ao: no .blend was written; --save FILE.blend keeps image and group")


def main(arguments):
    """Exit status: 0 done, 1 failed (one line on standard error), 2 wrong usage."""
    flags = parser().parse_args(arguments)
    try:
        run(flags)
    except Problem as problem:
        print(f"gloam_ao: {problem}", file=sys.stderr)
        return 1
    return 0
