"""The camera that is written against the positions that Cycles renders, for every way to set a camera up; and what a capture
leaves behind: blender -b --factory-startup -P cameras.py -- ADDON_FOLDER FOLDER"""
import os
import sys

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
addon, folder = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, addon)
import scene as scenes  # noqa: E402
import state  # noqa: E402
from gloam_blender.capture import Capture, region  # noqa: E402
from gloam_blender.exr_planes import read, read_channels  # noqa: E402

FAULTS = []


def check(name, holds, found):
    if not holds:
        FAULTS.append(f"{name}: {found}")


def planes_of(channels, pass_name, axes, suffix):
    return numpy.stack([channels[f"ViewLayer.{pass_name}{suffix}.{axis}"] for axis in axes], -1).astype(numpy.float64)


def projected(view, place, size):
    """Pixels from the top left corner, and depth, of positions in the world. size: height and width of what is shown."""
    pose = numpy.array(view["camera_to_world"])
    place = (place - pose[:3, 3]) @ pose[:3, :3]
    scale = numpy.array([view[key] for key in (("pixels_per_unit",) * 2 if view["camera_type"] == "ORTHO" else ("fx", "fy"))])
    if "projection_gl" in view:
        scale = numpy.array([view["projection_gl"][0][0] * size[1], view["projection_gl"][1][1] * size[0]]) / 2
    away = -place[..., 2]
    across = place[..., :2] / (away[..., None] if view["camera_type"] == "PERSP" else 1)
    return scale[0] * across[..., 0] + view["cx"], view["cy"] - scale[1] * across[..., 1], away


def centres(window):
    y, x = numpy.mgrid[window[1]:window[3], window[0]:window[2]] + 0.5
    return x, y


def check_view(name, view, image, suffix):
    """Each position lands on the centre of its pixel, at the depth that is written."""
    channels, size = image.channels, (image.display[3], image.display[2])
    depth = planes_of(channels, "Depth", "Z", suffix)[..., 0]
    normal = planes_of(channels, "Normal", "XYZ", suffix)
    found_x, found_y, away = projected(view, planes_of(channels, "Position", "XYZ", suffix), size)
    x, y = centres(image.window)
    seen = depth < 1e9
    off = max(numpy.abs(found_x - x)[seen].max(), numpy.abs(found_y - y)[seen].max())
    wrong = numpy.abs(depth / away - 1)[seen].max()
    length = numpy.abs(numpy.linalg.norm(normal, axis=-1) - 1)[seen].max()
    print(f"{name}{suffix}: {seen.mean():.0%} of {depth.shape[1]}x{depth.shape[0]} seen, "
          f"{off:.4f} pixels off, depth {wrong:.1e}, normals {length:.1e}")
    check(f"{name}{suffix}", seen.mean() > 0.5 and off < 0.01 and wrong < 1e-5 and length < 1e-4, (off, wrong, length))
    return depth


def capture(name, change=None, overscan=0.0, frame=1, size=None, border=None):
    """size: height and width of what is shown; border: pixels rendered around it, left, top, right and bottom."""
    scene, camera = scenes.build()
    scene.view_layers[0].use_pass_position = True
    if change:
        change(scene, camera)
    bpy.context.view_layer.update()
    before = state.lines()
    path = os.path.join(folder, f"{name}.exr")
    with Capture(scene, "ViewLayer", "CYCLES", overscan) as copy:
        copy.go_to(frame)
        written = copy.render(path)
    changed = state.difference(before, state.lines())
    check(name, not changed, f"changed {changed}")
    image, views = read(path), written.get("views", [written])
    depths = [check_view(name, view, image, f".{view['view']}" if len(views) > 1 else "") for view in views]
    left, top, width, height = *image.window[:2], *image.display[2:]
    found = (height, width), (-left, -top, image.window[2] - width, image.window[3] - height)
    check(name, found == (size or found[0], border or (0, 0, 0, 0)) or overscan and not border, found)
    check(name, (written["height"], written["width"]) == (height, width), written)
    check(name, not any(".Combined." in channel or "gloam" in channel for channel in image.channels), list(image.channels))
    return {channel: plane.astype(numpy.float32) for channel, plane in image.channels.items()}, depths, written


