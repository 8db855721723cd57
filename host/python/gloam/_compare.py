"""compare: how far an image is from another."""

import numpy

from . import _arrays, _files, _gloam, _run, _words
from ._gloam import Frame, UsageError

#: Where an array says nothing of its plane, the first of these that the other side has in its shape.
_RESULTS = ("ao", "ao_raw", "reflection", "bent_normal", "cone", "hit", "indirect", "bounces", "specular_occlusion", "contact", "environment", "color", "normal", "albedo", "depth")


def _name_for(array, other, plane):
    if plane is not None:
        return plane
    components = array.shape[2] if array.ndim == 3 else 1
    if isinstance(other, numpy.ndarray):
        return "color" if components == 3 else "reflection" if components == 4 else "ao"
    if not isinstance(other, (Frame, dict)):
        return "ao"  # what is wrong with the other side is told next
    first = {name: other[name][0] if isinstance(other[name], list) else other[name] for name in _RESULTS if name in other}
    fitting = [name for name, values in first.items() if values.ndim == array.ndim]
    return fitting[0] if fitting else "color" if components == 3 else "ao"


def _side(which, value, other, plane):
    """The images of a side, and the frame whose depth tells its background."""
    if isinstance(value, numpy.ndarray):
        return _files._image({_name_for(value, other, plane): value})[0], None
    if isinstance(value, Frame):
        return value, value
    if isinstance(value, _run.Result):
        return _files.image_of_result(value), value.frame
    if isinstance(value, dict) and value:
        image, _ = _files._image(value)
        return image, image
    raise _words.refusal(f"{which} is of type {type(value).__name__}; an array, a result of gloam.run, a gloam.Frame or a path are allowed")


def _opened(which, value):
    """A path's frame, its values as they are stored; an image of any library as an array."""
    if _arrays.is_array(value):
        return _arrays.image(which, value)
    return _files.read_as_stored(value) if _words.is_path(value) else value


def compare(test, reference, *, plane=None, mask=None, frame=None, exposure=None):
    """Figures of how far an image is from the truth, those of `gloam compare`, as a dict.

    test, reference: arrays, (height, width) or (height, width, components), in the layouts and types that gloam.run takes; results of gloam.run; gloam.Frames; dicts of arrays; or
        paths of EXR files, whose values are taken as they are stored.
    plane: the plane to compare; default: the first that both sides have, results first.
    mask: the pixels that count, an array of bool, (height, width), or of numbers above 0 there.  frame: a gloam.Frame or a path whose depth tells the background;
        default: the depth of the test, else of the reference, else every pixel counts.
    exposure: factor on radiance before ssim, gmsd and flip.

    Keys: pixels, mae, rmse, bias (mean of test - reference), psnr (dB for a peak of 1; None for equal images), max, over_1_255 and over_0_05 (shares
    of pixels), ssim, gmsd, of colours flip and rse; plane, truth_plane, notes; of several views also views, the figures of each.
    Raises gloam.Error for sizes that differ, values that are not finite, and a mask without a pixel.
    """
    test, reference = _opened("test", test), _opened("reference", reference)
    if isinstance(test, numpy.ndarray) and isinstance(reference, numpy.ndarray) and test.shape != reference.shape:
        raise _words.refusal(f"the test has the shape {test.shape}, and the reference {reference.shape}; "
                         "only images of one shape can be compared")
    plane = _words.text("plane", plane)
    images, teller = _side("test", test, reference, plane)
    truths, other_teller = _side("reference", reference, test, plane)
    tellers = [held for held in (teller, other_teller) if held is not None]
    if frame is not None:
        given = _opened("frame", frame)
        if not isinstance(given, Frame) or "depth" not in given:
            raise _words.refusal("frame: has no depth to tell the background by; a gloam.Frame or a path with depth is allowed")
        tellers.insert(0, given)
    figures = _gloam.compare(images, truths, plane or "", None if mask is None else _arrays.mask("mask", mask), tellers, _words.number("exposure", exposure))
    unknown = "no depth on either side: every pixel counts; frame=... or mask=... tells the background"
    notes = [] if figures.pop("background_is_known") else [unknown]
    figures["notes"] = notes
    _words.note(notes, stacklevel=2)
    return figures
