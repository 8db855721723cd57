"""read and write, and scenes: the same bits as the command's files."""

import os
import pathlib
import subprocess

import numpy
import pytest

import gloam

DATA = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"], "data")


def assert_same_frames(a, b):
    assert a.planes == b.planes and a.views == b.views
    for plane in a.planes:
        for left, right in zip(*[[f[plane]] if len(f.views) == 1 else f[plane] for f in (a, b)]):
            assert numpy.array_equal(left, right), plane


# A result of the command names its frame as well.
ALL = ("--float", "--keep-depth", "--outputs", "ao,ao_raw")


def assert_same_files(a, b):
    left, right = gloam.read(a, as_stored=True), gloam.read(b, as_stored=True)
    assert_same_frames(left, right)
    assert left.attributes == right.attributes and abs(a.stat().st_size - b.stat().st_size) < 200


def test_a_result_is_written_as_the_command_writes_it(command, tmp_path):
    command("run", "gtao", DATA / "loggia.exr", "-o", tmp_path / "command.exr", "--radius", "0.5", *ALL)
    gloam.write(tmp_path / "python.exr", gloam.run("gtao", DATA / "loggia.exr", radius=0.5))
    assert_same_files(tmp_path / "command.exr", tmp_path / "python.exr")


def test_two_eyes_are_written_as_the_command_writes_them(command, tmp_path):
    gloam.write(tmp_path / "pair.exr", gloam.capture("colonnade", 96, 64, ["normal"], stereo=0.065))
    command("run", "stereo-gtao", tmp_path / "pair.exr", "-o", tmp_path / "command.exr", "--radius", "0.5", *ALL)
    gloam.write(tmp_path / "python.exr", gloam.run("stereo-gtao", tmp_path / "pair.exr", radius=0.5))
    assert_same_files(tmp_path / "command.exr", tmp_path / "python.exr")


def test_a_frame_survives_a_file(frame, tmp_path):
    gloam.write(tmp_path / "frame.exr", frame, compression="piz")
    again = gloam.read(tmp_path / "frame.exr")
    assert_same_frames(again, frame)
    assert again.numbers["aoRadius"] == pytest.approx(frame.numbers["aoRadius"])
    assert again.attributes["gloamScene"] == frame.attributes["gloamScene"]


def test_what_was_changed_is_written(tmp_path):
    result = gloam.run("gtao", DATA / "loggia.exr", radius=0.5)
    result["ao"][:] = 0.25
    gloam.write(tmp_path / "changed.exr", result)
    assert (gloam.read(tmp_path / "changed.exr")["ao"] == 0.25).all()


def test_arrays_are_written(tmp_path):
    depth, color = numpy.full((9, 17), 3, numpy.float32), numpy.random.default_rng(1).random((9, 17, 3), numpy.float32)
    gloam.write(tmp_path / "arrays.exr", {"depth": depth, "color": color}, camera=gloam.Camera(20, 20, 8, 4, camera_to_world=numpy.eye(4)))
    again = gloam.read(tmp_path / "arrays.exr")
    assert numpy.array_equal(again["depth"], depth) and numpy.array_equal(again["color"], color)
    assert again.camera.fx == pytest.approx(20) and (again.camera.camera_to_world == numpy.eye(4)).all()


def test_a_camera_of_ones_own_replaces_the_files(frame, tmp_path):
    gloam.write(tmp_path / "frame.exr", frame)
    camera = gloam.Camera(200, 210, 70, 50, near=0.1, camera_to_world=frame.camera.camera_to_world)
    read = gloam.read(tmp_path / "frame.exr", camera=camera, planes=["depth", "normal"])
    assert read.planes == ["depth", "normal"]
    assert (read.camera.fx, read.camera.fy, read.camera.cx, read.camera.cy) == (200, 210, 70, 50)
    assert gloam.read(tmp_path / "frame.exr", camera=gloam.Camera(200, 210, 70, 50)).camera.camera_to_world is None
    assert gloam.read(tmp_path / "frame.exr", fov=90).camera.fx == pytest.approx(75)


