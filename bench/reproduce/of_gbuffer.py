"""docs/gbuffer.md"""
import re
import statistics
import warnings

from catalogue import no_figures, table
from intervals import ERROR, RATIO

PAGE = "docs/gbuffer.md"
no_figures(PAGE, "What nothing states", 1, why="what is read as what")


def stored_depths(depth, camera):
    """A depth as files may hold it, by name: the values, what the reader states, and whether lengths are known; else a factor is free."""
    import numpy
    height, width = depth.shape
    x, y = (numpy.arange(width) + 0.5 - camera.cx) / camera.fx, (numpy.arange(height) + 0.5 - camera.cy) / camera.fy
    secant = numpy.sqrt(1 + x[None] ** 2 + y[:, None] ** 2)
    surface = numpy.isfinite(depth)
    z = numpy.where(surface, depth, 1)
    near, far, black, white = 0.1, 2 * z.max(), 1.2 * z.max(), 0.5 * z[surface].min()
    ndc = numpy.where(surface, far / (far - near) * (1 - near / z), 1)
    return {"z": (depth, {}, True), "millimetres": (numpy.where(surface, numpy.round(1000 * z), 0), {"depth_scale": 0.001}, True),
            "ray": (depth * secant, {}, True), "disparity": (numpy.where(surface, 100 / z, 0), {}, False),
            "reversed": (numpy.where(surface, near / z, 0), {}, False), "ndc with near and far": (ndc, {"near": near, "far": far}, True),
            "ndc": (ndc, {}, True), "white near": (numpy.where(surface, (black - z) / (black - white), 0), {}, False),
            "black near": (numpy.where(surface, (z - white) / (black - white), 1), {}, False)}


def of_frame(lab, frame, fov=None):
    """For each of them: whether it is read right, told though it cannot be read, not told, read wrongly although something was told."""
    import gloam
    import numpy
    own = float(numpy.degrees(2 * numpy.arctan(frame.width / 2 / frame.camera.fx)))
    truth, rows = frame["depth"], []
    for values, stated, is_length in stored_depths(truth, frame.camera).values():
        file = lab.folder_for("meanings") / "depth.npy"
        numpy.save(file, values.astype(numpy.float32))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", gloam.Note)
            read = gloam.read(file, fov=fov or own, **stated)
        note = next(note for note in read.notes if note.startswith("depth: taken as"))
        both = numpy.isfinite(truth) & numpy.isfinite(read["depth"])
        factors = read["depth"][both] / truth[both]
        errors = numpy.abs(factors / (1 if is_length else numpy.median(factors)) - 1)
        is_right = numpy.percentile(errors, 95) < 0.01
        is_told = "though plane surfaces" in note
        is_taken = "by which plane surfaces" in note
        rows.append((is_right, not is_right and is_told, not is_right and not is_told and not is_taken, not is_right and is_taken))
    return rows


def scenes():
    import gloam
    return [gloam.capture(name, 640, 360, ["depth"]) for name in gloam.scenes()]


def of_all_conventions(lab):
    """The counts of bench/conventions.py, and all of them together."""
    rows = [[int(count) for count in re.findall(r"(\d+) (?:right|told|silent)", line)] for line in lab.program("conventions.py", "--random", "1,2").splitlines()]
    return [[(count,) for count in row] for row in rows]


@table(PAGE, "What nothing states", 2, minutes=9)
def conventions_told(lab):
    return of_all_conventions(lab)


@table(PAGE, "What nothing states", 3, minutes=1)
def meanings_of_depth(lab):
    of_frames = [of_frame(lab, frame) for frame in scenes()]
    return [[(sum(frame[row][column] for frame in of_frames),) for column in range(4)] for row in range(len(of_frames[0]))]


MARGINS = (0, 0.25, 0.5, 1, 2)  # radii at the median depth
BORDER = 40  # pixels
ROUNDS = range(3)  # in which margins take turns, so that other work slows all of them alike


def frames_with_margins(lab, scene):
    plain = lab.frame(scene, "960x540", "--planes", "normal")
    radius = lab.figures("info", plain)["radius_pixels"]
    return plain, [lab.frame(scene, "960x540", "--planes", "normal", "--overscan", f"{round(margin * radius)}px") for margin in MARGINS]


def errors_with_margin(lab, technique, frame, truth):
    """RMSE over the picture, and near its border."""
    import gloam
    import numpy
    truth, result = gloam.read(truth, planes=["ao", "depth"]), gloam.read(lab.result(technique, frame, "--preset", "medium"), planes=["ao"])
    squares, surface = (result["ao"] - truth["ao"]) ** 2, numpy.isfinite(truth["depth"])
    border = surface.copy()
    border[BORDER:-BORDER, BORDER:-BORDER] = False
    return numpy.sqrt(squares[surface].mean()), numpy.sqrt(squares[border].mean())


def times_of_kernels(lab, technique, frames):
    """Seconds that the processors take for a run, without what a command does once."""
    def seconds(frame, runs):
        return lab.usage("run", technique, frame, "-o", lab.unused("ao.exr"), "--preset", "medium", "--repeat", runs)["processors"]

    rounds = [[seconds(frame, 100 + i) - seconds(frame, 20 + i) for frame in frames] for i in ROUNDS]
    return [statistics.median(times) for times in zip(*rounds)]


def with_margins(lab, technique):
    columns, times = [], []
    for scene in ("courtyard", "colonnade", "temple", "lounge"):
        plain, frames = frames_with_margins(lab, scene)
        truth = lab.truth("ao", plain, 256)
        columns.append([errors_with_margin(lab, technique, frame, truth) for frame in frames])
        times.append(times_of_kernels(lab, technique, frames))
    totals = [sum(of_margin) for of_margin in zip(*times)]
    return [[*cells, total / totals[0]] for *cells, total in zip(*columns, totals)]


def of_errors_and_time(row, column):
    return RATIO if column == 4 else ERROR


@table(PAGE, "A margin around the picture", minutes=5, within=of_errors_and_time)
def margins_of_evidence(lab):
    return with_margins(lab, "evidence")


@table(PAGE, "A margin around the picture", 2, minutes=4, within=of_errors_and_time)
def margins_of_gtao(lab):
    return with_margins(lab, "gtao")
