#!/usr/bin/env python3
"""Puts a result into data/results: what pages, tests and script/reproduce read of it, one row a line.

    bench/reproduce/kept_results.py MADE.json KEPT.json
    bench/reproduce/kept_results.py --check       says which file of data/results has another form; exit status 1 if one has

MADE: a document of `gloam bench`, `gloam score` or `gloam stress`. Left out of rows are passes, rounds, intervals and what the cores spent,
which `gloam report` draws and compares for whoever measures, what is null, and of results of a set what the leaderboard does not show, of others
what the pages on accuracy do not. Of hard cases it is kept whether each technique holds each one. Numbers have seven digits. Readers take
this form and any other.
"""
import json
import pathlib
import sys

LEFT_OUT = ("passes", "cpu_ms", "interval", "rounds", "own_floor_ms", "copy_floor_ms")
OF_A_SET, OF_OTHERS = ("spent_on", "naive", "ladder", "image", "truth_image"), ("settings",)
DIGITS = 7
RESULTS = pathlib.Path(__file__).resolve().parents[2] / "data/results"


def slim(value, left_out):
    """A row, or a part of one, as it is kept."""
    if isinstance(value, dict):
        some = {name: slim(each, left_out) for name, each in value.items()
                if name not in left_out and not name.endswith(("_rounds", "_interval"))}
        return {name: each for name, each in some.items() if each not in (None, {})}
    if isinstance(value, list):
        return [slim(each, left_out) for each in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


def cases_held(document):
    """Of `gloam stress`: whether each technique holds each case."""
    held = {}
    for case in document["cases"]:
        key = case["technique"], case["case"]
        held[key] = held.get(key, True) and case["held"]
    rows = [{"technique": technique, "case": case, "held": all_held} for (technique, case), all_held in held.items()]
    return {"device": document["device"], "driver": document["driver"], "cases": rows, "failed": document["failed"]}


def kept(document):
    if "cases" in document:
        return cases_held(document)
    left_out = LEFT_OUT + (OF_A_SET if document.get("set") else OF_OTHERS)
    return {name: slim(value, left_out) if isinstance(value, list) else value for name, value in document.items()}


def line(value):
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def text_of(document):
    """One key a line, and of a list of objects one object a line."""
    lines = []
    for name, value in document.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            lines.append(f"{line(name)}: [\n" + ",\n".join(map(line, value)) + "\n]")
        else:
            lines.append(f"{line(name)}: {line(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def keep(made, path):
    pathlib.Path(path).write_text(text_of(kept(json.loads(pathlib.Path(made).read_text()))))


def check():
    files = [path for path in sorted(RESULTS.glob("*/*.json")) if path.parent.name != "devices"]
    others = [str(path) for path in files if path.read_text() != text_of(kept(json.loads(path.read_text())))]
    sys.exit(f"written otherwise than by bench/reproduce/kept_results.py: {', '.join(others)}" if others else None)


if __name__ == "__main__":
    if sys.argv[1:] == ["--check"]:
        check()
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    keep(*sys.argv[1:])
