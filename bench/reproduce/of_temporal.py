"""kernels/temporal/README.md"""
from catalogue import record, table
from intervals import SENSITIVE

PAGE = "kernels/temporal/README.md"
SHOTS = (("gallery", "walk"), ("courtyard", "orbit"), ("colonnade", "dolly"), ("clockwork", "gears"))
SETTINGS = (("--preset", "medium"), ("--preset", "ultra"), ("--preset", "medium", "--temporal"))


def shot_of(lab, scene, name, size, last, *flags):
    return lab.shot(scene, size, "--shot", name, "--frames", f"1-{last}", *flags)


def summary(lab, technique, shot, truth, frames, settings, *flags):
    """Over the frames named; those before them are computed for what accumulates."""
    return lab.compared(lab.result(technique, shot, *settings), truth, "--frames", frames, *flags)["summary"]


def errors_and_flicker(lab, technique, kind, shots, size, frames, rays):
    rows = []
    for scene, name in shots:
        shot = shot_of(lab, scene, name, size, frames.split("-")[1])
        truth = lab.truth(kind, shot, rays, "--frames", frames)
        found = [summary(lab, technique, shot, truth, frames, settings) for settings in SETTINGS]
        rows.append([*(s["mean"]["rmse"] for s in found), *(s["flicker"] for s in found)])
    return rows


def of_technique(lab, technique):
    return errors_and_flicker(lab, technique, "ao", SHOTS, "640x360", "8-12", 256)


@table(PAGE, "What it brings", minutes=6, within=SENSITIVE)
def evidence(lab):
    return of_technique(lab, "evidence")


@table(PAGE, "What it brings", 2, minutes=6, within=SENSITIVE)
def gtao(lab):
    return of_technique(lab, "gtao")


@table(PAGE, "What it brings", 3, minutes=6, within=SENSITIVE)
def bitmask(lab):
    return of_technique(lab, "bitmask")


@table(PAGE, "What it brings", 4, minutes=1, within=SENSITIVE)
def two_eyes(lab):
    shot, frames, rows = shot_of(lab, "gallery", "walk", "640x360", 12, "--stereo", 0.064), "9-12", []
    truth = lab.truth("ao", shot, 256, "--frames", frames)
    for technique in ("gtao", "stereo-gtao", "stereo-evidence"):
        for flags in ((), ("--temporal",)):
            settings = ("--preset", "medium", "--float", *flags)  # steps of half floats are a tenth of these inconsistencies
            found = summary(lab, technique, shot, truth, frames, settings, "--view", "left")
            apart = lab.figures("compare", "--stereo", lab.result(technique, shot, *settings), "--frames", frames, "--frame", shot)["summary"]
            rows.append([found["mean"]["rmse"], found["flicker"], apart["inconsistency"]])
    return rows


@table(PAGE, "What it brings", 5, minutes=1, within=SENSITIVE)
def indirect(lab):
    return errors_and_flicker(lab, "indirect", "indirect", (SHOTS[0], SHOTS[3]), "480x270", "5-12", 64)


record(PAGE, "By region", why="tests/python/test_accumulation.py prints the regions of a smaller shot; the rule before is no longer part of the project")
