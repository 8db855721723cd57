"""Frames in other formats than EXR, written by OpenCV, NumPy and h5py: the planes are those of the frame they were made of."""

import os
import pathlib
import subprocess
import sys

import cv2
import numpy
import pytest

import gloam

sys.path.insert(0, str(pathlib.Path(os.environ["GLOAM_SOURCE_DIR"], "bench", "reproduce")))

import of_gbuffer
from exr_files import layer, write_exr

FAR = 200.0  # beyond all that the frame shows


@pytest.fixture(scope="module")
def planes():
    """Depth, normals and colours of 150 x 90 pixels, and their camera's field of view."""
    frame = gloam.capture("colonnade", 150, 90, ["depth", "normal", "color"])
    depth = numpy.ascontiguousarray(frame["depth"])
    assert numpy.isfinite(depth).mean() > 0.5 and not numpy.isfinite(depth).all()
    return {name: numpy.ascontiguousarray(frame[name]) for name in ("depth", "normal", "color")}


def srgb(linear):
    linear = numpy.clip(linear, 0, 1)
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def whole(shares, kind):
    return numpy.round(shares * numpy.iinfo(kind).max).astype(kind)


def read(path, **options):
    return gloam.read(path, fov=60, **options)


def assert_depth(read_depth, depth, step):
    surface = numpy.isfinite(depth)
    assert numpy.array_equal(numpy.isfinite(read_depth), surface)
    assert numpy.abs(read_depth[surface] - depth[surface]).max() <= step


def millimetres(depth):
    return numpy.where(numpy.isfinite(depth), numpy.round(depth * 1000), 0).astype(numpy.uint16)


def bytes_of_24_bits(depth):
    steps = numpy.where(numpy.isfinite(depth), numpy.round(depth / FAR * (2**24 - 1)), 2**24 - 1).astype(numpy.uint32)
    return numpy.stack([steps & 255, steps >> 8 & 255, steps >> 16 & 255], -1).astype(numpy.uint8)


def pfm(depth):
    rows, columns = depth.shape
    return b"Pf\n%d %d\n-1.0\n" % (columns, rows) + depth[::-1].astype("<f4").tobytes()


@pytest.mark.parametrize("name", ["depth.png", "depth.tiff"])
def test_millimetres_of_16_bits(planes, tmp_path, name):
    cv2.imwrite(str(tmp_path / name), millimetres(planes["depth"]))
    frame = read(tmp_path / name, depth_scale=0.001)
    assert_depth(frame["depth"], planes["depth"], 0.00051)
    assert any("whole numbers of 16 bits" in note for note in frame.notes)


def test_the_largest_of_16_bits_is_background(planes, tmp_path):
    depth = millimetres(planes["depth"])
    depth[depth == 0] = 65535
    cv2.imwrite(str(tmp_path / "depth.png"), depth)
    frame = read(tmp_path / "depth.png", depth_scale=0.001)
    assert_depth(frame["depth"], planes["depth"], 0.00051)
    assert any("65535, the largest value" in note for note in frame.notes)


@pytest.mark.parametrize("order", ["low-first", "high-first"])
def test_24_bits_in_three_bytes(planes, tmp_path, order):
    packed = bytes_of_24_bits(planes["depth"])
    cv2.imwrite(str(tmp_path / "depth.png"), packed[..., ::-1] if order == "low-first" else packed)
    for stated in ("auto", order):
        frame = read(tmp_path / "depth.png", depth_scale=FAR, depth_bytes=stated)
        assert_depth(frame["depth"], planes["depth"], 1e-5)
    wrong = read(tmp_path / "depth.png", depth_scale=FAR, depth_bytes="high-first" if order == "low-first" else "low-first")
    assert not numpy.allclose(wrong["depth"], planes["depth"], atol=0.1)


@pytest.mark.parametrize("kind", ["<f4", ">f4", "<f8", ">f8"])
@pytest.mark.parametrize("shape", ["(H, W)", "(1, H, W)", "(H, W, 1)", "columns first"])
def test_arrays_of_numpy(planes, tmp_path, kind, shape):
    depth = planes["depth"].astype(kind)
    as_shape = {"(H, W)": depth, "(1, H, W)": depth[None], "(H, W, 1)": depth[..., None], "columns first": numpy.asfortranarray(depth)}
    numpy.save(tmp_path / "depth.npy", as_shape[shape])
    assert_depth(read(tmp_path / "depth.npy")["depth"], planes["depth"], 0)


def test_half_floats(planes, tmp_path):
    numpy.save(tmp_path / "depth.npy", planes["depth"].astype(numpy.float16))
    assert numpy.array_equal(read(tmp_path / "depth.npy")["depth"], planes["depth"].astype(numpy.float16).astype(numpy.float32))


def test_pfm_has_its_last_row_first(planes, tmp_path):
    (tmp_path / "depth.pfm").write_bytes(pfm(planes["depth"]))
    assert_depth(read(tmp_path / "depth.pfm")["depth"], planes["depth"], 0)


def test_disparities_are_inverse_depth(planes, tmp_path):
    focal, baseline, offset = 500, 0.2, 3
    (tmp_path / "disparity.pfm").write_bytes(pfm(numpy.where(numpy.isfinite(planes["depth"]), focal * baseline / planes["depth"] - offset, numpy.inf)))
    stated = {"depth_scale": 1 / (focal * baseline), "depth_offset": offset / (focal * baseline)}
    frame = read(tmp_path / "disparity.pfm", **stated)
    assert_depth(frame["depth"], planes["depth"], 1e-4)
    assert any("speaks of disparities" in note for note in frame.notes)
    assert_depth(read(tmp_path / "disparity.pfm", depth_is="inverse", **stated)["depth"], planes["depth"], 1e-4)


def test_depth_between_black_and_white(planes, tmp_path):
    near = 1.0
    grey = numpy.where(numpy.isfinite(planes["depth"]), (FAR - planes["depth"]) / (FAR - near), 0).astype(numpy.float32)
    cv2.imwrite(str(tmp_path / "depth.tiff"), grey)
    frame = read(tmp_path / "depth.tiff", depth_scale=near - FAR, depth_offset=FAR)
    assert_depth(frame["depth"], planes["depth"], 2e-5)


