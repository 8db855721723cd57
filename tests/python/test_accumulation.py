"""What `--temporal` is worth, by region: nowhere worse than single frames, and as long a memory as the camera allows."""

import json

import numpy
import pytest

import gloam

SINGLE = ("--set", "temporal.most_frames=1")  # the same samples, and nothing of the frames before
REGIONS = ("all", "flat", "edges", "moving", "around", "new")


def box(found, reach):
    """Pixels that have one of those found within so many columns and rows."""
    for axis in (0, 1):
        wide = numpy.zeros_like(found)
        for step in range(-reach, reach + 1):
            moved = numpy.roll(found, step, axis)
            if step:
                numpy.moveaxis(moved, axis, 0)[slice(None, step) if step > 0 else slice(step, None)] = False
            wide |= moved
        found = wide
    return found


def regions(frame, before, radius):
    """Masks by name: what moves by itself, its surroundings, what has come into view since the frame before, edges, and the rest."""
    camera = frame.camera
    z, motion = (numpy.asarray(frame[plane], float) for plane in ("depth", "motion"))
    height, width = z.shape
    y, x = numpy.mgrid[:height, :width]
    surface = numpy.isfinite(z)
    z = numpy.where(surface, z, 1)
    view = numpy.stack([(x + 0.5 - camera.cx) / camera.fx * z, (camera.cy - y - 0.5) / camera.fy * z, -z], -1)
    world = view @ camera.camera_to_world[:3, :3].T + camera.camera_to_world[:3, 3]
    past = (world - before.camera.camera_to_world[:3, 3]) @ before.camera.camera_to_world[:3, :3]
    rest_x, rest_y = -past[..., 0] / past[..., 2] * camera.fx + camera.cx - 0.5, past[..., 1] / past[..., 2] * camera.fy + camera.cy - 0.5
    moving = (numpy.hypot(x + motion[..., 0] - rest_x, y + motion[..., 1] - rest_y) > 0.3) & surface
    column, row = numpy.rint(x + motion[..., 0]).astype(int), numpy.rint(y + motion[..., 1]).astype(int)
    inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    there = numpy.asarray(before["depth"], float)[row.clip(0, height - 1), column.clip(0, width - 1)]
    depth_before = numpy.where(moving, z, -past[..., 2])
    new = ~(inside & (abs(there - depth_before) <= 0.03 * depth_before)) & surface & ~moving
    near = numpy.where(surface, 1 / z, 0)
    edges = numpy.zeros_like(surface)
    for dy in range(-2, 3):
        for dx in range(-2, 3):
            other = numpy.roll(near, (dy, dx), (0, 1))
            edges |= abs(other - near) > 0.05 * numpy.maximum(near, other)
    around = box(moving, int(radius * camera.fx / numpy.median(z[surface]))) & ~moving & surface
    edges &= surface & ~moving & ~new
    return {"all": surface, "flat": surface & ~edges & ~moving & ~new & ~around, "edges": edges, "moving": moving, "around": around, "new": new}


@pytest.fixture(scope="module")
def gears(command, tmp_path_factory):
    """A shot in which things and the camera move, the truth of its last frames, and their regions."""
    folder, radius = tmp_path_factory.mktemp("gears"), 0.25
    command("capture", "clockwork", "-o", folder / "shot.####.exr", "--shot", "gears", "--frames", "1-10", "--size", "320x180",
            "--planes", "normal,motion")
    command("reference", "ao", folder / "shot.####.exr", "-o", folder / "truth.####.exr", "--frames", "7-10", "--samples", "128", "--radius", radius)
    frames = [gloam.read(folder / f"shot.{i:04}.exr") for i in range(6, 11)]
    truths = [gloam.read(folder / f"truth.{i:04}.exr", planes=["ao"])["ao"] for i in range(7, 11)]
    return folder, radius, truths, [regions(frame, before, radius) for before, frame in zip(frames, frames[1:])]


