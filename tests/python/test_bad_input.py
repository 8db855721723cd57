"""What cannot be done raises one gloam.Error with a sentence, and nothing is lost: the next call works."""

import os
import subprocess
import sys

import numpy
import pytest

import gloam

CAMERA = dict(fx=100, fy=100, cx=75, cy=45)


@pytest.fixture()
def depth():
    return numpy.full((90, 150), 5, numpy.float32)


@pytest.fixture()
def camera():
    return gloam.Camera(**CAMERA)


def refused(call, sentence, kind=gloam.Error):
    with pytest.raises(kind) as raised:
        call()
    text = str(raised.value)
    assert sentence in text and "\n" not in text, text
    # Nothing is lost: the same process goes on.
    assert gloam.run("hbao+", depth=numpy.full((8, 16), 5, numpy.float32), camera=gloam.Camera(9, 9, 8, 4), radius=0.5)["ao"].shape == (8, 16)


@pytest.mark.parametrize("change, sentence", [
    (lambda z: z.astype(str), "has the dtype <U32"),
    (lambda z: z.astype("datetime64[s]"), "has the dtype datetime64[s]"),
    (lambda z: z.astype(object), "has the dtype object"),
    (lambda z: z.astype(complex), "has the dtype complex128"),
    (lambda z: z.ravel(), "plane 'depth' has the shape (13500,); (height, width) or (1, height, width) is allowed"),
    (lambda z: z[None, :, None, :, None], "has the shape (90, 1, 150, 1); (height, width)"),
    (lambda z: z[:0], "1 to 65536 pixels each way are allowed"),
    (lambda z: numpy.ma.masked_greater(z, 9), "plane 'depth' is a masked array"),
    (lambda z: z.tolist(), "plane 'depth' is of type list; an array is allowed, such as numpy.asarray(values, numpy.float32)"),
    (lambda z: None, "there is neither a frame nor an array"),
    (lambda z: numpy.zeros((2, 70000), numpy.float32), "1 to 65536 pixels each way"),
])
def test_arrays(change, sentence, depth, camera):
    refused(lambda: gloam.run("gtao", depth=change(depth), camera=camera, radius=0.5), sentence)


@pytest.mark.parametrize("call, sentence", [
    (lambda z: gloam.Device(3), "device is of type int; a text is allowed"),
    (lambda z: gloam.run("gtao", depth=z, fov=60, outputs=[z]), "outputs of type list is not allowed"),
    (lambda z: gloam.run("gtao", depth=z, fov=60, views=z), "views of type ndarray is not allowed"),
    (lambda z: gloam.read("none.exr", as_stored=z), "as_stored is of type ndarray; True or False is allowed"),
    (lambda z: gloam.read("none.exr", channels=z), "channels of type ndarray is not allowed"),
    (lambda z: gloam.capture("plane", 8, 8, eye=z[0, 0], target=(0, 0, 0)), "is not a point"),
])
def test_types(call, sentence, depth):
    refused(lambda: call(depth), sentence, gloam.UsageError)


def test_none_is_the_default():
    assert gloam.capture("plane", 16, None, ["normal"], peel=None, stochastic=None).height == 1080
    small = gloam.capture("plane", 16, 12, ["normal"])
    truth = gloam.reference(small, samples=32, what=None, falloff=None, seed=None)
    assert numpy.array_equal(truth["ao"], gloam.reference(small, samples=32)["ao"])


def test_light_that_is_none(depth, camera):
    color = numpy.random.default_rng(1).random((90, 150, 3), numpy.float32)

    def notes_on(color):
        return [note for note in gloam.run("indirect", depth=depth, color=color, camera=camera, radius=0.5).notes if note.startswith("color")]

    assert notes_on(color) == []
    odd = color.copy()
    odd[3, :4, 1] = -1
    odd[5, 7, 2] = numpy.inf
    infinite, negative = notes_on(odd)
    assert "1 pixel of 13500 is infinite or NaN" in infinite and "4 pixels of 13500 are negative" in negative
    assert "8-bit picture" in notes_on(numpy.round(color * 255) / numpy.float32(255))[0]


