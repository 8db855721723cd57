"""docs/blender.md"""
import re
import shutil

from catalogue import NotHere, record, table

PAGE = "docs/blender.md"


@table(PAGE, "How near to Cycles", minutes=8)
def cycles(lab):
    if not shutil.which("blender"):
        raise NotHere("needs Blender, which script/bootstrap does not install")
    rows = []
    for case in ("frame", "stereo", "orthographic"):
        printed = lab.printed("tests/blender/addon/check", case, lab.gloam, ".", "-", 300, 512)
        # The first is what the add-on ran, which is one of those that follow.
        rows.append([float(number) for number in re.findall(r": RMSE ([\d.e-]+) to Cycles", printed)][1:])
    return rows


record(PAGE, "docs/images/blender.png", why="made by hand in Blender, from a scene of its own and its compositor")
