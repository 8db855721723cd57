"""The package as such: its types, its docstrings, and other libraries in the same process."""

import ast
import inspect
import os
import pathlib
import shutil
import subprocess
import sys

import numpy
import pytest

import gloam

FOLDER = pathlib.Path(gloam.__file__).parent


def signature_of(function):
    return [(name, parameter.kind.name) for name, parameter in inspect.signature(function).parameters.items()]


def arguments_of(node):
    arguments = [(item.arg, "POSITIONAL_OR_KEYWORD") for item in node.args.args]
    if node.args.vararg:
        arguments.append((node.args.vararg.arg, "VAR_POSITIONAL"))
    arguments += [(item.arg, "KEYWORD_ONLY") for item in node.args.kwonlyargs]
    if node.args.kwarg:
        arguments.append((node.args.kwarg.arg, "VAR_KEYWORD"))
    return arguments


def stub():
    return ast.parse((FOLDER / "__init__.pyi").read_text()).body


def test_types_are_there_and_have_every_public_name():
    assert (FOLDER / "py.typed").exists()
    named = {node.name for node in stub() if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    assert named == set(gloam.__all__)


def test_types_agree_with_the_functions():
    for node in stub():
        if isinstance(node, ast.FunctionDef) and inspect.isfunction(getattr(gloam, node.name)):
            assert arguments_of(node) == signature_of(getattr(gloam, node.name)), node.name
        if not isinstance(node, ast.ClassDef):
            continue
        for method in node.body:
            if isinstance(method, ast.FunctionDef) and not method.decorator_list:
                known = getattr(getattr(gloam, node.name), method.name)
                if inspect.isfunction(known):
                    assert arguments_of(method) == signature_of(known), f"{node.name}.{method.name}"
            if isinstance(method, ast.FunctionDef) and method.decorator_list and node.name not in ("Result",):
                assert hasattr(getattr(gloam, node.name), method.name), f"{node.name}.{method.name}"


def test_everything_public_says_what_it_is():
    for name in gloam.__all__:
        assert inspect.getdoc(getattr(gloam, name)), name
    for name in ("run", "read", "capture", "Camera", "reference", "Frame"):
        text = inspect.getdoc(getattr(gloam, name))
        assert "scene units" in text or "pixels" in text, name
    assert "(height, width)" in inspect.getdoc(gloam.run)


def test_keywords_of_run_are_neither_planes_nor_parameters():
    from gloam import _gloam, _run

    options = {"camera", "fov", "views", "device", "settings", "frame", "technique", "temporal", "path", "resume", "half", "compression", "keep_depth",
               *_run._OPTIONS, *_run._NAMED}
    for technique in gloam.techniques().values():
        # As on the command line, `filter` is the technique that follows; settings={"filter": ...} is the parameter.
        assert options & set(technique.parameters) <= {"filter"}, technique.name
    assert not options & set(_gloam.known_planes())
    for technique in gloam.techniques().values():
        assert set(technique.parameters) & set(_gloam.known_planes()) <= {"alpha", "environment", "reflectance"}, technique.name
    # A number or a path is the parameter, an array the plane.
    planes, parameters = _run.divided({"reflectance": numpy.float32(0.1), "depth": numpy.zeros((2, 2), numpy.float32)})
    assert list(planes) == ["depth"] and list(parameters) == ["reflectance"]
    planes, parameters = _run.divided({"environment": pathlib.Path("sky.exr")})
    assert not planes and list(parameters) == ["environment"]


@pytest.mark.parametrize("order", ["gloam,numpy,cv2,matplotlib.pyplot", "cv2,matplotlib.pyplot,gloam", "matplotlib.pyplot,gloam,cv2"])
def test_other_libraries_in_the_process(order):
    for name in ("cv2", "matplotlib"):
        pytest.importorskip(name)
    done = subprocess.run([sys.executable, "-c", f"""
import os
os.environ["MPLBACKEND"] = "Agg"
import {order}
import numpy
z = numpy.full((48, 64), 5, numpy.float32)
camera = gloam.Camera(50, 50, 32, 24)
for _ in range(2):
    ao = gloam.run("gtao", depth=z, camera=camera, radius=0.5)["ao"]
    blurred = cv2.GaussianBlur(ao, (5, 5), 0)
    print(gloam.compare(blurred, ao)["ssim"], matplotlib.pyplot.figure() is not None)
"""], capture_output=True, text=True, env=os.environ)
    assert done.returncode == 0 and done.stdout == "1.0 True\n1.0 True\n", done.stdout + done.stderr


def test_no_symbol_but_the_modules_own_is_seen():
    library = next(FOLDER.glob("_gloam*.so"))
    seen = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True).stdout
    names = [line.split()[-1] for line in seen.splitlines()]
    assert [name for name in names if not name.startswith("_fini") and not name.startswith("_init")] == ["PyInit__gloam"]


def imported(folder):
    """What `import gloam` says of a package in a folder."""
    done = subprocess.run([sys.executable, "-c", "import gloam"], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(folder)})
    assert done.returncode == 1
    return done.stderr.splitlines()[-1]


def test_a_package_without_its_compiled_part_says_what_to_do(tmp_path):
    build = tmp_path / "build"
    package = build / "python" / "gloam"
    shutil.copytree(FOLDER, package, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    assert imported(build / "python").endswith("has no compiled part: run pip install . in the source tree, or script/build and PYTHONPATH=build/python")
    (build / "CMakeCache.txt").touch()
    assert imported(build / "python") == f"ImportError: gloam in {package} is not built yet: run cmake --build {build} --target gloam_python"
    (package / "_gloam.cpython-27-x86_64-linux-gnu.so").touch()
    assert "is built for another Python, _gloam.cpython-27-x86_64-linux-gnu.so, and this one takes _gloam.cpython-3" in imported(build / "python")


def test_the_source_tree_is_no_package_that_works_by_half():
    assert "has no compiled part" in imported(pathlib.Path(os.environ["GLOAM_SOURCE_DIR"]) / "host" / "python")
