"""docs/leaderboard.md: what was measured on the frozen set"""
from catalogue import measurements

METHOD = "contrib/score/plane_ao.py --in {frame} --out {image} --camera {camera} --radius {radius}"


def frozen_set(lab):
    folder = lab.folder_for("sets") / "gloam-1"
    lab.run_again(lab.gloam, "set", "make", "gloam-1", "-o", folder, "-q")  # keeps the files that are there
    return folder


@measurements("docs/leaderboard.md", "data/results/gloam-1/techniques.json", minutes=20)
def techniques(lab):
    return lab.bench("gloam-1", "--set", frozen_set(lab), "--presets", "medium", "--rounds", 6) / "bench.json"


@measurements("docs/leaderboard.md", "data/results/gloam-1/plane-ao.json", minutes=10)
def plane_ao(lab):
    folder = lab.folder_for("plane-ao")
    entry = lab.text("plane-ao.json", '{"name": "plane AO", "version": "1", "licence": "MIT", "settings": {"samples": 24}}')
    lab.run_again(lab.gloam, "score", "--command", f"/usr/bin/python3 {METHOD}", "--json", entry, "--set", frozen_set(lab), "-o", folder,
                  "--rounds", 1, fine=(0, 1))  # displays and parallel cameras are not the method's
    return folder / "bench.json"
