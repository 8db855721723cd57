"""What depth and normals of arrays stand for can be stated, as of files, with the same values and the same sentences."""

import warnings

import numpy
import pytest

import gloam

NEAR, FAR = 0.1, 40.0


@pytest.fixture(scope="module")
def scene():
    frame = gloam.capture("courtyard", 96, 54, ["normal"])
    depth = numpy.ascontiguousarray(frame["depth"])
    return {"depth": numpy.where(depth < FAR, depth, numpy.inf).astype(numpy.float32), "normal": numpy.ascontiguousarray(frame["normal"]), "camera": frame.camera}


def run(scene, **more):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return gloam.run("gtao", **{**scene, **more}, radius=1.0)


def ray(depth, camera):
    x = (numpy.arange(depth.shape[1]) + 0.5 - camera.cx) / camera.fx
    y = (numpy.arange(depth.shape[0]) + 0.5 - camera.cy) / camera.fy
    return (depth * numpy.sqrt(1 + x[None, :]**2 + y[:, None]**2))


def ndc(z):
    return numpy.where(numpy.isinf(z), 1, FAR / (FAR - NEAR) * (1 - NEAR / z.astype(float)))


def reversed_(z):
    return numpy.where(numpy.isinf(z), 0, NEAR / (FAR - NEAR) * (FAR / z.astype(float) - 1))


ENCODINGS = {
    "z": (lambda z, camera: z, {"depth_is": "z"}),
    "ray": (ray, {"depth_is": "ray"}),
    "ndc": (lambda z, camera: ndc(z), {"depth_is": "ndc", "near": NEAR, "far": FAR}),
    "reversed": (lambda z, camera: reversed_(z), {"depth_is": "reversed", "near": NEAR, "far": FAR}),
    "reversed, infinite far plane": (lambda z, camera: NEAR / z.astype(float), {"depth_is": "reversed", "near": NEAR}),
    "a background of its own": (lambda z, camera: numpy.where(numpy.isinf(z), -7, z), {"background": -7}),
    "a far plane": (lambda z, camera: numpy.where(numpy.isinf(z), 60, z), {"far": 60.0}),
}


@pytest.mark.parametrize("name", ENCODINGS)
def test_depth_is_what_it_is_said_to_be(name, scene):
    encode, words = ENCODINGS[name]
    stored = encode(scene["depth"], scene["camera"])
    made, expected = run(scene, depth=stored, **words), run(scene)
    seen = numpy.asarray(made.frame["depth"])
    assert numpy.array_equal(numpy.isinf(seen), numpy.isinf(scene["depth"]))
    surface = numpy.isfinite(seen)
    # A step of float32 in ndc near 1 is z^2 / near: 6e-8 * 40^2 / 0.1 at the most.
    bound = 1.2e-3 * (scene["depth"] / FAR)[surface]**2 + 3e-7 * scene["depth"][surface]
    assert (numpy.abs(seen[surface] - scene["depth"][surface]) <= bound).all()
    assert numpy.abs(made["ao"] - expected["ao"]).mean() < 1e-3
    assert not any(note.startswith("depth") and "far plane taken as infinite" not in note for note in made.notes), made.notes


