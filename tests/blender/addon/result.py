"""What is in the .blend that the command line saved: blender -b SAVED.blend -P result.py -- ORIGINAL.blend ADDON_FOLDER FOLDER FRAME...

The image and the group are there and show the AO that gloam wrote, the compositor multiplies the colour by it, and all else is as
in the original."""
import os
import sys

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
original, addon, folder, *frames = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon)
import state  # noqa: E402
from gloam_blender.exr_planes import read_channels  # noqa: E402

FAULTS = []


def check(name, holds, found=""):
    if not holds:
        FAULTS.append(f"{name}: {found}")


def rendered(scene, name, frame, is_composited):
    """Colours of the views, as an array of (height, width, 3) for each."""
    render = scene.render
    scene.frame_set(frame)
    scene.cycles.samples = 1
    render.use_compositing = is_composited
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.image_settings.views_format = "INDIVIDUAL"
    render.filepath = os.path.join(folder, f"{name}.exr")
    bpy.ops.render.render(write_still=True)
    ends = [view.file_suffix for view in render.views if view.use] if render.use_multiview else [""]
    files = [os.path.join(folder, f"{name}{end}.exr") for end in ends]
    return [numpy.stack([read_channels(file)[c] for c in "RGB"], -1) for file in files]


saved = state.lines()
scene = bpy.context.scene
images = [image for image in bpy.data.images if image.get("gloam_scene") == scene.name]
groups = [group for group in bpy.data.node_groups if group.get("gloam_scene") == scene.name]
check("image", len(images) == 1 and os.path.exists(bpy.path.abspath(images[0].filepath)), [image.filepath for image in bpy.data.images])
check("group", len(groups) == 1 and groups[0].use_fake_user, bpy.data.node_groups.keys())
used = [node for node in scene.node_tree.nodes if getattr(node, "node_tree", None) in groups]
check("compositor", scene.use_nodes and len(used) == 1, list(scene.node_tree.nodes))
scene.world.color = (0.5, 0.7, 0.9)
for frame in map(int, frames):
    planes = read_channels(os.path.join(folder, "gloam", f"scene_Scene_ao.{frame:04d}.exr"))
    views = [planes["AO"]] + [plane for name, plane in planes.items() if name.endswith(".AO")]
    plain, multiplied = rendered(scene, "plain", frame, False), rendered(scene, "multiplied", frame, True)
    check("views", len(views) == len(plain), (list(planes), len(plain)))
    for ao, colour, product in zip(views, plain, multiplied):
        off = numpy.abs(colour * ao[..., None] - product).max()
        print(f"frame {frame}: AO {ao.min():.3f} to {ao.max():.3f}, colour up to {colour.max():.3f}, colour x AO {off:.5f} off")
        check(f"frame {frame}", off < 1e-3 and ao.min() < 0.6 and colour.max() > 0.1, off)
bpy.ops.wm.open_mainfile(filepath=original)
before = state.lines()
for text in (saved, before):  # the compositor was asked for
    text["scene Scene"] = text["scene Scene"].replace("use_nodes: True", "use_nodes: False")
changed = state.difference(before, saved)
check("changed", changed == ["names of images", "names of node_groups"], changed)
for fault in FAULTS:
    print(f"FAULT {fault}")
sys.stdout.flush()
sys.exit(1 if FAULTS else 0)
