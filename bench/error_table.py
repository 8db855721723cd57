"""What the programs that measure errors on built-in scenes share: calls of the command, and a table in Markdown."""
import json
import pathlib
import subprocess


def call(gloam, *arguments):
    done = subprocess.run([gloam, *map(str, arguments), "-q"], stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def figures(gloam, test, truth, plane):
    return json.loads(call(gloam, "compare", test, truth, "--plane", plane, "--json", "-"))


def all_scenes(gloam):
    return [scene["name"] for scene in json.loads(call(gloam, "list", "scenes", "--json", "-"))]


def print_table(folder, scenes, cells_of):
    """One row per scene: cells_of(folder, scene) gives its cells by column."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for number, scene in enumerate(scenes):
        cells = cells_of(folder, scene)
        if number == 0:
            print("| scene | " + " | ".join(cells) + " |\n|---|" + "---:|" * len(cells))
        print(f"| {scene} | " + " | ".join(cells.values()) + " |", flush=True)
