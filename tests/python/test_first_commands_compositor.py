"""What a compositor does first works on an empty account: a file of a renderer with its layers in, AO as a file, as a layer of a copy, as a
picture and laid over the colour, of one frame and of a shot. The files are made, with the names that the renderers' documentation has."""

import shutil

import numpy
import pytest

import gloam
from exr_files import in_the_world, layer, write_exr
from first_user import User

pytest.importorskip("cv2")
SIZE = 192, 108


@pytest.fixture(scope="module")
def scene():
    frame = gloam.capture("lounge", *SIZE, ["normal", "color", "albedo", "emission"])
    place, facing = in_the_world(frame)
    return {**{name: numpy.array(frame[name]) for name in frame}, "position": place, "facing": facing, "camera": frame.camera}


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(scope="module")
def truth(scene):
    """AO of the same frame with all that is known of it."""
    return numpy.array(gloam.run("ao", depth=scene["depth"], normal=scene["normal"], camera=scene["camera"], radius=0.5)["ao"])


def beauty(scene):
    return {**layer("", scene["color"], "RGB", numpy.float16), **layer("", numpy.isfinite(scene["depth"]), "A", numpy.float16)}


def arnold(scene):
    return {**beauty(scene), **layer("", scene["depth"], "Z", behind=1e30), **layer("N", scene["facing"], "XYZ"), **layer("P", scene["position"], "XYZ"),
            **layer("diffuse_albedo", scene["albedo"], "RGB", numpy.float16), **layer("emission", scene["emission"], "RGB", numpy.float16),
            **layer("crypto_object00", numpy.arange(4 * SIZE[0] * SIZE[1]).reshape(SIZE[1], SIZE[0], 4) % 97 / 97, "RGBA")}


def karma(scene):
    """As Houdini writes it: each layer is a part, depth is the camera's z."""
    return {"C": beauty(scene), "Pz": layer("Pz", -scene["depth"], "Y"), "N": layer("N", scene["facing"], "XYZ"),
            "P": layer("P", scene["position"], "XYZ"), "albedo": layer("albedo", scene["albedo"], "RGB", numpy.float16)}


def vray(scene):
    """Sampler Info by names that nobody else gives, and a grey of the depth that is no distance."""
    return {**beauty(scene), **layer("SamplerInfo_P", scene["position"], "RGB"), **layer("SamplerInfo_N", scene["facing"], "RGB"),
            **layer("VRayZDepth", numpy.clip((10 - scene["depth"]) / 8, 0, 1), "Z"),
            **layer("VRaySelfIllumination", scene["emission"], "RGB", numpy.float16)}


FLAGS = {arnold: "", karma: "", vray: " --plane position=SamplerInfo_P --plane normal=SamplerInfo_N"}


@pytest.mark.parametrize("writer", [arnold, karma, vray])
def test_the_first_commands(tmp_path, cache, scene, truth, writer):
    user, flags = User(tmp_path, cache), FLAGS[writer]
    original = user.work / "comp.exr"
    write_exr(original, writer(scene))
    kept = original.read_bytes()

    first = user.type("gloam info comp.exr" + flags).splitlines()[0]
    assert first.startswith("Ambient occlusion can be computed: from ") and "by a camera fitted to its positions" in first, first

    said = user.type("gloam ao comp.exr --radius 0.5 -o ao.exr" + flags)
    found = numpy.array(gloam.read(user.work / "ao.exr", planes=["ao"])["ao"])
    assert numpy.sqrt(numpy.mean((found - truth) ** 2)) < 0.01, said
    user.expect_grey("ao.exr", truth.mean())

    user.type("gloam ao comp.exr --radius 0.5 --into with_ao.exr" + flags)
    own, copied = gloam.read(original, planes=["color"]), gloam.read(user.work / "with_ao.exr", planes=["color", "ao"])
    assert numpy.array_equal(own["color"], copied["color"]) and numpy.array_equal(copied["ao"], found)

    user.type("gloam ao comp.exr --radius 0.5 -o ao.png" + flags)
    user.expect_grey("ao.png", truth.mean(), 0.03)

    user.type("gloam auto comp.exr --composite picture.exr" + flags)
    picture, colour = user.channels("picture.exr")[..., :3], numpy.array(own["color"])[..., ::-1]
    assert picture.shape == colour.shape and numpy.isfinite(picture).all()
    assert 0.5 * colour.mean() < picture.mean() < 1.5 * colour.mean() and numpy.abs(picture - colour).mean() > 1e-3

    assert original.read_bytes() == kept
    if shutil.which("oiiotool"):
        status, out, err = user.tell("oiiotool --info -a -v with_ao.exr")
        assert status == 0 and "gloam.ao" in out, out + err
        assert user.tell("oiiotool --stats ao.exr")[0] == 0 and user.tell("oiiotool picture.exr -o half.exr")[0] == 0


def test_a_shot(tmp_path, cache, scene):
    user = User(tmp_path, cache)
    for number in range(1001, 1004):
        write_exr(user.work / f"shot.{number}.exr", arnold(scene))
    said = user.type("gloam info shot.####.exr")
    assert said.startswith("Ambient occlusion can be computed"), said
    status, out, err = user.tell("gloam ao shot.####.exr -o ao.####.exr --radius 0.5")
    assert status == 0, err
    user.check_proposals("gloam ao shot.####.exr -o ao.####.exr --radius 0.5", out + err)
    means = [user.expect_grey(f"ao.{number}.exr").mean() for number in range(1001, 1004)]
    assert max(means) - min(means) < 1e-6
    status, out, err = user.tell("gloam ao shot.####.exr --into with_ao.####.exr --composite with_ao.####.exr --radius 0.5")
    assert status == 0, err
    assert sorted(path.name for path in user.work.iterdir()) == sorted(
        f"{name}.{number}.exr" for name in ("shot", "ao", "with_ao") for number in range(1001, 1004))


def test_what_is_typed_wrong_is_told(tmp_path, cache, scene):
    """Each line that somebody types before reading a help says which words to type."""
    user = User(tmp_path, cache)
    write_exr(user.work / "comp.exr", arnold(scene))
    write_exr(user.work / "vray.exr", {name: values for name, values in vray(scene).items() if not name.startswith("VRayZDepth")})
    for line, sentences in {
            "gloam auto comp.exr --composite -o out.exr": ["--composite needs a value, OUT.exr, and the next word, -o, is a flag"],
            "gloam ao comp.exr --into -o ao.exr": ["--into needs a value, COPY.exr, and the next word, -o, is a flag"],
            "gloam ao comp.exr --radius --preset ultra": ["--radius needs a value, and the next word, --preset, is a flag"],
            "gloam ao comp.exr --into comp.exr": ["is also the frame; name another file"],
            "gloam ao vray.exr": ["needs 'depth'", "--plane depth=CHANNEL", "--plane position=LAYER"]}.items():
        status, out, err = user.tell(line)
        assert status in (1, 2) and err.count("\n") == 1 and all(sentence in err for sentence in sentences), (line, err)
    said = user.type("gloam info vray.exr")
    assert said.startswith("Ambient occlusion cannot be computed: the file lacks depth") and "--plane position=LAYER" in said.splitlines()[0], said
    assert sorted(path.name for path in user.work.iterdir()) == ["comp.exr", "vray.exr"]