@pytest.mark.parametrize("name", ENCODINGS)
def test_files_have_the_same_depth_and_notes(name, scene, tmp_path):
    encode, words = ENCODINGS[name]
    stored = encode(scene["depth"], scene["camera"]).astype(numpy.float32)
    # Under another name, as gloam.write cleans nothing but writes Z.
    gloam.write(tmp_path / "stored.exr", {"depth": stored, "normal": scene["normal"]}, camera=scene["camera"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        read = gloam.read(tmp_path / "stored.exr", camera=scene["camera"], **words)
    made = run(scene, depth=stored, **words)
    assert numpy.array_equal(read["depth"], made.frame["depth"])
    on_depth = lambda notes: [note for note in notes if note.startswith("depth") and "planar distance" not in note]
    assert on_depth(read.notes) == on_depth(made.notes)


def test_near_and_far_come_from_the_camera(scene):
    camera = gloam.Camera(scene["camera"].fx, scene["camera"].fy, scene["camera"].cx, scene["camera"].cy, near=NEAR, far=FAR)
    bare = {"normal": scene["normal"], "depth": ndc(scene["depth"])}
    assert numpy.array_equal(run({**bare, "camera": camera}, depth_is="ndc")["ao"],
                             run({**bare, "camera": scene["camera"]}, depth_is="ndc", near=NEAR, far=FAR)["ao"])


@pytest.mark.parametrize("words, sentence", [
    ({"depth_is": "ndc"}, "depth_is='ndc': needs the distance of the near plane; give near=, or a camera that has it"),
    ({"depth_is": "ndc", "near": 0.1}, "depth_is='ndc': needs the distance of the far plane"),
    ({"depth_is": "reversed", "near": 5, "far": 2}, "far is 2; expected more than near, 5"),
    ({"depth_is": "rya"}, "depth_is rya is not allowed (did you mean 'ray'?)"),
    ({"depth_is": 3}, "depth_is is of type int; a text is allowed"),
    ({"near": "close"}, "near is of type str; a number is allowed"),
    ({"normals_are": "wrold"}, "normals_are wrold is not allowed (did you mean 'world'?)"),
    ({"normals_are": "view world"}, "normals_are 'view world' states two of view and world; give one of them"),
    ({"normals_are": ""}, "normals_are is empty"),
    ({"normals_are": "world", "normal_space": "view"}, "normals_are and normal_space both state the normals; give one of them"),
    ({"normals_are": "x,x,z"}, "normal_axes x,x,z"),
])
def test_words_are_checked(words, sentence, scene):
    with pytest.raises(gloam.Error) as raised:
        run(scene, **words)
    assert sentence in str(raised.value), str(raised.value)


def test_what_has_no_effect_is_told(scene):
    assert any("near= has no effect" in note for note in run(scene, near=0.1).notes)
    small = run(scene, depth=scene["depth"] / 100)
    assert any("though all of it lies in 0..1; depth_is= says otherwise" in note for note in small.notes)
    assert not any("0..1" in note for note in run(scene, depth=scene["depth"] / 100, depth_is="z").notes)


def test_depth_that_joins_a_frame_is_what_it_is_said_to_be(scene):
    frame = gloam.capture("courtyard", 96, 54, ["normal"])
    made = gloam.run("gtao", frame, depth=ray(scene["depth"], scene["camera"]), depth_is="ray", radius=1.0)
    assert numpy.abs(made["ao"] - run(scene)["ao"]).mean() < 1e-3
    for name, value in (("depth_is", "ray"), ("near", 0.1), ("background", 3)):
        with pytest.raises(gloam.UsageError, match=f"{name}: a gloam.Frame has its own"):
            gloam.run("gtao", frame, radius=1.0, **{name: value})


@pytest.mark.parametrize("change, said, words", [
    (lambda n, camera: n * numpy.float32([1, -1, 1]), "x,-y,z", {"normal_axes": "x,-y,z"}),
    (lambda n, camera: 0.5 + 0.5 * n, "unsigned", {"normal_range": "unsigned"}),
    (lambda n, camera: n @ numpy.asarray(camera.camera_to_world)[:3, :3].T, "world", {"normal_space": "world"}),
    (lambda n, camera: 0.5 + 0.5 * n @ numpy.asarray(camera.camera_to_world)[:3, :3].T, "world unsigned", {"normal_space": "world", "normal_range": "unsigned"}),
    (lambda n, camera: n * numpy.float32([1, -1, -1]), "view  x,-y,-z", {"normal_space": "view", "normal_axes": "x,-y,-z"}),
])
def test_normals_are_what_they_are_said_to_be(change, said, words, scene):
    normal = change(scene["normal"], scene["camera"])
    made = run(scene, normal=normal, normals_are=said)
    assert numpy.array_equal(made["ao"], run(scene, normal=normal, **words)["ao"])
    assert numpy.abs(made["ao"] - run(scene)["ao"]).mean() < 1e-3 and not any(note.startswith("normals") for note in made.notes)


def test_auto_and_files_take_the_same_words(scene, tmp_path):
    stored = ray(scene["depth"], scene["camera"])
    made = gloam.auto(depth=stored, normal=scene["normal"], camera=scene["camera"], depth_is="ray", normals_are="view", radius=1.0, mask="never")
    surface = numpy.isfinite(scene["depth"])
    assert numpy.abs(made.frame["depth"][surface] - scene["depth"][surface]).max() < 1e-4
    gloam.write(tmp_path / "ray.exr", {"depth": stored, "normal": scene["normal"]}, camera=scene["camera"])
    expected = gloam.read(tmp_path / "ray.exr", depth="ray")
    assert numpy.array_equal(gloam.read(tmp_path / "ray.exr", depth_is="ray", normals_are="view")["depth"], expected["depth"])
    assert numpy.array_equal(gloam.run("gtao", tmp_path / "ray.exr", depth_is="ray", radius=1.0).frame["depth"], expected["depth"])
    (tmp_path / "ray.exr").rename(tmp_path / "ray.0001.exr")
    assert numpy.array_equal(gloam.Sequence(tmp_path / "ray.####.exr", depth_is="ray", normals_are="view")[1]["depth"], expected["depth"])
    with pytest.raises(gloam.UsageError, match="depth and depth_is both state the depth"):
        gloam.read(tmp_path / "ray.0001.exr", depth="ray", depth_is="ray")
