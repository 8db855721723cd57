"""kernels/adaptive/README.md"""
from catalogue import table
from recipes import rmse

CONVERGED = ("--directions", 32, "--steps", 64)
SETTINGS = (("--preset", "ultra"), ("--preset", "ultra", "--adaptive", "medium"), ("--preset", "ultra", "--directions", 2), ("--preset", "medium"))


@table("kernels/adaptive/README.md", "What it brings", minutes=2)
def errors(lab):
    rows = []
    for scene in ("courtyard", "temple", "corridor", "gallery"):
        frame = lab.frame(scene, "960x540")
        truth = lab.result("gtao", frame, *CONVERGED)
        rows.append([rmse(lab, lab.result("gtao", frame, *settings), truth, "--plane", "ao") for settings in SETTINGS])
    return rows
