"""Frames in other formats than EXR, written by OpenCV, NumPy and h5py: the planes are those of the frame they were made of."""

import os
import subprocess

import cv2
import numpy
import pytest

import gloam

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


@pytest.mark.parametrize("scene", ["gallery", "lounge", "temple", "courtyard", "statue"])
def test_plane_surfaces_tell_the_length_of_the_ray(tmp_path, scene):
    frame = gloam.capture(scene, 640, 360, ["depth"])
    depth, camera = frame["depth"], frame.camera
    x, y = (numpy.arange(640) + 0.5 - camera.cx) / camera.fx, (numpy.arange(360) + 0.5 - camera.cy) / camera.fy
    secant = numpy.sqrt(1 + x[None] ** 2 + y[:, None] ** 2)
    fov = numpy.degrees(2 * numpy.arctan(320 / camera.fx))
    near, far = 0.1, 500.0
    stored = {"z": depth, "ray": depth * secant, "disparity": 100 / depth, "ndc": far / (far - near) * (1 - near / depth)}
    notes = {}
    for name, values in stored.items():
        numpy.save(tmp_path / "depth.npy", numpy.where(numpy.isfinite(depth), values, 1 if name == "ndc" else 0).astype(numpy.float32))
        read_frame = gloam.read(tmp_path / "depth.npy", fov=fov)
        notes[name] = [note for note in read_frame.notes if note.startswith("depth: taken as")][0]
        if name in ("z", "ray"):
            assert numpy.allclose(read_frame["depth"], depth, rtol=1e-4), notes[name]
    assert "as the distance along the ray, by which plane surfaces are plane" in notes["ray"]
    if scene != "temple":  # whose plane surfaces are far and small at this size
        assert "1/z is a linear function of it" in notes["disparity"] and "disparity" in notes["disparity"]
    assert "distance along the ray" not in notes["ndc"] and "by which plane" not in notes["ndc"]
    assert "distance along the ray" not in notes["z"]


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
    else:
        cv2.imwrite(str(path), values[..., ::-1] if values.ndim == 3 else values)


def steps_of(depth, step):
    return numpy.where(numpy.isfinite(depth), numpy.round(depth / step), 65535).astype(numpy.uint16)


def normals_of_bytes(planes):
    return whole(planes["normal"] * 0.5 + 0.5, numpy.uint8)


def colours_of_bytes(planes):
    return whole(srgb(planes["color"]), numpy.uint8)


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
    wanted = {"depth"} | {"normal" for name in others if "normal" in name} | {"color" for name in others if "normal" not in name}
    assert set(frame.planes) >= wanted
    assert any("named as by" in note for note in frame.notes)
    surface = numpy.isfinite(planes["depth"])
    if "normal" in wanted:
        assert numpy.abs(frame["normal"] - planes["normal"])[surface].max() < 0.02
    if writer == "Middlebury":
        assert (frame.camera.fx, frame.camera.cx, frame.camera.cy) == (130, 75, 45)
    if writer in ("Hypersim", "TartanAir"):
        assert frame.camera.fx == pytest.approx(75 / numpy.tan(numpy.radians(30 if writer == "Hypersim" else 45)))


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