def camera_with(resolution=None, aspect=None, **values):
    def change(scene, camera):
        for key, value in values.items():
            setattr(camera.data, key, value)
        if resolution:
            scene.render.resolution_x, scene.render.resolution_y = resolution
        if aspect:
            scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = aspect
    return change


def stereo_with(mode, pivot, **values):
    def change(scene, camera):
        camera_with(**values)(scene, camera)
        scene.render.use_multiview = True
        eyes = camera.data.stereo
        eyes.convergence_mode, eyes.pivot, eyes.interocular_distance, eyes.convergence_distance = mode, pivot, 0.3, 5
    return change


def part_of_the_size(scene, _):
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 333, 251, 37


def scaled(_, camera):
    camera.scale = (2, 3, 0.5)


def cropped(scene, _):
    render = scene.render
    render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.2, 0.7, 0.1, 0.6


def own_cameras(scene, camera):
    """Multi-View: two cameras, found by the ends of their names."""
    scene.render.use_multiview, scene.render.views_format = True, "MULTIVIEW"
    camera.name = "shot_L"
    second = camera.copy()
    second.data = camera.data.copy()
    second.data.lens, second.name = 40, "shot_R"
    second.location.x += 0.4
    scene.collection.objects.link(second)


def cut(scene, camera):
    """Markers choose the camera: at frame 5 another one."""
    second = camera.copy()
    second.data = camera.data.copy()
    second.data.shift_x = 0.2
    scene.collection.objects.link(second)
    for frame, item in ((1, camera), (5, second)):
        scene.timeline_markers.new(str(frame), frame=frame).camera = item


def carried(scene, camera):
    scenes.animation(scene, camera)
    scenes.frame(scene, camera)
    parent = bpy.data.objects.new("rig", None)
    scene.collection.objects.link(parent)
    camera.parent = parent
    parent.rotation_euler.z = 0.1


def zooming(scene, camera):
    carried(scene, camera)
    camera.data.keyframe_insert("lens", frame=1)
    camera.data.lens = 80
    camera.data.keyframe_insert("lens", frame=3)
    scene.frame_set(1)


def without_materials(scene, _):
    """What no material with nodes covers: a ball without a material, a floor with an empty place for one, blocks whose material has no
    nodes, and a mirror."""
    bpy.data.objects["Sphere"].data.materials.clear()
    bpy.data.objects["Plane"].data.materials[0] = None
    bpy.data.objects["Plane.001"].data.materials[0] = scenes.material_of(0)
    bpy.data.materials["rough 0.75"].use_nodes = False


def own_output(scene, _):
    """A material that fills an output of roughness itself."""
    tree = bpy.data.materials["rough 0.75"].node_tree
    node = tree.nodes.new("ShaderNodeOutputAOV")
    node.name, node.inputs["Value"].default_value = "Roughness", 0.5


def hidden_ball(scene, _):
    """The ball is in a collection that the view layer leaves out; the compositor, which writes files, is on."""
    collection = bpy.data.collections.new("left out")
    scene.collection.children.link(collection)
    ball = bpy.data.objects["Sphere"]
    scene.collection.objects.unlink(ball)
    collection.objects.link(ball)
    scene.view_layers[0].layer_collection.children["left out"].exclude = True
    scene.view_layers.new("second")
    scene.use_nodes = True
    output = scene.node_tree.nodes.new("CompositorNodeOutputFile")
    output.base_path = os.path.join(folder, "of the compositor")
    scene.node_tree.links.new(scene.node_tree.nodes["Render Layers"].outputs["Image"], output.inputs[0])


