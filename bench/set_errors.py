#!/usr/bin/env python3
"""The best techniques' errors on a made set, and freezing it.

FOLDER holds a set by `gloam set make`. Measures each truth that has no best_error yet in the recipe, by the techniques that come nearest to
truths of its kind, at full resolution, on the first frame of a sequence, and enters the least RMSE over the foreground into the recipe. Says
which truths have more noise than a tenth of it: double their rays, build, and make them again. --freeze enters the hashes of the folder's
manifest too; a hash that is there already must be the same, since a set never changes.

  bench/set_errors.py out/gloam-1 data/sets/gloam-1.json [--freeze]
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

GLOAM = os.environ.get("GLOAM", str(pathlib.Path(__file__).resolve().parent.parent / "build/gloam"))

BY_EFFECT = {
    "ao": ["evidence ultra", "dp-evidence medium", "dp-evidence high", "dp-bitmask high"],
    "indirect": ["indirect ultra", "dp-indirect ultra"],
    "specular_occlusion": ["specular-occlusion ultra"],
    "bounces": ["multi-bounce ultra"],
    "contact": ["contact-shadow ultra", "contact-shadow low"],
    "reflection": ["sssr ultra", "sssr high"],
}
BY_KIND = {  # of ambient occlusion: hard frames have no layers, and modules of displays need techniques of any projection
    "hard": ["evidence ultra", "bitmask high", "hbao+ high"],
    "display": ["lightfield-ssao high", "lightfield-ssao ultra", "lightfield-hbao+ high"],
}


def call(*arguments):
    return subprocess.run([GLOAM, *arguments], check=True, capture_output=True, text=True).stdout


def error_of(folder, item, truth, technique, preset, output):
    reach = {"contact": ["--set", f"length={item['radius']!r}"], "reflection": []}
    call("run", technique, f"{folder}/{item['files'][0]['file']}", "-o", output, "--float", "-q", "--preset", preset,
         *reach.get(truth["effect"], ["--radius", repr(item["radius"])]))
    return json.loads(call("compare", output, f"{folder}/{truth['files'][0]['file']}", "-q", "--json", "-"))["rmse"]


def best_error(folder, item, truth, output):
    effect = truth["effect"]
    candidates = BY_KIND.get(item["kind"], BY_EFFECT[effect]) if effect == "ao" else BY_EFFECT[effect]
    errors = {one: error_of(folder, item, truth, *one.split(), output) for one in candidates}
    best = min(errors, key=errors.get)
    print(f"{item['name']} {effect}: {errors[best]:.4f} by {best}", flush=True)
    return float(f"{errors[best]:.4g}")


def measure(folder, manifest, recipe):
    recipes = {item["name"]: item for item in recipe["items"]}
    with tempfile.TemporaryDirectory() as work:
        for item in manifest["items"]:
            for truth, known in zip(item["truths"], recipes[item["name"]]["truths"]):
                if "best_error" not in known:
                    known["best_error"] = best_error(folder, item, truth, f"{work}/result.exr")
                if truth["noise"] > 0.1 * known["best_error"]:
                    print(f"{item['name']} {truth['effect']}: noise {truth['noise']:.2g} of {truth['rays']} rays is "
                          f"{truth['noise'] / known['best_error']:.0%} of the best error: more rays")


def freeze(manifest, recipe):
    hashes = recipe.setdefault("hashes", {})
    rays = {(item["name"], truth["effect"]): truth["rays"] for item in recipe["items"] for truth in item["truths"]}
    for item in manifest["items"]:
        if any(truth["rays"] != rays[item["name"], truth["effect"]] for truth in item["truths"]):
            print(f"{item['name']}: was made with other rays than the recipe says, so it is not frozen; make it again")
            continue
        for file in item["files"] + [file for truth in item["truths"] for file in truth["files"]]:
            if hashes.setdefault(file["file"], file["sha256"]) != file["sha256"]:
                sys.exit(f"{file['file']}: is frozen with another hash; a set never changes: make the next version")
    recipe.setdefault("frozen_with", f"gloam {manifest['gloam']} {manifest['commit']}")


def text_of(recipe):
    """An item a line, and a hash a line."""
    head = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in recipe.items() if key not in ("items", "hashes")]
    parts = head + ['"items": [\n' + ",\n".join(json.dumps(item) for item in recipe["items"]) + "\n]"]
    if "hashes" in recipe:
        lines = [f"{json.dumps(file)}: {json.dumps(digits)}" for file, digits in sorted(recipe["hashes"].items())]
        parts.append('"hashes": {\n' + ",\n".join(lines) + "\n}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("recipe", type=pathlib.Path)
    parser.add_argument("--freeze", action="store_true")
    flags = parser.parse_args()
    manifest = json.loads(pathlib.Path(flags.folder, "manifest.json").read_text())
    recipe = json.loads(flags.recipe.read_text())
    try:
        measure(flags.folder, manifest, recipe)
        if flags.freeze:
            freeze(manifest, recipe)
    finally:
        flags.recipe.write_text(text_of(recipe))


if __name__ == "__main__":
    main()
