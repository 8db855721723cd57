"""Frames of which nothing is stated: what their depth and normals mean is told by the normals, as bench/conventions.py stores them."""

import pathlib
import re
import sys
import warnings

import numpy
import pytest

import gloam

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import conventions
from exr_files import in_the_world, layer, write_exr

SCENES = ("gallery", "courtyard", "foliage")


@pytest.fixture(scope="module")
def frames():
    return {name: gloam.capture(name, 480, 270, ["depth", "normal"]) for name in SCENES}


def read(file, planes=("depth", "normal"), **words):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", gloam.Note)
        return gloam.read(file, planes=list(planes), **words)


def stored(folder, frame, convention):
    """The files of a frame, as of one of CONVENTIONS, and the words that read them."""
    values = conventions.of_frame(frame)
    depth, normal, flags, _ = conventions.CONVENTIONS[convention]
    files = [conventions.written(folder / name, made(values)) for name, made in (("depth", depth), ("normal", normal))]
    return files[0], {"plane_files": {"normal": files[1]}, "camera": frame.camera, **(flags(values) if callable(flags) else flags)}


def told_of(frame, plane="depth: taken as"):
    return next(note for note in frame.notes if note.startswith(plane))


#: The bent normals of leaves leave more than one meaning.
TOLD = {("foliage", "grey, black near, 16 bits")}


@pytest.mark.parametrize("convention", conventions.CONVENTIONS)
def test_each_convention_is_told_by_the_normals(convention, frames, tmp_path):
    for name, frame in frames.items():
        found, notes = conventions.outcome(frame, convention, tmp_path)
        assert found == "right" or (found == "told" and (name, convention) in TOLD), (name, notes)


#: Cameras drawn at random, some of which were read wrongly without a word: by what tells them now.
DRAWN = {(1, "banquet", "planar, rows from the bottom up"): "right", (1, "courtyard", "planar, 16 bits that wrap"): "right",
         (1, "temple", "planar, 16 bits that wrap"): "right", (2, "lounge", "grey, white near, 16 bits; normals 8 bits"): "right",
         (2, "hairball", "grey, black near, 16 bits"): "right", (2, "foliage", "device depth, nothing stated"): "told",
         (1, "hairball", "grey, white near, 16 bits; normals 8 bits"): "told"}


