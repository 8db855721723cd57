"""Ambient occlusion, reflections and other image-space effects on NumPy arrays and EXR files.

    import gloam
    result = gloam.run("gtao", depth=z, normal=n, camera=gloam.Camera(fx=850, fy=850, cx=960, cy=540), radius=0.5)
    result["ao"]                # (height, width), float32, 1 open, 0 closed

Arrays have rows from the top: (height, width), or (height, width, components), of NumPy, torch or whatever shares the host's memory. Depth is
the distance along the viewing axis in scene units, or what depth_is says; +inf, NaN, 0 and less, 1e10 and more are background. Normals are in view space: x to the
right, y up, z towards the eye. A radius, and every other length, is in the unit of depth.

Whatever cannot be done raises `gloam.Error`, whose text is one sentence: what is wrong, the value, what is allowed. docs/python.md has the rest.
"""

from . import _built

_built.check()

from . import _gloam
from ._auto import AutoResult, auto
from ._compare import compare
from ._device_memory import DeviceLayout, DevicePlane, device_layout, enqueue
from ._files import Run, Sequence, Written, read, write
from ._gloam import Camera, Device, DeviceInfo, Enqueued, Error, Frame, MissingPlanes, UsageError, devices
from ._pick import pick
from ._run import Pass, Result, run
from ._scenes import Scene, capture, reference, scenes
from ._techniques import Parameter, Technique, techniques
from ._words import Note

__version__ = _gloam.version

__all__ = [
    "AutoResult", "Camera", "Device", "DeviceInfo", "DeviceLayout", "DevicePlane", "Enqueued", "Error", "Frame", "MissingPlanes", "Note", "Parameter", "Pass", "Result", "Run", "Scene", "Sequence",
    "Technique", "UsageError", "Written", "auto", "capture", "compare", "device_layout", "devices", "enqueue", "pick", "read", "reference", "run", "scenes", "techniques", "write",
]

for _public in __all__:
    globals()[_public].__module__ = "gloam"
del _public
