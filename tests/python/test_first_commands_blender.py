"""What a Blender user does first works on an empty account, with a multilayer file as the render settings write it: without the add-on, whose
commands docs/blender.md has and the test of that page runs. One file is made, with Blender's names; the other is rendered, where Blender is."""

import pathlib
import re
import shutil

import numpy
import pytest

import gloam
from exr_files import in_the_world, layer, write_exr
from first_user import User

pytest.importorskip("cv2")
MAKE = pathlib.Path(__file__).parents[1] / "blender" / "addon" / "make.py"
PASSES = """import bpy
scene = bpy.context.scene; view = scene.view_layers[0]; scene.render.engine = 'CYCLES'; scene.cycles.samples = 16
view.use_pass_z = view.use_pass_normal = view.use_pass_ambient_occlusion = view.use_pass_diffuse_color = True
scene.camera.data.dof.use_dof = False
if not scene.world: scene.world = bpy.data.worlds.new('world')
scene.world.light_settings.distance = 0.5
scene.render.image_settings.file_format = 'OPEN_EXR_MULTILAYER'; scene.render.image_settings.color_depth = '32'
"""


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("cache")


def blender_channels(frame, *more):
    place, facing = in_the_world(frame)
    colour = numpy.dstack([frame["color"], numpy.isfinite(frame["depth"])])
    return {**layer("ViewLayer.Combined", colour, "RGBA", numpy.float16), **layer("ViewLayer.Depth", frame["depth"], "Z", behind=1e10),
            **layer("ViewLayer.Normal", facing, "XYZ"), **layer("ViewLayer.DiffCol", frame["albedo"], "RGB", numpy.float16),
            **(layer("ViewLayer.Position", place, "XYZ") if "Position" in more else {})}


HEADER = {"BlenderMultiChannel": "Blender V2.55.1 and newer", "Camera": "Camera", "Scene": "Scene", "Frame": "0001"}


@pytest.fixture(scope="module")
def frame():
    return gloam.capture("lounge", 192, 108, ["normal", "color", "albedo"])


def test_a_frame_with_positions(tmp_path, cache, frame):
    user = User(tmp_path, cache)
    write_exr(user.work / "render.exr", blender_channels(frame, "Position"), HEADER)
    truth = numpy.array(gloam.run("ao", frame, radius=0.5)["ao"])

    said = user.type("gloam info render.exr")
    assert said.startswith("Ambient occlusion can be computed: from depth and normals, by a camera fitted to its positions"), said
    assert "import bpy" not in said
    user.type("gloam ao render.exr --radius 0.5")
    found = numpy.array(gloam.read(user.work / "render_ao.exr", planes=["ao"])["ao"])
    assert numpy.sqrt(numpy.mean((found - truth) ** 2)) < 0.01
    user.expect_grey("render_ao.exr", truth.mean())
    user.type("gloam ao render.exr --radius 0.5 -o ao.png")
    user.expect_grey("ao.png", truth.mean(), 0.03)
    user.type("gloam view render.exr render_ao.exr -o look.html")
    user.type("gloam auto render.exr --composite picture.exr --explain why.png")
    picture, colour = user.channels("picture.exr")[..., :3], numpy.array(frame["color"])
    assert 0.5 * colour.mean() < picture.mean() < 1.5 * colour.mean() and user.channels("why.png").std() > 10


@pytest.mark.parametrize("name", ["render.####.exr", "render####.exr"])
def test_a_shot(tmp_path, cache, frame, name):
    """Output //render.#### or //render of the render settings."""
    user = User(tmp_path, cache)
    for number in (1, 2, 3):
        write_exr(user.work / name.replace("####", f"{number:04}"), blender_channels(frame, "Position"), {**HEADER, "Frame": f"{number:04}"})
    status, out, err = user.tell(f"gloam run ao {name} -o ao.####.exr --frames 1-3 --radius 0.5 --resume")
    assert status == 0, err
    user.check_proposals("gloam run ao", out + err)
    for number in (1, 2, 3):
        user.expect_grey(f"ao.{number:04}.exr", numpy.array(gloam.run("ao", frame, radius=0.5)["ao"]).mean())


def test_a_frame_without_a_camera(tmp_path, cache, frame):
    """The guess is said by every command, with the way out."""
    user = User(tmp_path, cache)
    write_exr(user.work / "render.exr", blender_channels(frame), HEADER)
    said = user.type("gloam info render.exr")
    assert "by a camera that is a guess" in said.splitlines()[0] and "import bpy" in said
    said = user.type("gloam ao render.exr")
    assert "(--fov, --camera; gloam info prints lines with which Blender writes it)" in said, said
    user.expect_grey("render_ao.exr")
    assert "gloam info" not in user.type("gloam ao render.exr --fov 76")


@pytest.mark.skipif(not shutil.which("blender"), reason="no blender to render with")
def test_a_render(tmp_path, cache):
    """The lines of gloam info, pasted into Blender's console, and what Cycles' own pass says."""
    user = User(tmp_path, cache)
    blend = str(user.home / "shot.blend")
    user.type(f"blender -b --factory-startup --python-exit-code 1 -P {MAKE} -- frame {blend} {user.home / 'scene.obj'} 100")
    (user.home / "passes.py").write_text(PASSES + f"bpy.ops.wm.save_as_mainfile(filepath={blend!r})\n")
    user.type(f"blender -b {blend} --python-exit-code 1 -P {user.home / 'passes.py'}")
    user.type(f"blender -b {blend} -o //../work/render.#### -F OPEN_EXR_MULTILAYER -f 1")
    assert [path.name for path in user.work.iterdir()] == ["render.0001.exr"]

    said = user.type("gloam info render.0001.exr")
    assert "by a camera that is a guess" in said.splitlines()[0], said
    lines = re.search(r"^import bpy.*?^open\(.*?$", said, re.MULTILINE | re.DOTALL)
    (user.home / "console.py").write_text(lines[0])
    user.type(f"blender -b {blend} --python-exit-code 1 -P {user.home / 'console.py'}")
    assert "by the camera in the JSON beside it" in user.type("gloam info render.0001.exr").splitlines()[0]

    said = user.type("gloam ao render.0001.exr --radius 0.5")
    assert "assumed" not in said, said
    user.expect_grey("render.0001_ao.exr")
    rmse = re.search(r"RMSE +([\d.]+)", user.type("gloam compare render.0001_ao.exr render.0001.exr -o difference.png"))
    assert float(rmse[1]) < 0.08  # docs/blender.md: .0555 without the noise of few samples
    user.type("gloam auto render.0001.exr --composite picture.exr")
    assert user.channels("picture.exr")[..., :3].mean() > 0.01