def test_planes_of_a_frame_are_views_that_cannot_be_written(frame):
    assert "depth" in frame and len(frame) == len(frame.planes) == len(list(frame))
    depth = frame["depth"]
    assert depth.shape == (90, 150) and depth.strides == (160 * 4, 4) and not depth.flags.owndata
    for name in ("depth", "normal"):
        with pytest.raises(ValueError):
            frame[name][0, 0] = 1
    assert "150 x 90 pixels" in repr(frame) and "depth" in repr(frame)


def test_an_array_outlives_its_frame():
    scene = gloam.Scene("colonnade")
    depth = gloam.capture(scene, 64, 48, ["normal"])["depth"]
    for _ in range(20):
        last = gloam.capture(scene, 64, 48, ["normal"])
    assert numpy.array_equal(depth, last["depth"])


def test_notes_are_told(tmp_path):
    gloam.write(tmp_path / "depth.exr", {"depth": numpy.full((9, 16), 3, numpy.float32)})
    with pytest.warns(gloam.Note, match="field of view"):
        read = gloam.read(tmp_path / "depth.exr")
    assert any("field of view" in note for note in read.notes)


@pytest.mark.parametrize("call, sentence", [
    (lambda folder: gloam.read(folder / "none.exr"), "none.exr"),
    (lambda folder: gloam.read(folder / "text.exr"), "text.exr"),
    (lambda folder: gloam.read(folder / "half.exr"), "half.exr"),
    (lambda folder: gloam.read(7), "file is of type int"),
    (lambda folder: gloam.read(folder / "whole.exr", planes=["dpeth"]), "no plane 'dpeth' (did you mean 'depth'?)"),
    (lambda folder: gloam.read(folder / "whole.exr", depth="rey"), "depth_is rey is not allowed (did you mean 'ray'?)"),
    (lambda folder: gloam.read(folder / "whole.exr", fov=500), "500"),
    (lambda folder: gloam.read(folder / "whole.exr", views=["left"]), "left"),
    (lambda folder: gloam.read(folder / "whole.exr", camera=folder / "none.json"), "none.json"),
    (lambda folder: gloam.read(folder / "whole.exr", channels={"depth": 3}), "channels"),
    (lambda folder: gloam.write(folder / "out.jpg", {"ao": numpy.ones((4, 4), numpy.float32)}), "name it with .exr or .png"),
    (lambda folder: gloam.write(folder / "no" / "out.exr", {"ao": numpy.ones((4, 4), numpy.float32)}), "out.exr"),
    (lambda folder: gloam.write(folder, {"ao": numpy.ones((4, 4), numpy.float32)}), ".exr"),
    (lambda folder: gloam.write(folder / "out.exr", {"ao": numpy.ones((4, 4), complex)}), "has the dtype complex128"),
    (lambda folder: gloam.write(folder / "out.exr", {}), "the dict has no array"),
    (lambda folder: gloam.write(folder / "out.exr", [1]), "list cannot be written"),
    (lambda folder: gloam.write(folder / "out.exr", {"ao": numpy.ones((4, 4), numpy.float32)}, compression="zpi"), "zpi"),
])
def test_files_that_cannot_be(call, sentence, frame, tmp_path):
    gloam.write(tmp_path / "whole.exr", frame)
    (tmp_path / "text.exr").write_text("not an image")
    (tmp_path / "half.exr").write_bytes((tmp_path / "whole.exr").read_bytes()[:5000])
    with pytest.raises(gloam.Error) as raised:
        call(tmp_path)
    assert sentence in str(raised.value) and "\n" not in str(raised.value), str(raised.value)
    assert not (tmp_path / "out.exr").exists()


def test_capture_is_the_commands(command, tmp_path):
    command("capture", "statue", "-o", tmp_path / "command.exr", "--size", "96x64", "--set", "faces=5000", "--peel", "3", "--stochastic", "2")
    captured = gloam.capture("statue", 96, 64, peel=3, stochastic=2, faces=5000)
    gloam.write(tmp_path / "python.exr", captured)
    assert_same_files(tmp_path / "command.exr", tmp_path / "python.exr")
    scene = gloam.Scene("statue", faces=5000)
    assert_same_frames(gloam.capture(scene, 96, 64, peel=3, stochastic=2), captured)
    assert "statue" in repr(scene) and scene.cameras and scene.faces > 1000


