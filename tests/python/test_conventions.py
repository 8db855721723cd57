"""Normals and depth of arrays agree: another convention is found, and said, where nothing states one."""

import warnings

import numpy
import pytest

import gloam


@pytest.fixture(scope="module")
def room():
    """A frame of 320 x 180 pixels whose surfaces face all ways."""
    frame = gloam.capture("courtyard", 320, 180, ["normal"])
    return {"depth": numpy.ascontiguousarray(frame["depth"]), "normal": numpy.ascontiguousarray(frame["normal"]), "camera": frame.camera}


def in_world(normal, camera):
    return (normal @ numpy.asarray(camera.camera_to_world)[:3, :3].T).astype(numpy.float32)


CONVENTIONS = {
    "y down": (lambda n, camera: n * numpy.float32([1, -1, 1]), {"normal_axes": "x,-y,z"}),
    "z away": (lambda n, camera: n * numpy.float32([1, 1, -1]), {"normal_axes": "x,y,-z"}),
    "y down, z away": (lambda n, camera: n * numpy.float32([1, -1, -1]), {"normal_axes": "x,-y,-z"}),
    "0 to 1": (lambda n, camera: 0.5 + 0.5 * n, {"normal_range": "unsigned"}),
    "0 to 1, y down": (lambda n, camera: 0.5 + 0.5 * n * numpy.float32([1, -1, 1]), {"normal_range": "unsigned", "normal_axes": "x,-y,z"}),
    "world": (in_world, {"normal_space": "world"}),
    "world, z up": (lambda n, camera: numpy.ascontiguousarray(in_world(n, camera)[..., [0, 2, 1]] * numpy.float32([1, -1, 1])),
                    {"normal_space": "world", "normal_axes": "x,-z,y"}),
}


def run(room, **more):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return gloam.run("gtao", **{**room, **more}, radius=1.0)


def on_normals(result):
    return [note for note in result.notes if note.startswith("normals:")]


@pytest.mark.parametrize("name", CONVENTIONS)
def test_normals_of_arrays_are_taken_in_the_convention_that_agrees_with_the_depth(name, room):
    change, words = CONVENTIONS[name]
    other = change(room["normal"], room["camera"])
    undisturbed = run(room)
    found = run(room, normal=other)
    # The nearest float of 0.5 + 0.5 n, and of a turned n, moves a few samples across an edge.
    assert numpy.sqrt(numpy.mean((found["ao"] - undisturbed["ao"])**2)) < 1e-3
    notes = on_normals(found)
    assert len(notes) == 1 and "says otherwise" in notes[0], notes
    told = run(room, normal=other, **words)
    assert numpy.array_equal(told["ao"], found["ao"])
    assert on_normals(told) == []


def test_normals_in_the_convention_of_gloam_need_no_note(room):
    assert on_normals(run(room)) == []


def test_what_is_stated_stands_and_is_told(room):
    flipped = room["normal"] * numpy.float32([1, -1, 1])
    result = run(room, normal=flipped, normal_axes="x,y,z")
    assert ["normal_axes='x,-y,z' states that" in note for note in on_normals(result)] == [True]


def test_normals_that_join_a_frame_are_looked_at(room):
    frame = gloam.capture("courtyard", 320, 180, ["normal"])
    flipped = room["normal"] * numpy.float32([1, -1, 1])
    joined = gloam.run("gtao", frame, normal=flipped, radius=1.0)
    assert numpy.array_equal(joined["ao"], gloam.run("gtao", frame, radius=1.0)["ao"])
    assert len(on_normals(joined)) == 1
    with pytest.raises(gloam.UsageError, match="normal_axes: a gloam.Frame has its own"):
        gloam.run("gtao", frame, normal_axes="x,-y,z")


def test_normals_that_are_none_are_counted(room):
    half = room["normal"].copy()
    half[::2] = 0
    for normal in (room["normal"] * 0, room["normal"] * numpy.float32(numpy.nan), half):
        notes = run(room, normal=normal).notes
        assert any("have none (zero or not finite)" in note for note in notes), notes


def test_normals_of_no_convention_are_made_from_the_depth(room):
    strange = 255 * (0.5 + 0.5 * room["normal"]).astype(numpy.float32)
    result = run(room, normal=strange)
    assert any("fit no convention" in note and "not used" in note for note in result.notes), result.notes
    assert all(note and not note.startswith(";") for note in result.notes), result.notes
    without = run({name: value for name, value in room.items() if name != "normal"})
    assert numpy.array_equal(result["ao"], without["ao"])


def test_normals_of_another_frame_are_told(room):
    constant = numpy.zeros_like(room["normal"])
    constant[..., 2] = 1
    notes = run(room, normal=constant).notes
    assert any("in any convention" in note for note in notes), notes


def test_words_are_checked(room):
    with pytest.raises(gloam.UsageError, match="normal_axes y,y,z: is not allowed"):
        gloam.run("gtao", **room, normal_axes="y,y,z")
    with pytest.raises(gloam.UsageError, match="signed"):
        gloam.run("gtao", **room, normal_range="both")


def test_files_take_the_same_words(room, tmp_path):
    path = tmp_path / "frame.exr"
    gloam.write(path, {"depth": room["depth"], "normal": room["normal"] * numpy.float32([1, -1, 1])}, camera=room["camera"])
    read = gloam.read(path, normal_axes="x,-y,z")
    assert numpy.abs(read["normal"] - room["normal"]).max() < 1e-6


def test_depth_that_is_negative_or_of_no_use_is_told(room):
    turned = run(room, depth=-room["depth"])
    assert numpy.array_equal(turned["ao"], run(room)["ao"])
    assert any("all of it is negative" in note for note in turned.notes)
    assert any("no pixel has a usable depth" in note for note in run(room, depth=numpy.zeros_like(room["depth"])).notes)
