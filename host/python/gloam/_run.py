"""run: a technique on arrays, on a frame or on a file."""

import collections
import os
import statistics

import numpy

from . import _arrays, _gloam, _words
from ._gloam import Camera, Error, Frame, UsageError

Pass = collections.namedtuple("Pass", ["view", "name", "ms"])
Pass.__doc__ = "A pass of a run: the view, its name such as 'gtao/estimate', and a list of times on the device, milliseconds."

#: Keywords of `run` that are neither planes nor parameters of techniques.
_OPTIONS = ("preset", "filter", "extras", "outputs", "resolution", "adaptive", "only", "elsewhere", "math", "real", "lanes", "seed",
            "repeat", "strips", "layers", "eyes")

#: Those that are named in its signature.
_NAMED = ("camera", "fov", "views", "device", "settings") + _words.DEPTH + _words.NORMALS


class Result(dict):
    """What a run made: arrays by the names of their planes, and facts about the run as attributes.

    An array is float32, C-contiguous and its owner's alone: (height, width), or (height, width, components). Of a frame with several
    views each value is a list of arrays, in the order of `views`.

    technique; device, its name; lanes; views.  ms: time of all passes on the device, milliseconds; passes: a gloam.Pass for each (view,
    name, ms for each repeat); total_ms for each repeat.  radius, scene units, or None; radius_from: "flag", "scene" or "frame";
    radius_pixels.  notes: sentences.  attributes: how it was made, for a header.  skipped_share: of the pixels, by a mask.
    device_bytes.  frame: what it was made of, with depth and cameras.  number: of a sequence's frame, or None.
    """

    def __init__(self, outcome, several):
        super().__init__()
        of_views = outcome.arrays
        for name in of_views[0] if of_views else ():
            arrays = [planes[name] for planes in of_views]
            self[name] = arrays if several else arrays[0]
        self.technique = outcome.technique
        self.device = outcome.device
        self.lanes = outcome.lanes
        self.views = outcome.views
        self.passes = [Pass(*facts) for facts in outcome.passes]
        self.total_ms = outcome.total_ms
        self.radius, self.radius_from = outcome.radius or (None, None)
        self.notes = outcome.notes
        self.attributes = outcome.attributes
        self.skipped_share = outcome.skipped_share
        self.device_bytes = outcome.device_bytes
        self.frame = outcome.source
        self.number = outcome.number
        if self.radius_from == "frame":
            self.notes.append(f"radius: {self.radius:g} scene units, made from the frame, as none is given")

    @property
    def ms(self):
        """Time of all passes on the device, milliseconds; of several runs (`repeat`) the median."""
        return statistics.median(self.total_ms)

    @property
    def radius_pixels(self):
        """The radius in pixels at the median depth of the frame; None without a radius or a surface."""
        per_unit = None if self.radius is None else _gloam.pixels_at_median_depth(self.frame)
        return None if per_unit is None else self.radius * per_unit

    def __repr__(self):
        planes = []
        for name, value in self.items():
            shape = f"{len(value)} x {value[0].shape}" if isinstance(value, list) else f"{value.shape}"
            planes.append(f"{name} {shape}")
        number = "" if self.number is None else f" of frame {self.number}"
        radius = "" if self.radius is None else f"; radius {self.radius:g}, from the {self.radius_from}"
        return f"<gloam.Result of {self.technique}{number}: {', '.join(planes)}{radius}; {self.ms:.2f} ms on {self.device}>"


def _is_planes(value):
    """Whether a keyword's value is of a plane: an array, or a list with one for each view."""
    return _arrays.is_array(value) or isinstance(value, (list, tuple)) and any(_arrays.is_array(item) for item in value)


def divided(keywords):
    """Keywords as planes and as parameters. Throws for an array under a name that no plane has."""
    known = _gloam.known_planes()
    planes = {}
    parameters = {}
    for name, value in keywords.items():
        name = _words.text("keyword", name)
        value = _arrays.plain(value)
        if value is None and name in known:
            continue  # not given
        if name in known and not isinstance(value, (str, bool, int, float, numpy.generic, os.PathLike)):
            planes[name] = value
        elif _is_planes(value):
            raise _words.refusal(f"no plane '{name}'{_gloam.suggestion(name, known)}; there are {_gloam.enumerate(known)}")
        else:
            parameters[name] = value
    return planes, parameters