def test_whole_numbers_of_the_depth_range(planes, tmp_path):
    near, far = 0.1, 100
    ndc = numpy.where(numpy.isfinite(planes["depth"]), far / (far - near) * (1 - near / planes["depth"]), 1)
    cv2.imwrite(str(tmp_path / "depth.png"), whole(ndc, numpy.uint16))
    depth = read(tmp_path / "depth.png", depth_is="ndc", near=near, far=far)["depth"]
    surface = numpy.isfinite(planes["depth"])
    # half a step of 16 bits, as a share of z^2 / near
    assert (numpy.abs(1 / depth[surface] - 1 / planes["depth"][surface]) <= 0.5 / 65535 / near * 1.01).all()


@pytest.mark.parametrize("name", ["frame.npz", "packed.npz", "frame.hdf5"])
def test_one_file_of_several_arrays(planes, tmp_path, name):
    arrays = {"depth": planes["depth"], "normals": planes["normal"], "colors": planes["color"], "K": numpy.eye(3)}
    if name.endswith("hdf5"):
        h5py = pytest.importorskip("h5py")
        with h5py.File(tmp_path / name, "w") as file:
            for key, array in arrays.items():
                file.create_dataset(key, data=array, compression="gzip" if key == "normals" else None)
            file["version"] = numpy.bytes_("1.0")
    else:
        (numpy.savez if name == "frame.npz" else numpy.savez_compressed)(tmp_path / name, text=numpy.array("a"), **arrays)
    frame = read(tmp_path / name)
    assert set(frame.planes) >= {"depth", "normal", "color"}
    assert_depth(frame["depth"], planes["depth"], 0)
    assert numpy.abs(frame["normal"] - planes["normal"]).max() < 1e-6
    assert numpy.array_equal(frame["color"], planes["color"])
    assert any("'K' of 3x3 is left out" in note for note in frame.notes)


@pytest.mark.parametrize("depth", ["depth", "distance"])
def test_the_hdf5_of_blenderproc(planes, tmp_path, depth):
    """Float depth or distance along the ray, 1e10 where nothing is, normals of the camera from 0 to 1, colours of 8 bits."""
    h5py = pytest.importorskip("h5py")
    length = planes["depth"] if depth == "depth" else rays(planes)
    with h5py.File(tmp_path / "0.hdf5", "w") as file:
        file["colors"], file["normals"] = colours_of_bytes(planes), encoded_normals(planes).astype(numpy.float32)
        file[depth] = numpy.where(numpy.isfinite(length), length, 1e10).astype(numpy.float32)
        file["category_id_segmaps"] = numpy.zeros(length.shape, numpy.uint8)
    frame = read(tmp_path / "0.hdf5")
    assert_depth(frame["depth"], planes["depth"], 1e-4)
    assert {"normal", "color"} <= set(frame.planes)
    assert numpy.abs(frame["normal"] - planes["normal"])[numpy.isfinite(planes["depth"])].max() < 1e-5


def test_observations_of_habitat(planes, tmp_path):
    """By the names of its sensors; planar, and 0 where nothing is."""
    depth = numpy.where(numpy.isfinite(planes["depth"]), planes["depth"], 0)
    colours = numpy.concatenate([colours_of_bytes(planes), numpy.full((*depth.shape, 1), 255, numpy.uint8)], -1)
    numpy.savez(tmp_path / "observations.npz", depth_sensor=depth, color_sensor=colours, semantic_sensor=numpy.zeros(depth.shape, numpy.uint32))
    frame = read(tmp_path / "observations.npz")
    assert_depth(frame["depth"], planes["depth"], 0)
    assert "color" in frame.planes


def test_planes_in_files_of_their_own(planes, tmp_path, command):
    cv2.imwrite(str(tmp_path / "d.png"), millimetres(planes["depth"]))
    cv2.imwrite(str(tmp_path / "n.png"), whole(planes["normal"] * 0.5 + 0.5, numpy.uint16)[..., ::-1])
    cv2.imwrite(str(tmp_path / "c.png"), whole(srgb(planes["color"]), numpy.uint8)[..., ::-1])
    files = {"depth": tmp_path / "d.png", "normal": tmp_path / "n.png", "color": tmp_path / "c.png"}
    frame = read(tmp_path / "d.png", depth_scale=0.001, plane_files=files)
    assert_depth(frame["depth"], planes["depth"], 0.00051)
    surface = numpy.isfinite(planes["depth"])
    assert numpy.abs(frame["normal"] - planes["normal"])[surface].max() < 1e-4
    assert numpy.abs(srgb(frame["color"]) - srgb(planes["color"])).max() < 0.5 / 255 + 1e-6
    assert any("decoded from sRGB" in note for note in frame.notes)
    command("ao", "--depth-file", files["depth"], "--normal-file", files["normal"], "--color-file", files["color"],
            "--depth-scale", 0.001, "--fov", 60, "--radius", 0.5)
    by_files = gloam.read(tmp_path / "d_ao.exr")["ao"]
    by_arrays = gloam.run("ao", depth=planes["depth"], normal=planes["normal"], fov=60, radius=0.5)["ao"]
    assert numpy.sqrt(numpy.mean((by_files - by_arrays) ** 2)) < 0.01


def all_stored_depths(depth, camera):
    """Those of the table in docs/gbuffer.md, and one whose near plane is stated."""
    stored = of_gbuffer.stored_depths(depth, camera)
    return {**stored, "reversed with near": (stored["reversed"][0], {"near": 0.1}, True)}


