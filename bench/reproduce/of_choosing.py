"""docs/choosing.md"""
from catalogue import table
from intervals import CHANGING, ERROR, MACHINE, Interval
from recipes import SCENES, rows_printed

PAGE = "docs/choosing.md"
OF_BUDGETS = ("gallery", "courtyard", "lounge", "temple", "corridor", "colonnade", "banquet", "statue")
INTERVALS = (MACHINE, ERROR, MACHINE, MACHINE, MACHINE, CHANGING, CHANGING, CHANGING)


def rows_of(lab, scene):
    """What is printed of a scene: without a budget, with each of three, and with each of three errors."""
    folder, tables = lab.folder_for("budgets"), lab.folder_for("picture-fit")
    lab.program("picture_fit.py", tables, "--each", lab.gloam)
    printed = rows_printed(lab.program("budget_errors.py", folder, "--without", tables, lab.gloam, "480x270", 128, scene))
    return [cells for name, cells in printed if name == scene]


@table(PAGE, "How good the choice is", minutes=150, within=lambda row, column: INTERVALS[min(column, 7)])
def budgets(lab):
    rows = []
    for scene in OF_BUDGETS:
        for cells in rows_of(lab, scene)[1:4]:
            everything, its_error, budget, error, ms, looking, expected, best = (cell[0] for cell in cells[:8])
            rows.append([everything, its_error, budget, ms, looking, error, expected, best, None])
    return rows


# Of the whole time: other work moves it by some units.
SAVED = Interval("share of time saved", 10, 0, "a difference of two times of one process", True)
FLAT = ("pillar", "slab", "plane")


@table(PAGE, "What looking saves", minutes=3, within=lambda row, column: SAVED if column == 3 else MACHINE)
def looking(lab):
    rows = {}
    for scene in SCENES:
        told = lab.figures("auto", lab.frame(scene, "960x540"), "-o", lab.unused("effects.exr"), "--measure", "--repeat", 7)
        everything = sum(effect["ms_everywhere"] or 0 for effect in told["effects"])
        rows[scene] = [everything, told["total_ms"], told["classify_ms"] + told["glance_ms"], 100 * (1 - told["total_ms"] / everything)]
    others = list(zip(*(row for scene, row in rows.items() if scene not in FLAT)))
    return [*(rows[scene] for scene in FLAT), [(min(column), max(column)) for column in others]]
