"""The add-on as a user installs it, and its button: blender -b --factory-startup -P addon.py -- ZIP GLOAM FOLDER VERSION"""
import os
import re
import subprocess
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scene as scenes  # noqa: E402

archive, gloam, folder, version = sys.argv[sys.argv.index("--") + 1:]
FAULTS = []


def check(name, holds, found=""):
    if not holds:
        FAULTS.append(f"{name}: {found}")


def press():
    """What the button says where it fails; nothing where it does its work."""
    try:
        bpy.ops.gloam.ambient_occlusion()
    except RuntimeError as error:
        return str(error).strip()
    return ""


scene, camera = scenes.build()  # factory settings: without add-ons
bpy.ops.preferences.addon_install(filepath=archive)
bpy.ops.preferences.addon_enable(module="gloam_blender")
import gloam_blender  # noqa: E402

manifest = open(os.path.join(os.path.dirname(gloam_blender.__file__), "blender_manifest.toml")).read()
check("version", ".".join(map(str, gloam_blender.bl_info["version"])) == version, gloam_blender.bl_info["version"])
check("manifest", re.search(r'^version = "(.*)"$', manifest, re.M).group(1) == version, manifest)

bpy.context.preferences.addons["gloam_blender"].preferences.program = os.path.join(folder, "nowhere")
said = press()
check("no gloam", "is no program" in said, said)
bpy.context.preferences.addons["gloam_blender"].preferences.program = gloam
from gloam_blender import interface  # noqa: E402

names = [item[0] for item in interface.technique_items(scene.gloam, bpy.context)]
check("techniques", {"ao", "evidence", "gtao", "stereo-gtao"} <= set(names) and not {"sssr", "bilateral", "dp-gtao"} & set(names), names)
scene.gloam.technique, scene.gloam.preset, scene.gloam.radius = "gtao", "low", 0.5
scene.gloam.output = folder
scene.gloam.overscan = 10
scene.render.engine = "BLENDER_EEVEE"
scene.use_nodes = True
for _ in range(2):  # the second run brings image and group up to date
    said = press()
    check("button", said == "", said)
from gloam_blender import exr_planes  # noqa: E402

render = (0, 0, scenes.WIDTH, scenes.HEIGHT)
written = exr_planes.read(os.path.join(folder, "Scene_ao.0001.exr"))
check("size with overscan", (written.window, written.display) == (render, render) and written.channels["AO"].shape == render[:1:-1], written.window)
# gloam takes what lies in the margin for occluders, and writes the render.
rendered = exr_planes.read(os.path.join(folder, "Scene.0001.exr"))
grown = tuple(round(0.1 * side) for side in render[2:])
check("frame with overscan", (rendered.display, rendered.window) == (render, (-grown[0], -grown[1], render[2] + grown[0], render[3] + grown[1])), rendered.window)
by_hand = [os.path.join(folder, f"by_hand{name}.exr") for name in ("", "_whole")]
for path, flags in zip(by_hand, ([], ["--keep-margin"])):
    subprocess.run([gloam, "run", "gtao", os.path.join(folder, "Scene.0001.exr"), "-o", path, "--preset", "low", "--radius", "0.5",
                    "--normal-space", "world", "-q", *flags], check=True, stdout=subprocess.DEVNULL)
same, whole = map(exr_planes.read, by_hand)
check("the render is written", (same.window == render, whole.window == rendered.window, (same.channels["AO"] == written.channels["AO"]).all()) == (True, True, True),
      (same.window, whole.window))
from gloam_blender import job  # noqa: E402

check("no note on the margin", job.notes_in('{"notes": ["margin: 16 pixels", "radius"]}') == ["radius"])
groups = [node for node in scene.node_tree.nodes if node.bl_idname == "CompositorNodeGroup"]
image = bpy.data.images.get("gloam AO Scene")
check("image", image and tuple(image.size) == (scenes.WIDTH, scenes.HEIGHT), image and image.size[:])
check("group", len(groups) == 1 and groups[0].inputs["Strength"].default_value == 1 and len(bpy.data.node_groups) == 1, groups)
links = {(link.from_node.bl_idname, link.to_node.bl_idname) for link in scene.node_tree.links}
check("links", {("CompositorNodeRLayers", "CompositorNodeGroup"), ("CompositorNodeGroup", "CompositorNodeComposite")} <= links, links)
# Two .blend files beside each other: neither loses what the other wrote.
scene.gloam.output = "//gloam"
kept = {}
for blend in ("one", "two"):
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, f"{blend}.blend"))
    scene.camera.location.x += 0.3
    said = press()
    check(blend, said == "", said)
    kept.setdefault(blend, open(os.path.join(folder, "gloam", f"{blend}_Scene_ao.0001.exr"), "rb").read())
check("two files", kept["one"] != kept["two"] and kept["one"] == open(os.path.join(folder, "gloam", "one_Scene_ao.0001.exr"), "rb").read())
scene.camera = None
said = press()
check("no camera", "The scene has no camera; add one" in said, said)
bpy.ops.preferences.addon_disable(module="gloam_blender")
check("disabled", not hasattr(bpy.types.Scene, "gloam"))
for fault in FAULTS:
    print(f"FAULT {fault}")
sys.stdout.flush()
sys.exit(1 if FAULTS else 0)
