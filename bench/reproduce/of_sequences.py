"""docs/sequences.md"""
import json
import os
import pathlib
import subprocess

from catalogue import record, table
from intervals import ERROR, MACHINE, MEMORY, SENSITIVE

PAGE = "docs/sequences.md"
RADIUS = ("--radius", 0.5)
PATH = {"width": 320, "height": 180, "fx": 212, "fy": 212, "cx": 160, "cy": 90, "frames": 12,
        "path": [{"camera_to_world": [[1, 0, 0, 1.6], [0, 1, 0, 1.65], [0, 0, 1, 2.5], [0, 0, 0, 1]]},
                 {"camera_to_world": [[1, 0, 0, 1.9], [0, 1, 0, 1.65], [0, 0, 1, 1.5], [0, 0, 0, 1]]}]}


@table(PAGE, "Error and flicker", 2, minutes=2, within=lambda row, column: SENSITIVE if column == 1 else ERROR)
def flicker(lab):
    shot = lab.shot("gallery", "320x180", "--planes", "normal,color", "--camera-path", lab.text("path.json", json.dumps(PATH)))
    truth = lab.truth("ao", shot, 256, *RADIUS)
    tests = [lab.result("gtao", shot, *RADIUS, "--preset", preset) for preset in ("low", "medium", "high", "ultra")]
    tests += [lab.result("ao", shot, *RADIUS), lab.truth("ao", shot, 256, *RADIUS, "--seed", 7)]
    summaries = [lab.compared(test, truth, "--frame", shot)["summary"] for test in tests]
    return [[s["mean"]["rmse"], s["flicker"], s["new_rmse"], s["old_rmse"]] for s in summaries]


def large_shot(lab, frames):
    return lab.shot("gallery", "1920x1080", "--shot", "walk", "--frames", f"1-{frames}", "--planes", "normal")


@table(PAGE, "Memory", minutes=4, within=MEMORY)
def memory(lab):
    shot = large_shot(lab, 24)

    def peak(most, *flags):
        return lab.usage("run", "gtao", shot, "-o", lab.unused("ao.####.exr"), *RADIUS, "--memory", most, *flags)["peak"]

    return [[peak(most), () if most in ("250M", "300M") else peak(most, "--temporal")] for most in ("250M", "300M", "400M", "600M", "1G", "2G")]


WRITTEN = ((), ("--compression", "none"), ("--compression", "rle"), ("--compression", "piz"), ("--compression", "zips"), ("--float",),
           ("--outputs", "ao,ao_raw", "--float"), ("--outputs", "ao,ao_raw", "--float", "--keep-depth"))
FRAMES = 20


def processors(lab, *command):
    before = os.times()
    subprocess.run([str(c) for c in command], cwd=lab.root, stdout=subprocess.DEVNULL, check=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


@table(PAGE, "Time", minutes=4, within=lambda row, column: ERROR if column else MACHINE)
def time(lab):
    shot, rows = large_shot(lab, FRAMES), []
    for flags in WRITTEN:
        result = lab.result("gtao", shot, *RADIUS, "--preset", "medium", *flags)
        used = lab.usage("run", "gtao", shot, "-o", lab.unused("ao.####.exr"), *RADIUS, "--preset", "medium", *flags)["processors"]
        rows.append([1000 * used / FRAMES, sum(file.stat().st_size for file in pathlib.Path(result).parent.glob("*.exr")) / FRAMES / 1e6])
    first, frame = lab.result("gtao", shot, *RADIUS, "--preset", "medium").replace("####", "0001"), shot.replace("####", "0001")
    floor = processors(lab, lab.root / "build/bench/bench_sequence_floor", shot, "-o", lab.unused("floor.####.exr"), "--written", first)
    alone = lab.result("gtao", frame, *RADIUS, "--preset", "medium")
    of_one = lab.usage("run", "gtao", frame, "-o", lab.unused("ao.exr"), *RADIUS, "--preset", "medium")["processors"]
    written = pathlib.Path(lab.unused("floor.0001.exr")).stat().st_size
    return [*rows, [1000 * floor / FRAMES, written / 1e6], [1000 * of_one, pathlib.Path(alone).stat().st_size / 1e6]]


record(PAGE, "docs/images/memory_of_a_shot.svg", why="drawn from the samples of 10 000 frames that a test of script/test --long takes in an hour")
