"""auto: the effects that a frame calls for."""

import json

from . import _gloam, _run, _words
from ._run import Result

#: Keywords of `auto` that are neither planes nor parameters of techniques.
_OPTIONS = ("preset", "filter", "extras", "resolution", "adaptive", "math", "real", "lanes", "seed", "repeat")

#: Those that are named in its signature.
_NAMED = ("camera", "fov", "views", "device", "settings", "budget", "error", "mask", "measure", "composite", "color_holds",
          "ambient") + _words.DEPTH + _words.NORMALS


class AutoResult(Result):
    """What gloam.auto made: arrays of all effects by the names of their planes, as a gloam.Result.

    effects: a list of dicts, one for each effect, as `gloam auto --json` writes them: "name", "technique", "wanted", "everywhere", "why",
    "share_of_tiles", "runs" (the technique computed, or None), "ms", "ms_everywhere", "ms_masked", "masked", "change" and "lost" (RMS of
    the picture, None where not known) and "refinements".  facts: all that the command writes, a dict, with the effects in it, "classify_ms",
    "glance_ms", "total_ms", "device", with a goal "chosen", "expected_error", "goal_met" and "why", and the radius.
    composite: the picture, (height, width, 3), scene-linear, where it was asked for; of several views a list; else None.
    """

    def __init__(self, outcome, several, facts, composite):
        super().__init__(outcome, several)
        self.facts = facts
        self.effects = facts["effects"]
        self.composite = None if composite is None else composite["color"]
        if self.radius is not None:
            facts.update(radius=self.radius, radius_from=self.radius_from, radius_pixels=self.radius_pixels)
        facts["notes"] = self.notes


def auto(frame=None, *, budget=None, error=None, mask=None, measure=False, composite=False, color_holds=None, ambient=None, camera=None,
         fov=None, views=None, device=None, settings=None, depth_is=None, near=None, far=None, background=None, depth_scale=None, depth_offset=None, normals_are=None,
         normal_space=None, normal_range=None, normal_axes=None, **keywords):
    """Looks at a frame, computes only the effects that it calls for, and returns a gloam.AutoResult: their planes as arrays, and why.

    What a frame does not call for is given as if computed: AO of 1, reflections of 0.
    frame, planes by keyword, camera, fov, views, device, depth_is, near, far, background, normals_are, normal_space, normal_range, normal_axes: as for gloam.run. Of a path only the
        planes are read that effects may need.
    budget: device time for all effects and for looking, milliseconds above 0, or a text such as "30ms" or "60fps": effects, presets and resolutions are chosen for the least error of
        the picture.  error: instead, the RMS error of the picture, above 0; chosen is what takes the least time. Both need the plane color.
    mask: whether an effect is computed only where the frame calls for it: "measured" (both ways are timed; the default), "always" or "never".
        For the frames of a shot give "never", as the command does by default: masks that come and go from frame to frame would flicker.
    measure: also computes everything everywhere, and tells what that takes.
    composite: also makes the frame's colour with all effects, no light counted twice.
    color_holds: what colour holds beside direct light, "ambient,shadows" or "none"; default: as the file says, else ambient and shadows.
    ambient: radiance of an even sky, three numbers, for frames without a plane of ambient light.
    Parameters of techniques by keyword, settings, preset, resolution, filter, extras, adaptive, math, real, lanes, seed, repeat: as for gloam.run,
        for all effects that have them.

    Raises gloam.Error, with the sentence of the command `gloam auto`: gloam.UsageError for names and values, and for a goal on a frame without
    colour, gloam.MissingPlanes where the frame has what no effect needs. Ctrl-C ends the call between two passes.
    """
    options = {name: keywords.pop(name) for name in _OPTIONS if name in keywords}
    surfaces = _words.surfaces(depth_is=depth_is, near=near, far=far, background=background, depth_scale=depth_scale, depth_offset=depth_offset, normals_are=normals_are, normal_space=normal_space,
                               normal_range=normal_range, normal_axes=normal_axes)
    planes, parameters = _run.divided(keywords)
    _run.check_names(parameters, _OPTIONS + _NAMED)
    words, run_words = _run.shared_words(parameters, settings, options)
    more = {"budget": _words.budget("budget", budget), "error": _words.number("error", error), "mask": _words.text("mask", mask),
            "measure": bool(measure), "composite": bool(composite), "color_holds": _words.text("color_holds", color_holds),
            "ambient": _words.point("ambient", ambient)}
    made, is_own, several = _run.frame_for(frame, planes, camera, fov, views, surfaces,
                                           lambda paths, reading: _gloam.read_for_auto(paths, reading, words, more))
    outcome, facts, picture = _gloam.auto(words, made, is_own, _words.device(device), run_words, more)
    result = AutoResult(outcome, several, json.loads(facts), picture)
    _run.tell(result, outcome.notes, made, is_own, stacklevel=2)
    return result