@pytest.mark.parametrize("mask", ["ao", "ao_raw"])
def test_a_mask_that_the_technique_makes(mask, depth, camera):
    refused(lambda: gloam.run("gtao", depth=depth, camera=camera, only=mask), f"gtao makes '{mask}' itself", gloam.UsageError)


def test_planes_of_two_sizes(depth, camera):
    refused(lambda: gloam.run("gtao", depth=depth, normal=numpy.zeros((90, 140, 3), numpy.float32), camera=camera),
            "plane 'normal' is 140 x 90 pixels, and 'depth' is 150 x 90")
    refused(lambda: gloam.run("gtao", depth=depth, normal=numpy.zeros((90, 150, 5), numpy.float32), camera=camera),
            "plane 'normal' has the shape (90, 150, 5); (height, width, 3) or (3, height, width) is allowed")


@pytest.mark.parametrize("change, sentence", [
    (dict(fx=float("nan")), "fx is nan; a number above 0 is allowed"),
    (dict(fy=0), "fy is 0"),
    (dict(cx=float("inf")), "camera:"),
    (dict(far=-1), "far is -1"),
    (dict(near=5, far=2), "far is 2; more than near, 5, is allowed"),
    (dict(camera_to_world=numpy.full((4, 4), numpy.nan)), "camera_to_world[0, 0] is nan; a finite number is allowed"),
    (dict(camera_to_world=numpy.diag([1, 1, 2, 1])), "camera_to_world"),
    (dict(camera_to_world=numpy.diag([1, 1, -1, 1])), "mirrors the world"),
    (dict(camera_to_world=numpy.eye(3)), "has the shape (3, 3); (4, 4) is allowed"),
    (dict(world_to_camera="north"), "world_to_camera is no matrix"),
    (dict(fx="9"), "camera: fx is of type str; a number is allowed"),
    (dict(cy=None), "camera: cy is of type NoneType"),
    (dict(near=[1]), "camera: near is of type list"),
    (dict(fy=True), "camera: fy is of type bool"),
    (dict(camera_to_world=numpy.eye(4), world_to_camera=numpy.eye(4)), "are both given"),
])
def test_cameras(change, sentence):
    refused(lambda: gloam.Camera(**{**CAMERA, **change}), sentence)


def test_no_camera_and_too_many(depth, camera):
    refused(lambda: gloam.run("gtao", depth=depth), "camera: none is given; give camera=gloam.Camera(")
    refused(lambda: gloam.run("gtao", depth=depth, camera=[camera, camera]), "there are 2 cameras and 1 views")
    refused(lambda: gloam.run("gtao", depth=[depth, depth], camera=camera), "there are 1 cameras and 2 views")
    refused(lambda: gloam.run("gtao", depth=depth, camera=(1, 2, 3, 4)), "camera is of type int; a gloam.Camera is allowed")
    refused(lambda: gloam.run("gtao", depth=depth, camera=camera, fov=60), "camera and fov are both given")
    refused(lambda: gloam.run("gtao", depth=depth, fov=600), "600", gloam.UsageError)


def test_all_missing_planes_at_once(depth, camera):
    with pytest.raises(gloam.MissingPlanes, match="sssr: needs 'color' and 'roughness', and the frame has only depth") as raised:
        gloam.run("sssr", depth=depth, camera=camera)
    assert raised.value.planes == ["color", "roughness"]
    refused(lambda: gloam.run("gtao"), "there is neither a frame nor an array")


