"""read, write and Sequence: frames in EXR files."""

import collections
import os

import numpy

from . import _arrays, _gloam, _run, _words
from ._gloam import Error, Frame, UsageError


def read(file, *, camera=None, fov=None, depth_is=None, depth=None, near=None, far=None, background=None, depth_scale=None,
         depth_offset=None, depth_bytes=None, depth_encoding=None, plane_files=None, normals_are=None, normal_space=None, normal_range=None, normal_axes=None, views=None,
         channels=None, planes=None, as_stored=False):
    """Reads a frame from an EXR file, or an image of another format (PNG, TIFF, PFM, HDR, NPY, NPZ, HDF5), and returns a gloam.Frame. What is not stated and has to be assumed is in its `notes`.

    file: a path, or a list of two paths, one for each eye.
    camera: a gloam.Camera, or the path of a camera JSON; default: the header's, else the JSON beside the file.
    fov: horizontal field of view, degrees, over every other camera.
    depth_is: what depth values mean: "auto", "z" (along the viewing axis), "ray", "ndc", "reversed" or "inverse" (1 / z); near, far: the clipping planes of
        ndc and reversed, scene units.  background: the depth value that means background.  depth: another name of depth_is.
    depth_scale, depth_offset: what is stored, times the scale, plus the offset, is what depth_is says: 0.001 makes metres of millimetres.
    depth_bytes: "low-first" or "high-first": of depth of 24 bits in three bytes, red is the lowest or the highest; default: found.
    depth_encoding: what was done to stored depth, "srgb", "bottom-up" and "wrapped" (16 bits), with commas between, or "plain"; default: found.
    plane_files: {"normal": "n.png"}: planes in files of their own, in place of those of the file.
    normals_are: as for gloam.run; or one by one, normal_space: "auto", "view" or "world".  normal_range: "auto", "signed" (-1 to 1), "unsigned" (0 to 1) or "srgb" (that with the curve of a picture).  normal_axes: "auto", or the axis
        that each component lies along: "x,-y,z" has y down. What is not stated is found by the depth.
    views: names of the views to read.  channels: {"depth": "Layer.Z"}: channels or layers that planes are taken from, or "none".
    planes: names of the planes to read; default: all that every view has.
    as_stored: values as they are in the file, not clamped, replaced or made unit: for measuring.

    Raises gloam.Error for a file that cannot be read, naming it.
    """
    words = _words.reading(camera, fov=fov, depth_is=depth_is, depth=depth, near=near, far=far, background=background, depth_scale=depth_scale,
                           depth_offset=depth_offset, depth_bytes=depth_bytes, depth_encoding=depth_encoding, plane_files=plane_files, views=views, channels=channels, as_stored=as_stored, normals_are=normals_are, normal_space=normal_space, normal_range=normal_range, normal_axes=normal_axes)
    paths = _run._files(file)
    if paths is None:
        raise _words.refusal(f"file is of type {type(file).__name__}; a path is allowed, or a list of two paths, one for each eye")
    frame = _gloam.read(paths, words, _words.names("planes", planes) or [])
    _words.note(frame.notes, stacklevel=2)
    return frame


def read_as_stored(file):
    """A file for comparing: nothing is clamped or replaced."""
    return _gloam.read([_words.path("file", file)], _words.reading(as_stored=True), [])


def _image(planes, views=None):
    """Arrays as a frame without cameras, their values as they are."""
    of_views, _ = _run._of_each_view(dict(planes))
    of_views, notes = _arrays.planes_of_views(of_views, views)
    return _gloam.image_of_arrays(of_views, views or _run._names_of_views(None, len(of_views))), notes


def image_of_result(result):
    listed = {name: value if isinstance(value, list) else [value] for name, value in result.items()}
    return _image(listed, result.views)[0]


def _is_picture(path):
    return os.path.splitext(os.fsdecode(path))[1].lower() == ".png"


def _write_picture(target, what, plane):
    """A PNG of one plane, by default of the first; of several views one for each."""
    teller = None
    if isinstance(what, Frame):
        image = what
    elif isinstance(what, _run.Result):
        image, teller = image_of_result(what), what.frame
    elif isinstance(what, dict) and what:
        image, _ = _image(what)
    elif _arrays.is_array(what):
        array = _arrays.image("write: the array", what)
        plane = plane or ("ao" if array.ndim == 2 else "color")
        image, _ = _image({plane: array[..., :3] if array.ndim == 3 and plane == "color" else array})
    else:
        raise _words.refusal(f"write: {type(what).__name__} cannot be drawn; an array, a result of gloam.run, a gloam.Frame or a dict of arrays can")
    listed = list(what) if isinstance(what, dict) else image.planes
    _words.note(_gloam.write_pictures(target, image, _words.text("plane", plane) or listed[0], teller), stacklevel=3)


