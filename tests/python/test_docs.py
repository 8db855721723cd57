"""docs/python.md: every snippet runs as it stands there, and its figures are those of docs/images."""

import os
import pathlib
import subprocess
import sys

import pytest

SOURCE = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"])
FIGURES = ("python_truth.png", "python_edges.png")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    for name in ("cv2", "matplotlib"):
        pytest.importorskip(name)
    folder = tmp_path_factory.mktemp("page")
    done = subprocess.run([sys.executable, pathlib.Path(__file__).parent / "page.py", folder], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-4000:]
    return folder


def test_snippets_print_what_the_page_says(folder):
    printed = (folder / "printed").read_text()
    assert "beside the box 0." in printed and "far from it 1.00" in printed
    for sentence in ("UsageError: no technique 'gtoa' (did you mean 'gtao'?)", "no parameter 'radus' (did you mean 'radius'?)",
                     "Error: plane 'depth' has the dtype float64", "MissingPlanes: sssr: needs 'color'", "Error: camera: fx is nan"):
        assert sentence in printed, printed
    assert "1004 " in printed and "frame | radius: none is given" in printed


@pytest.mark.parametrize("name", FIGURES)
def test_figures_are_those_of_the_page(name, folder):
    import cv2
    import numpy

    made, kept = cv2.imread(str(folder / name)), cv2.imread(str(SOURCE / "docs" / "images" / name))
    assert f"images/{name}" in (SOURCE / "docs" / "python.md").read_text()
    assert kept is not None, f"docs/images/{name} is missing: run script/update-python-figures"
    # Fonts and versions of the libraries differ from machine to machine.
    assert made.shape[:2] == kept.shape[:2] or abs(numpy.subtract(made.shape, kept.shape)).max() < 20
    if made.shape == kept.shape:
        assert numpy.abs(made.astype(int) - kept.astype(int)).mean() < 6, "run script/update-python-figures"


def test_the_snippet_of_the_readme_runs():
    import re

    import numpy

    snippets = re.findall(r"^```python\n(.*?)^```$", (SOURCE / "README.md").read_text(), flags=re.DOTALL | re.MULTILINE)
    assert len(snippets) == 1
    names = {"z": numpy.full((1080, 1920), 5, numpy.float32), "n": numpy.tile(numpy.float32([0, 0, 1]), (1080, 1920, 1))}
    exec(snippets[0], names)
    assert names["result"]["ao"].shape == (1080, 1920)
