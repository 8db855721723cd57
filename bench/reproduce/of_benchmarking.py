"""docs/benchmarking.md"""
import documents
from catalogue import record, table
from intervals import ERROR, RATIO, SENSITIVE

PAGE = "docs/benchmarking.md"
ROWS = (("gtao", "low", False), ("gtao", "low", True), ("gtao", "medium", False), ("gtao", "medium", True), ("gtao", "high", False),
        ("bitmask", "medium", True), ("gtao", "ultra", False), ("hbao+", "medium", False), ("hbao+", "medium", True), ("evidence", "low", False),
        ("evidence", "low", True), ("evidence", "high", True))


@table(PAGE, "A sequence", minutes=1, within=lambda row, column: (RATIO, ERROR, SENSITIVE)[column])
def sequence(lab):
    folder = lab.bench("walk", "--sequence", "gallery:walk", "--size", "320x180", "--rays", 128, "--techniques", "hbao+,gtao,bitmask,evidence")
    rows = documents.read(folder)["sequence"]["rows"]
    found = {(r["technique"], r["preset"], r["temporal"]): r for r in rows}
    return [[found[row][name] for name in ("ratio_to_hbao_plus", "rmse", "flicker")] for row in ROWS]


record(PAGE, "A paper, measured again", why="how long commands of minutes take on two idle cores")
record(PAGE, "What was measured", why="many runs of two builds, one made slower on purpose, for half a day on a machine with other work")
record(PAGE, "What was measured", 2, why="twenty processes of two builds, one made slower on purpose, on an idle machine")
record(PAGE, "The roofline", 2, why="two runs on a machine with other work, whose shares of peaks are that machine's")