def _parameter_names():
    return {parameter["name"] for facts in _gloam.techniques() for parameter in facts["parameters"]}


def check_names(parameters, keywords):
    """Refuses a keyword that no technique has as a parameter, where it looks most like one of the call's own, such as 'presett'."""
    known = _parameter_names() if parameters else ()
    for name in parameters:
        if name in known:
            continue
        said = _gloam.suggestion(name, [*keywords, *known])
        if said and said in [_gloam.suggestion(name, [keyword]) for keyword in keywords]:
            raise _words.refusal(f"no keyword '{name}'{said}; there are {_gloam.enumerate(list(keywords))}, planes, and the technique's parameters")


def _of_each_view(planes):
    """Planes by name as dicts by view, and whether they were given as lists."""
    planes = {_words.text("name of a plane", name): value for name, value in planes.items()}
    counts = {name: len(value) for name, value in planes.items() if isinstance(value, (list, tuple)) and _is_planes(value)}
    if not counts:
        return [planes], False
    for name, value in planes.items():
        if name not in counts:
            raise _words.refusal(f"plane '{name}' is one array, and others are lists of views; give a list of {max(counts.values())}")
    if len(set(counts.values())) > 1:
        listed = ", ".join(f"{name} {count}" for name, count in counts.items())
        raise _words.refusal(f"the planes have different numbers of views ({listed}); give one array of each plane for each view")
    return [{name: value[i] for name, value in planes.items()} for i in range(next(iter(counts.values())))], True


def _names_of_views(given, count):
    named = _words.names("views", given)
    if named is None:
        return [""] if count == 1 else ["left", "right"] if count == 2 else [f"view{i}" for i in range(count)]
    if len(named) != count or len(set(named)) != count:
        raise _words.refusal(f"views {named} are {len(named)} names, and there are {count} views; give each a name of its own")
    return named


def _size(planes):
    for name, value in planes.items():
        if value.ndim >= 2:
            return value.shape[1:] if _gloam.is_stack(name) else value.shape[:2]
    return None


def _way_to_a_camera(given):
    """How a matrix becomes a camera, as the end of a sentence."""
    shape = tuple(getattr(given, "shape", ()))
    if shape == (4, 4):
        return ": gloam.Camera.from_projection(matrix, 'opengl', width, height)"
    return ": gloam.Camera.from_intrinsics(K)" if shape == (3, 3) else ""


def _cameras(camera, fov, of_views, several):
    count = len(of_views)
    if camera is not None and fov is not None:
        raise _words.refusal("camera and fov are both given; give one of them")
    if camera is None and fov is None:
        raise _words.refusal("camera: none is given; give camera=gloam.Camera(fx=..., fy=..., cx=..., cy=...), gloam.Camera.from_projection(...), or "
                             "fov=DEGREES")
    if fov is not None:
        size = _size(of_views[0])
        if size is None:
            return [Camera(1, 1, 0, 0)] * count  # what is wrong with the arrays is told next
        return [_gloam.camera_with_fov(int(size[1]), int(size[0]), _words.number("fov", fov))] * count
    cameras = list(camera) if isinstance(camera, (list, tuple)) else [camera]
    for item in cameras:
        if not isinstance(item, Camera):
            raise _words.refusal(f"camera is of type {type(item).__name__}; a gloam.Camera is allowed{', or a list of them' if several else ''}"
                                 f"{_way_to_a_camera(item)}")
    if len(cameras) != count:
        raise _words.refusal(f"there are {len(cameras)} cameras and {count} views; give one for each view")
    return cameras


def frame_of(planes, camera, fov, views, surfaces):
    """A frame of arrays, and whether its views were given as lists."""
    if not planes:
        raise _words.refusal("there is neither a frame nor an array; give depth=... and camera=..., or a gloam.Frame")
    of_views, several = _of_each_view(planes)
    names = _names_of_views(views, len(of_views))
    of_views, notes = _arrays.planes_of_views(of_views, names)
    return _gloam.frame_of_arrays(of_views, _cameras(camera, fov, of_views, several), names, surfaces, notes), several


