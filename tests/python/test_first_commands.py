"""What a NumPy user does first works on an empty account: arrays in, AO out, a picture, a camera of a projection, a comparison."""

import pathlib
import re
import subprocess
import sys

import numpy
import pytest

import gloam

PROGRAM = pathlib.Path(__file__).parent / "programs" / "first_commands.py"


def test_the_first_commands(tmp_path):
    home = tmp_path / "home"
    home.mkdir()
    work = tmp_path / "work"
    work.mkdir()
    environment = {"PATH": "/usr/bin:/bin", "HOME": str(home), "PYTHONPATH": str(pathlib.Path(gloam.__file__).parent.parent.resolve()), "PYTHONDONTWRITEBYTECODE": "1"}
    # No warning: nothing here is assumed.
    done = subprocess.run([sys.executable, "-W", "error", PROGRAM], cwd=work, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    said = re.fullmatch(r"\(90, 160\) open ([\d.]+) beside the box ([\d.]+) rmse ([\d.]+) notes \[\]\n", done.stdout)
    assert said, done.stdout
    assert float(said[1]) > 0.98 and float(said[2]) < 0.95 and float(said[3]) < 0.002
    assert [path.name for path in work.iterdir()] == ["ao.png"]


def size_of(png):
    data = png.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")


def test_pictures_are_those_of_the_command(tmp_path, command):
    cv2 = pytest.importorskip("cv2")
    frame = gloam.capture("colonnade", 96, 54, ["normal", "color"])
    gloam.write(tmp_path / "frame.exr", frame)
    read = gloam.read(tmp_path / "frame.exr")
    result = gloam.run("gtao", read, radius=0.5)
    command("run", "gtao", tmp_path / "frame.exr", "-o", tmp_path / "of_command.png", "--radius", "0.5")
    expected = cv2.imread(str(tmp_path / "of_command.png"), cv2.IMREAD_COLOR)
    shown = lambda *arguments, **words: (gloam.write(tmp_path / "shown.png", *arguments, **words),
                                         cv2.imread(str(tmp_path / "shown.png"), cv2.IMREAD_COLOR))[1]
    assert numpy.array_equal(shown(result), expected)
    assert numpy.array_equal(shown({"ao": result["ao"], "depth": read["depth"]}), expected)
    raw = shown(result, plane="ao_raw")
    assert raw.shape == expected.shape and not numpy.array_equal(raw, expected)
    surface = numpy.isfinite(read["depth"])
    grey = shown(result["ao"])  # an array alone tells no background
    assert numpy.abs(grey[surface].astype(float) - expected[surface]).max() == 0
    assert numpy.abs(grey[..., 0].astype(float) / 255 - result["ao"]).max() < 1 / 255
    assert shown(read, plane="normal").shape == (54, 96, 3) and shown(numpy.moveaxis(read["color"], 2, 0)).shape == (54, 96, 3)


def test_pictures_of_views_are_several(tmp_path):
    pair = gloam.capture("colonnade", 48, 32, ["normal"], stereo=0.065)
    gloam.write(tmp_path / "pair.PNG", pair, plane="normal")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["pair.left.PNG", "pair.right.PNG"]
    assert size_of(tmp_path / "pair.left.PNG") == (48, 32)


def test_pictures_that_show_nothing_are_told(tmp_path):
    frame = gloam.capture("colonnade", 48, 32, ["normal"])
    with pytest.warns(gloam.Note, match="of the pixels of 'depth' are above 1, and white: a picture shows 0 to 1"):
        gloam.write(tmp_path / "depth.png", frame, plane="depth")
    with pytest.warns(gloam.Note, match="are above 1, and white"):
        gloam.write(tmp_path / "bytes.png", numpy.full((8, 8), 255.0))
    for what, words, sentence in [(frame, {"plane": "nromal"}, "no plane 'nromal' (did you mean 'normal'?)"), ({}, {}, "dict cannot be drawn"),
                                  (numpy.full((8, 8), 255, numpy.uint8), {}, "write: the array has the dtype uint8 and values up to 255"), (3, {}, "int cannot be drawn"), (numpy.zeros(4), {}, "write: the array has the shape (4,)")]:
        with pytest.raises(gloam.UsageError) as raised:
            gloam.write(tmp_path / "none.png", what, **words)
        assert sentence in str(raised.value)
    with pytest.raises(gloam.UsageError, match="plane: chooses what a picture shows, and an EXR file has all planes"):
        gloam.write(tmp_path / "none.exr", frame, plane="normal")
    with pytest.raises(gloam.UsageError, match="an array has no name in an EXR file; give a dict such as {'ao': array}"):
        gloam.write(tmp_path / "none.exr", numpy.zeros((4, 4)))


def test_pick_takes_arrays(tmp_path):
    frame = gloam.capture("colonnade", 64, 36, ["normal"])
    planes = {"depth": numpy.array(frame["depth"])[None].astype(float), "normal": numpy.moveaxis(frame["normal"], 2, 0)}
    words = dict(truth=gloam.run("evidence", frame, radius=0.5, preset="ultra"), techniques=["hbao+", "gtao"], radius=0.5, rounds=1, error=0.5)
    best = gloam.pick(**planes, camera=frame.camera, **words)
    assert best["technique"] in ("hbao+", "gtao") and best["radius"] == 0.5
    named = gloam.pick(frame, **words)
    rmse = lambda facts: {(each["technique"], each["preset"], each["resolution"]): each["rmse"] for each in facts["finalists"]}
    both = set(rmse(best)) & set(rmse(named))
    assert both and all(rmse(best)[name] == pytest.approx(rmse(named)[name], abs=1e-5) for name in both)
    for more, sentence in (({"frame": frame}, "arrays do not go with a frame"), ({"channels": {"depth": "Z"}}, "channels: is for a path"),
                           ({"camera": None}, "camera: none is given")):
        with pytest.raises(gloam.UsageError) as raised:
            gloam.pick(**{**planes, "camera": frame.camera, **words, **more})
        assert sentence in str(raised.value), str(raised.value)
    with pytest.raises(gloam.UsageError, match="there is neither a frame nor an array"):
        gloam.pick(error=0.1)
