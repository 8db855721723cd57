"""Ambient occlusion of a Blender scene by gloam, without a window.

blender -b SCENE.blend --python gloam_ao.py -- --technique gtao --preset high --animation --save with_ao.blend
blender -b --python gloam_ao.py -- --help
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from gloam_blender import command_line  # noqa: E402

status = command_line.main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
sys.stdout.flush()
sys.exit(status)
