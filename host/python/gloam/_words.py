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


def refusal(sentence):
    """What is wrong with a call, as an error of one line that is no longer than others, whatever names and values are in it."""
    return UsageError(_gloam.printable(_as_utf8(sentence)))


def _refuse(name, value, allowed):
    raise refusal(f"{name} is of type {type(value).__name__}; {allowed} is allowed")


def _shown(value):
    """A value in a sentence: its type where it is longer than a line."""
    try:
        shown = repr(value)
    except ValueError:  # of whole numbers of thousands of digits
        shown = "\n"
    return shown if len(shown) <= 80 and "\n" not in shown else f"of type {type(value).__name__}"


def _as_utf8(value):
    """A text that the compiled part takes: what is no character, such as half of one, becomes an escape."""
    return value.encode("utf-8", "backslashreplace").decode("utf-8")


def text(name, value):
    if value is None:
        return None
    if isinstance(value, str):
        return _as_utf8(value)
    _refuse(name, value, "a text")


def word(name, value):
    """A text that has to be given."""
    if value is None:
        _refuse(name, value, "a text")
    return text(name, value)


def integer(name, value):
    if value is None:
        return None
    if isinstance(value, (int, numpy.integer)) and not isinstance(value, bool):
        if -(2**31) <= value < 2**31:
            return int(value)
        raise refusal(f"{name} {_shown(value)} is not allowed; a whole number of 32 bits is")
    _refuse(name, value, "a whole number")


def frames_of_range(frames):
    """A range as a text such as "1-99x2", however long it is."""
    if not frames:
        raise refusal(f"frames {_shown(frames)} has no number; name one and more")
    first, last = (integer("frames", number) for number in sorted((frames[0], frames[-1])))
    return str(first) if first == last else f"{first}-{last}x{integer('frames', abs(frames.step))}"


def number(name, value):
    if value is None:
        return None
    if isinstance(value, (int, float, numpy.integer, numpy.floating)) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            raise refusal(f"{name} {_shown(value)} is not allowed; a number up to 1.8e308 is") from None
    _refuse(name, value, "a number")


def budget(name, value):
    """Milliseconds, or a time in words."""
    if isinstance(value, str):
        return text(name, value)
    if value is None or isinstance(value, (int, float, numpy.integer, numpy.floating)):
        return number(name, value)
    _refuse(name, value, "a number of milliseconds, or a text such as '60fps',")


def point(name, value):
    if value is None:
        return None
    is_list = isinstance(value, (tuple, list)) or isinstance(value, numpy.ndarray) and value.ndim == 1
    values = [number(name, item) for item in value] if is_list else None
    if values is None or len(values) != 3:
        raise refusal(f"{name} {_shown(value)} is not a point; three numbers are allowed, such as (1, 2, 3)")
    return values


def names(name, value):
    """A name, or a list of them; also "a,b", as on the command line."""
    if value is None:
        return None
    if isinstance(value, str):
        value = value.split(",")
    if isinstance(value, (list, tuple)) and value and all(isinstance(item, str) and item for item in value):
        return [_as_utf8(item) for item in value]
    raise refusal(f"{name} {_shown(value)} is not allowed; a list of names is, such as ['ao', 'ao_raw']")


def path(name, value):
    """The bytes of a path: a file's name need not be UTF-8."""
    if not isinstance(value, (str, os.PathLike)):
        _refuse(name, value, "a path")
    try:
        encoded = os.fsencode(value)
    except UnicodeEncodeError:
        raise refusal(f"{name} {_shown(value)} is not a path: it has half of a character") from None
    if b"\0" in encoded:
        raise refusal(f"{name} {_shown(value)} is not a path: it has a zero byte")
    return encoded


def is_path(value):
    return isinstance(value, (str, os.PathLike))


def _is_file_name(value):
    """Whether a text has bytes that are not UTF-8, as `os.fsdecode` keeps them."""
    return any("\udc80" <= letter <= "\udcff" for letter in value)


def _setting(name, value):
    if isinstance(value, (bool, numpy.bool_)):
        return "on" if value else "off"
    if isinstance(value, (int, float, numpy.integer, numpy.floating)):
        # Through float32 nothing is gained: the shortest decimal form is what a user would have written.
        plain = value.item() if isinstance(value, numpy.generic) else value
        if isinstance(plain, int) and abs(plain) >= 2**64:
            raise refusal(f"{name} {_shown(plain)} is not allowed; a number of 64 bits is")
        return repr(plain)
    if isinstance(value, os.PathLike) or isinstance(value, str) and _is_file_name(value):
        return path(name, value)
    if isinstance(value, str):
        return _as_utf8(value)
    _refuse(name, value, "a number, True or False, or a word")