@pytest.mark.parametrize("scene", ["gallery", "lounge", "courtyard", "corridor", "banquet"])
def test_plane_surfaces_tell_what_depth_means(tmp_path, scene):
    frame = gloam.capture(scene, 640, 360, ["depth"])
    fov = float(numpy.degrees(2 * numpy.arctan(320 / frame.camera.fx)))
    surface = numpy.isfinite(frame["depth"])
    for name, (values, stated, is_length) in all_stored_depths(frame["depth"], frame.camera).items():
        numpy.save(tmp_path / "depth.npy", values.astype(numpy.float32))
        depth = gloam.read(tmp_path / "depth.npy", fov=fov, **stated)
        note = [note for note in depth.notes if note.startswith("depth: taken as")][0]
        if name == "ndc":
            assert "planar" in note and ("though plane surfaces" in note or "0..1" in note), (name, note)
            continue
        both = surface & numpy.isfinite(depth["depth"])
        factors = depth["depth"][both] / frame["depth"][both]
        factor = 1 if is_length else numpy.median(factors)
        if name == "ndc with near and far" and "though all of it lies in 0..1" in note:
            continue  # too flat to tell at this size
        assert numpy.percentile(numpy.abs(factors / factor - 1), 95) < 0.01, (name, note)


def test_no_plane_surface_tells_nothing(tmp_path):
    generator = numpy.random.default_rng(3)
    numpy.save(tmp_path / "depth.npy", 2 + generator.random((360, 640)))
    assert "depth: taken as planar distance along the viewing axis; depth_is= says otherwise" in read(tmp_path / "depth.npy").notes


def test_radiance_pictures(planes, tmp_path):
    cv2.imwrite(str(tmp_path / "color.hdr"), planes["color"][..., ::-1])
    color = read(tmp_path / "color.hdr")["color"]
    largest = planes["color"].max(-1, keepdims=True)
    assert (numpy.abs(color - planes["color"]) <= largest / 128 + 1e-6).all()


# --- Writers of several files: data/writers.json


def secant_of(depth, fov):
    height, width = depth.shape
    focal = width / 2 / numpy.tan(numpy.radians(fov / 2))
    x, y = (numpy.arange(width) + 0.5 - width / 2) / focal, (numpy.arange(height) + 0.5 - height / 2) / focal
    return numpy.sqrt(1 + x[None] ** 2 + y[:, None] ** 2)


def save(path, values):
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix == ".npy":
        numpy.save(path, values)
    elif path.suffix == ".hdf5":
        h5py = pytest.importorskip("h5py")
        with h5py.File(path, "w") as file:
            file["dataset"] = values.astype(numpy.float16)
    elif path.suffix == ".pfm":
        path.write_bytes(pfm(values))
    elif path.suffix == ".exr":
        write_exr(path, values if isinstance(values, dict) else layer("", values, "RGB" if values.ndim == 3 else "Y"))
    else:
        cv2.imwrite(str(path), values[..., ::-1] if values.ndim == 3 else values)


def steps_of(depth, step):
    return numpy.where(numpy.isfinite(depth), numpy.round(depth / step), 65535).astype(numpy.uint16)


def normals_of_bytes(planes):
    return whole(planes["normal"] * 0.5 + 0.5, numpy.uint8)


def colours_of_bytes(planes):
    return whole(srgb(planes["color"]), numpy.uint8)


def rays(planes):
    return (planes["depth"] * secant_of(planes["depth"], 60)).astype(numpy.float32)


def grey_of_depth(planes):
    """As a render pass with red, green and blue holds it, and alpha."""
    return {**layer("", numpy.repeat(planes["depth"][..., None], 3, -1), "RGB", behind=65504), **layer("", numpy.ones_like(planes["depth"]), "A")}


def encoded_normals(planes):
    """From 0 to 1, black where nothing is."""
    return numpy.where(numpy.isfinite(planes["depth"])[..., None], planes["normal"] * 0.5 + 0.5, 0)


