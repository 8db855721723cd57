"""Arrays of any layout, type and library give the bits of float32 in C order, or a sentence with the call that helps."""

import warnings

import numpy
import pytest

import gloam


@pytest.fixture(scope="module")
def scene():
    frame = gloam.capture("courtyard", 60, 40, ["normal", "color"])
    planes = {name: numpy.array(frame[name]) for name in ("depth", "normal", "color")}  # of their own: DLPack of NumPy 1 needs them writable
    return {**planes, "camera": frame.camera}


def ao(scene, **more):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        given = {name: scene[name] for name in ("depth", "normal", "camera")}
        return gloam.run("gtao", **{**given, **more}, radius=1.0)


class Shared:
    """An array that is seen through DLPack alone, as one of another library."""

    def __init__(self, array, device=1):
        self.array, self.device = array, device

    def __dlpack__(self, stream=None):
        return self.array.__dlpack__()

    def __dlpack_device__(self):
        return (self.device, 0)


class OfCuPy(Shared):
    def get(self):
        return self.array


class OfTorch(Shared):
    requires_grad = False

    def cpu(self):
        return self.array


class Interface:
    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        return self.array


def unaligned(z):
    return numpy.frombuffer(b"x" + z.tobytes(), numpy.float32, offset=1).reshape(z.shape)


DEPTHS = {
    "(1, H, W)": lambda z: z[None],
    "(H, W, 1)": lambda z: z[..., None],
    "(1, 1, H, W)": lambda z: z[None, None],
    "(1, H, W, 1)": lambda z: z[None, ..., None],
    "float64": lambda z: z.astype(float),
    "long double": lambda z: z.astype(numpy.longdouble),
    "big endian": lambda z: z.astype(">f4"),
    "Fortran order": numpy.asfortranarray,
    "negative strides": lambda z: z[::-1, ::-1].copy()[::-1, ::-1],
    "every second column": lambda z: numpy.repeat(z, 2, axis=1)[:, ::2],
    "transposed": lambda z: z.T.copy().T,
    "unaligned": unaligned,
    "read-only": lambda z: numpy.frombuffer(z.tobytes(), numpy.float32).reshape(z.shape),
    "DLPack": Shared,
    "DLPack, pinned memory of CUDA": lambda z: Shared(z, 3),
    "DLPack, float64 with strides": lambda z: Shared(numpy.asfortranarray(z.astype(float))),
    "__array__": Interface,
}
NORMALS = {
    "(3, H, W)": lambda n: numpy.moveaxis(n, 2, 0),
    "(1, 3, H, W)": lambda n: numpy.moveaxis(n, 2, 0)[None].copy(),
    "(1, H, W, 3)": lambda n: n[None],
    "(H, W, 4)": lambda n: numpy.dstack([n, n[..., :1]]),
    "(4, H, W)": lambda n: numpy.moveaxis(numpy.dstack([n, n[..., :1]]), 2, 0),
    "float64": lambda n: n.astype(float),
    "DLPack, (3, H, W)": lambda n: Shared(numpy.moveaxis(n, 2, 0)),
}


@pytest.mark.parametrize("name", DEPTHS)
def test_depth_in_another_form_gives_the_same_bits(name, scene):
    assert numpy.array_equal(ao(scene, depth=DEPTHS[name](scene["depth"]))["ao"], ao(scene)["ao"])


@pytest.mark.parametrize("name", NORMALS)
def test_normals_in_another_form_give_the_same_bits(name, scene):
    assert numpy.array_equal(ao(scene, normal=NORMALS[name](scene["normal"]))["ao"], ao(scene)["ao"])


def test_an_array_of_whole_numbers(scene):
    millimetres = (1000 * numpy.nan_to_num(scene["depth"], posinf=0)).astype(numpy.uint16)
    whole = ao(scene, depth=millimetres)
    assert numpy.array_equal(whole["ao"], ao(scene, depth=millimetres.astype(numpy.float32))["ao"])


def test_a_fourth_component_is_alpha_or_told(scene):
    rgba = numpy.dstack([scene["color"], numpy.full(scene["depth"].shape, 0.5)])
    made = gloam.run("indirect", depth=scene["depth"], normal=scene["normal"], color=rgba, camera=scene["camera"], radius=1.0)
    plain = gloam.run("indirect", depth=scene["depth"], normal=scene["normal"], color=scene["color"], camera=scene["camera"], radius=1.0)
    assert numpy.array_equal(made["indirect"], plain["indirect"])
    assert not any("component" in note for note in made.notes)
    told = ao(scene, normal=NORMALS["(H, W, 4)"](scene["normal"])).notes
    assert "normal: its 4th component is left out; normal has 3" in told


