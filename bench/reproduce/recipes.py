"""What tables of several pages are made by."""
import os
import pathlib

from catalogue import NotHere
from markdown import numbers_in

SCENES = "banquet clockwork colonnade corridor courtyard fence foliage gallery hairball lounge pillar plane slab statue temple".split()
# As the pages on light order them: rooms, then thin things, then what hardly has any.
BY_KIND = "gallery courtyard lounge statue temple corridor colonnade banquet fence foliage hairball clockwork pillar slab plane".split()


def rows_printed(text):
    """Rows of tables in Markdown: the label, and the numbers of each cell."""
    rows = [line.strip().strip("|").split("|") for line in text.splitlines() if line.startswith("|")]
    return [(cells[0].strip(), [tuple(n.value for n in numbers_in(cell)) for cell in cells[1:]]) for cells in rows]


def row_of(text, label):
    found = [cells for name, cells in rows_printed(text) if name == label]
    if len(found) != 1:
        raise ValueError(f"{len(found)} rows are called {label}")
    return found[0]


def mean_of(rows):
    """The row of means over rows whose cells are tuples of equal length."""
    return [tuple(sum(numbers) / len(rows) for numbers in zip(*cells)) for cells in zip(*rows)]


def effect_errors(lab, effect, scenes):
    """Rows of bench/effect_errors.py: a cell is (RMSE,) or (RMSE, bias)."""
    folder = lab.folder_for(f"effect-{effect}")
    return [row_of(lab.program("effect_errors.py", effect, folder, scene, "--gloam", lab.gloam), scene) for scene in scenes]


def effect_files(lab, effect, plane, scene):
    """The frame and the truth that bench/effect_errors.py has made."""
    effect_errors(lab, effect, [scene])
    folder = lab.folder_for(f"effect-{effect}")
    return folder / f"{scene}.exr", folder / f"{scene}_{plane}_truth.exr"


def environment_errors(lab, what, size, samples, scenes):
    folder = lab.folder_for(f"environment-{what}")
    return [row_of(lab.program("environment_errors.py", what, folder, lab.gloam, size, samples, scene), scene) for scene in scenes]


def sets(**parameters):
    """--set NAME=VALUE of each; `__` stands for a point."""
    return [word for name, value in parameters.items() for word in ("--set", f"{name.replace('__', '.')}={value}")]


def rmse(lab, result, truth, *flags):
    return lab.compared(result, truth, *flags)["rmse"]


def of_each_view(lab, result, truth, figure="rmse", *flags):
    """A figure of the left and of the right eye."""
    return tuple(lab.compared(result, truth, "--view", view, *flags)[figure] for view in ("left", "right"))


def pair(lab, scene, size, *flags):
    """What two eyes see, 65 mm apart."""
    return lab.frame(scene, size, "--stereo", 0.065, *flags)


def capture(lab, name):
    """A frame that is not part of the project (see GLOAM_CAPTURES in docs/fuzzing.md)."""
    folder = pathlib.Path(os.environ.get("GLOAM_CAPTURES", lab.root.parent / "shared" / "captures"))
    if not (folder / name).is_file():
        raise NotHere(f"needs {name} among the frames that are not part of the project; GLOAM_CAPTURES names their folder")
    return str(folder / name)


def where_captured(lab, name, make):
    """make(path), or None where the frame is not at hand."""
    try:
        path = capture(lab, name)
    except NotHere:
        return None
    return make(path)


def is_called(name, wanted):
    """Papers' scenes are called "gallery for Pica": the stand-in is enough. A star stands for any end."""
    return name == wanted or name.startswith(f"{wanted} for ") or wanted.endswith("*") and name.startswith(wanted[:-1])


def named(figures, *wanted):
    """The one figure of Lab.paper whose names are these."""
    found = [value for names, value in figures.items() if all(map(is_called, names, wanted))]
    if len(found) != 1:
        raise ValueError(f"{len(found)} figures of the paper are called {', '.join(wanted)}")
    return found[0]


def computed_share(lab, technique, frame, *flags):
    """Share of the pixels that a run with a mask estimates."""
    return 1 - lab.figures("run", technique, frame, "-o", lab.unused("result.exr"), *flags)["skipped_share"]