def test_names_are_suggested_as_the_command_does(depth, camera, frame, command, tmp_path):
    gloam.write(tmp_path / "frame.exr", frame)
    for keywords, flags in [(dict(technique="gtoa"), ["gtoa"]), (dict(technique="gtao", radus=1), ["gtao", "--set", "radus=1"]),
                            (dict(technique="gtao", preset="hihg"), ["gtao", "--preset", "hihg"]),
                            (dict(technique="gtao", extras=["bent_norml"]), ["gtao", "--with", "bent_norml"]),
                            (dict(technique="gtao", outputs=["ao_rew"]), ["gtao", "--outputs", "ao_rew"]),
                            (dict(technique="gtao", only="corner-mesk"), ["gtao", "--only", "corner-mesk"]),
                            (dict(technique="gtao", radius=-1), ["gtao", "--set", "radius=-1"]),
                            (dict(technique="gtao", jitter="maybe"), ["gtao", "--set", "jitter=maybe"])]:
        with pytest.raises(gloam.UsageError) as raised:
            gloam.run(depth=depth, normal=numpy.zeros((90, 150, 3), numpy.float32), camera=camera, **keywords)
        said = command("run", flags[0], tmp_path / "frame.exr", "-o", tmp_path / "out.exr", *flags[1:], status=2)
        for flag, keyword in [("--with bent_norml", "extras='bent_norml'"), ("--only corner-mesk", "only='corner-mesk'"),
                              ("--plane mask=CHANNEL", "channels={'mask': 'CHANNEL'}")]:
            said = said.replace(flag, keyword)  # each caller reads its own spelling
        assert said.strip().endswith(str(raised.value)), (said, str(raised.value))
    refused(lambda: gloam.run("gtao", depth=depth, nromal=depth, camera=camera), "no plane 'nromal' (did you mean 'normal'?)")
    for wrong, right in (("presett", "preset"), ("outputt", "outputs"), ("devcie", "device"), ("resolutoin", "resolution")):
        refused(lambda: gloam.run("gtao", depth=depth, camera=camera, **{wrong: "high"}),
                f"no keyword '{wrong}' (did you mean '{right}'?); there are preset, ", gloam.UsageError)
    refused(lambda: gloam.run("gtao", depth=depth, camera=camera, math="fsat"), "did you mean 'fast'?", gloam.UsageError)
    refused(lambda: gloam.run("gtao", depth=depth, camera=camera, resolution="haf"), "did you mean 'half'?", ValueError)
    assert issubclass(gloam.UsageError, ValueError) and issubclass(gloam.Error, RuntimeError)


@pytest.mark.parametrize("keywords, sentence", [
    (dict(radius="wide"), "radius = 'wide' is not allowed"),
    (dict(radius=float("nan")), "radius = 'nan' is not allowed"),
    (dict(radius=[1, 2]), "radius is of type list; a number, True or False, or a word is allowed"),
    (dict(lanes=3), "3 lanes are not allowed"),
    (dict(lanes="many"), "lanes is of type str; a whole number is allowed"),
    (dict(seed=-1), "seed -1 is not allowed"),
    (dict(seed=1 << 40), "is not allowed; a whole number of 32 bits is"),
    (dict(repeat=0), "0 runs are not allowed"),
    (dict(outputs=[]), "outputs [] is not allowed"),
    (dict(settings=[("radius", 1)]), "settings is of type list"),
    (dict(device="none such"), "no device matches 'none such'; there are "),
    (dict(device=3), "device is of type int"),
    (dict(real=1), "real is of type int"),
])
def test_parameters(keywords, sentence, depth, camera):
    refused(lambda: gloam.run("gtao", depth=depth, camera=camera, **keywords), sentence)


def test_views_of_different_numbers(depth, camera):
    refused(lambda: gloam.run("gtao", depth=[depth, depth], normal=numpy.zeros((90, 150, 3), numpy.float32), camera=[camera] * 2),
            "plane 'normal' is one array, and others are lists of views; give a list of 2")
    refused(lambda: gloam.run("gtao", depth=[depth, depth], alpha=[depth], camera=[camera] * 2), "the planes have different numbers of views")
    refused(lambda: gloam.run("gtao", depth=[depth, depth], camera=[camera] * 2, views=["a", "a"]), "give each a name of its own")
    refused(lambda: gloam.run("stereo-gtao", depth=[depth, depth], camera=[camera] * 2), "a camera without a pose")
    refused(lambda: gloam.run("stereo-gtao", depth=depth, camera=camera), "needs a frame of two views")


