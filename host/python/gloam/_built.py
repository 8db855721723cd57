"""Says what to do where the compiled part is not there, or cannot be loaded."""

import glob
import importlib.machinery
import os


def check(folder=os.path.dirname(os.path.abspath(__file__))):
    """Raises ImportError, in one line, unless the compiled part can be imported."""
    suffixes = importlib.machinery.EXTENSION_SUFFIXES
    if any(os.path.exists(os.path.join(folder, "_gloam" + suffix)) for suffix in suffixes):
        return
    others = sorted(os.path.basename(path) for path in glob.glob(os.path.join(glob.escape(folder), "_gloam*.so")))
    build = os.path.dirname(os.path.dirname(folder))
    if others:
        raise ImportError(f"gloam in {folder} is built for another Python, {others[0]}, and this one takes _gloam{suffixes[0]}: run that Python, or "
                          "configure with cmake -DPython_EXECUTABLE=...")
    if os.path.exists(os.path.join(build, "CMakeCache.txt")):
        raise ImportError(f"gloam in {folder} is not built yet: run cmake --build {build} --target gloam_python")
    raise ImportError(f"gloam in {folder} has no compiled part: run pip install . in the source tree, or script/build and PYTHONPATH=build/python")