def write(path, what, *, plane=None, camera=None, fov=None, compression="zip", half=False, keep_margin=False):
    """Writes an EXR file, or a picture, PNG, as the command `gloam` does. It is there whole or not at all.

    path: of an EXR file; or of a picture, "ao.png", which shows one plane for people: AO and other single components as grey from 0 to 1, normals as
        0.5 + 0.5 n, colour through the sRGB curve, background hatched where a depth tells it. plane: which one; default: the first. Of
        several views there is a picture for each, "ao.left.png". A picture may be of an array too.
    what: a gloam.Frame; a result of gloam.run, with the depth and the camera of its frame, as `gloam run -o` writes it; or a dict of arrays by
        the names of their planes, (height, width) or (height, width, components), in the layouts and types that gloam.run takes, or lists.
    camera, fov: as for gloam.run, for a dict.
    compression: "zip", "zips", "piz", "rle" or "none", all lossless.  half: AO and other bounded planes as 16-bit floats.
    keep_margin: of a result for a frame that was rendered with a margin, write the whole data window instead of the display window.

    Raises gloam.Error, naming the path, if it cannot be written.
    """
    target = _words.path("path", path)
    compression = _words.word("compression", compression)
    if _is_picture(target):
        _write_picture(target, what, plane)
        return
    if plane is not None:
        raise _words.refusal("plane: chooses what a picture shows, and an EXR file has all planes; leave it out, or name a .png")
    if keep_margin and not isinstance(what, _run.Result):
        raise _words.refusal("keep_margin: is of results of gloam.run, and all else is written whole; leave it out")
    if _arrays.is_array(what):
        raise _words.refusal("write: an array has no name in an EXR file; give a dict such as {'ao': array}, or name a .png")
    if isinstance(what, Frame):
        _gloam.write(target, what, None, [], {}, {}, compression, bool(half), True)
    elif isinstance(what, _run.Result):
        _words.note(_gloam.notes_on_margin(what.frame, bool(keep_margin)), stacklevel=2)
        carried = ["depth"] + (["normal"] if len(what.frame.views) == 2 else [])
        _gloam.write(target, what.frame, image_of_result(what), carried, what.attributes, {}, compression, bool(half), bool(keep_margin))
    elif isinstance(what, dict):
        if not what:
            raise _words.refusal("write: the dict has no array; give one of arrays by the names of their planes")
        image, notes = _image(what)
        _words.note(notes, stacklevel=2)
        cameras = None
        if camera is not None or fov is not None:
            of_views, several = _run._of_each_view(dict(what))
            of_views, _ = _arrays.planes_of_views(of_views)
            cameras = _run._cameras(camera, fov, of_views, several)
        _gloam.write_image(target, image, cameras, compression, bool(half))
    else:
        raise _words.refusal(f"write: {type(what).__name__} cannot be written; a gloam.Frame, a result of gloam.run, or a dict of arrays can")


Written = collections.namedtuple("Written", ["done", "skipped", "again"])
Written.__doc__ = """The frames of a sequence that were written, by number: done; skipped, left alone since they were whole; again, a dict with why,
of those done whose files were there already."""


