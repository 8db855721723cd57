"""A scene of scene.py, and its meshes for gloam's ray tracer: blender -b --factory-startup -P make.py -- KIND OUT.blend OUT.obj PERCENT"""
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scene as scenes  # noqa: E402

kind, out, meshes, percent = sys.argv[sys.argv.index("--") + 1:]
scene, camera = scenes.build()
getattr(scenes, kind)(scene, camera)
scene.render.resolution_percentage = int(percent)
bpy.ops.wm.save_as_mainfile(filepath=out)
bpy.ops.wm.obj_export(filepath=meshes, forward_axis="Y", up_axis="Z", export_materials=False, export_triangulated_mesh=True)