def test_reference_is_the_commands(command, tmp_path):
    frame = gloam.capture("colonnade", 64, 48, ["normal"])
    gloam.write(tmp_path / "frame.exr", frame)
    command("reference", "ao", tmp_path / "frame.exr", "-o", tmp_path / "truth.exr", "--samples", "64")
    truth = gloam.reference(tmp_path / "frame.exr", samples=64)
    assert truth.planes == ["ao", "ao_noise", "depth"] and truth.numbers["aoSamples"] == 64
    stored = gloam.read(tmp_path / "truth.exr", as_stored=True)
    for plane in ("ao", "ao_noise"):
        assert numpy.array_equal(truth[plane], stored[plane])
    with_falloff = gloam.reference(frame, "colonnade", samples=32, radius=0.5, falloff="hbao+", settings={"hbao+.bias": 0.2})
    assert not numpy.array_equal(with_falloff["ao"], truth["ao"])


def test_every_kind_of_reference_is_the_commands(command, tmp_path):
    frame = gloam.capture("colonnade", 32, 24, ["normal", "roughness"])
    gloam.write(tmp_path / "frame.exr", frame)
    gloam.write(tmp_path / "sky.exr", gloam.capture("plane", 64, 32, ["color"]))
    kinds = {
        "bounces": ({"bounces": 2, "radius": 1}, ["--bounces", "2", "--radius", "1"]),
        "specular_occlusion": ({}, []),
        "indirect": ({"radius": float("inf")}, ["--radius", "inf"]),
        "contact": ({"length": 2, "light_direction": (1, 2, 0), "light_angle": 5},
                    ["--length", "2", "--light-direction", "1,2,0", "--light-angle", "5"]),
        "environment": ({"environment": tmp_path / "sky.exr", "environment_axes": "blender", "environment_turn": 30},
                        ["--environment", tmp_path / "sky.exr", "--environment-axes", "blender", "--environment-turn", "30"]),
    }
    for kind, (words, flags) in kinds.items():
        command("reference", kind, tmp_path / "frame.exr", "-o", tmp_path / "truth.exr", "--samples", "32", *flags)
        truth, stored = gloam.reference(tmp_path / "frame.exr", what=kind, samples=32, **words), gloam.read(tmp_path / "truth.exr", as_stored=True)
        assert truth.planes == sorted([kind, kind + "_noise", "depth"])
        for plane in (kind, kind + "_noise"):
            assert numpy.array_equal(truth[plane], stored[plane]), plane


def test_whole_picture_is_the_commands(command, tmp_path):
    frame = gloam.capture("colonnade", 32, 24, ["normal", "color", "ambient", "albedo", "metallic", "roughness", "reflectance"])
    assert frame.attributes["gloamColorHolds"] == "ambient,shadows"
    gloam.write(tmp_path / "frame.exr", frame)
    command("reference", "composite", tmp_path / "frame.exr", "-o", tmp_path / "truth.exr", "--samples", "32", "--color-holds", "ambient,shadows,reflection",
            "--ambient", "0.1,0.2,0.3")
    truth = gloam.reference(tmp_path / "frame.exr", what="composite", samples=32, color_holds="ambient,shadows,reflection", ambient=(0.1, 0.2, 0.3))
    stored = gloam.read(tmp_path / "truth.exr", as_stored=True)
    assert truth.planes == ["ao", "ao_noise", "color", "color_noise", "depth", "indirect", "indirect_noise"]
    for plane in truth.planes:
        assert numpy.array_equal(truth[plane], stored[plane]), plane


