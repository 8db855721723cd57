"""The pictures that a page shows are those that its snippets wrote into this folder. Usage: figures.py PAGE"""

import os
import pathlib
import re
import sys

import cv2
import numpy

page = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"]) / sys.argv[1]
names = re.findall(r"\(images/(\w+\.png)\)", page.read_text())
assert names, f"{sys.argv[1]} shows no picture"
for name in names:
    made, kept = cv2.imread(name), cv2.imread(str(page.parent / "images" / name))
    assert made is not None and kept is not None, f"{name} is not made, or not in docs/images: run script/update-python-figures"
    # Fonts and versions of the libraries differ from machine to machine.
    assert made.shape[:2] == kept.shape[:2] or abs(numpy.subtract(made.shape, kept.shape)).max() < 20, name
    if made.shape == kept.shape:
        difference = numpy.abs(made.astype(int) - kept.astype(int)).mean()
        assert difference < 6, f"{name} differs by {difference}: run script/update-python-figures"
print(*names)
