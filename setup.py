"""Builds the Python module by CMake, for `pip install .` and `pip wheel .`; pyproject.toml has the rest.

The build folder is GLOAM_BUILD, if that is set; else build/, where script/build has made the module for this Python; else build-wheel/, where only the
module is built. Nothing else is written into the source tree.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")


def build_folder():
    if os.environ.get("GLOAM_BUILD"):
        return pathlib.Path(os.environ["GLOAM_BUILD"]).resolve()
    is_made = (ROOT / "build/python/gloam" / f"_gloam{SUFFIX}").exists() and (ROOT / "build/CMakeCache.txt").exists()
    return ROOT / ("build" if is_made else "build-wheel")


BUILD = build_folder()


def run(*command):
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        raise SystemExit(f"gloam: {command[0]} is not installed; script/bootstrap installs what the build needs") from None
    except subprocess.CalledProcessError as error:
        raise SystemExit(f"gloam: {' '.join(map(str, command))} failed with status {error.returncode}; its last lines are above, and script/bootstrap "
                         "installs the packages that the build needs") from None


class BuildByCMake(build_ext):
    """The compiled part is a target of CMake."""

    def build_extension(self, extension):
        if not (BUILD / "CMakeCache.txt").exists():
            generator = ["-G", "Ninja"] if shutil.which("ninja") else []
            options = ["-DCMAKE_BUILD_TYPE=Release", "-DGLOAM_TESTS=OFF", "-DGLOAM_BENCH=OFF", "-DGLOAM_INSTALL=OFF", "-DGLOAM_PYTHON=ON"]
            run("cmake", "-S", ROOT, "-B", BUILD, *generator, *options, f"-DPython_EXECUTABLE={self.interpreter()}")
        run("cmake", "--build", BUILD, "--target", "gloam_python", "--parallel", str(os.cpu_count() or 1))
        built = BUILD / "python/gloam" / f"_gloam{SUFFIX}"
        if not built.exists():
            raise SystemExit(f"gloam: {BUILD} is a build for another Python, without {built.name}; remove it, or set GLOAM_BUILD to another folder")
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, target)

    @staticmethod
    def interpreter():
        """This Python; of a virtual environment the one that it was made of, which has the headers."""
        name = f"python{sysconfig.get_python_version()}"
        base = pathlib.Path(sysconfig.get_config_var("BINDIR")) / name
        return base if base.exists() else pathlib.Path(sys.executable)


version = re.search(r"project\(gloam VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
ours = BUILD / "wheel"
ours.mkdir(parents=True, exist_ok=True)
setup(
    version=version,
    packages=["gloam"],
    package_dir={"gloam": "host/python/gloam"},
    package_data={"gloam": ["py.typed", "__init__.pyi"]},
    ext_modules=[Extension("gloam._gloam", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
    options={"build": {"build_base": str(ours / "parts")}, "egg_info": {"egg_base": str(ours)}},
)