# Of each: the depth's file and values, the other planes' files, the flags that the user still has to give, and the step of the depth.
WRITERS = {
    "Hypersim": ("scene_cam_00_geometry_hdf5/frame.0000.depth_meters.hdf5", lambda p: numpy.where(numpy.isfinite(p["depth"]), p["depth"] * secant_of(p["depth"], 60), numpy.nan),
                 {"scene_cam_00_geometry_hdf5/frame.0000.normal_cam.hdf5": lambda p: p["normal"], "scene_cam_00_final_hdf5/frame.0000.color.hdf5": lambda p: p["color"]}, {}, 0.02),
    "Omnidata": ("depth_zbuffer/point_0_view_1_domain_depth_zbuffer.png", lambda p: steps_of(p["depth"], 1 / 512),
                 {"normal/point_0_view_1_domain_normal.png": normals_of_bytes, "rgb/point_0_view_1_domain_rgb.png": colours_of_bytes}, {"fov": 60}, 0.51 / 512),
    "Taskonomy": ("point_0_view_1_domain_depth_euclidean.png", lambda p: steps_of(p["depth"] * secant_of(p["depth"], 60), 1 / 512),
                  {"point_0_view_1_domain_normal.png": normals_of_bytes}, {"fov": 60}, 0.51 / 512),
    "Replicator": ("distance_to_image_plane_0003.npy", lambda p: p["depth"], {"normals_0003.png": normals_of_bytes, "rgb_0003.png": colours_of_bytes}, {"fov": 60}, 0),
    "Replicator rays": ("distance_to_camera_0003.npy", lambda p: p["depth"] * secant_of(p["depth"], 60).astype(numpy.float32), {"normals_0003.png": normals_of_bytes}, {"fov": 60}, 1e-4),
    "Virtual KITTI 2": ("frames/depth/Camera_0/depth_00007.png", lambda p: steps_of(p["depth"], 0.01), {}, {"fov": 60}, 0.0051),
    "TartanAir": ("P000/depth_left/000000_left_depth.npy", lambda p: p["depth"], {"P000/image_left/000000_left.png": colours_of_bytes}, {}, 0),
    "Middlebury": ("Piano/disp0.pfm", lambda p: numpy.where(numpy.isfinite(p["depth"]), 130 * 0.2 / p["depth"] - 0.1, numpy.inf), {"Piano/im0.png": colours_of_bytes}, {}, 1e-3),
    "Kubric": ("depth_00003.tiff", lambda p: numpy.where(numpy.isfinite(p["depth"]), rays(p), 1e10).astype(numpy.float32),
               {"normal_00003.png": lambda p: whole(p["normal"] * 0.5 + 0.5, numpy.uint16), "rgba_00003.png": colours_of_bytes}, {"fov": 60}, 1e-4),
    "Infinigen": ("frames/Depth/camera_0/Depth_0_0_0048_0.npy", lambda p: p["depth"],
                  {"frames/SurfaceNormal/camera_0/SurfaceNormal_0_0_0048_0.npy": lambda p: p["normal"], "frames/Image/camera_0/Image_0_0_0048_0.png": colours_of_bytes}, {"fov": 60}, 0),
    "FlyingThings3D": ("disparity/TRAIN/A/0000/left/0006.pfm", lambda p: numpy.where(numpy.isfinite(p["depth"]), 1050 / p["depth"], 0), {}, {}, 1e-3),
    "BEDLAM2": ("exr_layers/depth/seq_000000/seq_000000_0003_depth.exr", lambda p: layer("", p["depth"], ["Depth"], numpy.float16, behind=65504),
                {"exr_layers/cameranormal/seq_000000/seq_000000_0003_cameranormal.png": normals_of_bytes, "exr_layers/image/seq_000000/seq_000000_0003_image.png": colours_of_bytes}, {"fov": 60}, 0.02),
    "Unity Perception": ("sequence.0/step0.camera.Depth.exr", lambda p: {**layer("", p["depth"], "R"), **layer("", numpy.zeros((90, 150, 2)), "GB"), **layer("", numpy.ones((90, 150)), "A")},
                         {"sequence.0/step0.camera.Normal.exr": encoded_normals, "sequence.0/step0.camera.png": colours_of_bytes}, {"fov": 60}, 0),
    "Movie Render Queue": ("FinalImageMovieRenderQueue_WorldDepth.0003.exr", grey_of_depth,
                           {"FinalImageMovieRenderQueue_WorldNormal.0003.exr": lambda p: p["normal"], "FinalImage.0003.exr": lambda p: p["color"], "FinalImageBaseColor.0003.exr": lambda p: p["color"]}, {"fov": 60, "normal_space": "view"}, 0),
    "a folder for each pass of Unreal": ("seq/FinalImageSceneDepth/0003.exr", grey_of_depth, {"seq/FinalImageWorldNormal/0003.exr": encoded_normals, "seq/FinalImage/0003.png": colours_of_bytes}, {"fov": 60}, 0),
    "Unity Recorder": ("shot_Depth_0003.exr", grey_of_depth, {"shot_Normal_0003.exr": lambda p: p["normal"], "shot_Beauty_0003.exr": lambda p: p["color"], "shot_Albedo_0003.exr": lambda p: p["color"]}, {"fov": 60}, 0),
    "a folder of EXR": ("run/depth/0012.exr", lambda p: p["depth"], {"run/normal/0012.exr": lambda p: p["normal"], "run/image/0012.png": colours_of_bytes}, {"fov": 60}, 0),
    "CARLA": ("run/depth/000012.png", lambda p: bytes_of_24_bits(p["depth"]), {"run/rgb/000012.png": colours_of_bytes, "run/normals/000012.png": normals_of_bytes}, {"fov": 90, "depth_scale": FAR}, 2e-5),
}


@pytest.mark.parametrize("writer", WRITERS)
def test_the_files_of_a_writer(planes, tmp_path, writer):
    file, depth, others, stated, step = WRITERS[writer]
    with numpy.errstate(invalid="ignore"):
        save(tmp_path / file, depth(planes))
    for name, values in others.items():
        save(tmp_path / name, values(planes))
    if writer == "Middlebury":
        (tmp_path / file).with_name("calib.txt").write_text("cam0=[130 0 74.5; 0 130 44.5; 0 0 1]\ncam1=[130 0 77.5; 0 130 44.5; 0 0 1]\ndoffs=0.1\nbaseline=0.2\nwidth=150\nheight=90\nndisp=290\n")
    frame = gloam.read(tmp_path / file, **stated)
    assert_depth(frame["depth"], planes["depth"], step)
    wanted = {"depth"} | {"normal" if "normal" in name.lower() else "albedo" if "BaseColor" in name or "Albedo" in name else "color" for name in others}
    assert set(frame.planes) >= wanted
    assert any("named as by" in note for note in frame.notes)
    surface = numpy.isfinite(planes["depth"])
    if "normal" in wanted:
        assert numpy.abs(frame["normal"] - planes["normal"])[surface].max() < 0.02
    if writer == "Middlebury":
        assert (frame.camera.fx, frame.camera.cx, frame.camera.cy) == (130, 75, 45)
    if fov := {"Hypersim": 60, "TartanAir": 90, "FlyingThings3D": 49.134}.get(writer):
        assert frame.camera.fx == pytest.approx(75 / numpy.tan(numpy.radians(fov / 2)))


@pytest.mark.parametrize("file, steps, fov, color", [("test.depth.00003.png", 255 / 10, None, "test.rgba.00003.png"), ("room0/results/depth000003.png", 6553.5, 90, None)],
                         ids=["Habitat", "Replica"])
def test_depth_of_ten_metres_at_most(planes, tmp_path, file, steps, fov, color):
    surface = numpy.isfinite(planes["depth"])
    depth = numpy.where(surface, 9.9 / planes["depth"][surface].max() * planes["depth"], numpy.inf)
    kind = numpy.uint8 if steps < 256 else numpy.uint16
    save(tmp_path / file, numpy.where(surface, depth * steps, 0).astype(kind))
    if color:
        save(tmp_path / color, colours_of_bytes(planes))
    frame = gloam.read(tmp_path / file, **({} if fov else {"fov": 60}))
    assert_depth(frame["depth"], numpy.where(depth * steps < 1, numpy.inf, depth), 1 / steps)
    assert ("color" in frame.planes) == bool(color) and any("named as by" in note for note in frame.notes)
    if fov:
        assert frame.camera.fx == pytest.approx(75)
    assert any("256 steps are too few for smooth surfaces; store 16 bits, or floats" in note for note in frame.notes) == (kind is numpy.uint8)