def request_words(technique, parameters, settings, options):
    """What the compiled part takes as a request, and as options of the run."""
    name = _words.text("technique", technique)
    if name is None:
        raise _words.refusal("technique: none is named; gloam.techniques() has them")
    words, run_words = shared_words(parameters, settings, options)
    return {"technique": name, **words}, run_words


def shared_words(parameters, settings, options):
    """A request without a technique, and options of the run."""
    words = {"settings": _words.settings(parameters, settings)}
    for name in ("outputs", "extras"):
        words[name] = _words.names(name, options.get(name))
    for name in ("layers", "eyes", "preset", "filter", "resolution", "adaptive", "only", "elsewhere"):
        words[name] = _words.text(name, options.get(name))
    run_words = {name: _words.text(name, options.get(name)) for name in ("math", "real")}
    run_words.update({name: _words.integer(name, options.get(name)) for name in ("lanes", "seed", "repeat")})
    return words, run_words


def _strips(value):
    """The number of strips; 0 for as few as fit, None for a frame that is computed whole."""
    if value == "auto":
        return 0
    if isinstance(value, str):
        raise _words.refusal(f"strips {value} is not allowed; 'auto' is, or a number from 1 to 65536")
    count = _words.integer("strips", value)
    if count is not None and not 1 <= count <= 65536:
        raise _words.refusal(f"strips {count} is not allowed; 'auto' is, or a number from 1 to 65536")
    return count


def _files(frame):
    """The paths of a frame in one file, or of its two eyes in two."""
    if _words.is_path(frame):
        return [_words.path("frame", frame)]
    if isinstance(frame, (list, tuple)) and frame and all(_words.is_path(item) for item in frame):
        return [_words.path("frame", item) for item in frame]
    return None


def frame_for(frame, planes, camera, fov, views, surfaces, read):
    """The frame to compute on, whether it is the call's own, and whether its views are a list. `read`: reads the planes needed of files."""
    if frame is None:
        made, several = frame_of(planes, camera, fov, views, surfaces)
        return made, True, several
    paths = _files(frame)
    if paths is not None:
        if planes:
            raise _words.refusal(f"{_gloam.enumerate(list(planes))}: arrays do not go with a path; give gloam.read(path) and the arrays")
        made = read(paths, _words.reading(camera, fov=fov, views=views, **surfaces))
        return made, True, len(made.views) > 1
    if not isinstance(frame, Frame):
        raise _words.refusal(f"frame is of type {type(frame).__name__}; a gloam.Frame, a path, or arrays by keyword are allowed{', depth=array' if _arrays.is_array(frame) else ''}")
    for name, value in (("camera", camera), ("fov", fov), ("views", views)):
        if value is not None:
            raise _words.refusal(f"{name}: a gloam.Frame has its own; leave it out, or give it to gloam.read")
    for name, value in surfaces.items():
        if value is not None and ("depth" if name in _words.DEPTH else "normal") not in planes:
            raise _words.refusal(f"{name}: a gloam.Frame has its own; leave it out, or give it to gloam.read")
    if not planes:
        return frame, False, len(frame.views) > 1
    of_views, several = _of_each_view(planes)
    if len(of_views) != len(frame.views):
        raise _words.refusal(f"the frame has {len(frame.views)} views, and {len(of_views)} are given of {_gloam.enumerate(list(planes))}")
    of_views, notes = _arrays.planes_of_views(of_views, frame.views)
    return _gloam.with_planes(frame, of_views, surfaces, notes), True, len(frame.views) > 1


def tell(result, notes, frame, is_own, stacklevel):
    """Shows the notes of a result's making, but for those of a frame that the caller had before."""
    assumed = set() if is_own else set(frame.notes)
    notes = [text for text in notes if text not in assumed]
    if result.radius_from == "frame":
        notes.append("radius: none is given, so it is made from the frame; the result's radius says which, and radius=... gives one")
    _words.note(notes, stacklevel=stacklevel + 1)