class Sequence:
    """The frames of a sequence, in files that are named by a pattern.

    pattern: "shot.####.exr" (# is a digit, filled up with zeros) or "shot.%04d.exr"; a list of two patterns has one for each eye.
    frames: "1001-1100", "1-99x2", "1,5,9-12", or numbers (a range, a list); default: all that are there.
    missing: for frames that are not there: "error" (where frames are named), "skip", or "hold", the frame before.
    The other keywords: as for gloam.read. camera may be a pattern too, or a JSON that lists the cameras of all frames.

    Iterating gives a gloam.Frame for each number of `numbers`; sequence[1001] reads one frame.
    Raises gloam.Error for a sequence without files, and for frames that are missing.
    """

    def __init__(self, pattern, *, frames=None, missing=None, camera=None, fov=None, depth_is=None, depth=None, near=None, far=None,
                 background=None, depth_scale=None, depth_offset=None, depth_bytes=None, depth_encoding=None, plane_files=None, normals_are=None, normal_space=None, normal_range=None, normal_axes=None, views=None, channels=None):
        paths = _run._files(pattern)
        if paths is None:
            raise _words.refusal(f"pattern is of type {type(pattern).__name__}; a path such as 'shot.####.exr' is allowed, or a list of two")
        if isinstance(frames, range):
            frames = _words.frames_of_range(frames)
        elif isinstance(frames, (list, tuple)) or isinstance(frames, (int, numpy.integer)):
            numbers = [frames] if isinstance(frames, (int, numpy.integer)) else frames
            frames = ",".join(str(_words.integer("frames", number)) for number in numbers)
        self._words = _words.reading(camera, fov=fov, depth_is=depth_is, depth=depth, near=near, far=far, background=background,
                                     depth_scale=depth_scale, depth_offset=depth_offset, depth_bytes=depth_bytes, depth_encoding=depth_encoding, plane_files=plane_files, views=views, channels=channels, normals_are=normals_are, normal_space=normal_space, normal_range=normal_range, normal_axes=normal_axes)
        self._held = _gloam.open_sequence(paths, _words.text("frames", frames), _words.text("missing", missing), self._words)
        self.notes = self._held.notes
        _words.note(self.notes, stacklevel=2)

    @property
    def numbers(self):
        return self._held.numbers

    def __len__(self):
        return len(self._held.numbers)

    def __iter__(self):
        return (self.read(number) for number in self._held.numbers)

    def __getitem__(self, number):
        return self.read(number)

    def read(self, number, planes=None):
        """Reads a frame by its number: a gloam.Frame with these planes; default: all."""
        return self._held.read(_words.integer("number", number), self._words, _words.names("planes", planes) or [])

    def run(self, technique, *, temporal=False, device=None, settings=None, **keywords):
        """An iterator over a technique's results, a gloam.Result for each frame, with its number as `number`.

        The next frame is decoded while one is computed. The keywords are those of gloam.run, without planes, camera and repeat.
        temporal: AO and reflections become means over the frames that showed each surface, with the same bits as `gloam run --temporal`.
        Without a radius, each frame has its own.
        Raises gloam.Error for a frame that fails; calling next() again goes on with the frame after it.
        """
        words, run_words = self._request(technique, settings, keywords, ("temporal", "device", "settings"))
        return Run(self, _gloam.run_over(self._held, self._words, words, bool(temporal), _words.device(device), run_words))

    def write(self, technique, path, *, temporal=False, resume=False, half=True, compression="zip", keep_depth=False, keep_margin=False, device=None,
              settings=None, **keywords):
        """Writes a technique's results, a file for each frame, with the pixels that `gloam run` on a shot writes. Returns a gloam.Written.

        Frames are decoded, computed and written at the same time. Each file has the technique's first output, or `outputs`, and the camera.
        path: a pattern such as "ao.####.exr".  half: AO as half.  compression: as for gloam.write.  keep_depth: the frame's depth too, and of two
        eyes the normals.  keep_margin: of frames with a margin the whole data window, instead of the display window.  temporal and the other
        keywords: as for `run`.
        resume: leaves frames alone that are whole and were made in the same way: by this method, with the same keywords, from the same files.
        After an interruption the same call with resume=True goes on, and gives the files that one undisturbed call gives.
        Raises gloam.Error if frames fail, after the others are written, and where nothing can be written.
        """
        own = ("temporal", "resume", "half", "compression", "keep_depth", "keep_margin", "device", "settings")
        words, run_words = self._request(technique, settings, keywords, own)
        writing = {"temporal": bool(temporal), "resume": bool(resume), "half": bool(half), "keep_depth": bool(keep_depth),
                   "keep_margin": bool(keep_margin), "compression": _words.word("compression", compression)}
        done, skipped, failed, again, notes, is_disk_full = _gloam.write_over(
            self._held, self._words, words, run_words, _words.device(device), _words.path("path", path), writing)
        radius = "radius: each frame has its own, made from its depths; "
        _words.note([radius + "radius=... gives one to all" if text.startswith(radius) else text for text in notes], stacklevel=2)
        if failed:
            way_on = "; free some space, then the same call with resume=True goes on" if is_disk_full else ""
            first = next(iter(failed))
            raise Error(f"{len(failed)} of {len(self)} frames failed: {_gloam.frames_in_words(list(failed))}; frame {first}: {failed[first]}{way_on}")
        return Written(done, skipped, again)

    @staticmethod
    def _request(technique, settings, keywords, own):
        """The words of a request and of its run. `own`: keywords of the call itself."""
        options = {name: keywords.pop(name) for name in _run._OPTIONS if name in keywords}
        if options.get("repeat") not in (None, 1):
            raise _words.refusal(f"repeat {options['repeat']}: times one frame; leave it out, or run one frame alone")
        if options.get("strips") is not None:
            raise _words.refusal("strips: are for gloam.run and one frame; leave them out")
        planes, parameters = _run.divided(keywords)
        if planes:
            raise _words.refusal(f"{_gloam.enumerate(list(planes))}: planes come with the frames; leave them out")
        _run.check_names(parameters, tuple(name for name in _run._OPTIONS if name not in ("repeat", "strips")) + own)
        return _run.request_words(technique, parameters, settings, options)

    def __repr__(self):
        return repr(self._held)


class Run:
    """Results of a technique on the frames of a sequence, one after another: an iterator. A frame that fails raises; whoever catches that may
    go on with the next."""

    def __init__(self, sequence, compiled):
        self._sequence = sequence
        self._compiled = compiled
        self._noted = set()

    def __iter__(self):
        return self

    def __next__(self):
        outcome = self._compiled.next()
        if outcome is None:
            raise StopIteration
        result = _run.Result(outcome, len(outcome.source.views) > 1)
        notes = list(outcome.notes)
        if result.radius_from == "frame":
            notes = [text for text in notes if not text.startswith("radius: ")]
            notes.append("radius: each frame has its own, made from its depths; radius=... gives one to all")
        _words.note([text for text in notes if text not in self._noted], stacklevel=2)
        self._noted.update(notes)
        return result

    def __repr__(self):
        return f"<gloam.Run over {self._sequence!r}>"