def test_pixel_positions_of_unity_give_the_lens(planes, tmp_path):
    depth = planes["depth"]
    height, width = depth.shape
    x, y = (numpy.arange(width) + 0.5 - width / 2) / 100, (numpy.arange(height) + 0.5 - height / 2) / 100
    place = numpy.stack([x[None] * depth, -y[:, None] * depth, depth], -1)
    for name, values in {"Depth": depth, "PixelPosition": place}.items():
        write_exr(tmp_path / f"step3.camera.{name}.exr", layer("", values, "RGB"[:numpy.atleast_3d(values).shape[-1]]))
    frame = gloam.read(tmp_path / "step3.camera.Depth.exr")
    assert frame.camera.fx == pytest.approx(100, rel=1e-3) and any("is in camera space" in note for note in frame.notes)
    assert_depth(frame["depth"], depth, 1e-4)


def test_an_exr_of_more_than_depth_is_read_alone(planes, tmp_path):
    """Names of a writer do not make a depth of a frame with planes of its own, nor of a picture that lies in a folder of that name alone."""
    full = {**layer("", planes["depth"] * 2, "Z"), **layer("", planes["color"], "RGB")}
    write_exr(tmp_path / "shot_Depth_0003.exr", full)
    write_exr(tmp_path / "shot_Normal_0003.exr", layer("", planes["normal"], "RGB"))
    frame = read(tmp_path / "shot_Depth_0003.exr")
    assert set(frame.planes) == {"depth", "color"} and not any("named as by" in note for note in frame.notes)
    save(tmp_path / "depth/beauty.exr", planes["color"])
    assert read(tmp_path / "depth/beauty.exr").planes == ["color"]
    write_exr(tmp_path / "other_Depth_0003.exr", grey_of_depth(planes))
    assert_depth(read(tmp_path / "other_Depth_0003.exr")["depth"], planes["depth"], 0)
    chosen = read(tmp_path / "other_Depth_0003.exr", channels={"depth": "G"})
    assert_depth(chosen["depth"], planes["depth"], 0)


def test_files_of_a_shot_of_passes(planes, tmp_path, command):
    for number in (1, 2):
        for name, values in {"WorldDepth": grey_of_depth(planes), "WorldNormal": planes["normal"]}.items():
            save(tmp_path / f"FinalImage{name}.{number:04}.exr", values)
    assert "2 frames as by Movie Render Queue" in command("ao", tmp_path, status=1)
    told = command("run", "gtao", tmp_path / "FinalImageWorldDepth.####.exr", "--fov", 60, "--normal-space", "view", "--radius", 0.5, "-o", tmp_path / "ao.####.exr", "--float")
    assert "named as by Movie Render Queue: normal from" in told
    found = gloam.read(tmp_path / "ao.0002.exr", as_stored=True)["ao"]
    frame = gloam.run("gtao", depth=planes["depth"], normal=planes["normal"], fov=60, radius=0.5)
    assert numpy.abs(numpy.array(found) - numpy.array(frame["ao"])).max() < 1e-5


def test_occlusion_darkens_the_illumination_of_hypersim(planes, tmp_path, command):
    """color = diffuse_illumination x diffuse_reflectance + residual, of which AO darkens the illumination."""
    pytest.importorskip("h5py")
    generator = numpy.random.default_rng(7)
    shape = (*planes["depth"].shape, 3)
    illumination, reflectance, residual = ((low + generator.random(shape)).astype(numpy.float16).astype(numpy.float64) for low in (0.5, 0, 0))
    geometry, final = tmp_path / "scene_cam_00_geometry_hdf5", tmp_path / "scene_cam_00_final_hdf5"
    with numpy.errstate(invalid="ignore"):
        save(geometry / "frame.0000.depth_meters.hdf5", WRITERS["Hypersim"][1](planes))
    color = (illumination * reflectance + residual).astype(numpy.float16)
    for name, values in {"color": color, "diffuse_illumination": illumination, "diffuse_reflectance": reflectance, "residual": residual}.items():
        save(final / f"frame.0000.{name}.hdf5", values)
    depth = geometry / "frame.0000.depth_meters.hdf5"
    told = command("run", "ao", depth, "--radius", 0.5, "-o", tmp_path / "ao.exr", "--float", "--composite", tmp_path / "c.exr")
    frame, ao = gloam.read(depth), gloam.read(tmp_path / "ao.exr", as_stored=True)["ao"][..., None]
    assert numpy.array_equal(frame["illumination"], illumination) and "named as by Hypersim" in told
    assert "darkens illumination times albedo" in told
    expected = illumination * ao * reflectance + residual
    surface = numpy.isfinite(planes["depth"])
    step = 2.0**-10 + 1e-6  # half a step of halves between 2 and 4, as color is stored
    picture = gloam.read(tmp_path / "c.exr", as_stored=True)["color"]
    assert numpy.abs(picture - expected)[surface].max() <= step
    assert numpy.abs(color * ao - expected)[surface].max() > 20 * step  # what darkening all of it would give
    assert numpy.array_equal(picture[~surface], color[~surface])
    result = gloam.auto(depth, composite=True, color_holds="ambient,shadows,indirect,reflection", radius=0.5)
    own = illumination * result["ao"][..., None] * reflectance + residual
    assert numpy.abs(result.composite - own)[surface].max() <= step
    assert any("darkens illumination times albedo" in note for note in result.notes)


def test_a_folder_gets_the_name_of_a_frame(planes, tmp_path, command):
    for number in (1, 2):
        save(tmp_path / f"out/distance_to_camera_{number:04}.npy", planes["depth"])
    told = command("ao", tmp_path / "out", status=1)
    assert "is a folder; it has 2 frames as by Omniverse Replicator" in told and "distance_to_camera_0001.npy" in told


