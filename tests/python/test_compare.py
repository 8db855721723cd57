"""compare: the figures of the command; FLIP against published values, SSIM against OpenCV's own."""

import os
import pathlib

import numpy
import pytest

import gloam

DATA = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"], "data")
FIGURES = ("pixels", "mae", "rmse", "bias", "psnr", "max", "over_1_255", "over_0_05", "ssim", "gmsd")


def plain(*colour):
    return numpy.tile(numpy.array(colour, numpy.float32), (8, 8, 1))


@pytest.mark.parametrize("a, b, flip", [
    ((0, 1, 0), (0, 0, 1), 1),
    ((0, 0, 0), (1, 1, 1), 0.9673797627205596),
    ((0.25, 0.25, 0.25), (0.5, 0.5, 0.5), 0.4518496411120435),
    ((0.2, 0.7, 0.4), (0.2, 0.7, 0.4), 0),
])
def test_flip_of_plain_images_as_the_authors_have_it(a, b, flip):
    # By the Python code of FLIP's authors (github.com/NVlabs/flip), on these images.
    assert gloam.compare(plain(*a), plain(*b))["flip"] == pytest.approx(flip, abs=1e-7)


def test_flip_of_edges_and_colours_as_the_authors_have_it():
    x, y = numpy.meshgrid(numpy.arange(56.0), numpy.arange(40.0))
    truth = numpy.stack([0.5 + 0.4 * numpy.sin(0.3 * x), 0.5 + 0.4 * numpy.cos(0.2 * y), numpy.where(x > y, 0.8, 0.2)], axis=2)
    test = numpy.stack([0.5 + 0.4 * numpy.sin(0.3 * x + 0.4), 0.45 + 0.4 * numpy.cos(0.2 * y), numpy.where(x > y + 2, 0.7, 0.2)], axis=2)
    assert gloam.compare(test.astype(numpy.float32), truth.astype(numpy.float32))["flip"] == pytest.approx(0.3003879421932732, abs=1e-6)


def test_ssim_is_opencvs():
    cv2 = pytest.importorskip("cv2")
    if not hasattr(cv2, "quality"):
        pytest.skip("this OpenCV has no module quality")
    random = numpy.random.default_rng(3)
    truth = cv2.GaussianBlur(random.random((90, 150), numpy.float32), (0, 0), 3)
    test = numpy.clip(truth + random.normal(0, 0.02, truth.shape).astype(numpy.float32), 0, 1)
    expected = cv2.quality.QualitySSIM_compute(test * 255, truth * 255)[0][0]
    assert gloam.compare(test, truth)["ssim"] == pytest.approx(expected, abs=1e-6)


def test_rmse_and_bias_are_those_of_numpy():
    random = numpy.random.default_rng(4)
    a, b = random.random((90, 150), numpy.float32), random.random((90, 150), numpy.float32)
    mask = random.random((90, 150)) > 0.3
    figures = gloam.compare(a, b, mask=mask)
    difference = a.astype(float)[mask] - b.astype(float)[mask]
    assert figures["pixels"] == mask.sum()
    assert figures["rmse"] == pytest.approx(numpy.sqrt((difference**2).mean()), rel=1e-12)
    assert figures["bias"] == pytest.approx(difference.mean(), rel=1e-9)
    assert figures["max"] == pytest.approx(abs(difference).max(), rel=1e-12)