def test_rgba_is_written_with_its_alpha(scene, tmp_path):
    rgba = numpy.dstack([scene["color"], numpy.full(scene["depth"].shape, 0.5, numpy.float32)])
    gloam.write(tmp_path / "rgba.exr", {"depth": scene["depth"], "color": rgba}, camera=scene["camera"])
    read = gloam.read(tmp_path / "rgba.exr")
    assert numpy.array_equal(read["color"], scene["color"]) and (read["alpha"] == 0.5).all()


def test_masks_are_bool_or_numbers(scene):
    mask = numpy.zeros(scene["depth"].shape, bool)
    mask[:, :30] = True
    expected = ao(scene, only=mask.astype(numpy.float32))
    assert expected.skipped_share > 0.1
    for given in (mask, mask[None], 255 * mask.astype(numpy.uint8), mask[::-1].copy()[::-1], Interface(mask)):
        assert numpy.array_equal(ao(scene, only=given)["ao"], expected["ao"])
    test, truth = ao(scene)["ao"], ao(scene, bias=0.1)["ao"]
    figure = gloam.compare(test, truth, mask=mask)["rmse"]
    assert figure == pytest.approx(numpy.sqrt(numpy.mean((test - truth)[mask].astype(float)**2)))
    for given in (mask[..., None], mask.astype(float), numpy.asfortranarray(mask), Interface(mask)):
        assert gloam.compare(test, truth, mask=given)["rmse"] == figure


def test_images_of_any_form_are_compared(scene):
    test, truth = ao(scene)["ao"], ao(scene, bias=0.1)["ao"]
    figures = gloam.compare(test, truth)
    for change in (lambda a: a[None], lambda a: a[..., None], lambda a: a.astype(float), numpy.asfortranarray, Shared, Interface):
        assert gloam.compare(change(test), truth) == figures
        assert gloam.compare(test, change(truth)) == figures
    color = gloam.compare(scene["color"], 0.9 * scene["color"])
    assert gloam.compare(numpy.moveaxis(scene["color"], 2, 0), 0.9 * scene["color"]) == color


def test_views_and_layers_of_any_form():
    pair = gloam.capture("colonnade", 48, 32, ["normal"], stereo=0.065)
    expected = gloam.run("stereo-gtao", pair, radius=0.5)["ao"]
    made = gloam.run("stereo-gtao", depth=[z[None] for z in pair["depth"]], normal=[Shared(numpy.moveaxis(n, 2, 0).copy()) for n in pair["normal"]],
                     camera=pair.camera, radius=0.5)["ao"]
    assert all(numpy.array_equal(a, b) for a, b in zip(made, expected))
    layered = gloam.capture("fence", 48, 32, ["normal"], peel=2)
    stack = numpy.stack([layered["peel.00"], layered["peel.01"]])
    made = gloam.run("dp-gtao", depth=layered["depth"], normal=layered["normal"], peel=stack[None].astype(float), camera=layered.camera, radius=0.5)
    assert numpy.array_equal(made["ao"], gloam.run("dp-gtao", layered, radius=0.5)["ao"])


def test_the_field_of_view_is_that_of_the_image_whatever_its_axes(scene):
    expected = gloam.run("gtao", depth=scene["depth"], fov=60, radius=1.0)["ao"]
    assert numpy.array_equal(gloam.run("gtao", depth=scene["depth"][None], fov=60, radius=1.0)["ao"], expected)


@pytest.mark.parametrize("change, sentence", [
    (lambda z: OfCuPy(z, 2), "plane 'depth' is in the memory of a CUDA device, and gloam takes arrays of the host: array.get()"),
    (lambda z: OfTorch(z, 2), "is in the memory of a CUDA device, and gloam takes arrays of the host: tensor.cpu()"),
    (lambda z: Shared(z, 10), "is in the memory of a ROCm device, and gloam takes arrays of the host: numpy.asarray(array)"),
    (lambda z: type("Graded", (OfTorch,), {"requires_grad": True})(z), "plane 'depth' carries gradients, which end here: tensor.detach()"),
    (lambda z: Shared(numpy.frombuffer(z.tobytes(), numpy.float32).reshape(z.shape)), "plane 'depth': NumPy cannot read this test_arrays.Shared ("),
    (lambda z: z.astype(complex), "plane 'depth' has the dtype complex128; real numbers and bool are allowed: array.astype(numpy.float32)"),
    (lambda z: z.astype(object), "has the dtype object"),
    (lambda z: numpy.ma.masked_greater(z, 9), "plane 'depth' is a masked array"),
    (lambda z: numpy.stack([z, z]), "has the shape (2, 40, 60); (height, width) or (1, height, width) is allowed: array[0] is one image, and list(array)"),
    (lambda z: numpy.dstack([z, z, z]), "has the shape (40, 60, 3); (height, width) is allowed: array[..., 0] is its first component"),
    (lambda z: z.ravel(), "has the shape (2400,); (height, width) or (1, height, width) is allowed"),
    (lambda z: z.tolist(), "plane 'depth' is of type list; an array is allowed, such as numpy.asarray(values, numpy.float32)"),
])
def test_what_is_no_plane_is_told_with_the_call_that_helps(change, sentence, scene):
    with pytest.raises(gloam.Error) as raised:
        gloam.run("gtao", depth=change(scene["depth"]), camera=scene["camera"], radius=1.0)
    assert sentence in str(raised.value) and "\n" not in str(raised.value)