def test_planes_beside_an_exr(planes, tmp_path):
    numpy.save(tmp_path / "color.npy", planes["color"] * 2)
    gloam.write(tmp_path / "frame.exr", gloam.capture("colonnade", 150, 90, ["depth", "normal", "color"]))
    before, frame = gloam.read(tmp_path / "frame.exr"), gloam.read(tmp_path / "frame.exr", plane_files={"color": tmp_path / "color.npy"})
    assert numpy.array_equal(frame["color"], planes["color"] * 2)
    assert numpy.array_equal(frame["normal"], before["normal"]) and numpy.array_equal(frame["depth"], before["depth"])
    assert repr(frame.camera) == repr(before.camera)


def test_a_shot_of_images(planes, tmp_path, command):
    for number in (7, 8):
        numpy.save(tmp_path / f"depth.{number:04}.npy", planes["depth"] * number)
        numpy.save(tmp_path / f"normal.{number:04}.npy", planes["normal"])
    command("run", "gtao", tmp_path / "depth.####.npy", "--plane-file", f"normal={tmp_path}/normal.####.npy", "--fov", 60,
            "-o", tmp_path / "ao.####.exr", "--radius", 1)
    for number in (7, 8):
        alone = gloam.run("gtao", read(tmp_path / f"depth.{number:04}.npy", plane_files={"normal": tmp_path / f"normal.{number:04}.npy"}), radius=1)
        assert numpy.abs(gloam.read(tmp_path / f"ao.{number:04}.exr")["ao"] - alone["ao"]).max() < 0.001


