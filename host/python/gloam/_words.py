"""Keywords of calls, checked and brought to the form that the compiled part takes."""

import os
import warnings

import numpy

from . import _gloam
from ._gloam import Error, UsageError


class Note(UserWarning):
    """What a call assumed, or what does not suit a frame. Every note is also in the `notes` of what the call returns."""


def note(texts, stacklevel):
    """Shows notes by `warnings`: each once for a line of the caller, and silenced or made errors by its usual filters."""
    for text in texts:
        warnings.warn(text, Note, stacklevel=stacklevel + 1)


def _refuse(name, value, allowed):
    raise UsageError(f"{name} is of type {type(value).__name__}; {allowed} is allowed")


def _shown(value):
    """A value in a sentence: its type where it is longer than a line."""
    shown = repr(value)
    return shown if len(shown) <= 80 and "\n" not in shown else f"of type {type(value).__name__}"


def text(name, value):
    if value is None:
        return None
    if isinstance(value, str):
        return value
    _refuse(name, value, "a text")


def integer(name, value):
    if value is None:
        return None
    if isinstance(value, (int, numpy.integer)) and not isinstance(value, bool):
        if -(2**31) <= value < 2**31:
            return int(value)
        raise UsageError(f"{name} {value} is not allowed; a whole number of 32 bits is")
    _refuse(name, value, "a whole number")


def number(name, value):
    if value is None:
        return None
    if isinstance(value, (int, float, numpy.integer, numpy.floating)) and not isinstance(value, bool):
        return float(value)
    _refuse(name, value, "a number")


def point(name, value):
    if value is None:
        return None
    is_list = isinstance(value, (tuple, list)) or isinstance(value, numpy.ndarray) and value.ndim == 1
    values = [number(name, item) for item in value] if is_list else None
    if values is None or len(values) != 3:
        raise UsageError(f"{name} {_shown(value)} is not a point; three numbers are allowed, such as (1, 2, 3)")
    return values


def names(name, value):
    """A name, or a list of them; also "a,b", as on the command line."""
    if value is None:
        return None
    if isinstance(value, str):
        value = value.split(",")
    if isinstance(value, (list, tuple)) and value and all(isinstance(item, str) and item for item in value):
        return list(value)
    raise UsageError(f"{name} {_shown(value)} is not allowed; a list of names is, such as ['ao', 'ao_raw']")


def path(name, value):
    if isinstance(value, (str, os.PathLike)):
        return os.fsdecode(value)
    _refuse(name, value, "a path")


def is_path(value):
    return isinstance(value, (str, os.PathLike))


def _setting(name, value):
    if isinstance(value, (bool, numpy.bool_)):
        return "on" if value else "off"
    if isinstance(value, (int, float, numpy.integer, numpy.floating)):
        # Through float32 nothing is gained: the shortest decimal form is what a user would have written.
        return repr(value.item() if isinstance(value, numpy.generic) else value)
    if isinstance(value, (str, os.PathLike)):
        return os.fsdecode(value)
    _refuse(name, value, "a number, True or False, or a word")


def settings(*groups):
    """Parameters as pairs of texts, as the command line has them."""
    pairs = []
    for group in groups:
        if group is not None and not isinstance(group, dict):
            _refuse("settings", group, "a dict of parameters by name")
        pairs += [(name, _setting(name, value)) for name, value in (group or {}).items()]
    return pairs


def device(value):
    """A device that was opened, or the one that a text stands for: opened at its first use, and kept."""
    if isinstance(value, _gloam.Device):
        return value
    if _no_folder is not None:
        raise _no_folder
    return _gloam.shared_device(text("device", value) or "")


def reading(camera=None, **words):
    """The words of how a file is read."""
    if camera is not None and not isinstance(camera, _gloam.Camera):
        camera = path("camera", camera)
    checks = {"fov": number, "near": number, "far": number, "background": number, "depth": text, "normal_space": text, "views": names}
    read = {name: checks[name](name, value) for name, value in words.items() if name in checks}
    if "channels" in words and words["channels"] is not None:
        channels = words["channels"]
        if not isinstance(channels, dict) or not all(isinstance(item, str) for pair in channels.items() for item in pair):
            raise UsageError(f"channels {_shown(channels)} is not allowed; a dict is, such as {{'depth': 'Layer.Z'}}")
        read["channels"] = channels
    as_stored = words.get("as_stored")
    if as_stored is not None and not isinstance(as_stored, (bool, numpy.bool_)):
        _refuse("as_stored", as_stored, "True or False")
    if as_stored:
        read["as_stored"] = True
    return {"camera": camera, **read}


# PoCL finds no device without a folder for its kernels. The environment is set here, since later there may be threads.
_no_folder = None
try:
    _gloam.give_pocl_a_folder()
except Error as error:
    _no_folder = error