@pytest.mark.parametrize("words, sentence", [
    (dict(normal=numpy.full((40, 60, 3), 128, numpy.uint8)), "plane 'normal' has the dtype uint8, as a picture of normals has it; give array / 255 and normals_are='unsigned'"),
    (dict(roughness=numpy.full((40, 60), 200, numpy.uint8)), "plane 'roughness' has the dtype uint8 and values up to 200, where 1 is the most; give array / 255"),
    (dict(albedo=numpy.full((40, 60, 3), 9000, numpy.int32)), "values up to 9000, where 1 is the most; give array / 65535"),
    (dict(color=numpy.full((40, 60, 4), 255, numpy.uint8)), "alpha, the 4th component of plane 'color', has the dtype uint8 and values up to 255"),
    (dict(camera=numpy.eye(4)), "camera is of type ndarray; a gloam.Camera is allowed: gloam.Camera.from_projection(matrix, 'opengl', width, height)"),
    (dict(camera=numpy.eye(3)), "a gloam.Camera is allowed: gloam.Camera.from_intrinsics(K)"),
    (dict(frame=numpy.zeros((40, 60))), "a gloam.Frame, a path, or arrays by keyword are allowed, depth=array"),
])
def test_what_is_likely_meant_is_told(words, sentence, scene):
    with pytest.raises(gloam.UsageError) as raised:
        gloam.run("gtao", **{"depth": scene["depth"], "camera": scene["camera"], "radius": 1.0, **words})
    assert sentence in str(raised.value), str(raised.value)


def test_pictures_of_bytes_are_not_compared_with_values_up_to_one(scene):
    made = ao(scene)["ao"]
    with pytest.raises(gloam.UsageError, match="test has the dtype uint8 and values up to 255, where 1 is the most; give array / 255"):
        gloam.compare((255 * made).astype(numpy.uint8), made)


def test_none_and_numbers_without_axes(scene):
    expected = ao(scene)["ao"]
    assert numpy.array_equal(ao(scene, color=None, back_depth=None)["ao"], expected)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        made = gloam.run("gtao", depth=scene["depth"], normal=scene["normal"], camera=scene["camera"], radius=numpy.array(1.0))
    assert numpy.array_equal(made["ao"], expected)


def test_notes_on_the_radius_name_the_keyword(scene):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        notes = gloam.run("gtao", depth=scene["depth"], camera=scene["camera"], radius=5000).notes
    assert any("; radius=" in note and "--" not in note for note in notes), notes


def test_normals_of_two_components_are_told(scene):
    with pytest.raises(gloam.Error, match=r"plane 'normal' has the shape \(40, 60, 2\); \(height, width, 3\) or \(3, height, width\) is allowed"):
        gloam.run("gtao", depth=scene["depth"], normal=scene["normal"][..., :2], camera=scene["camera"], radius=1.0)


def test_tensors_of_torch(scene):
    torch = pytest.importorskip("torch")
    tensor = torch.from_numpy(scene["depth"].copy())
    expected = ao(scene)["ao"]
    for given in (tensor, tensor[None], tensor.double(), tensor.t().contiguous().t()):
        assert numpy.array_equal(ao(scene, depth=given)["ao"], expected)
    normal = torch.from_numpy(scene["normal"].copy()).permute(2, 0, 1)[None]
    assert numpy.array_equal(ao(scene, normal=normal)["ao"], expected)
    mask = torch.zeros(tensor.shape, dtype=torch.bool)
    mask[:, :30] = True
    assert numpy.array_equal(ao(scene, only=mask)["ao"], ao(scene, only=mask.numpy())["ao"])
    for given, call in ((tensor.clone().requires_grad_(), "tensor.detach()"), (tensor.bfloat16(), "tensor.float()")):
        with pytest.raises(gloam.UsageError) as raised:
            ao(scene, depth=given)
        assert call in str(raised.value)


@pytest.mark.parametrize("greatest, divisor", [(255, 255), (65535, 65535)])
def test_colour_of_whole_numbers_is_told(greatest, divisor, scene):
    picture = numpy.random.default_rng(1).integers(0, greatest + 1, (*scene["depth"].shape, 3)).astype(numpy.uint16)
    notes = gloam.run("indirect", depth=scene["depth"], color=picture, camera=scene["camera"], radius=1.0).notes
    assert any(f"whole numbers up to {picture.max()}" in note and f"divide by {divisor}" in note for note in notes), notes
    halved = picture * numpy.float32(0.501)
    assert not any("whole numbers" in note for note in gloam.run("indirect", depth=scene["depth"], color=halved, camera=scene["camera"], radius=1.0).notes)
