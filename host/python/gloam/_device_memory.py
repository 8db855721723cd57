"""enqueue: a technique on planes in a device's memory."""

import collections

import numpy

from . import _gloam, _words
from ._gloam import Camera, Device
from ._run import _NAMED, _OPTIONS, check_names, request_words

DeviceLayout = collections.namedtuple("DeviceLayout", ["pitch", "offset", "bytes"])
DeviceLayout.__doc__ = """Where a plane of a size lies best in a buffer of its own, bytes: from row to row, before pixel (0, 0), and in all."""

DevicePlane = collections.namedtuple("DevicePlane", ["memory", "offset", "pitch", "step", "is_clean"], defaults=(0, 0, 0, False))
DevicePlane.__doc__ = """A plane in OpenCL buffers.

memory: a buffer of pyopencl, or its address (a cl_mem as a whole number), with the components of a pixel side by side; or a list with one
    for each component.  offset: bytes before pixel (0, 0).  pitch: bytes from row to row, and step: from pixel to pixel; 0: tight.
is_clean: the caller answers for every pixel (depth from 1e-30 to 1e10 or +inf, no NaN, normals of unit length or zero), and the plane is read
    in place; other values could lead a kernel out of its buffers. Else it is copied on the device: depth out of that range becomes +inf, and
    elsewhere NaN and components out of the plane's range become 0, or what background has."""


def device_layout(width, height):
    """The gloam.DeviceLayout of an image: a plane that lies so is used in place, without a copy. width, height: pixels."""
    return DeviceLayout(*_gloam.device_layout(_words.integer("width", width), _words.integer("height", height)))


def _described(name, plane):
    """A plane as the compiled part takes it."""
    if not isinstance(plane, DevicePlane):
        raise _words.refusal(f"plane '{name}' is of type {type(plane).__name__}; a gloam.DevicePlane is allowed")
    for field in ("offset", "pitch", "step"):
        number = getattr(plane, field)
        if isinstance(number, bool) or not isinstance(number, (int, numpy.integer)) or not 0 <= number < 1 << 63:
            raise _words.refusal(f"{field} of plane '{name}' is {number!r}; bytes are allowed, 0 or more")
    buffers = plane.memory if isinstance(plane.memory, (list, tuple)) else [plane.memory]
    handles = [_gloam.handle(f"memory of plane '{name}'", buffer) for buffer in buffers]
    return handles, int(plane.offset), int(plane.step), int(plane.pitch), bool(plane.is_clean)


def _of_views(planes, count):
    """A dict of planes, or of lists of planes, as one dict for each view."""
    lists = {name: plane if isinstance(plane, list) else [plane] for name, plane in planes.items()}
    for name, views in lists.items():
        if len(views) != count:
            raise _words.refusal(f"plane '{name}' is given for {len(views)} views, and there are {count} cameras; give one for each")
    return [{_words.text("name of a plane", name): _described(name, views[i]) for name, views in lists.items() if views[i] is not None}
            for i in range(count)]


def enqueue(technique, planes, results, *, size, camera, device, wait_for=(), settings=None, **keywords):
    """Enqueues a technique on planes in a device's memory, and returns a gloam.Enqueued without waiting. Nothing goes through the host.

    technique: a name of gloam.techniques().  planes, results: dicts of gloam.DevicePlane by the names of planes, read and written; of two eyes
        each value is a list of two, with None for a result that one of them lacks.  size: (width, height), pixels.  camera: a gloam.Camera, or a list with one for each view.
    device: gloam.Device(queue=...), of a queue that keeps the order of commands. The buffers are of its context, and live until the event
        is complete.  wait_for: events before which nothing begins.
    radius (scene units) and other parameters, settings, preset, filter, resolution, math, real, lanes and seed as for gloam.run; a technique with a radius
        needs one, since the pixels are not looked at.

    Raises gloam.Error, with what is wrong with which plane."""
    options = {name: keywords.pop(name) for name in _OPTIONS if name in keywords}
    for name in ("outputs", "repeat", "strips", "only"):
        if options.get(name) is not None:
            raise _words.refusal(f"{name}: does not go with planes in a device's memory; leave it out")
    check_names(keywords, _OPTIONS + _NAMED)
    words, run_words = request_words(technique, keywords, settings, options)
    if not isinstance(device, Device):
        raise _words.refusal(f"device is of type {type(device).__name__}; gloam.Device(queue=...) is allowed")
    if not isinstance(size, (list, tuple)) or len(size) != 2 or None in size:
        raise _words.refusal("size is no pair of numbers; (width, height) is allowed, pixels")
    cameras = list(camera) if isinstance(camera, (list, tuple)) else [camera]
    if not cameras:
        raise _words.refusal("camera is an empty list; a gloam.Camera is allowed, or a list with one for each view")
    for item in cameras:
        if not isinstance(item, Camera):
            raise _words.refusal(f"camera is of type {type(item).__name__}; a gloam.Camera is allowed, or a list of them")
    if not isinstance(planes, dict) or not planes or not isinstance(results, dict) or not results:
        raise _words.refusal("planes and results: dicts of gloam.DevicePlane by names of planes are allowed, with one plane at least")
    names = [""] if len(cameras) == 1 else ["left", "right"] if len(cameras) == 2 else [f"view{i}" for i in range(len(cameras))]
    views = list(zip(names, cameras, _of_views(planes, len(cameras)), _of_views(results, len(cameras))))
    pixels = tuple(_words.integer("size", number) for number in size)
    if not isinstance(wait_for, (list, tuple)):
        raise _words.refusal(f"wait_for is of type {type(wait_for).__name__}; a list of events is allowed")
    events = [_gloam.handle("an event of wait_for", event) for event in wait_for]
    return _gloam.enqueue(words, pixels, views, device, run_words, events)
