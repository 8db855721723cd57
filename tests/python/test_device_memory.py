"""gloam.enqueue: planes and results in a device's memory. OpenCL by ctypes stands in for pyopencl, whose objects have an int_ptr too."""

import ctypes

import gloam
import numpy as np
import pytest

OPENCL = ctypes.CDLL("libOpenCL.so.1")
for name in ("clCreateContext", "clCreateCommandQueue", "clCreateBuffer"):
    getattr(OPENCL, name).restype = ctypes.c_void_p
WIDTH, HEIGHT = 50, 33
CAMERA = gloam.Camera(fx=40, fy=40, cx=25, cy=16.5)


class Object:
    """As one of pyopencl."""

    def __init__(self, address):
        self.int_ptr = address


class Caller:
    """A program's own context, queue and buffers."""

    def __init__(self):
        platform, device = ctypes.c_void_p(), ctypes.c_void_p()
        assert OPENCL.clGetPlatformIDs(1, ctypes.byref(platform), None) == 0
        assert OPENCL.clGetDeviceIDs(platform, ctypes.c_uint64(0xFFFFFFFF), 1, ctypes.byref(device), None) == 0
        self.context = OPENCL.clCreateContext(None, 1, ctypes.byref(device), None, None, None)
        self.queue = OPENCL.clCreateCommandQueue(ctypes.c_void_p(self.context), device, ctypes.c_uint64(0), None)

    def buffer(self, data):
        """A buffer with the bytes of an array."""
        return OPENCL.clCreateBuffer(ctypes.c_void_p(self.context), ctypes.c_uint64(1 | 32), ctypes.c_size_t(data.nbytes),
                                     data.ctypes.data_as(ctypes.c_void_p), None)

    def read(self, buffer, array):
        assert OPENCL.clEnqueueReadBuffer(ctypes.c_void_p(self.queue), ctypes.c_void_p(buffer), 1, ctypes.c_size_t(0), ctypes.c_size_t(array.nbytes),
                                          array.ctypes.data_as(ctypes.c_void_p), 0, None, None) == 0
        return array


@pytest.fixture(scope="module")
def caller():
    return Caller()


@pytest.fixture(scope="module")
def device(caller):
    return gloam.Device(queue=Object(caller.queue))


def box(shift=0):
    z = np.full((HEIGHT, WIDTH), 5, np.float32)
    z[10:22, 15 + shift:35 + shift] = 4.5
    return z


def level_normals():
    n = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    n[..., 2] = 1
    return n


