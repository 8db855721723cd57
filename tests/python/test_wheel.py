"""pip makes a wheel of the source tree without a network, and what it installs into a virtual environment runs."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import zipfile

import pytest

for needed in ("pip", "setuptools", "wheel", "venv", "ensurepip"):
    if importlib.util.find_spec(needed) is None:
        pytest.skip(f"no {needed}: apt install python3-pip python3-venv python3-setuptools python3-wheel", allow_module_level=True)

ROOT = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"])
# Of the build under test, which has the module: build/python.
BUILD = pathlib.Path(os.environ["PYTHONPATH"].split(os.pathsep)[0]).parent


def run(*command, **environment):
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, env={**kept, **environment}, cwd="/")
    assert done.returncode == 0, (done.stdout + done.stderr)[-3000:]
    return done.stdout


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """A virtual environment that sees the system's NumPy, setuptools and wheel."""
    folder = tmp_path_factory.mktemp("wheel") / "environment"
    run(sys.executable, "-m", "venv", "--system-site-packages", folder)
    return folder


@pytest.fixture(scope="module")
def wheel(environment, tmp_path_factory):
    before = sorted(ROOT.iterdir())
    folder = tmp_path_factory.mktemp("wheels")
    run(environment / "bin/pip", "wheel", ROOT, "--no-build-isolation", "--no-deps", "--no-index", "-w", folder, GLOAM_BUILD=str(BUILD))
    assert sorted(ROOT.iterdir()) == before
    return next(folder.glob("gloam-*.whl"))


def test_a_wheel_has_the_module_and_nothing_else(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    parts = {name for name in names if name.startswith("gloam/")}
    assert {name.split("/")[1] for name in parts} == {path.name for path in (BUILD / "python/gloam").iterdir() if path.is_file()}
    assert all(name in parts or ".dist-info/" in name for name in names)
    assert "-cp3" in wheel.name and "linux" in wheel.name


def test_a_wheel_runs_in_a_virtual_environment(environment, wheel):
    run(environment / "bin/pip", "install", "--no-index", "--no-deps", "--force-reinstall", wheel)
    said = run(environment / "bin/python", "-c", """
import gloam, numpy
z = numpy.full((48, 64), 5.0)
z[10:30, 20:40] = 4.5
ao = gloam.run("gtao", depth=z, fov=60, radius=1)["ao"]
print(gloam.__file__, gloam.__version__, ao.shape, bool(ao.min() < 0.99))
""", PYTHONWARNINGS="ignore")
    assert said.startswith(str(environment)) and said.endswith(" (48, 64) True\n"), said
    assert f"Version: {said.split()[1]}\n" in run(environment / "bin/pip", "show", "gloam")


def test_pip_install_of_the_source_tree(environment, wheel):
    run(environment / "bin/pip", "uninstall", "-y", "gloam")
    said = run(environment / "bin/pip", "install", "--no-build-isolation", "--no-index", ROOT, GLOAM_BUILD=str(BUILD))
    assert "Requirement already satisfied: numpy" in said  # the system's
    assert run(environment / "bin/python", "-c", "import gloam; print(gloam.__file__)").startswith(str(environment))


def test_a_build_without_cmake_says_so(environment, tmp_path):
    done = subprocess.run([environment / "bin/python", "setup.py", "bdist_wheel", "-d", tmp_path], capture_output=True, text=True, cwd=ROOT,
                          env={"PATH": str(tmp_path), "GLOAM_BUILD": str(tmp_path / "build")})
    assert done.returncode == 1 and done.stderr.splitlines()[-1] == "gloam: cmake is not installed; script/bootstrap installs what the build needs", done.stderr