@pytest.mark.parametrize("technique", ["evidence", "bitmask", "gtao"])
def test_no_region_loses_by_the_frames_before(technique, gears, command):
    folder, radius, truths, found = gears

    def errors(name, *more):
        command("run", technique, folder / "shot.####.exr", "-o", folder / f"{name}.####.exr", "--radius", radius, "--float", "--temporal", *more)
        results = [gloam.read(folder / f"{name}.{i:04}.exr", planes=["ao"])["ao"] for i in range(7, 11)]
        squares = [(numpy.asarray(result, float) - truth) ** 2 for result, truth in zip(results, truths)]
        rmse = {region: numpy.sqrt(numpy.concatenate([s[m[region]] for s, m in zip(squares, found)]).mean()) for region in REGIONS}
        summary = command("compare", folder / f"{name}.####.exr", folder / "truth.####.exr", "--frame", folder / "shot.####.exr", "--frames", "7-10",
                          as_json=True)["summary"]
        return rmse, summary["flicker"]

    (single, flicker_single), (temporal, flicker) = errors("single", *SINGLE), errors("temporal")
    print(technique, "flicker", f"{flicker_single:.4f} {flicker:.4f}", *(f"{r} {single[r]:.4f} {temporal[r]:.4f}" for r in REGIONS))
    assert temporal["all"] < single["all"] - 0.0005 and flicker < 0.9 * flicker_single
    # A memory of 64 frames loses .004 to .006 on what moves, and .0005 to .002 around it and on what is new.
    assert {r: temporal[r] - single[r] for r in REGIONS if temporal[r] > single[r] + 0.0004} == {}


def noise_left(command, folder, camera_path, *more):
    """Of the raw AO of a twelfth frame: RMSE to the mean over many seeds, as a share of that of a single frame."""
    command("capture", "gallery", "-o", folder / "shot.####.exr", "--camera-path", camera_path, "--planes", "normal,motion")
    run = ("run", "gtao", folder / "shot.####.exr", "--radius", "0.5", "--float", "--temporal", "--outputs", "ao_raw,frames")
    command(*run, "-o", folder / "kept.####.exr", *more)
    kept = numpy.asarray(gloam.read(folder / "kept.0012.exr", planes=["ao_raw"])["ao_raw"], float)
    singles = [gloam.run("gtao", gloam.read(folder / "shot.0012.exr"), radius=0.5, seed=seed, outputs=["ao_raw"])["ao_raw"] for seed in range(100, 148)]
    mean = numpy.mean(numpy.asarray(singles, float), 0)
    inner = (slice(20, -20), slice(40, -40))
    error = [numpy.sqrt(((image - mean)[inner] ** 2).mean()) for image in (kept, numpy.asarray(singles[0], float))]
    return error[0] / error[1]


def test_a_camera_at_rest_or_turning_keeps_a_long_memory(command, tmp_path):
    eye, size = numpy.array([1.56, 1.64, 2.1]), {"width": 320, "height": 180, "fx": 212, "fy": 212, "cx": 160, "cy": 90}

    def path(turn, step):
        poses = []
        for i in range(12):
            pose = numpy.eye(4)
            c, s = numpy.cos(turn * i), numpy.sin(turn * i)
            pose[:3, :3] = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
            pose[:3, 3] = eye + [step * i, 0, 0]
            poses.append({"camera_to_world": pose.tolist()})
        name = tmp_path / "path.json"
        name.write_text(json.dumps({**size, "path": poses}))
        return name

    rest, turning = noise_left(command, tmp_path, path(0, 0)), noise_left(command, tmp_path, path(0.01, 0))
    travelling, no_turn = noise_left(command, tmp_path, path(0, 0.03)), noise_left(command, tmp_path, path(0, 0.03), "--set", "temporal.turn=inf")
    print(f"noise left: at rest {rest:.3f}, turning {turning:.3f}, travelling {travelling:.3f}, with turn=inf {no_turn:.3f}")
    assert rest < 0.25 and turning < 0.6 and no_turn < 0.6 < travelling
