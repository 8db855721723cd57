"""Renders small frames with depth, normals and positions, and saves their scenes: shift.exr and shift.blend, ortho.*, eyes.*.

blender -b --factory-startup --python-exit-code 1 -P render_positions.py -- FOLDER

shift: a shifted lens, a vertical sensor fit, pixels twice as wide as high, half resolution, frame 3. ortho: orthographic.
eyes: two views that converge at a distance. Positions are those of pixel centres.
"""
import os
import sys

import bpy
import mathutils


def add_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=30)
    for i in range(6):
        bpy.ops.mesh.primitive_cube_add(size=1 + 0.3 * i, location=(i - 3, 1.5 * (i % 3), 0.6 + 0.5 * (i % 2)))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.location = (6, -7, 5)
    camera.rotation_euler = mathutils.Euler((1.05, 0.05, 0.7))
    camera.scale = (2, 2, 2)  # has no effect on a camera
    scene.world = bpy.data.worlds.new("world")
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_position = True
    scene.render.resolution_x, scene.render.resolution_y = 160, 90
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    return scene, camera.data


def render(scene, folder, name):
    scene.render.filepath = os.path.join(folder, name + ".exr")
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, name + ".blend"))
    bpy.ops.render.render(write_still=True)


def main(folder):
    scene, camera = add_scene()
    camera.sensor_fit, camera.sensor_height, camera.lens = "VERTICAL", 20, 28
    camera.shift_x, camera.shift_y = 0.12, -0.07
    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = 2, 1
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 200, 240, 50
    scene.camera.location = (6, -7, 5)
    scene.camera.keyframe_insert("location", frame=1)
    scene.camera.location = (5, -7.5, 5.5)
    scene.camera.keyframe_insert("location", frame=3)
    scene.frame_set(3)
    render(scene, folder, "shift")

    scene, camera = add_scene()
    camera.type, camera.ortho_scale = "ORTHO", 9
    render(scene, folder, "ortho")

    scene, camera = add_scene()
    scene.render.use_multiview = True
    scene.render.views_format = "STEREO_3D"
    camera.stereo.convergence_mode, camera.stereo.convergence_distance = "OFFAXIS", 4
    camera.stereo.interocular_distance, camera.stereo.pivot = 0.3, "LEFT"
    scene.render.image_settings.views_format = "MULTIVIEW"
    render(scene, folder, "eyes")


main(*sys.argv[sys.argv.index("--") + 1:])
