"""Arrays of anybody, brought to the form that the compiled part takes: float32, C-contiguous, the components of a pixel side by side."""

import numpy

from . import _gloam, _words

#: Devices of DLPack whose memory the host reads: the CPU, pinned memory of CUDA and ROCm, managed memory of CUDA.
_OF_HOST = (1, 3, 11, 13)
_DEVICES = {2: "CUDA", 4: "OpenCL", 7: "Vulkan", 8: "Metal", 10: "ROCm", 14: "oneAPI"}

#: By these others are recognised as arrays: those of torch, CuPy, JAX, PIL, xarray.
_MARKS = ("__dlpack__", "__array__", "__array_interface__")


def is_array(value):
    """Whether a value is an array of any library, with one axis at least."""
    if isinstance(value, numpy.ndarray):
        return value.ndim > 0
    if isinstance(value, (numpy.generic, type)):
        return False
    return any(hasattr(type(value), mark) for mark in _MARKS) and getattr(value, "ndim", 1) > 0


def _type_of(value):
    return f"{type(value).__module__.split('.')[0]}.{type(value).__name__}"


def _check_device(what, value):
    """Refuses an array in the memory of a device, with the call that copies it to the host."""
    if not hasattr(value, "__dlpack_device__"):
        return
    device = int(value.__dlpack_device__()[0])
    if device in _OF_HOST:
        return
    call = "array.get()" if hasattr(value, "get") else "tensor.cpu()" if hasattr(value, "cpu") else "numpy.asarray(array)"
    raise _words.refusal(f"{what} is in the memory of a {_DEVICES.get(device, 'foreign')} device, and gloam takes arrays of the host: {call}")


def _of_library(what, value):
    """The NumPy array of another library's, without a copy where that can be."""
    _check_device(what, value)
    if getattr(value, "requires_grad", False):
        raise _words.refusal(f"{what} carries gradients, which end here: tensor.detach()")
    reason = None
    if hasattr(value, "__dlpack__") and hasattr(numpy, "from_dlpack"):
        try:
            return numpy.from_dlpack(value)
        except Exception as error:  # of types that DLPack or this NumPy lacks, such as bool: perhaps the library itself can
            reason = error
    try:
        array = numpy.asarray(value)
        if array.ndim > 0 or reason is None:
            return array
    except Exception as error:
        reason = error
    said = str(reason).splitlines()[0] if str(reason) else type(reason).__name__
    call = "tensor.float()" if hasattr(value, "float") else "numpy.array(array, numpy.float32)"
    raise _words.refusal(f"{what}: NumPy cannot read this {_type_of(value)} ({said}); convert it first: {call}")


def plain(value):
    """A number that is an array without axes, of any library, as a number; any other value as it is."""
    is_number = getattr(value, "ndim", None) == 0 and hasattr(value, "item") and not isinstance(value, numpy.generic)
    return value.item() if is_number else value


def on_host(what, value):
    """The NumPy array of numbers behind a value. `what`: for messages, "plane 'depth'"."""
    if not is_array(value):
        raise _words.refusal(f"{what} is of type {type(value).__name__}; an array is allowed, such as numpy.asarray(values, numpy.float32)")
    array = value if isinstance(value, numpy.ndarray) else _of_library(what, value)
    if isinstance(array, numpy.ma.MaskedArray):
        raise _words.refusal(f"{what} is a masked array, and gloam knows no masks; fill it first: array.filled(numpy.inf)")
    if array.dtype.kind not in "biuf":
        raise _words.refusal(f"{what} has the dtype {array.dtype}; real numbers and bool are allowed: array.astype(numpy.float32)")
    return numpy.asarray(array)


def _as_float(array):
    """float32, C-contiguous and aligned: the array itself if it is that. What float32 cannot hold becomes infinite."""
    with numpy.errstate(over="ignore"):
        return numpy.require(array, numpy.float32, ["C", "A"])


def _without_first(array, axes):
    """Without axes of length 1 before the last `axes`, such as a batch of one image."""
    while array.ndim > axes and array.shape[0] == 1:
        array = array[0]
    return array