def laid_out(values=None):
    """Floats as gloam.device_layout says, and where the pixels are among them."""
    layout = gloam.device_layout(WIDTH, HEIGHT)
    data = np.full(layout.bytes // 4, np.nan, np.float32)
    rows = data[layout.offset // 4:][:HEIGHT * layout.pitch // 4].reshape(HEIGHT, layout.pitch // 4)
    if values is not None:
        rows[:, :WIDTH] = values
    return data, rows[:, :WIDTH], layout


def test_planes_that_lie_well_are_used_in_place(caller, device):
    data, _, layout = laid_out(box())
    result, pixels, _ = laid_out()
    memory, written = caller.buffer(data), caller.buffer(result)
    done = gloam.enqueue("gtao", {"depth": gloam.DevicePlane(Object(memory), layout.offset, layout.pitch, is_clean=True)},
                         {"ao": gloam.DevicePlane(written, layout.offset, layout.pitch)}, size=(WIDTH, HEIGHT), camera=CAMERA, device=device,
                         radius=1.0, preset="low")
    assert done.copied == [] and done.int_ptr > 0 and done.device_bytes > 0
    done.wait()
    caller.read(written, result)
    assert (pixels == gloam.run("gtao", depth=box(), camera=CAMERA, radius=1.0, preset="low")["ao"]).all()


def test_interleaved_planes_are_copied_on_the_device(caller, device):
    depth, normal, ao = box(), level_normals(), np.zeros((HEIGHT, WIDTH), np.float32)
    planes = {"depth": gloam.DevicePlane(caller.buffer(depth)), "normal": gloam.DevicePlane(caller.buffer(normal))}
    written = caller.buffer(ao)
    done = gloam.enqueue("gtao", planes, {"ao": gloam.DevicePlane(written)}, size=(WIDTH, HEIGHT), camera=CAMERA, device=device, radius=1.0)
    assert done.copied == ["depth", "normal", "ao"]
    done.wait()
    assert (caller.read(written, ao) == gloam.run("gtao", depth=depth, normal=normal, camera=CAMERA, radius=1.0)["ao"]).all()


def test_two_eyes(caller, device):
    eyes = [box(), box(2)]
    shifted = np.eye(4)
    shifted[0, 3] = 0.2
    cameras = [gloam.Camera(40, 40, 25, 16.5, camera_to_world=matrix) for matrix in (np.eye(4), shifted)]
    results = [np.zeros((HEIGHT, WIDTH), np.float32) for _ in eyes]
    written = [caller.buffer(result) for result in results]
    done = gloam.enqueue("stereo-ao", {"depth": [gloam.DevicePlane(caller.buffer(eye)) for eye in eyes]},
                         {"ao": [gloam.DevicePlane(memory) for memory in written]}, size=(WIDTH, HEIGHT), camera=cameras, device=device, radius=1.0)
    done.wait()
    expected = gloam.run("stereo-ao", depth=eyes, camera=cameras, radius=1.0)["ao"]
    for memory, result, of_run in zip(written, results, expected):
        assert (caller.read(memory, result) == of_run).all()


@pytest.fixture(scope="module")
def refusal(caller, device):
    """Enqueues a call with something wrong in it, and returns what is said."""
    memory = caller.buffer(box())

    def refuse(technique="gtao", drops=(), **changes):
        call = {"planes": {"depth": gloam.DevicePlane(memory)}, "results": {"ao": gloam.DevicePlane(memory)}, "size": (WIDTH, HEIGHT),
                "camera": CAMERA, "device": device, "radius": 1.0, **changes}
        with pytest.raises(gloam.Error) as caught:
            gloam.enqueue(technique, **{name: value for name, value in call.items() if name not in drops})
        assert "\n" not in str(caught.value)
        return str(caught.value)

    refuse.memory = memory
    return refuse


def test_what_is_wrong_with_a_call_is_said(refusal):
    assert refusal(drops=["radius"]) == "radius=: none is given, and planes in a device's memory are not looked at to make one; give a radius"
    assert "gloam.Device(queue=...) is allowed" in refusal(device="pocl")
    assert "(width, height) is allowed" in refusal(size=7)
    assert "(width, height) is allowed" in refusal(size=(None, 5))
    assert "an empty list" in refusal(camera=[])
    assert "a list of events is allowed" in refusal(wait_for=7)
    assert "a gloam.Camera is allowed" in refusal(camera=None)
    assert "given for 1 views, and there are 2 cameras" in refusal(camera=[CAMERA, CAMERA])
    assert refusal(repeat=3) == "repeat: does not go with planes in a device's memory; leave it out"
    assert "did you mean 'gtao'" in refusal(technique="gtoa")
    with pytest.raises(gloam.UsageError, match="queue is of type str"):
        gloam.Device(queue="mine")


def test_what_is_wrong_with_a_plane_is_said(refusal):
    of = lambda **facts: {"depth": gloam.DevicePlane(**{"memory": refusal.memory, **facts})}
    assert "did you mean 'ao'" in refusal(results={"aoo": gloam.DevicePlane(refusal.memory)})
    assert "needs 'depth'" in refusal(planes={"normal": gloam.DevicePlane(refusal.memory, step=12)})
    assert refusal(planes={"depth": refusal.memory}) == "plane 'depth' is of type int; a gloam.DevicePlane is allowed"
    assert "an object of pyopencl is allowed" in refusal(planes=of(memory="memory"))
    assert "ends at byte" in refusal(planes=of(offset=64))
    assert "offset of plane 'depth' is -4" in refusal(planes=of(offset=-4))
    assert refusal(planes={**of(), "normal": gloam.DevicePlane(refusal.memory, step=4)}) == (
        "plane 'normal': a step of 4 bytes is given; its 3 components side by side take 12")
    assert "of another context" in refusal(planes=of(memory=Caller().buffer(box())))
