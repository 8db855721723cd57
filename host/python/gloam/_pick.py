"""pick: the setting to use on a frame, by measurement."""

import json
import os
import tempfile

from . import _files, _gloam, _run, _words
from ._gloam import Frame

#: Keywords of how a file is read.
_READING = ("camera", "fov", "depth", "views", "channels") + _words.DEPTH + _words.NORMALS


def _file(name, value, folder):
    """The path of a frame: of one in memory that of a file made of it."""
    if isinstance(value, _run.Result):
        path = os.path.join(folder, f"{name}.exr")
        _files.write(path, value)
        return _words.path(name, path)
    if not isinstance(value, Frame):
        return _words.path(name, value)
    path = os.path.join(folder, f"{name}.exr")
    _files.write(path, value)
    return _words.path(name, path)


def _of_arrays(planes, reading):
    """A frame of planes by keyword, and what is left of the keywords of reading: nothing."""
    taken = {name: reading.pop(name, None) for name in _words.DEPTH + _words.NORMALS}
    camera, fov, views = (reading.pop(name, None) for name in ("camera", "fov", "views"))
    for name in reading:
        raise _words.refusal(f"{name}: is for a path, and does not go with arrays; leave it out")
    return _run.frame_of(planes, camera, fov, views, _words.surfaces(**taken))[0]


def pick(frame=None, *, budget=None, error=None, by="rmse", truth=None, techniques=None, radius=None, rays=256, rounds=9, time=60, device=None,
         **reading):
    """Tries presets of techniques at full and at half resolution on a frame, and returns the best within a bound as a dict.

    frame: a path, a gloam.Frame, or instead planes by keyword with a camera, as for gloam.run.  budget: milliseconds on the device, or a text such as "20ms" or "60fps", for the whole of the effect, its filter included: the most accurate
        setting within it is picked.  error: instead, a bound on the figure that decides; the cheapest setting within it is picked.
    by: what decides which image is nearer: "rmse", "ssim" (1 - SSIM) or "flip".
    truth: what errors are to: a path, a result of gloam.run or a gloam.Frame, as gloam.reference makes it, or a list of them, one for each view; default: traced where
        the frame shows a built-in scene, else a converged estimate, and a note says so.
    techniques: these only, a list of names; default: all that make the truth's effect, without a truth those of ambient occlusion.
    radius: scene units; default: the truth's, else the scene's own, else made from the frame.  rays: per pixel, for a truth that is traced.
    rounds: each times every finalist once, in turn.  time: seconds for everything but tracing, the likeliest settings first; None: for all.
    device, camera, fov, depth_is, near, far, background, views, channels, normals_are, normal_space, normal_range, normal_axes: as for gloam.read, of a path.

    The keys are those of `gloam pick --json`: "technique", "preset", "resolution", "ms", "rmse", "ssim", "why" (a sentence), "device", "error_to", "by",
    "finalists" (a list of dicts), "skipped", "left_out", "radius", "radius_from" and "notes".
    Raises gloam.Error that names the nearest miss if nothing is within the bound, gloam.UsageError for names and values.
    """
    planes = {name: reading.pop(name) for name in list(reading) if name in _gloam.known_planes() and _run._is_planes(reading[name])}
    for name in reading:
        if name not in _READING:
            raise _words.refusal(f"no keyword '{name}'{_gloam.suggestion(name, list(_READING))}; there are {_gloam.enumerate(list(_READING))}, and planes")
    words = {"budget": _words.budget("budget", budget), "error": _words.number("error", error), "by": _words.text("by", by),
             "techniques": _words.names("techniques", techniques), "radius": _words.number("radius", radius),
             "rays": _words.integer("rays", rays), "rounds": _words.integer("rounds", rounds), "seconds": _words.number("time", time)}
    for name in ("budget", "error", "radius", "rays", "rounds", "seconds"):
        if words[name] is not None and not isinstance(words[name], str) and not words[name] > 0:
            raise _words.refusal(f"{name} {words[name]:g} is not allowed; a number above 0 is")
    own_notes = []
    if frame is None or planes:
        if frame is not None:
            raise _words.refusal(f"{_gloam.enumerate(list(planes))}: arrays do not go with a frame; give one of them")
        frame = _of_arrays(planes, reading)
        own_notes = frame.notes
    truths = [] if truth is None else list(truth) if isinstance(truth, (list, tuple)) else [truth]
    with tempfile.TemporaryDirectory(prefix="gloam-pick-") as folder:
        words["truths"] = [_file(f"truth{i}", each, folder) for i, each in enumerate(truths)]
        path = _file("frame", frame, folder)
        facts, value, source, found = _gloam.pick(path, words, _words.reading(**reading), _words.device(device))
    notes = list(dict.fromkeys([*own_notes, *found]))
    _words.note(notes, stacklevel=2)
    return {**json.loads(facts), "radius": value, "radius_from": source, "notes": notes}