def _without_ones(array):
    """An image of one component without the axes of length 1 that stand for it and for a batch."""
    array = _without_first(array, 3)
    if array.ndim == 3 and array.shape[0] != 1 and array.shape[2] == 1:
        return array[..., 0]
    return _without_first(array, 2)


def _laid_out(array, components):
    """(height, width), or (height, width, components), of the layouts that others use. The components may be one more than are asked for.
    An array of none of these layouts is given back as it is."""
    if components == 1:
        return _without_ones(array)
    array = _without_first(array, 3)
    if array.ndim != 3:
        return array
    for count in (components, components + 1):
        if array.shape[2] == count:
            return array
        if array.shape[0] == count:
            return numpy.moveaxis(array, 0, 2)
    return array


def _refuse_batch(what, array):
    """Several images in one array, where one is wanted."""
    if array.ndim != 3 or array.shape[0] > 100 or array.shape[-1] in (2, 3, 4):
        return
    raise _words.refusal(f"{what} has the shape {array.shape}; (height, width) or (1, height, width) is allowed: array[0] is one image, and "
                         "list(array) has one for each view")


def _refuse_integers(what, array):
    """Whole numbers of a picture, where 1 is the most that there can be."""
    if array.dtype.kind in "iu" and array.size and array.max() > 1:
        raise _words.refusal(f"{what} has the dtype {array.dtype} and values up to {array.max()}, where 1 is the most; give "
                             f"array / {255 if array.max() <= 255 else 65535}")


def _plane(what, name, value):
    """The array of a plane, and its component too many, if there is one."""
    array = on_host(what, value)
    if name == "normal" and array.dtype.kind == "u":
        raise _words.refusal(f"{what} has the dtype {array.dtype}, as a picture of normals has it; give array / {numpy.iinfo(array.dtype).max} and "
                             "normals_are='unsigned'")
    if name != "mask" and _gloam.is_unit_interval(name):
        _refuse_integers(what, array)
    if _gloam.is_stack(name):
        return _as_float(_without_first(array, 3)), None
    components = _gloam.components(name)
    array = _laid_out(array, components)
    if components == 1:
        if array.ndim == 3 and array.shape[-1] in (2, 3, 4):
            raise _words.refusal(f"{what} has the shape {array.shape}; (height, width) is allowed: array[..., 0] is its first component")
        _refuse_batch(what, array)
        return _as_float(array), None
    if array.ndim == 3 and array.shape[2] == components + 1:
        return _as_float(array[..., :components]), array[..., components]
    return _as_float(array), None


def planes_of_views(of_views, names=None):
    """Planes by name, a dict for each view, as the compiled part takes them, and notes on what is left out."""
    taken, notes = [], []
    for i, planes in enumerate(of_views):
        view = names[i] if names else ""
        made = {}
        for name, value in planes.items():
            made[name], rest = _plane(f"plane '{name}' of view '{view}'" if view else f"plane '{name}'", name, value)
            if rest is None:
                continue
            if name == "color" and "alpha" not in planes:
                _refuse_integers("alpha, the 4th component of plane 'color',", rest)
                made["alpha"] = _as_float(rest)
            else:
                notes.append(f"{name}: its {made[name].shape[2] + 1}th component is left out; {name} has {made[name].shape[2]}")
        taken.append(made)
    return taken, list(dict.fromkeys(notes))


def image(what, value):
    """An image whose plane is not named: (height, width), or (height, width, components) with 3 or 4 of them."""
    array = _without_ones(on_host(what, value))
    _refuse_integers(what, array)
    if array.ndim == 3 and array.shape[2] not in (3, 4) and array.shape[0] in (3, 4):
        array = numpy.moveaxis(array, 0, 2)
    if array.ndim not in (2, 3):
        raise _words.refusal(f"{what} has the shape {array.shape}; (height, width) or (height, width, components) is allowed")
    return _as_float(array)


def mask(what, value):
    """A mask as an array of bool, (height, width): numbers above 0 count."""
    array = _laid_out(on_host(what, value), 1)
    return numpy.ascontiguousarray(array if array.dtype == bool else array > 0)
