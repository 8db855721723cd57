"""What the tests of the Python module share: the command, and small frames."""

import json
import os
import subprocess
import warnings

import numpy
import pytest

import gloam


def pytest_configure(config):
    config.addinivalue_line("filterwarnings", "ignore::gloam.Note")


@pytest.fixture(scope="session")
def command():
    """Runs the command and returns what it prints as JSON, or as text."""
    program = os.environ["GLOAM_BINARY"]

    def run(*arguments, as_json=False, status=0):
        words = [program, *map(str, arguments)] + (["--json", "-"] if as_json else [])
        done = subprocess.run(words, capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        return json.loads(done.stdout) if as_json else done.stdout + done.stderr

    return run


@pytest.fixture(scope="session")
def frame():
    """A G-buffer of 150 x 90 pixels: rows of this width are padded in memory."""
    return gloam.capture("colonnade", 150, 90)


@pytest.fixture(scope="session")
def arrays(frame):
    return {"depth": numpy.ascontiguousarray(frame["depth"]), "normal": numpy.ascontiguousarray(frame["normal"])}


@pytest.fixture()
def quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield
