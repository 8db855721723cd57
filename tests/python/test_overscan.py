"""Frames with a margin around the picture."""
import gloam
import numpy
import pytest


@pytest.fixture(scope="module")
def frame():
    return gloam.capture("temple", 64, 36, ["normal"], margin=(20, 12))


def test_picture_cuts_arrays_to_the_display_window(frame):
    plain = gloam.capture("temple", 64, 36, ["normal"])
    assert frame["depth"].shape == (60, 104) and plain["depth"].shape == (36, 64)
    assert numpy.array_equal(frame["depth"][frame.picture], plain["depth"])
    assert numpy.array_equal(plain["depth"][plain.picture], plain["depth"])
    assert frame.numbers["aoRadius"] == plain.numbers["aoRadius"]


def test_results_are_written_as_the_picture(frame, tmp_path):
    result = gloam.run("gtao", frame, radius=0.5)
    assert result["ao"].shape == (60, 104)
    gloam.write(tmp_path / "ao.exr", result)
    gloam.write(tmp_path / "whole.exr", result, keep_margin=True)
    gloam.write(tmp_path / "frame.exr", frame)
    written, whole = gloam.read(tmp_path / "ao.exr"), gloam.read(tmp_path / "whole.exr")
    assert numpy.array_equal(written["ao"], result["ao"][frame.picture]) and written["depth"].shape == (36, 64)
    assert numpy.array_equal(whole["ao"], result["ao"])
    assert gloam.read(tmp_path / "frame.exr").picture == frame.picture


def test_a_sequence_is_written_as_the_picture(frame, tmp_path):
    gloam.write(tmp_path / "f.0001.exr", frame)
    shot = gloam.Sequence(tmp_path / "f.####.exr")
    shot.write("gtao", tmp_path / "ao.####.exr", radius=0.5)
    shot.write("gtao", tmp_path / "whole.####.exr", radius=0.5, keep_margin=True)
    written, whole = gloam.read(tmp_path / "ao.0001.exr")["ao"], gloam.read(tmp_path / "whole.0001.exr")
    assert written.shape == (36, 64) and numpy.array_equal(written, whole["ao"][whole.picture])


def test_margins_that_are_none():
    with pytest.raises(gloam.Error, match="margin"):
        gloam.capture("plane", 64, 36, margin=(1, 2, 3))
    with pytest.raises(gloam.Error, match="margin of -1"):
        gloam.capture("plane", 64, 36, margin=-1)