def test_figures_are_the_commands(command, tmp_path):
    result = gloam.run("gtao", DATA / "loggia.exr", radius=0.5)
    gloam.write(tmp_path / "ao.exr", result)
    expected = command("compare", tmp_path / "ao.exr", DATA / "loggia_ao_ref.exr", as_json=True)
    for test in (result, tmp_path / "ao.exr", gloam.read(tmp_path / "ao.exr")):
        figures = gloam.compare(test, DATA / "loggia_ao_ref.exr")
        assert {name: figures[name] for name in FIGURES} == {name: expected[name] for name in FIGURES}
        assert (figures["plane"], figures["truth_plane"]) == ("ao", "ao")
    raw = command("compare", tmp_path / "ao.exr", DATA / "loggia_ao_ref.exr", "--what", "ao_raw", as_json=True)
    assert gloam.compare(result, DATA / "loggia_ao_ref.exr", plane="ao_raw")["rmse"] == raw["rmse"]
    assert gloam.compare(result["ao"], DATA / "loggia_ao_ref.exr", frame=DATA / "loggia.exr")["rmse"] == expected["rmse"]
    assert gloam.compare(result["ao"], gloam.read(DATA / "loggia_ao_ref.exr"))["rmse"] == expected["rmse"]


def test_two_views_are_pooled(command, tmp_path):
    gloam.write(tmp_path / "pair.exr", gloam.capture("colonnade", 96, 64, ["normal"], stereo=0.065))
    a, b = gloam.run("gtao", tmp_path / "pair.exr", radius=0.5), gloam.run("hbao", tmp_path / "pair.exr", radius=0.5)
    gloam.write(tmp_path / "a.exr", a)
    gloam.write(tmp_path / "b.exr", b)
    expected = command("compare", tmp_path / "a.exr", tmp_path / "b.exr", as_json=True)
    figures = gloam.compare(a, b)
    assert figures["rmse"] == expected["rmse"] and figures["views"]["right"]["ssim"] == expected["views"]["right"]["ssim"]


def test_equal_images_have_no_psnr():
    figures = gloam.compare(plain(0.2, 0.3, 0.4), plain(0.2, 0.3, 0.4))
    assert figures["psnr"] is None and figures["rmse"] == 0 and figures["ssim"] == 1


def test_background_that_is_not_known_is_told():
    with pytest.warns(gloam.Note, match="no depth on either side: every pixel counts"):
        figures = gloam.compare(plain(1, 0, 0), plain(0, 1, 0))
    assert figures["pixels"] == 64 and figures["notes"]


@pytest.mark.parametrize("call, sentence", [
    (lambda a, f: gloam.compare(a, a[:-1].copy()), "the reference (89, 150)"),
    (lambda a, f: gloam.compare(a, numpy.stack([a] * 3, 2)), "the test has the shape (90, 150), and the reference (90, 150, 3)"),
    (lambda a, f: gloam.compare(a, a, mask=numpy.zeros(a.shape, bool)), "all 150x90 pixels are background"),
    (lambda a, f: gloam.compare(a, a, mask=numpy.zeros((3, 3), bool)), "mask has the dtype bool and the shape (3, 3)"),
    (lambda a, f: gloam.compare(a, a, mask=[1]), "mask is of type list; an array is allowed"),
    (lambda a, f: gloam.compare(a, a * numpy.float32("nan")), "the truth image is nan at pixel (0, 0)"),
    (lambda a, f: gloam.compare(a.astype(complex), a), "test has the dtype complex128"),
    (lambda a, f: gloam.compare(a, 3), "reference is of type int"),
    (lambda a, f: gloam.compare(f, f, plane="nromal"), "did you mean 'normal'?"),
    (lambda a, f: gloam.compare({"ao": a}, {"reflection": numpy.stack([a] * 4, 2)}), "cannot be compared"),
    (lambda a, f: gloam.compare(a, a, exposure=-1), "exposure -1 is not allowed"),
    (lambda a, f: gloam.compare(a, a, frame={"ao": a}), "has no depth to tell the background by"),
    (lambda a, f: gloam.compare(a, "none.exr"), "none.exr"),
])
def test_comparisons_that_cannot_be(call, sentence, frame):
    with pytest.raises(gloam.Error) as raised:
        call(numpy.random.default_rng(5).random((90, 150), numpy.float32), frame)
    assert sentence in str(raised.value) and "\n" not in str(raised.value), str(raised.value)
