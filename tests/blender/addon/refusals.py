"""What cannot be done is told in one sentence, and changes nothing.

blender -b --factory-startup -P refusals.py -- ADDON_FOLDER GLOAM FOLDER"""
import contextlib
import io
import os
import sys
import tempfile

import bpy
from mathutils import Matrix

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
addon, gloam, folder = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon)
import scene as scenes  # noqa: E402
import state  # noqa: E402
from gloam_blender import command_line, job  # noqa: E402

FAULTS = []


def expect(name, words, *flags, change=None, status=1):
    """A run of the command line on a fresh scene that `change` has spoilt."""
    scene, camera = scenes.build()
    if change:
        change(scene, camera)
        bpy.context.view_layer.update()
    before, said = state.lines(), io.StringIO()
    with contextlib.redirect_stderr(said):
        try:
            found = command_line.main(["--gloam", gloam, "--output", folder, "--radius", "0.5", *flags])
        except SystemExit as end:
            found = end.code
    text = said.getvalue()
    if found != status or text.count("\n") != 1 or not text.startswith("gloam_ao: ") or words not in text:
        FAULTS.append(f"{name}: status {found}, said {text!r}, expected {status} and one line with '{words}'")
    changed = state.difference(before, state.lines())
    if changed:
        FAULTS.append(f"{name}: changed {changed}")
    print(f"{name}: {text.strip()}")


def set_type(kind):
    def change(_, camera):
        camera.data.type = kind
    return change


def remove_camera(scene, camera):
    bpy.data.objects.remove(camera)


def light_as_camera(scene, _):
    scene.camera = bpy.data.objects["Sphere"]


def mirror(_, camera):
    camera.matrix_world = camera.matrix_world @ Matrix.Diagonal((-1, 1, 1, 1))



def shear_by_parent(scene, camera):
    parent = bpy.data.objects.new("parent", None)
    scene.collection.objects.link(parent)
    parent.scale, camera.parent = (1, 1, 3), parent
    bpy.context.view_layer.update()


def no_views(scene, _):
    scene.render.use_multiview = True
    for view in scene.render.views:
        view.use = False


def spherical(scene, camera):
    scene.render.use_multiview = camera.data.stereo.use_spherical_stereo = True


def animated_focus(scene, camera):
    camera.data.dof.use_dof = True
    camera.data.dof.keyframe_insert("use_dof", frame=1)


def animated_shift(scene, camera):
    camera.data.shift_x = 0.1
    camera.data.keyframe_insert("shift_x", frame=1)


def folder_with(name, text):
    """A folder in which a file of the scene's name lies already."""
    path = tempfile.mkdtemp(dir=folder)
    with open(os.path.join(path, name), "w") as taken:
        taken.write(text)
    return path


file = os.path.join(folder, "file")
open(file, "w").close()
expect("no camera", "has no camera; add one", change=remove_camera)
expect("no camera object", "is no camera object", change=light_as_camera)
expect("panorama", "is panoramic", change=set_type("PANO"))
expect("mirrored", "is mirrored", change=mirror)
expect("sheared", "is sheared", change=shear_by_parent)
expect("no views", "no view is used", change=no_views)
expect("spherical", "spherical stereo", change=spherical)
expect("focus", "depth of field", change=animated_focus)
expect("shift", "is animated, and overscan cannot follow", "--overscan", "10", change=animated_shift)
expect("no gloam", "is no program", "--gloam", "/nowhere/gloam")
expect("another program", "is not gloam", "--gloam", "/bin/true")
expect("technique", "did you mean 'gtao'", "--technique", "gtoa")
expect("reflections", "makes no ambient occlusion", "--technique", "sssr")
expect("layers", "reads peel, which Blender does not render", "--technique", "dp-gtao")
expect("second eye", "needs a second view", "--technique", "stereo-gtao")
expect("preset", "has no preset 'best'", "--preset", "best")
expect("parameter", "no parameter 'colour'", "--set", "colour=red")
expect("folder", "cannot be written", "--output", os.path.join(file, "out"))
expect("files of another .blend", "belongs to the scene 'Scene' of '../other.blend': it would be lost", "--output",
       folder_with("Scene.camera.json", '{"blend": "../other.blend", "scene": "Scene", "frames": {"1": {}}}'))
expect("a camera of nobody", "belongs to something else", "--output", folder_with("Scene.camera.json", '{"fx": 100}'))
expect("a picture of nobody", "Scene_ao_rgb.0001.exr' is there and belongs to something else", "--output", folder_with("Scene_ao_rgb.0001.exr", ""))
expect("scene", "has no scene 'other'", "--scene", "other")
expect("layer", "has no view layer 'other'", "--layer", "other")
expect("save", "is not there", "--save", "/nowhere/out.blend")
expect("early frame", "frame -3 is before frame 0", change=lambda scene, _: scene.frame_set(-3))
expect("engine", "EEVEE renders only where there is a display", "--engine", "scene",
       change=lambda scene, _: setattr(scene.render, "engine", "BLENDER_EEVEE"))
for flags in (("--radius", "-1"), ("--radius", "nan"), ("--frames", "5-1"), ("--overscan", "80"), ("--set", "radius"), ("--colour",),
              ("--frames", "1", "--animation")):
    expect(" ".join(flags), "(--help)", *flags, status=2)
# Escape in the middle of an animation.
scene, camera = scenes.build()
scenes.animation(scene, camera)
bpy.context.view_layer.update()
before = state.lines()
steps = job.steps(scene, job.Settings(frames=[1, 2, 3], output=folder, layer="ViewLayer", program=gloam), job.Outcome())
for _ in range(3):
    print(next(steps).text)
steps.close()
if state.difference(before, state.lines()):
    FAULTS.append(f"cancelled: changed {state.difference(before, state.lines())}")
# A lens that changes, which the motion pass of Cycles does not know of.
for is_zooming in (False, True):
    scene, camera = scenes.build()
    scenes.animation(scene, camera)
    if is_zooming:
        camera.data.keyframe_insert("lens", frame=1)
        camera.data.lens = 80
        camera.data.keyframe_insert("lens", frame=3)
    outcome = job.Outcome()
    for _ in job.steps(scene, job.Settings(frames=[1, 2], output=folder, layer="ViewLayer", program=gloam, temporal=True), outcome):
        pass
    if any("lens is animated" in note for note in outcome.notes) != is_zooming:
        FAULTS.append(f"zooming {is_zooming}: notes {outcome.notes}")
for fault in FAULTS:
    print(f"FAULT {fault}")
sys.stdout.flush()
sys.exit(1 if FAULTS else 0)