@pytest.mark.parametrize("seed, scene, convention", DRAWN)
def test_frames_of_cameras_drawn_at_random(seed, scene, convention, tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", gloam.Note)
        (frame,) = conventions.drawn(seed, [scene]).values()
    found, notes = conventions.outcome(frame, convention, tmp_path)
    assert found == DRAWN[seed, scene, convention], notes


def test_normals_tell_how_often_a_stated_planar_distance_wraps(tmp_path):
    file, words = stored(tmp_path, gloam.capture("temple", 480, 270, ["depth", "normal"]), "planar, 16 bits that wrap")
    told, by_words = read(file, **words), read(file, **words, depth_is="z", depth_encoding="wrapped")
    assert numpy.array_equal(told["depth"], by_words["depth"])


WORDS = {"depth_is": str, "depth_encoding": str, "near": float, "far": float, "depth_scale": float, "depth_offset": float}


def words_in(note):
    """Those that a note names for what was taken, before what says otherwise."""
    taken = note.split("says otherwise")[0].rsplit(";", 1)[0]
    return {word: WORDS[word](value.strip("'")) for word, value in re.findall(r"\b(\w+)=('[^']*'|[-+.\de]+)", taken) if word in WORDS}


@pytest.mark.parametrize("convention", ["device depth, nothing stated", "reversed, infinite far plane", "grey, white near, clamped", "grey, white near, 16 bits, sRGB curve",
                                        "grey, black near, 16 bits", "planar, rows from the bottom up"])
def test_the_words_of_the_note_state_what_was_found(convention, frames, tmp_path):
    file, words = stored(tmp_path, frames["gallery"], convention)
    found = read(file, **words)
    stating = words_in(told_of(found))
    assert stating
    again = read(file, **words, **stating)
    assert not any("by which" in note for note in again.notes), again.notes
    both = numpy.isfinite(found["depth"]) & numpy.isfinite(again["depth"])
    assert both.sum() > 0.999 * numpy.isfinite(found["depth"]).sum()
    # The note has six digits, which device depth divides by what is left to its pole.
    assert numpy.abs(again["depth"][both] / found["depth"][both] - 1).max() < 2e-2
    assert numpy.median(numpy.abs(again["depth"][both] / found["depth"][both] - 1)) < 1e-3


def test_depth_means_the_same_to_a_command_that_needs_no_normals(frames, tmp_path):
    file, words = stored(tmp_path, frames["gallery"], "reversed, with a far plane; world normals")
    assert numpy.array_equal(read(file, ["depth"], **words)["depth"], read(file, **words)["depth"])


def test_clipping_planes_that_the_normals_contradict_are_told(frames, tmp_path):
    frame = frames["gallery"]
    file, words = stored(tmp_path, frame, "device depth, nothing stated")
    held = frame.camera
    of_camera = gloam.Camera(held.fx, held.fy, held.cx, held.cy, near=1.0, far=60.0)
    found = read(file, **{**words, "camera": of_camera})
    assert "near and far, 1 and 60, do not fit" in told_of(found)
    assert conventions.is_right(found, conventions.of_frame(frame), False)  # those of a camera are given up
    stated = read(file, **{**words, "camera": of_camera}, near=1.0, far=60.0)
    assert "near and far, 1 and 60, do not fit" in told_of(stated)
    assert not conventions.is_right(stated, conventions.of_frame(frame), False)


def test_planar_depth_stays_planar_where_normals_are_those_of_another_frame(frames, tmp_path):
    normal = conventions.written(tmp_path / "other", frames["foliage"]["normal"].astype(numpy.float32))
    file, words = stored(tmp_path, frames["gallery"], "planar, floats")
    found = read(file, **{**words, "plane_files": {"normal": normal}})
    assert numpy.array_equal(found["depth"], frames["gallery"]["depth"])
    assert "by which plane surfaces are plane" in told_of(found)


@pytest.mark.parametrize("name, told", [("ray", "distance along the ray (to"), ("reversed", "1 / distance (to"), ("ndc", "1 / distance (to")])
def test_arrays_that_contradict_their_normals_are_told(name, told, frames):
    frame = frames["gallery"]
    values = conventions.of_frame(frame)
    depth = {"ray": values.floats(values.z * values.secant, numpy.inf), "reversed": values.floats(values.near / values.z, 0), "ndc": values.floats(values.device(), 1)}[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", gloam.Note)
        seen = gloam.run("gtao", depth=depth, normal=frame["normal"], camera=frame.camera, radius=1.0)
        said = gloam.run("gtao", depth=depth, normal=frame["normal"], camera=frame.camera, radius=1.0, depth_is=name, near=values.near, far=1e6 if name == "reversed" else values.far)
    note = next(note for note in seen.notes if "though it agrees with the normals" in note)
    assert told in note and f"give depth_is='{name}'" in note
    assert not any("though it agrees" in note for note in said.notes)


def test_whole_numbers_that_wrap_are_unwrapped_where_surfaces_go_on(tmp_path):
    frame = gloam.capture("gallery", 480, 270, ["depth"])
    steps = numpy.where(numpy.isfinite(frame["depth"]), numpy.round(frame["depth"] / numpy.nanmax(frame["depth"][numpy.isfinite(frame["depth"])]) * 150000), 0)
    for name, kind in (("unsigned", numpy.uint16), ("signed", numpy.int16)):
        numpy.save(tmp_path / f"{name}_depth.npy", steps.astype(numpy.int64).astype(kind))
        found = read(tmp_path / f"{name}_depth.npy", ["depth"], camera=frame.camera)
        assert any("taken to wrap around" in note for note in found.notes), found.notes
        seen = numpy.isfinite(found["depth"]) & (steps > 0)
        assert numpy.mean(numpy.abs(found["depth"][seen] - steps[seen]) < 1) > 0.95
        plain = read(tmp_path / f"{name}_depth.npy", ["depth"], camera=frame.camera, depth_encoding="plain")
        assert not any("wrap" in note for note in plain.notes)


def test_wide_ranges_with_edges_do_not_wrap(tmp_path):
    for name in ("foliage", "hairball", "fence"):
        frame = gloam.capture(name, 480, 270, ["depth"])
        surface = numpy.isfinite(frame["depth"])
        steps = numpy.where(surface, frame["depth"] / frame["depth"][surface].max() * 65000, 0).astype(numpy.uint16)
        numpy.save(tmp_path / "depth.npy", steps)
        found = read(tmp_path / "depth.npy", ["depth"], camera=frame.camera)
        assert not any("wrap" in note for note in found.notes), found.notes


def test_one_frame_of_a_shot_decides_for_all(frames, tmp_path):
    frame = frames["gallery"]
    values = conventions.of_frame(frame)
    for number in (1, 2, 3):
        depth = values.floats(values.near / values.z, 0)
        if number != 2:
            depth[:] = 0  # nothing to tell by
            depth[:20, :20] = 0.5
        numpy.save(tmp_path / f"depth.{number:04d}.npy", depth)
        numpy.save(tmp_path / f"normal.{number:04d}.npy", frame["normal"])
    notes = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        shot = gloam.Sequence(tmp_path / "depth.####.npy", plane_files={"normal": tmp_path / "normal.####.npy"}, camera=frame.camera)
        for result in shot.run("gtao", radius=1.0):
            notes += list(result.notes)
    notes += [str(warning.message) for warning in caught]
    told = {note for note in notes if "depth: taken as" in note}
    assert any("reversed normalised device depth" in note and "decided on frame 2 for the whole sequence" in note for note in told), told


@pytest.mark.parametrize("word, said", [("foo", "'foo' is not allowed"), ("srgb,", "'srgb' is for shares of white"), ("", "is empty"), ("wrapped", "whole numbers of 16 bits")])
def test_words_of_an_encoding(word, said, frames, tmp_path):
    file, words = stored(tmp_path, frames["gallery"], "planar, floats")
    with pytest.raises(gloam.Error, match=said):
        read(file, **words, depth_encoding=word)


def grey_of(frame, is_white_near, is_clamped):
    depth, surface = frame["depth"], numpy.isfinite(frame["depth"])
    near, far = 0.5 * depth[surface].min(), numpy.percentile(depth[surface], 95) if is_clamped else 1.2 * depth[surface].max()
    black_near = numpy.where(surface, numpy.clip((depth - near) / (far - near), 0, 1), 1)
    return 1 - black_near if is_white_near else black_near


@pytest.mark.parametrize("is_clamped", [False, True], ids=["whole", "clamped"])
@pytest.mark.parametrize("is_white_near", [True, False], ids=["white near", "black near"])
@pytest.mark.parametrize("names", [("VRayZDepth", "VRayNormals"), ("ZDepth", "normals"), ("CGeometry_ZDepth", "CGeometry_NormalsShading")], ids=lambda names: names[0])
def test_a_grey_of_a_renderer_is_no_planar_distance(names, is_white_near, is_clamped, frames, tmp_path):
    """V-Ray's and Corona's depth is a grey between two distances, of either polarity: by the normals its shape is known, by positions its lengths too."""
    frame = frames["gallery"]
    surface = numpy.isfinite(frame["depth"])
    planes = {**layer(names[0], grey_of(frame, is_white_near, is_clamped), "Z"), **layer(names[1], frame["normal"], "XYZ")}
    write_exr(tmp_path / "normals.exr", planes)
    by_normals = read(tmp_path / "normals.exr", fov=float(numpy.degrees(2 * numpy.arctan(240 / frame.camera.fx))))
    assert f"linear in the distance, {'white' if is_white_near else 'black'} near" in told_of(by_normals)
    both = surface & numpy.isfinite(by_normals["depth"])
    factors = by_normals["depth"][both] / frame["depth"][both]
    assert both.sum() >= 0.94 * surface.sum()
    assert numpy.percentile(numpy.abs(factors / numpy.median(factors) - 1), 90) < 0.01

    write_exr(tmp_path / "positions.exr", {**planes, **layer("P", in_the_world(frame)[0], "XYZ")})
    by_positions = read(tmp_path / "positions.exr")
    assert any(f"made from the positions, since '{names[0]}.Z' is neither" in note for note in by_positions.notes)
    assert numpy.array_equal(numpy.isfinite(by_positions["depth"]), surface)
    assert numpy.abs(by_positions["depth"][surface] / frame["depth"][surface] - 1).max() < 1e-4
    chosen = gloam.read(tmp_path / "positions.exr", channels={"depth": names[0]})
    assert not any("made from the positions" in note for note in chosen.notes)
