"""Cycles' ambient occlusion of each frame at pixel centres: blender -b SCENE.blend -P truth.py -- OUT_FOLDER SAMPLES FRAME..."""
import os
import sys

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import cycles_ao  # noqa: E402

folder, samples, *frames = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene
cycles_ao.set_up(scene, samples)
scene.cycles.max_bounces = 0
scene.camera.data.dof.use_dof = scene.render.use_motion_blur = False
scene.render.image_settings.views_format = "MULTIVIEW"
for frame in frames:
    scene.frame_set(int(frame))
    scene.render.filepath = os.path.join(folder, f"truth.{int(frame):04d}.exr")
    bpy.ops.render.render(write_still=True)
