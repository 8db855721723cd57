"""docs/measured.md"""
from catalogue import record, table
from intervals import MACHINE

PAGE = "docs/measured.md"


@table(PAGE, "Lanes", minutes=1, within=MACHINE)
def lanes(lab):
    frame = lab.frame("courtyard", "1920x1080", "--planes", "normal")

    def estimate(math, lanes):
        told = lab.figures("run", "hbao+", frame, "-o", lab.unused("ao.exr"), "--lanes", lanes, "--math", math, "--repeat", 9, "--radius", 0.5)
        return next(p["ms"]["median"] for p in told["passes"] if p["name"] == "hbao+/estimate")

    return [[estimate(math, count) for count in (1, 4, 8, 16)] for math in ("precise", "fast")]


record(PAGE, "The past as hidden layers", why="the second layer was projected from earlier frames by code that is not part of the project")
record(PAGE, "Edges once per pixel", why="filters were computed from raw images by code that is not part of the project")
record(PAGE, "The first image", why="read from the log and the system calls of a driver of OpenCL, on one machine")
