"""Runs the snippets of docs/python.md, in their order, in a folder where they find what they name.

Usage: page.py FOLDER    leaves what the snippets write, and what they print in "printed"
"""

import contextlib
import os
import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"])


def snippets():
    page = (SOURCE / "docs" / "python.md").read_text()
    return re.findall(r"^```(python|sh)\n(.*?)^```$", page, flags=re.DOTALL | re.MULTILINE)


def run(folder):
    binary = pathlib.Path(os.environ["GLOAM_BINARY"]).parent
    for name, target in (("data", SOURCE / "data"), ("bench", SOURCE / "bench"), ("build", binary)):
        (folder / name).symlink_to(target)
    # python3 is the interpreter that the module was built for, and ~ this folder.
    (folder / "bin").mkdir()
    (folder / "bin" / "python3").symlink_to(sys.executable)
    environment = {**os.environ, "HOME": str(folder), "PATH": f"{folder / 'bin'}:{binary}:{os.environ['PATH']}"}
    names = {}
    os.chdir(folder)
    with open("printed", "w") as printed, contextlib.redirect_stdout(printed):
        for language, text in snippets():
            if language == "python":
                exec(compile(text, f"docs/python.md: {text[:40]!r}", "exec"), names)
            else:
                subprocess.run(["bash", "-e", "-o", "pipefail", "-c", text], check=True, env=environment)


if __name__ == "__main__":
    run(pathlib.Path(sys.argv[1]).resolve())