channels, depths, _ = capture("plain", size=(scenes.HEIGHT, scenes.WIDTH))
roughness = numpy.unique(channels["ViewLayer.Roughness.X"])
check("roughness", numpy.array_equal(roughness, [0.25, 0.75]), roughness)
check("albedo", abs(channels["ViewLayer.DiffCol.R"].max() - 0.8) < 1e-3, channels["ViewLayer.DiffCol.R"].max())
channels, _, _ = capture("without_materials", without_materials)
roughness = numpy.unique(channels["ViewLayer.Roughness.X"], return_counts=True)
check("without materials", numpy.array_equal(roughness[0], [0, 1]) and roughness[1][1] > 1000, roughness)
channels, _, _ = capture("own_output", own_output)
roughness = numpy.unique(channels["ViewLayer.Roughness.X"])
check("own output", numpy.array_equal(roughness, [0.25, 0.5]), roughness)
capture("shift", camera_with(shift_x=0.13, shift_y=-0.21))
capture("vertical", camera_with(sensor_fit="VERTICAL", sensor_width=30, sensor_height=20, shift_x=0.1, shift_y=0.05))
capture("tall", camera_with((120, 160), sensor_width=30, sensor_height=20, shift_x=-0.1, shift_y=0.1))
capture("horizontal_tall", camera_with((120, 160), sensor_fit="HORIZONTAL", sensor_width=30, sensor_height=20, shift_y=0.1))
capture("wide_pixels", camera_with(aspect=(2, 1), shift_x=0.1, shift_y=0.1))
capture("high_pixels", camera_with(aspect=(1, 1.5), shift_x=0.1, shift_y=0.1))
capture("orthographic", camera_with(type="ORTHO", ortho_scale=7, shift_x=0.1, shift_y=-0.08))
capture("orthographic_wide_pixels", camera_with(aspect=(1.5, 1), type="ORTHO", ortho_scale=7, shift_x=0.1, shift_y=-0.08))
capture("percentage", part_of_the_size, size=(92, 123))
capture("scaled", scaled)
capture("overscan", camera_with(shift_x=0.1, shift_y=0.07), overscan=0.1, size=(scenes.HEIGHT, scenes.WIDTH),
        border=(16, 12, 16, 12))
capture("overscan_tall", camera_with((121, 120), (1, 1.02), shift_x=0.1), overscan=0.07)
capture("overscan_orthographic", camera_with(type="ORTHO", ortho_scale=7, shift_x=0.1), overscan=0.1)
for mode in ("OFFAXIS", "PARALLEL", "TOE"):
    for pivot in ("LEFT", "RIGHT", "CENTER"):
        capture(f"{mode}_{pivot}", stereo_with(mode, pivot, shift_x=0.05))
capture("stereo_tall", stereo_with("OFFAXIS", "CENTER", resolution=(120, 160)))
capture("stereo_overscan", stereo_with("OFFAXIS", "CENTER"), overscan=0.1)
capture("stereo_orthographic", stereo_with("TOE", "CENTER", type="ORTHO", ortho_scale=7))
capture("own_cameras", own_cameras)
capture("cut", cut, frame=6, overscan=0.1)
capture("zooming", zooming, frame=2)
channels, (depth,), _ = capture("carried", carried, frame=2)
_, _, earlier = capture("carried_before", carried, frame=1)
# Vector: where the surface was in the frame before, y up.
(before_x, before_y, _) = projected(earlier, planes_of(channels, "Position", "XYZ", ""), depth.shape)
x, y = centres((0, 0, depth.shape[1], depth.shape[0]))
motion = planes_of(channels, "Vector", "XY", "")
off = max(numpy.abs(before_x - x - motion[..., 0]).max(), numpy.abs(y - before_y - motion[..., 1]).max())
print(f"motion up to {numpy.abs(motion).max():.1f} pixels, {off:.4f} off")
check("motion", off < 0.01 and numpy.abs(motion).max() > 5, (off, numpy.abs(motion).max()))
channels, (hidden,), _ = capture("hidden", hidden_ball)
check("layers", all(name.startswith("ViewLayer.") for name in channels), list(channels))
check("hidden", (hidden > depths[0] + 0.1).sum() > 100, "the ball is there")
check("hidden", not os.path.exists(os.path.join(folder, "of the compositor")), "the compositor wrote files")
scene, camera = scenes.build()
cropped(scene, camera)
scene.cycles.samples = 1
scene.render.image_settings.file_format, scene.render.filepath = "OPEN_EXR", os.path.join(folder, "cropped_by_blender.exr")
bpy.ops.render.render(write_still=True)
own = read_channels(scene.render.filepath)["R"].shape
check("region", region(scene.render) == (32, 48, 112, 108) and own == (60, 80), (region(scene.render), own))
capture("cropped", cropped, size=own, border=(32, 48, 48, 12))
capture("cropped_overscan", cropped, overscan=0.1, size=own, border=(48, 60, 64, 24))
left = [name for name in os.listdir(folder) if "part" in name]
check("files", not left, left)
for fault in FAULTS:
    print(f"FAULT {fault}")
sys.stdout.flush()
sys.exit(1 if FAULTS else 0)
