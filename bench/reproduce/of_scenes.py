"""docs/scenes.md, data/README.md: what script/update-scenes writes"""
import shutil

from catalogue import page_of_text, picture, table
from markdown import Table, numbers_in
from recipes import SCENES

SHARED = {"minutes": 8, "shares": "update-scenes"}


def made(lab):
    """A folder with what build/data/scene_pages writes."""
    folder = lab.folder_for("scenes")
    if not (folder / "done").exists():
        for part in ("docs/images/scenes", "data"):
            (folder / part).mkdir(parents=True, exist_ok=True)
        shutil.copy(lab.root / "data/README.md", folder / "data")
        lab.run_again(lab.root / "build/data/scene_pages", folder)
        (folder / "done").touch()
    return folder


@page_of_text("docs/scenes.md", **SHARED)
def page(lab):
    return (made(lab) / "docs/scenes.md").read_text()


@table("data/README.md", "Built-in scenes", **SHARED)
def scenes(lab):
    rows = Table(made(lab) / "data/README.md", "Built-in scenes").rows
    return [[tuple(number.value for number in numbers_in(cell)) for cell in row[1:]] for row in rows]


for name in SCENES:
    picture("docs/scenes.md", f"docs/images/scenes/{name}.png", **SHARED)(lambda lab, name=name: made(lab) / f"docs/images/scenes/{name}.png")
