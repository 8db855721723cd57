"""blender -b --factory-startup -P make.py -- KIND OUT.blend"""
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scene as scenes  # noqa: E402

kind, out = sys.argv[sys.argv.index("--") + 1:]
scene, camera = scenes.build()
getattr(scenes, kind)(scene, camera)
bpy.ops.wm.save_as_mainfile(filepath=out)