@pytest.mark.parametrize("call, sentence", [
    (lambda f: gloam.capture("colonade"), "no scene 'colonade' (did you mean 'colonnade'?)"),
    (lambda f: gloam.capture("statue", 8, 8, fases=3), "fases"),
    (lambda f: gloam.capture("colonnade", 0, 8), "0"),
    (lambda f: gloam.capture("colonnade", 8, 8, ["dept"]), "dept"),
    (lambda f: gloam.capture("colonnade", 8, 8, camera="norht"), "norht"),
    (lambda f: gloam.capture("colonnade", 8, 8, eye=(0, 1, 2)), "eye and target go together"),
    (lambda f: gloam.capture("colonnade", 8, 8, eye=(0, 1), target=(1, 1, 1)), "eye (0, 1) is not a point"),
    (lambda f: gloam.capture("colonnade", 8, 8, fov=0), "fov 0 is not allowed"),
    (lambda f: gloam.capture("colonnade", 8, 8, camera=gloam.Camera(8, 8, 4, 4)), "has no pose"),
    (lambda f: gloam.capture("colonnade", 8, 8, convergence=2), "give stereo=DISTANCE too"),
    (lambda f: gloam.capture("colonnade", "8"), "width is of type str"),
    (lambda f: gloam.reference(f, what="oa"), "did you mean 'ao'?"),
    (lambda f: gloam.reference(f, samples=0), "0 samples are not allowed"),
    (lambda f: gloam.reference(f, radius=-1), "radius -1 is not allowed"),
    (lambda f: gloam.reference(f, falloff="hbaoo"), "did you mean 'hbao'?"),
    (lambda f: gloam.reference(f, "fence"), "is not what the frame shows"),
    (lambda f: gloam.reference(f, seed=-1), "seed -1 is not allowed"),
    (lambda f: gloam.reference(f, what="contact", radius=1), "radius 1: is for ao, "),
    (lambda f: gloam.reference(f, what="contact", light_direction=(0, 0, 0)), "direction 0,0,0 is not allowed"),
    (lambda f: gloam.reference(f, what="contact", light_position=(0, 0)), "light_position (0, 0) is not a point"),
    (lambda f: gloam.reference(f, what="contact", length=-1), "length -1 is not allowed"),
    (lambda f: gloam.reference(f, what="bounces", bounces=-1), "-1 bounces are not allowed"),
    (lambda f: gloam.reference(f, what="composite", color_holds="sun"), "color_holds sun: 'sun' is not known"),
    (lambda f: gloam.reference(f, what="composite", ambient=(1, 1, -1)), "ambient 1,1,-1: is a radiance"),
    (lambda f: gloam.reference(f, what="ao", ambient=(1, 1, 1)), "ambient 1,1,1: is for composite"),
    (lambda f: gloam.reference(f, what="environment"), "give environment FILE.exr"),
    (lambda f: gloam.reference(f, what="environment", environment="/none.exr"), "/none.exr"),
    (lambda f: gloam.reference(3), "frame is of type int"),
])
def test_scenes_that_cannot_be(call, sentence, frame):
    with pytest.raises(gloam.Error) as raised:
        call(frame)
    assert sentence in str(raised.value) and "\n" not in str(raised.value), str(raised.value)


def test_lists_are_those_of_the_command(command):
    listed = {entry["name"]: entry for entry in command("list", "techniques", as_json=True)}
    techniques = gloam.techniques()
    assert sorted(techniques) == sorted(listed)
    for name, technique in techniques.items():
        entry = listed[name]
        assert (technique.summary, technique.reads, technique.extras) == (entry["summary"], entry["reads"], entry["extras"])
        assert list(technique.parameters) == [parameter["name"] for parameter in entry["parameters"]]
        for parameter in entry["parameters"]:
            known = technique.parameters[parameter["name"]]
            default = None if known.default == float("inf") else known.default  # JSON has no infinity
            assert (default, known.choices, known.unit) == (parameter["default"], parameter["choices"], parameter["unit"])
    assert "gtao" in repr(techniques["gtao"])
    assert list(gloam.scenes()) == [entry["name"] for entry in command("list", "scenes", as_json=True)]
    assert [device.name for device in gloam.devices()] == [entry["device"] for entry in command("list", "devices", as_json=True)]