@pytest.mark.parametrize(
    "words, told",
    [
        (["depth.npy", "--normal-file", "nothing.png"], ["nothing.png", "cannot read"]),
        (["depth.npy", "--normal-file", "depth.npy"], ["depth.npy", "has 1 component, and normal has 3"]),
        (["depth.npy", "--normal-file", "small.npy"], ["small.npy", "8x6", "150x90", "one size"]),
        (["depth.npy", "--plane-file", "nromal=normal.npy"], ["nromal", "no plane has this name", "normal"]),
        (["depth.npy", "--plane-file", "normal"], ["PLANE=FILE"]),
        (["depth.npy", "--depth-file", "depth.npy", "--plane-file", "depth=small.npy"], ["has the file"]),
        (["text.png"], ["text.png", "cannot be read as PNG"]),
        (["text.tif"], ["text.tif", "cannot be read as TIFF"]),
        (["text.npz"], ["text.npz", "cannot be read as NPZ"]),
        (["text.hdf5"], ["text.hdf5", "HDF5"]),
        (["complex.npy"], ["complex.npy", "c8"]),
        (["cube.npy"], ["cube.npy", "(9, 9, 9)"]),
        (["depth.npy", "--into", "copy.exr"], ["depth.npy", "is no EXR"]),
        (["text.txt"], ["text.txt", "not an EXR", "TIFF"]),
    ],
)
def test_wrong_input_gets_one_line(planes, tmp_path, monkeypatch, words, told):
    numpy.save(tmp_path / "depth.npy", planes["depth"])
    numpy.save(tmp_path / "normal.npy", planes["normal"])
    numpy.save(tmp_path / "small.npy", numpy.ones((6, 8, 3), numpy.float32))
    numpy.save(tmp_path / "cube.npy", numpy.ones((9, 9, 9)))
    numpy.save(tmp_path / "complex.npy", numpy.ones((6, 8), numpy.complex64))
    for ending in ("png", "tif", "npz", "hdf5", "txt"):
        (tmp_path / f"text.{ending}").write_text("nothing of an image")
    before = sorted(os.listdir(tmp_path))
    output = [] if "--into" in words else ["-o", "o.exr"]
    done = subprocess.run([os.environ["GLOAM_BINARY"], "run", "gtao", *words, "--fov", "60", *output], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode in (1, 2), done.stderr
    refusal = [line for line in done.stderr.splitlines() if line.startswith("gloam: ")]
    assert len(refusal) == 1, done.stderr
    for text in told:
        assert text in refusal[0]
    assert sorted(os.listdir(tmp_path)) == before


# --- What goes wrong in silence otherwise


@pytest.fixture()
def shot(planes, tmp_path):
    """Two frames of depth and normals, whose names have other digits behind the number."""
    for number in (1, 2):
        numpy.save(tmp_path / f"depth.{number:04}.v2.npy", planes["depth"] * number)
        numpy.save(tmp_path / f"normal.{number:04}.npy", planes["normal"] if number == 1 else -planes["normal"])
    return tmp_path


def run_shot(command, shot, *more):
    return command("run", "gtao", shot / "depth.####.v2.npy", "--normal-file", shot / "normal.####.npy", "--fov", 60, "--radius", 1,
                   "-o", shot / "ao.####.exr", "--normal-space", "view", "--normal-range", "signed", "--normal-axes", "x,y,z", *more)


def test_a_shot_knows_the_numbers_of_its_frames(command, shot):
    run_shot(command, shot, "--resume")
    results = [gloam.read(shot / f"ao.{number:04}.exr")["ao"] for number in (1, 2)]
    depth = numpy.load(shot / "depth.0002.v2.npy")
    alone = gloam.run("gtao", depth=depth, normal=numpy.load(shot / "normal.0002.npy"), fov=60, radius=1, normal_space="view", normal_range="signed", normal_axes="x,y,z")
    assert numpy.abs(results[1] - alone["ao"]).max() < 0.001
    assert not numpy.allclose(results[0], results[1], atol=0.05)


def test_a_shot_is_computed_again_where_a_file_of_a_plane_is_new(command, shot):
    run_shot(command, shot, "--resume")
    before = [(shot / f"ao.{number:04}.exr").stat().st_mtime_ns for number in (1, 2)]
    run_shot(command, shot, "--resume")
    assert [(shot / f"ao.{number:04}.exr").stat().st_mtime_ns for number in (1, 2)] == before
    numpy.save(shot / "normal.0002.npy", numpy.load(shot / "normal.0001.npy"))
    run_shot(command, shot, "--resume")
    after = [(shot / f"ao.{number:04}.exr").stat().st_mtime_ns for number in (1, 2)]
    assert after[0] == before[0] and after[1] != before[1]


def test_python_resumes_where_nothing_of_the_depth_has_changed(shot):
    def write(**stated):
        return gloam.Sequence(shot / "depth.####.v2.npy", fov=60, **stated).write("gtao", shot / "made.####.exr", radius=1, resume=True)

    assert len(write(depth_scale=1.0).done) == 2 and len(write(depth_scale=1.0).done) == 0
    assert len(write(depth_scale=0.5).done) == 2
    assert len(write(depth_scale=0.5, plane_files={"normal": shot / "normal.0001.npy"}).done) == 2


def test_two_eyes_have_no_plane_in_common(planes, tmp_path, command):
    for eye in "LR":
        numpy.save(tmp_path / f"pair_{eye}.npy", planes["depth"])
    numpy.save(tmp_path / "n.npy", planes["normal"])
    told = command("run", "gtao", tmp_path / "pair_L.npy", tmp_path / "pair_R.npy", "--normal-file", tmp_path / "n.npy", "--fov", 60, "-o", tmp_path / "o.exr", status=2)
    assert "one eye" in told
    gloam.write(tmp_path / "pair.exr", gloam.capture("colonnade", 150, 90, ["depth"], stereo=0.065))
    told = command("run", "gtao", tmp_path / "pair.exr", "--normal-file", tmp_path / "n.npy", "-o", tmp_path / "o.exr", status=1)
    assert "file of one view alone" in told


def test_the_header_of_a_frame_does_not_speak_for_planes_of_other_files(planes, tmp_path):
    gloam.write(tmp_path / "frame.exr", gloam.capture("colonnade", 150, 90, ["depth", "normal"]))  # gloamNormalSpace, gloamOrigin
    cv2.imwrite(str(tmp_path / "n.png"), normals_of_bytes(planes)[..., ::-1])
    surface = numpy.isfinite(planes["depth"])
    frame = gloam.read(tmp_path / "frame.exr", plane_files={"normal": tmp_path / "n.png"})
    assert numpy.abs(frame["normal"] - planes["normal"])[surface].max() < 0.02
    numpy.save(tmp_path / "ray.npy", planes["depth"] * 2)
    assert numpy.array_equal(gloam.read(tmp_path / "frame.exr", plane_files={"depth": tmp_path / "ray.npy"})["depth"][surface], 2 * planes["depth"][surface])


def test_the_file_of_the_depth_gives_its_camera(planes, tmp_path):
    gloam.write(tmp_path / "d.exr", gloam.capture("colonnade", 150, 90, ["depth"]))
    numpy.save(tmp_path / "n.npy", planes["normal"])
    alone = gloam.read(tmp_path / "d.exr")
    frame = gloam.read(tmp_path / "d.exr", plane_files={"depth": tmp_path / "d.exr", "normal": tmp_path / "n.npy"})
    assert repr(frame.camera) == repr(alone.camera) and frame.camera.fx != pytest.approx(75 / numpy.tan(numpy.radians(30)))
    assert numpy.array_equal(frame["depth"], alone["depth"])


def test_a_plane_of_a_file_is_of_one_side_of_a_comparison(planes, tmp_path, command):
    for name, factor in (("a", 1), ("b", 2)):
        gloam.write(tmp_path / f"{name}.exr", {"color": planes["color"] * factor})
    numpy.save(tmp_path / "c.npy", planes["color"])
    figures = command("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--plane-file", f"color={tmp_path / 'c.npy'}", "--what", "color", as_json=True)
    assert figures["max"] > 0


def test_a_camera_beside_the_frame_overrules_that_of_the_writer(planes, tmp_path):
    save(tmp_path / "frame.0000.depth_meters.hdf5", planes["depth"])
    (tmp_path / "frame.0000.depth_meters.camera.json").write_text('{"width": 150, "height": 90, "fx": 80, "fy": 80, "cx": 75, "cy": 45, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}')
    assert gloam.read(tmp_path / "frame.0000.depth_meters.hdf5").camera.fx == 80


def test_signs_are_judged_after_the_scale(planes, tmp_path):
    numpy.save(tmp_path / "depth.npy", numpy.where(numpy.isfinite(planes["depth"]), -100 * planes["depth"], 0))
    assert_depth(read(tmp_path / "depth.npy", depth_scale=-0.01)["depth"], planes["depth"], 1e-4)
    verged = numpy.where(numpy.isfinite(planes["depth"]), 100 / planes["depth"] - 20, numpy.inf)  # below 0 far away
    (tmp_path / "disparity.pfm").write_bytes(pfm(verged))
    assert_depth(read(tmp_path / "disparity.pfm", depth_scale=0.01, depth_offset=0.2)["depth"], planes["depth"], 1e-2)


def test_alpha_of_its_own_file_stays(planes, tmp_path):
    numpy.save(tmp_path / "depth.npy", planes["depth"])
    numpy.save(tmp_path / "a.npy", numpy.full(planes["depth"].shape, 0.25, numpy.float32))
    cv2.imwrite(str(tmp_path / "c.png"), numpy.full((*planes["depth"].shape, 4), 255, numpy.uint8))
    frame = read(tmp_path / "depth.npy", plane_files={"alpha": tmp_path / "a.npy", "color": tmp_path / "c.png"})
    assert (frame["alpha"] == 0.25).all()


def test_a_flag_without_effect_is_told(planes, tmp_path):
    numpy.save(tmp_path / "depth.npy", planes["depth"])
    assert any("depth_bytes" in note and "no effect" in note for note in read(tmp_path / "depth.npy", depth_bytes="low-first").notes)


def test_a_picture_composed_of_images(planes, tmp_path, command):
    numpy.save(tmp_path / "depth.npy", planes["depth"])
    numpy.save(tmp_path / "color.npy", planes["color"])
    command("run", "gtao", tmp_path / "depth.npy", "--color-file", tmp_path / "color.npy", "--fov", 60, "--radius", 1, "-o", tmp_path / "ao.exr", "--composite", tmp_path / "graded.exr")
    graded, ao = gloam.read(tmp_path / "graded.exr")["color"], gloam.read(tmp_path / "ao.exr")["ao"]
    assert numpy.abs(graded - planes["color"] * ao[..., None]).max() < 0.01


def tiff(values, photometric=1, orientation=1):
    """A TIFF of 8 bits in one strip."""
    height, width = values.shape
    entries = [(256, width), (257, height), (258, 8), (259, 1), (262, photometric), (273, 8), (274, orientation), (277, 1), (278, height), (279, values.size)]
    fields = b"".join(tag.to_bytes(2, "little") + (4).to_bytes(2, "little") + (1).to_bytes(4, "little") + value.to_bytes(4, "little") for tag, value in entries)
    return b"II*\0" + (8 + values.size).to_bytes(4, "little") + values.astype(numpy.uint8).tobytes() + len(entries).to_bytes(2, "little") + fields + bytes(4)


@pytest.mark.parametrize("bytes_of, told", [
    (tiff(numpy.ones((4, 6)), photometric=0), "photometric interpretation is 0"),
    (tiff(numpy.ones((4, 6)), orientation=3), "orientation is 3"),
])
def test_what_a_tiff_says_of_its_values_is_not_passed_over(tmp_path, bytes_of, told):
    (tmp_path / "depth.tif").write_bytes(tiff(numpy.arange(1, 25).reshape(4, 6)))
    assert numpy.array_equal(read(tmp_path / "depth.tif")["depth"], numpy.arange(1, 25, dtype=numpy.float32).reshape(4, 6))
    (tmp_path / "depth.tif").write_bytes(bytes_of)
    with pytest.raises(gloam.Error, match=told):
        read(tmp_path / "depth.tif")


@pytest.mark.parametrize("name, contents", [
    ("depth.hdr", b"#?RADIANCE\n\n-Y 268435456 +X 1\n" + bytes(1 << 22)),
    ("depth.npy", b"\x93NUMPY\x01\x00\x76\x00" + b"{'descr': '<f4', 'fortran_order': False, 'shape': (268435456, 1, 2), }".ljust(0x75) + b"\n" + bytes(64)),
    ("depth.pfm", b"Pf\n1 268435456\n-1.0\n" + bytes(64)),
])
def test_a_small_file_cannot_claim_much_memory(tmp_path, name, contents):
    import resource
    (tmp_path / name).write_bytes(contents)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(gloam.Error, match=name):
        read(tmp_path / name)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 1 << 18  # kilobytes


def test_a_file_that_is_named_for_a_space_of_normals_states_it(planes, tmp_path):
    numpy.save(tmp_path / "depth.npy", planes["depth"])
    for name, is_world in (("room_WorldNormal", True), ("normal_world", True), ("room_normal", False)):
        numpy.save(tmp_path / f"{name}.npy", planes["normal"])
        frame = read(tmp_path / "depth.npy", plane_files={"normal": tmp_path / f"{name}.npy"})
        assert ("normal" not in frame.planes) == is_world, (name, frame.notes)  # without a pose, world space cannot be used


def test_a_picture_is_no_depth_of_24_bits(planes, tmp_path):
    grey = numpy.clip(numpy.where(numpy.isfinite(planes["depth"]), planes["depth"] / 15, 1) * 255, 0, 255).astype(numpy.uint8)
    cv2.imwrite(str(tmp_path / "depth.png"), cv2.applyColorMap(grey, cv2.COLORMAP_TURBO))
    with pytest.raises(gloam.Error, match="vary alike"):
        read(tmp_path / "depth.png")
    read(tmp_path / "depth.png", depth_bytes="low-first")


def test_a_scale_of_0_is_refused(planes, tmp_path):
    numpy.save(tmp_path / "depth.npy", planes["depth"])
    with pytest.raises(gloam.UsageError, match="depth_scale=0"):
        read(tmp_path / "depth.npy", depth_scale=0)


def test_a_plane_of_a_writer_that_does_not_fit_is_left_out(planes, tmp_path):
    save(tmp_path / "distance_to_image_plane_0000.npy", planes["depth"])
    save(tmp_path / "normals_0000.png", normals_of_bytes(planes)[::2, ::2])
    frame = read(tmp_path / "distance_to_image_plane_0000.npy")
    assert "normal" not in frame.planes and any("normal: left out" in note and "75x45" in note for note in frame.notes)


def test_intrinsics_beside_the_arrays_give_the_field_of_view(planes, tmp_path):
    numpy.savez(tmp_path / "frame.npz", depth=planes["depth"], K=numpy.array([[96.0, 0, 75], [0, 96, 45], [0, 0, 1]]))
    frame = gloam.read(tmp_path / "frame.npz")
    assert frame.camera.fx == pytest.approx(96) and any("matrix 'K'" in note for note in frame.notes)
    assert gloam.read(tmp_path / "frame.npz", fov=60).camera.fx == pytest.approx(75 / numpy.tan(numpy.radians(30)))


def test_a_grey_in_whole_numbers_tells_its_ends(tmp_path):
    frame = gloam.capture("gallery", 640, 360, ["depth"])
    depth, surface = frame["depth"], numpy.isfinite(frame["depth"])
    black, white = 1.2 * depth[surface].max(), 0.5 * depth[surface].min()
    cv2.imwrite(str(tmp_path / "ZDepth.png"), numpy.where(surface, numpy.round(65535 * (black - depth) / (black - white)), 0).astype(numpy.uint16))
    grey = gloam.read(tmp_path / "ZDepth.png", fov=float(numpy.degrees(2 * numpy.arctan(320 / frame.camera.fx))))
    both = surface & numpy.isfinite(grey["depth"])
    factors = grey["depth"][both] / depth[both]
    assert numpy.percentile(numpy.abs(factors / numpy.median(factors) - 1), 95) < 0.02, grey.notes