def run(technique, frame=None, *, camera=None, fov=None, views=None, device=None, settings=None, depth_is=None, near=None, far=None,
        background=None, depth_scale=None, depth_offset=None, normals_are=None, normal_space=None, normal_range=None, normal_axes=None, **keywords):
    """Runs a technique on arrays, on a gloam.Frame or on an EXR file, and returns a gloam.Result: arrays by the names of planes.

    technique: a name of gloam.techniques(); "ao" stands for the default of ambient occlusion.
    frame: a gloam.Frame (planes by keyword join its own, or take their place), a path, or a list of two paths, one for each eye. Of a
        path only the planes are read that the technique needs.
    Planes by keyword, instead of a frame: arrays (height, width), or (height, width, 3) for normal, color, albedo, reflectance and position;
        peel and stochastic, stacks of layers, are (layers, height, width). (1, height, width), (3, height, width) and (height, width, 4) are
        taken too, and so are all real dtypes, bool, any strides, and arrays of torch, CuPy and others in the host's memory; float32 in C order is
        read in place. A list of arrays has one for each view. The arrays are only read, and may change or go when the call has returned.
    camera: a gloam.Camera, or a list with one for each view; fov instead: the horizontal field of view, degrees. Of a path: a camera
        JSON too.
    views: names of the views; of a path those to read.
    depth_is: what depth values mean: "z" (scene units along the viewing axis; the default), "ray" (from the eye), "ndc" (0 at the near plane, 1 at
        the far plane) or "reversed" (1 and 0).  near, far: the clipping planes, scene units, for the last two; default: the camera's.
    background: the depth value that means background, as it is stored.  depth_scale, depth_offset: what is stored, times the scale, plus the
        offset, is what depth_is says.
    normals_are: the convention of the normals in one text: "view" or "world", "signed" (-1 to 1), "unsigned" (0 to 1) or "srgb" (that with the curve of a picture), and the axes, "x,-y,z" with y
        down: "world unsigned". normal_space, normal_range, normal_axes: the same one by one. What is not stated is found by the depth: normals
        that agree with it in another convention than view space alone are taken in that one, and a note says so.
    Parameters of the technique by keyword: radius (scene units), samples, ...; settings: the same as a dict, for names with a dot
        ({"bilateral.radius": 2}). Without a radius one is made from the frame, and the result says so.
    layers: "one", "stochastic" or "peeled", and eyes: "one" or "both", choose a variant of the technique: "gtao" with layers="peeled" is "dp-gtao".
    preset: "low", "medium", "high" or "ultra".  outputs: planes to make, of the usual ones.  extras: planes to make beside them.
    filter: the technique that follows, or "none".  resolution: "full", "half" or "quarter".  adaptive: a preset.
    only: a mask: an array, above 0 where work is wanted, a plane's name, or a technique that makes one.  elsewhere: a technique.
    device: a gloam.Device, or part of a name.  math: "fast" or "precise".  real: "float" or "double".  lanes: 1, 4, 8 or 16.
    seed: of the random numbers, 0 or more.  repeat: timed runs.
    strips: computes a frame that is too large for the device in strips of rows, so many, or "auto", as few as fit. The estimate is the same
        but for the random numbers of its samples, which begin anew in each strip.

    Raises gloam.Error, with the sentence of the command `gloam`, in which options are keywords: gloam.UsageError for names and values, gloam.MissingPlanes for all planes
    that the technique lacks. The interpreter is free for other threads meanwhile, and Ctrl-C ends the call between two passes.
    """
    options = {name: keywords.pop(name) for name in _OPTIONS if name in keywords}
    surfaces = _words.surfaces(depth_is=depth_is, near=near, far=far, background=background, depth_scale=depth_scale, depth_offset=depth_offset, normals_are=normals_are, normal_space=normal_space,
                               normal_range=normal_range, normal_axes=normal_axes)
    mask = options.get("only")
    if _is_planes(mask):
        keywords["mask"], options["only"] = mask, "mask"
    planes, parameters = divided(keywords)
    check_names(parameters, _OPTIONS + _NAMED)
    words, run_words = request_words(technique, parameters, settings, options)
    made, is_own, several = frame_for(frame, planes, camera, fov, views, surfaces, lambda paths, reading: _gloam.read_for(paths, reading, words))
    outcome = _gloam.run(words, made, is_own, _words.device(device), run_words, _strips(options.get("strips")))
    result = Result(outcome, several)
    tell(result, outcome.notes, made, is_own, stacklevel=2)
    return result