def test_frames_with_arrays(frame, depth, camera):
    refused(lambda: gloam.run("gtao", frame, depth=depth[:80]), "the arrays are 150 x 80 pixels, and the frame has 150 x 90")
    refused(lambda: gloam.run("gtao", frame, depth=[depth, depth]), "the frame has 1 views, and 2 are given of depth")
    refused(lambda: gloam.run("gtao", "frame.exr", depth=depth), "depth: arrays do not go with a path")
    refused(lambda: gloam.run("gtao", frame, camera=camera), "camera: a gloam.Frame has its own")
    refused(lambda: gloam.run("gtao", 5), "frame is of type int")
    refused(lambda: gloam.run("gtao", "no_such_file.exr"), "no_such_file.exr")
    with pytest.raises(KeyError, match="no plane 'dept' \\(did you mean 'depth'\\?\\)"):
        frame["dept"]


def test_values_that_are_not_finite_are_background(depth, camera):
    depth[0, :4] = [numpy.nan, numpy.inf, -1, 0]
    result = gloam.run("gtao", depth=depth, camera=camera, radius=0.5)
    assert (result["ao"][0, :4] == 1).all() and numpy.isfinite(result["ao"]).all()


def in_new_process(text, **environment):
    return subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, env={**os.environ, **environment})


def test_without_a_device_import_works_and_the_first_call_raises(tmp_path):
    done = in_new_process("""
import numpy, gloam
print(len(gloam.techniques()), gloam.Camera(1, 1, 0, 0))
z = numpy.ones((8, 8), numpy.float32)
for call in (gloam.devices, gloam.Device, lambda: gloam.run("gtao", depth=z, camera=gloam.Camera(1, 1, 0, 0))):
    try:
        call()
    except gloam.Error as error:
        print(error)
print(gloam.capture("colonnade", 16, 16, ["normal"]))
""", OCL_ICD_VENDORS=str(tmp_path))
    lines = done.stdout.splitlines()
    assert done.returncode == 0 and len(lines) == 5, done.stderr
    assert all(line.startswith("no OpenCL platform found; ") for line in lines[1:4]), lines
    assert "16 x 16" in lines[4]


def test_a_frame_larger_than_the_device_says_needed_and_available():
    done = in_new_process("""
import numpy, gloam
camera = gloam.Camera(9000, 9000, 4096, 4096)
z = numpy.full((8192, 8192), 5, numpy.float32)
try:
    gloam.run("gtao", depth=z, camera=camera, radius=0.5, outputs=["ao"])
except gloam.Error as error:
    print(error)
print(gloam.run("gtao", depth=z[:64], camera=camera, radius=0.5)["ao"].shape)
""", POCL_MEMORY_LIMIT="1")
    lines = done.stdout.splitlines()
    assert done.returncode == 0 and len(lines) == 2, done.stdout + done.stderr
    assert "8192x8192 pixels need " in lines[0] and " of device memory, and " in lines[0] and "has 1024 MiB" in lines[0], lines
    assert "; or strips='auto': " in lines[0] and " more on either side, need " in lines[0], lines
    assert lines[1] == "(64, 8192)"


def test_strips_are_offered_where_they_work(depth, camera):
    refused(lambda: gloam.run("sssr", depth=depth, color=numpy.zeros((90, 150, 3), numpy.float32), roughness=depth, camera=camera, strips=2),
            "sssr: cannot be computed in strips: ")
    refused(lambda: gloam.run("gtao", depth=depth, camera=camera, strips="many"), "strips many is not allowed")
    refused(lambda: gloam.run("gtao", depth=depth, camera=camera, strips=0), "strips 0 is not allowed")
    # A radius that reaches beyond the image leaves strips as large as the image, and still right.
    assert gloam.run("gtao", depth=depth, camera=camera, radius=500.0, strips=2)["ao"].shape == (90, 150)


def test_a_frame_larger_than_the_device_is_computed_in_strips():
    done = in_new_process("""
import numpy, gloam
z = numpy.full((6720, 6720), 5, numpy.float32)
z[3000:3100, 3000:3100] = 4.95
call = dict(depth=z, camera=gloam.Camera(6000, 6000, 3360, 3360), radius=0.1, outputs=["ao"], preset="low")
try:
    gloam.run("hbao", **call)
except gloam.Error as error:
    print("refused")
result = gloam.run("hbao", **call, strips="auto")
print(result["ao"].shape, float(result["ao"].min()) < 0.97, result.device_bytes < 1 << 30)
""", POCL_MEMORY_LIMIT="1")
    assert done.stdout == "refused\n(6720, 6720) True True\n", done.stdout + done.stderr