def settings(*groups):
    """Parameters as pairs of texts, as the command line has them."""
    pairs = []
    for group in groups:
        if group is not None and not isinstance(group, dict):
            _refuse("settings", group, "a dict of parameters by name")
        pairs += [(text("settings", name), _setting(name, value)) for name, value in (group or {}).items()]
    return pairs


def device(value):
    """A device that was opened, or the one that a text stands for: opened at its first use, and kept."""
    if isinstance(value, _gloam.Device):
        return value
    if _no_folder is not None:
        raise _no_folder
    opened = _gloam.shared_device(text("device", value) or "")
    _note_foreign_folders()
    return opened


def _note_foreign_folders():
    """Says, once, which folders are not used for compiled kernels."""
    global _has_noted_folders
    if _has_noted_folders:
        return
    _has_noted_folders = True
    sentence = _gloam.foreign_folders_note()
    if sentence:
        note([sentence], stacklevel=4)


#: The keywords that state what depth stands for, and those that state the convention of normals.
DEPTH = ("depth_is", "near", "far", "background", "depth_scale", "depth_offset")
NORMALS = ("normals_are", "normal_space", "normal_range", "normal_axes")
_NORMALS_ARE = {"view": "normal_space", "world": "normal_space", "signed": "normal_range", "unsigned": "normal_range", "srgb": "normal_range"}


def _normals_are(value):
    """The words that one text such as "world unsigned x,-y,z" stands for."""
    words = {}
    for word in (text("normals_are", value) or "").split():
        name = "normal_axes" if "," in word else _NORMALS_ARE.get(word)
        if name is None:
            raise refusal(f"normals_are {word} is not allowed{_gloam.suggestion(word, list(_NORMALS_ARE))}; 'view' or 'world', 'signed', "
                          "'unsigned' or 'srgb', and axes such as 'x,-y,z' are, with spaces between")
        if name in words:
            raise refusal(f"normals_are {_shown(value)} states two of {words[name]} and {word}; give one of them")
        words[name] = word
    if value is not None and not words:
        raise refusal("normals_are is empty; 'view' or 'world' is allowed, for example")
    return words


def _normals(given):
    """The words of the convention of normals."""
    words = {name: text(name, given.get(name)) for name in NORMALS[1:]}
    for name, word in _normals_are(given.get("normals_are")).items():
        if words[name] is not None:
            raise refusal(f"normals_are and {name} both state the normals; give one of them")
        words[name] = word
    return words


def _depth(given):
    """The words of what depth stands for."""
    return {"depth_is": text("depth_is", given.get("depth_is")),
            **{name: number(name, given.get(name)) for name in DEPTH[1:]}}


def surfaces(**given):
    """The words of what depth and normals stand for, of the keywords DEPTH and NORMALS."""
    return {**_depth(given), **_normals(given)}


def reading(camera=None, **words):
    """The words of how a file is read."""
    if camera is not None and not isinstance(camera, _gloam.Camera):
        camera = path("camera", camera)
    if words.get("depth") is not None:
        if words.get("depth_is") is not None:
            raise refusal("depth and depth_is both state the depth; give one of them")
        words["depth_is"] = text("depth", words["depth"])
    read = {"fov": number("fov", words.get("fov")), "views": names("views", words.get("views")), **_depth(words), **_normals(words)}
    for name in ("depth_bytes", "depth_encoding"):
        if words.get(name) is not None:
            read[name] = text(name, words[name])
    if words.get("plane_files") is not None:
        files = words["plane_files"]
        if not isinstance(files, dict) or not all(isinstance(plane, str) for plane in files):
            raise refusal(f"plane_files {_shown(files)} is not allowed; a dict is, such as {{'normal': 'n.png'}}")
        read["plane_files"] = {_as_utf8(plane): path(f"plane_files[{plane!r}]", file) for plane, file in files.items()}
    if "channels" in words and words["channels"] is not None:
        channels = words["channels"]
        if not isinstance(channels, dict) or not all(isinstance(item, str) for pair in channels.items() for item in pair):
            raise refusal(f"channels {_shown(channels)} is not allowed; a dict is, such as {{'depth': 'Layer.Z'}}")
        read["channels"] = {_as_utf8(plane): _as_utf8(channel) for plane, channel in channels.items()}
    as_stored = words.get("as_stored")
    if as_stored is not None and not isinstance(as_stored, (bool, numpy.bool_)):
        _refuse("as_stored", as_stored, "True or False")
    if as_stored:
        read["as_stored"] = True
    return {"camera": camera, **read}


# PoCL finds no device without a folder for its kernels. The environment is set here, since later there may be threads.
_no_folder = None
_has_noted_folders = False
try:
    _gloam.give_pocl_a_folder()
except Error as error:
    _no_folder = error
