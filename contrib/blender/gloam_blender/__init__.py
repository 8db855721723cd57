"""Ambient occlusion of Blender scenes by gloam: see docs/blender.md."""
import sys

bl_info = {
    "name": "gloam Ambient Occlusion",
    "author": "The gloam authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > gloam Ambient Occlusion",
    "description": "Ambient occlusion in screen space, by the gloam command, as an image and a compositor group",
    "category": "Render",
}


def register():
    from . import interface

    interface.register()


def unregister():
    from . import interface

    interface.unregister()
    # A newer version may be installed over this one while Blender runs.
    for name in [name for name in sys.modules if name.startswith(__package__ + ".")]:
        del sys.modules[name]
