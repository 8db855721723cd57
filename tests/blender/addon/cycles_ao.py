"""Cycles' ambient occlusion of each frame at pixel centres: blender -b SCENE.blend -P cycles_ao.py -- OUT_FOLDER SAMPLES FRAME..."""
import os
import sys

import bpy

folder, samples, *frames = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene
cycles, image = scene.cycles, scene.render.image_settings
cycles.samples, cycles.max_bounces = int(samples), 0
cycles.use_adaptive_sampling = False
cycles.pixel_filter_type, cycles.filter_width = "BOX", 0.01
scene.camera.data.dof.use_dof = scene.render.use_motion_blur = False
scene.view_layers[0].use_pass_ambient_occlusion = scene.view_layers[0].use_pass_z = True
image.file_format, image.color_depth, image.views_format = "OPEN_EXR_MULTILAYER", "32", "MULTIVIEW"
for frame in frames:
    scene.frame_set(int(frame))
    scene.render.filepath = os.path.join(folder, f"truth.{int(frame):04d}.exr")
    bpy.ops.render.render(write_still=True)