def test_a_forked_process_is_told():
    done = in_new_process("""
import multiprocessing, numpy, gloam
z = numpy.full((8, 16), 5, numpy.float32)
call = lambda: gloam.run("gtao", depth=z, camera=gloam.Camera(9, 9, 8, 4), radius=0.5)
call()
def child():
    try:
        call()
    except gloam.Error as error:
        print(error, flush=True)
process = multiprocessing.get_context("fork").Process(target=child)
process.start()
process.join(60)
print(process.exitcode, call()["ao"].shape)
""")
    lines = done.stdout.splitlines()
    assert lines[0].startswith("this process was forked from one in which gloam had worked") and lines[1] == "0 (8, 16)", done.stdout + done.stderr


MILLION = "x" * 1_000_000


@pytest.mark.parametrize("call, sentence", [
    (lambda z: gloam.run(MILLION, depth=z, fov=60), "no technique"),
    (lambda z: gloam.run("gtao", depth=z, fov=60, **{MILLION: 1}), "bytes left out"),
    (lambda z: gloam.run("gtao", depth=z, fov=60, preset=MILLION), "bytes left out"),
    (lambda z: gloam.run("gtao", depth=z, fov=60, views=["a\nb", "a\nb"]), "are 2 names, and there are 1 views"),
    (lambda z: gloam.run("gtao\ud800", depth=z, fov=60), "gtao\\ud800"),
    (lambda z: gloam.run("gtao", depth=z, fov=10**400), "fov of type int is not allowed"),
    (lambda z: gloam.run("gtao", depth=z, fov=60, radius=10**5000), "radius of type int is not allowed"),
    (lambda z: gloam.run("gtao", depth=z, fov=60, seed=10**5000), "seed of type int is not allowed"),
    (lambda z: gloam.Camera(fx=10**400, fy=1, cx=0, cy=0), "camera: fx is beyond 1.8e308"),
    (lambda z: gloam.write("none.exr", {"depth": z}, compression=None), "compression is of type NoneType; a text is allowed"),
    (lambda z: gloam.write("none.exr", {3: z}), "name of a plane is of type int"),
    (lambda z: gloam.read("frame.exr\0.exr"), "is not a path: it has a zero byte"),
    (lambda z: gloam.read("half\ud800.exr"), "is not a path: it has half of a character"),
    (lambda z: gloam.Sequence("none.####.exr", frames=range(10**9)), "names more than 1000000 frames"),
    (lambda z: gloam.Sequence("none.####.exr", frames=range(0, 10**30, 10**29)), "a whole number of 32 bits is"),
    (lambda z: gloam.Sequence("none.####.exr", frames=range(3, 3)), "has no number"),
])
def test_what_is_beyond_all_bounds(call, sentence, depth):
    with pytest.raises(gloam.UsageError) as raised:
        call(depth)
    text = str(raised.value)
    assert sentence in text and "\n" not in text and len(text) < 4100, text[:300]


def test_names_that_are_not_utf8(depth, camera, tmp_path):
    folder = os.path.join(os.fsencode(tmp_path), b"caf\xe9")
    os.mkdir(folder)
    name = os.fsdecode(os.path.join(folder, b"caf\xe9.exr"))
    gloam.write(name, {"depth": depth}, camera=camera)
    frame = gloam.read(name)
    assert numpy.array_equal(frame["depth"], depth) and frame.name == os.path.basename(name) and "caf\\xe9" in repr(frame)
    assert gloam.run("hbao+", name, radius=0.5)["ao"].shape == depth.shape
    shot = os.fsdecode(os.path.join(folder, b"s\xe9.####.exr"))
    gloam.write(shot.replace("####", "0001"), {"depth": depth}, camera=camera)
    sequence = gloam.Sequence(shot)
    assert sequence.numbers == [1] and sequence[1].views == frame.views and "\\xe9" in repr(sequence)
    with pytest.raises(gloam.Error, match=r"caf\\xe9"):
        gloam.read(os.fsdecode(os.path.join(folder, b"none\xe9.exr")))
