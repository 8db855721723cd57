"""Every figure of README.md is one of a result file, of another page, or of the program.

Usage: readme.py. Environment: GLOAM_SOURCE_DIR, GLOAM_BUILD_DIR.
"""

import json
import os
import pathlib
import re
import subprocess

SOURCE = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"])
GLOAM = pathlib.Path(os.environ["GLOAM_BUILD_DIR"]) / "gloam"
README = (SOURCE / "README.md").read_text()

# Numbers that are no figures: names of versions, and exit statuses.
NO_FIGURES = ("Debian 12", "0 done, 1 failed", "2 wrong usage", "128 + signal")


def page(name):
    return (SOURCE / name).read_text()


def shown(pattern):
    """The groups of a pattern in the prose of README.md, where it stands once."""
    found = re.findall(pattern, README)
    assert len(found) == 1, f"README.md has {len(found)} places for {pattern!r}"
    return found[0] if isinstance(found[0], tuple) else (found[0],)


def nearest_on_the_set():
    """On how many frames of the frozen set `evidence` is the nearest, and on how many it runs; of techniques that see one layer."""
    results = json.loads(page("data/results/gloam-1/techniques.json"))["results"]
    errors = {}
    for row in results:
        is_counted = (row["effect"], row["preset"], row["variant"], row["depths"], row["views"]) == ("ao", "medium", "", ["depth"], 1)
        if is_counted and "rmse_to_truth" in row:
            errors.setdefault(row["scene"], {})[row["technique"]] = row["rmse_to_truth"]
    frames = [by_technique for by_technique in errors.values() if "evidence" in by_technique]
    return sum(min(frame.values()) == frame["evidence"] for frame in frames), len(frames)


def row_of(table, need):
    """Cells of the first table of docs/accuracy.md that says which setting suits a need, by class."""
    lines = [line for line in table.splitlines() if line.startswith("| ")]
    heading = next(line for line in lines if line.startswith("| need | architecture"))
    row = next(line for line in lines[lines.index(heading):] if line.startswith(f"| {need} |"))
    return dict(zip(*([cell.strip() for cell in line.strip("|").split("|")][1:] for line in (heading, row))))


def inconsistencies():
    """Rows A and D of the table of docs/stereo.md on indirect light: by how much the eyes disagree in each scene."""
    table = page("docs/stereo.md").split("### Indirect light")[1].split("\n## ")[0]
    rows = {name: [int(cell) for cell in cells.split("|")[:4]]
            for name, cells in re.findall(r"^\| (A|D)(?:, `indirect`)? \|([\d |]+)", table, re.M)}
    return rows["A"], rows["D"]


def check_evidence():
    stated = tuple(map(int, shown(r"nearest to the truth, of all that see one layer, on (\d+) of the (\d+) frames")))
    assert stated == nearest_on_the_set(), (stated, nearest_on_the_set())


def check_needs():
    accuracy = page("docs/accuracy.md")
    within = row_of(accuracy, "at most the time of HBAO+ medium")
    assert within["architecture at 1920x1080"] == "gtao medium" and within["object"] == "gtao high", within
    assert within["architecture at 960x540"] == "bitmask medium", within
    assert "for architecture at 1920x1080 (`medium`) and for objects (`high`)" in README and "for architecture at 960x540" in README
    least = {name: setting for name, setting in row_of(accuracy, "least time").items() if not name.startswith("own frame")}
    assert least.pop("thin") == "hbao low" and all(setting.startswith("gtao") for setting in least.values()), least
    assert "`low` takes it there, and `gtao` in the other classes of built-in scenes" in README


def check_presets_of_gtao():
    """`medium` is not worse than `low` where it is advised, and `high` is outdoors; among thin things `medium` is."""
    worse = re.findall(r"^\| gtao \| (\w+) \| (\w+) \| (.*?) \|", page("docs/accuracy.md"), re.M)
    scenes = {(low, high): text for low, high, text in worse}
    assert all(scene in scenes["medium", "high"] for scene in ("temple", "courtyard")), scenes
    assert all(scene in scenes["low", "medium"] for scene in ("hairball", "fence", "foliage")), scenes
    assert "courtyard" not in scenes["low", "medium"], scenes


def check_ratios():
    alone, with_ao = shown(r"their light, in ([\d.]+) times the time of `bitmask`; with its AO beside it \(`--with ao`\) ([\d.]+) times")
    stated = " ".join(page("kernels/gtao/README.md").split())
    assert f"takes {alone} times the processor time of `bitmask`" in stated and f"which filters both images, {with_ao} times" in stated
    environment, = shown(r"in ([\d.]+) times the time of `bitmask`; `sssr --environment")
    assert f"takes {environment} times the processor time of `bitmask`" in " ".join(page("kernels/evidence/README.md").split())


def check_eyes():
    assert "which disagree a twentieth as much" in README
    alone, together = inconsistencies()
    ratio = sum(a / d for a, d in zip(alone, together)) / len(alone)
    assert 18 <= ratio <= 22, ratio


def check_renderers():
    """The renderers named are those that docs/gbuffer.md has a paragraph for."""
    paragraphs = re.findall(r"^\*\*(.+?)\*\*", page("docs/gbuffer.md").split("## Renderers")[1].split("## Writing")[0], re.M)
    named, = shown(r"with a paragraph each for ([^.]*)\.")
    assert " ".join(named.split()) == f"{', '.join(paragraphs[:-1])} and {paragraphs[-1]}", (named, paragraphs)


def check_program():
    scenes = json.loads(subprocess.run([GLOAM, "list", "scenes", "--json", "-"], capture_output=True, check=True).stdout)
    assert "one of [fifteen built-in scenes]" in README and len(scenes) == 15, len(scenes)
    for command, words in (("pick", "for a minute at most"), ("bench", "`bench` takes a minute")):
        assert words in README, words
        text = subprocess.run([GLOAM, command, "--help"], capture_output=True, check=True, text=True).stdout
        assert re.search(r"default 1m\b", " ".join(text.split())), f"{command} --help"


def check_hard_cases():
    """The camera that is far away is one of the hard cases."""
    assert "a camera 1e7 units away" in README and "1e7" in page("docs/stability.md")


def numbers_of_prose():
    """Numbers outside of blocks, of code and of links' targets."""
    text = re.sub(r"^```.*?^```", "", README, flags=re.M | re.S)
    text = re.sub(r"`[^`]*`|\]\([^)]*\)", " ", text)
    for words in NO_FIGURES:
        text = text.replace(words, " ")
    return re.findall(r"(?<![\w.])\d[\d.]*(?:e\d+)?", text)


CHECKS = (check_evidence, check_needs, check_presets_of_gtao, check_ratios, check_eyes, check_renderers, check_program, check_hard_cases)
# How many numbers each place checked above has; another number in README.md needs a check of its own.
CHECKED = {"34", "42", "960", "1920", "1.3", "1.7", "2.5", "1e7"}

for check in CHECKS:
    check()
unknown = [number.rstrip(".") for number in numbers_of_prose() if number.rstrip(".") not in CHECKED]
assert not unknown, f"README.md states {unknown}, which nothing backs: add a check, or leave them out"
print(f"{len(CHECKS)} checks, {len(numbers_of_prose())} numbers")
