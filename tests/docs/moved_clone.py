"""script/build in a clone that was moved, with a build folder that was copied, and of targets: on a project that compiles nothing.

  moved_clone.py SOURCE
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(sys.argv[1])
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(nothing LANGUAGES NONE)
file(WRITE ${PROJECT_BINARY_DIR}/made_from "${PROJECT_SOURCE_DIR}")
add_custom_target(product COMMAND ${CMAKE_COMMAND} -E echo "the product is made")
add_custom_target(tests ALL COMMAND ${CMAKE_COMMAND} -E echo "tests are made")
"""


def clone(root):
    (root / "script").mkdir(parents=True)
    for name in ("build", "configure"):
        shutil.copy(SOURCE / "script" / name, root / "script")
    (root / "script/bootstrap").write_text("#!/bin/sh\n")
    (root / "script/bootstrap").chmod(0o755)
    shutil.copy(SOURCE / "CMakePresets.json", root)
    (root / "CMakeLists.txt").write_text(PROJECT)


def build(root, *targets):
    done = subprocess.run([root / "script/build", *targets], cwd="/", capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (root / "build/made_from").read_text() == str(root)
    return done


def check(folder):
    first, moved, copied = folder / "first", folder / "moved place", folder / "copied"
    clone(first)
    done = build(first)
    assert "the product is made" in done.stdout and "tests are made" not in done.stdout, done.stdout
    assert done.stderr == "", done.stderr
    assert "tests are made" in build(first, "all").stdout
    both = build(first, "product", "tests").stdout
    assert "the product is made" in both and "tests are made" in both, both

    first.rename(moved)
    said = build(moved).stderr
    assert said.count("\n") == 1 and f"was made in {first}/build, from {first}; it is configured anew" in said, said
    assert build(moved).stderr == "", "said once"

    clone(copied)
    shutil.copytree(moved / "build", copied / "build")
    said = build(copied).stderr
    assert said.count("\n") == 1 and f"was made in {moved}/build" in said, said
    assert build(moved).stderr == "", "the original is as it was"


with tempfile.TemporaryDirectory() as name:
    check(pathlib.Path(name).resolve())
