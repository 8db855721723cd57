"""bench/README.md"""
import shutil

from catalogue import NotHere, table
from intervals import EXACT, MACHINE, RATIO
from markdown import Table
from recipes import rows_printed

PAGE = "bench/README.md"
NAMES = ("gloam fast", "gloam precise", "naive", "naive unrolled", "native", "native tuned", "gather floor", "copy floor")


@table(PAGE, "bench_hbao_plus", 2, minutes=1, within=lambda row, column: MACHINE if column < 2 else RATIO)
def hbao_plus(lab):
    found = dict(rows_printed(lab.printed("sh", "-c", "build/bench/bench_hbao_plus --benchmark_filter=nothing 2>&1")))
    rows = [[cells[i][0] for i in (0, 1, 3, 4)] for cells in (found[name] for name in NAMES)]
    rows[2][2] = (rows[2][2], None)  # and in words
    return rows


@table(PAGE, "bench_denormals", minutes=3, within=lambda row, column: RATIO if column else MACHINE)
def denormals(lab):
    found = dict(rows_printed(lab.printed(lab.root / "build/bench/bench_denormals")))
    return [[cell[0] for cell in found[row[0]]] for row in Table(lab.root / PAGE, "bench_denormals").rows]


@table(PAGE, "Instructions on GPUs", minutes=2, within=EXACT)
def instructions(lab):
    if not shutil.which("clang-15"):
        raise NotHere("clang-15 and libclc-15 (Debian 12)")
    rows = lab.printed(lab.root / "script/update-instruction-counts", lab.gloam, "--print").strip().split("\n")
    return [[int(cell) for cell in row.strip("| ").split(" | ")[1:]] for row in rows]
