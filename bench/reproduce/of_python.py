"""docs/python.md"""
import pathlib
import shutil
import sys

from catalogue import picture, table
from intervals import MACHINE, RATIO
from markdown import numbers_in

PAGE = "docs/python.md"


@table(PAGE, "Time and memory", minutes=1, within=lambda row, column: RATIO if column == 3 else MACHINE)
def overhead(lab):
    lines = [line.split(" call ") for line in lab.program("python_overhead.py").splitlines() if " call " in line]
    found = {technique.strip(): [n.value for n in numbers_in(rest)] for technique, rest in lines}
    return [found[technique] for technique in ("gtao", "hbao+", "evidence")]


def snippets(lab):
    """The folder in which the snippets of the page have run."""
    folder = lab.folder_for("python-snippets")
    if not (folder / "python_edges.png").exists():
        shutil.rmtree(folder)
        folder.mkdir()
        environment = {"GLOAM_SOURCE_DIR": str(lab.root), "GLOAM_BUILD_DIR": str(lab.root / "build")}
        lab._run([sys.executable, "tests/docs/snippets.py", PAGE, str(folder)], environment)
    return folder


for name in ("python_truth.png", "python_edges.png"):
    picture(PAGE, f"docs/images/{name}", minutes=1, shares="snippets of docs/python.md")(lambda lab, name=name: pathlib.Path(snippets(lab)) / name)
