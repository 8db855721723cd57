"""Cameras of other programs' matrices put points where those programs draw them, and matrices of another kind are refused with the reason."""

import numpy
import pytest

import gloam

WIDTH, HEIGHT = 320, 180
INFINITY = float("inf")


def frustum(convention, ahead, y_down, left, right, bottom, top, near, far, is_reversed, z=None):
    """A projection for column vectors, from its definition: x and y of the near plane's corners go to -1 and 1, and depths `near` and `far` to the
    ends of z. `ahead`: the sign of z before the camera; `y_down`: of the view space."""
    lowest = (-1 if convention == "opengl" else 0) if z is None else z
    ends = (1, lowest) if is_reversed else (lowest, 1)
    # z over w is a + b / depth.
    b = (ends[0] - ends[1]) * near if far == INFINITY else (ends[0] - ends[1]) / (1 / near - 1 / far)
    a = ends[1] if far == INFINITY else ends[0] - b / near
    up = -1 if y_down else 1  # of the view space
    down = -1 if convention == "vulkan" else 1  # of the image
    m = numpy.zeros((4, 4))
    m[0, 0] = 2 * near / (right - left)
    m[0, 2] = -ahead * (right + left) / (right - left)
    m[1, 1] = down * up * 2 * near / (top - bottom)
    m[1, 2] = -ahead * down * (top + bottom) / (top - bottom)
    m[2, 2], m[2, 3] = ahead * a, b
    m[3, 2] = ahead
    return m


def box(convention, ahead, y_down, left, right, bottom, top, near, far, is_reversed):
    """The orthographic one."""
    lowest = -1 if convention == "opengl" else 0
    ends = (1, lowest) if is_reversed else (lowest, 1)
    slope = (ends[1] - ends[0]) / (far - near)
    down = -1 if convention == "vulkan" else 1
    m = numpy.eye(4)
    m[0, 0], m[0, 3] = 2 / (right - left), -(right + left) / (right - left)
    m[1, 1] = down * (-1 if y_down else 1) * 2 / (top - bottom)
    m[1, 3] = -down * (top + bottom) / (top - bottom)
    m[2, 2], m[2, 3] = ahead * slope, ends[0] - slope * near
    return m


def drawn(m, convention, point):
    """Where a program draws a point of its view space, pixels from the top left corner, and its window depth."""
    clip = m @ numpy.append(point, 1)
    x, y, z = clip[:3] / clip[3]
    if convention != "vulkan":
        y = -y
    return (1 + x) / 2 * WIDTH, (1 + y) / 2 * HEIGHT, z


def expected(camera, point, ahead, y_down):
    x, y, depth = point[0], -point[1] if y_down else point[1], ahead * point[2]
    by = 1 if camera.orthographic else depth
    return camera.cx + camera.fx * x / by, camera.cy - camera.fy * y / by


SPACES = [("opengl", -1, False), ("vulkan", -1, False), ("vulkan", 1, True), ("vulkan", 1, False), ("unreal", 1, False)]
POINTS = [(0.3, -0.2, 4.0), (-1.5, 0.7, 2.5), (0, 0, 1), (2, 1, 30)]


def as_given(m, convention):
    return m.T if convention == "unreal" else m


@pytest.mark.parametrize("far", [50.0, INFINITY])
@pytest.mark.parametrize("is_reversed", [False, True])
@pytest.mark.parametrize("edges", [(-0.2, 0.2, -0.1, 0.1), (-0.1, 0.3, -0.05, 0.25)], ids=["middle", "off-axis"])
@pytest.mark.parametrize("convention, ahead, y_down", SPACES)
@pytest.mark.parametrize("make", [frustum, box])
def test_a_projection_draws_points_where_its_program_does(make, convention, ahead, y_down, edges, is_reversed, far):
    if make is box and (far == INFINITY or (convention == "vulkan" and ahead > 0 and not y_down)):
        pytest.skip("no such orthographic camera")
    near = 0.25
    m = make(convention, ahead, y_down, *edges, near, far, is_reversed)
    camera = gloam.Camera.from_projection(as_given(m, convention), convention, WIDTH, HEIGHT)
    assert camera.orthographic == (make is box)
    for x, y, depth in POINTS:
        point = (x, y, ahead * depth)
        assert numpy.allclose(drawn(m, convention, point)[:2], expected(camera, point, ahead, y_down), rtol=0, atol=1e-9)
    assert camera.near == pytest.approx(near, rel=1e-9) and camera.far == pytest.approx(far, rel=1e-9)
    single = gloam.Camera.from_projection(as_given(m, convention).astype(numpy.float32), convention, WIDTH, HEIGHT)
    assert single.fx == pytest.approx(camera.fx, rel=1e-6) and single.near == pytest.approx(near, rel=1e-5)


def test_known_matrices():
    # gluPerspective(60, 16/9, 0.1, 100): f = cot 30 degrees.
    f = 3**0.5
    gl = [[f * 9 / 16, 0, 0, 0], [0, f, 0, 0], [0, 0, -100.1 / 99.9, -20 / 99.9], [0, 0, -1, 0]]
    camera = gloam.Camera.from_projection(gl, "opengl", 1920, 1080)
    assert (camera.fx, camera.fy) == (pytest.approx(540 * f), pytest.approx(540 * f)) and (camera.cx, camera.cy) == (960, 540)
    assert (camera.near, camera.far) == (pytest.approx(0.1), pytest.approx(100))
    assert camera.fx == pytest.approx(gloam.Camera.from_fov(60, 1920, 1080, axis="vertical").fx)
    # FReversedZPerspectiveMatrix of 90 degrees, 16:9, near plane at 10 cm: rows are vectors.
    unreal = [[1, 0, 0, 0], [0, 16 / 9, 0, 0], [0, 0, 0, 1], [0, 0, 10, 0]]
    camera = gloam.Camera.from_projection(unreal, "unreal", 1920, 1080)
    assert (camera.fx, camera.fy, camera.cx, camera.cy, camera.near, camera.far) == (960, 960, 960, 540, 10, INFINITY)
    # glm::perspectiveRH_ZO(radians(90), 1, 0.5, 8) with row 1 negated, as of a program with Vulkan.
    vulkan = [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -8 / 7.5, -4 / 7.5], [0, 0, -1, 0]]
    camera = gloam.Camera.from_projection(vulkan, "vulkan", 100, 100)
    assert (camera.fx, camera.fy, camera.cy, camera.near, camera.far) == (50, 50, 50, pytest.approx(0.5), pytest.approx(8))
    # The same with glFrustum(-0.1, 0.3, -0.05, 0.15, 0.1, 10): the principal point is a quarter from the left, and as far above the bottom.
    shifted = [[0.5, 0, 0.5, 0], [0, 1, 0.5, 0], [0, 0, -10.1 / 9.9, -2 / 9.9], [0, 0, -1, 0]]
    camera = gloam.Camera.from_projection(shifted, "opengl", 400, 200)
    assert (camera.cx, camera.cy) == (100, 150) and (camera.fx, camera.fy) == (100, 100)


def test_reversed_z_of_opengl_from_one_to_zero():
    m = frustum("opengl", -1, False, -0.2, 0.2, -0.1, 0.1, 0.25, INFINITY, True, z=0)
    camera = gloam.Camera.from_projection(m, "opengl", WIDTH, HEIGHT)
    assert (camera.near, camera.far) == (pytest.approx(0.25), INFINITY)
    m = frustum("opengl", -1, False, -0.2, 0.2, -0.1, 0.1, 0.25, 60, True, z=0)
    assert gloam.Camera.from_projection(m, "opengl", WIDTH, HEIGHT).far == pytest.approx(60)


@pytest.mark.parametrize("convention, ahead, y_down", SPACES)
@pytest.mark.parametrize("is_reversed", [False, True])
def test_depth_buffers_become_distances(convention, ahead, y_down, is_reversed):
    m = frustum(convention, ahead, y_down, -0.2, 0.2, -0.1, 0.1, 0.25, 50.0, is_reversed)
    camera = gloam.Camera.from_projection(as_given(m, convention), convention, WIDTH, HEIGHT)
    z = numpy.linspace(1, 8, WIDTH * HEIGHT).reshape(HEIGHT, WIDTH)
    window = ahead * m[2, 2] + m[2, 3] / z
    if convention == "opengl":
        window = (1 + window) / 2  # glDepthRange(0, 1)
    result = gloam.run("gtao", depth=window, camera=camera, depth_is="reversed" if is_reversed else "ndc", radius=0.5)
    assert numpy.abs(result.frame["depth"] / z - 1).max() < 1e-5


def test_a_pose_has_the_axes_of_its_matrix():
    cosine, sine = numpy.cos(0.3), numpy.sin(0.3)
    pose = numpy.array([[cosine, 0, sine, 1], [0, 1, 0, 2], [-sine, 0, cosine, 3], [0, 0, 0, 1]])
    for convention, ahead, y_down in SPACES:
        m = as_given(frustum(convention, ahead, y_down, -0.2, 0.2, -0.1, 0.1, 0.25, 50.0, False), convention)
        axes = numpy.diag([1, -1 if y_down else 1, -ahead, 1])
        for words in ({"camera_to_world": pose}, {"world_to_camera": numpy.linalg.inv(pose)}):
            camera = gloam.Camera.from_projection(m, convention, WIDTH, HEIGHT, **words)
            assert numpy.allclose(camera.camera_to_world, pose @ axes, atol=1e-12)


GL = frustum("opengl", -1, False, -0.1, 0.3, -0.05, 0.25, 0.25, 50.0, False)
VULKAN = frustum("vulkan", -1, False, -0.2, 0.2, -0.1, 0.1, 0.25, 50.0, False)
UNREAL = frustum("unreal", 1, False, -0.1, 0.3, -0.1, 0.1, 0.25, INFINITY, True).T
VIEW = numpy.array([[0.8, 0, 0.6, 1], [0, 1, 0, 2], [-0.6, 0, 0.8, 3], [0, 0, 0, 1]])


def with_element(m, row, column, value):
    changed = numpy.array(m, float)
    changed[row, column] = value
    return changed


@pytest.mark.parametrize("matrix, convention, sentence", [
    (GL.T, "opengl", "projection is transposed: 'opengl' has matrices for column vectors; give projection.T"),
    (VULKAN.T, "vulkan", "projection is transposed: 'vulkan' has matrices for column vectors; give projection.T"),
    (UNREAL.T, "unreal", "projection is transposed: 'unreal' has matrices for row vectors; give projection.T"),
    (box("opengl", -1, False, -1, 3, -1, 1, 0.1, 9, False).T, "opengl", "projection is transposed"),
    (GL @ VIEW, "opengl", "give the projection alone, without the view"),
    (VIEW, "opengl", "give the projection alone, without the view"),
    (with_element(GL, 2, 0, 0.1), "opengl", "projection[2, 0] is 0.1, where a projection without a turn, a shear and an oblique near plane has 0"),
    (with_element(UNREAL, 0, 1, 0.1), "unreal", "projection[0, 1] is 0.1"),
    (with_element(GL, 0, 0, -1), "opengl", "projection[0, 0] is -1, which mirrors the image"),
    (with_element(GL, 1, 1, 0), "opengl", "projection[1, 1] is 0, which flattens the image"),
    (with_element(GL, 2, 3, 0), "opengl", "projection[2, 3] is 0, so that all depths become one"),
    (with_element(GL, 2, 3, numpy.nan), "opengl", "projection[2, 3] is nan; a finite number is allowed"),
    (GL, "vulkan", "y is up in the image, where Vulkan has it down; negate row 1 if the viewport's height is negative, or say 'opengl'"),
    (VULKAN, "opengl", "say 'vulkan' of a matrix of Vulkan"),
    (UNREAL.T, "opengl", "projection[3, 2] is 1, of a camera that looks along +z; 'opengl' looks along -z"),
    (GL.T, "unreal", "projection[2, 3] is -1, of a camera that looks along -z; 'unreal' looks along +z"),
    (with_element(GL, 2, 2, 1), "opengl", "a near plane before the camera and a far plane behind it are allowed: is its z from -1 to 1"),
    (GL[:3], "opengl", "projection has the shape (3, 4); (4, 4) is allowed"),
    ("gl", "opengl", "projection is no matrix; 4 x 4 numbers are allowed"),
    (GL, "openlg", "convention openlg is not allowed (did you mean 'opengl'?)"),
    (GL, None, "convention is of type NoneType"),
])
def test_matrices_that_are_of_another_kind_are_told(matrix, convention, sentence):
    with pytest.raises(gloam.Error) as raised:
        gloam.Camera.from_projection(matrix, convention, WIDTH, HEIGHT)
    assert sentence in str(raised.value) and "\n" not in str(raised.value), str(raised.value)


def test_transposed_matrices_are_found_at_every_near_plane():
    """A near plane for which element [2, 3] is 1 or -1 makes both last rows look alike."""
    for convention, ahead, y_down in SPACES:
        for near in (0.01, 0.25, 0.5, 1.0, 2.0):
            for far in (50.0, INFINITY):
                for is_reversed in (False, True):
                    m = frustum(convention, ahead, y_down, -0.1, 0.3, -0.1, 0.1, near, far, is_reversed)
                    with pytest.raises(gloam.UsageError):
                        gloam.Camera.from_projection(as_given(m, convention).T, convention, WIDTH, HEIGHT)


@pytest.mark.parametrize("width, height, sentence", [
    (0, 9, "width 0 is not allowed; 1 to 65536 pixels are"),
    (9, 1.5, "height is of type float; a whole number is allowed"),
    ("9", 9, "width is of type str"),
    (10**400, 9, "width is beyond 1.8e308"),
])
def test_sizes_are_checked(width, height, sentence):
    for call in (lambda: gloam.Camera.from_projection(GL, "opengl", width, height), lambda: gloam.Camera.from_fov(60, width, height)):
        with pytest.raises(gloam.UsageError) as raised:
            call()
        assert sentence in str(raised.value)


def test_intrinsics():
    K = numpy.array([[800, 0, 319.5], [0, 810, 239.5], [0, 0, 1]])
    camera = gloam.Camera.from_intrinsics(K, near=0.1, far=9)
    assert (camera.fx, camera.fy, camera.cx, camera.cy, camera.near, camera.far) == (800, 810, 319.5, 239.5, 0.1, 9)
    opencv = gloam.Camera.from_intrinsics(K.tolist(), pixel_centre=0, camera_to_world=numpy.diag([1, 1, 1, 1]))
    assert (opencv.cx, opencv.cy) == (320, 240) and opencv.camera_to_world is not None
    for wrong, sentence in ((K.T, "it is transposed; give K.T"), (with_element(K, 0, 1, 2), "K has a skew of 2; 0 is allowed"),
                            (with_element(K, 1, 1, -9), "fy is -9; a number above 0 is allowed"), (2 * K, "K[2, 2] is 2; 1 is allowed"),
                            (numpy.eye(4), "K has the shape (4, 4); (3, 3) is allowed"), ("K", "K is no matrix; 3 x 3 numbers")):
        with pytest.raises(gloam.Error) as raised:
            gloam.Camera.from_intrinsics(wrong)
        assert sentence in str(raised.value), str(raised.value)
    with pytest.raises(gloam.UsageError, match="pixel_centre 0.25 is not allowed; 0.5 is, or 0"):
        gloam.Camera.from_intrinsics(K, pixel_centre=0.25)


def test_intrinsics_of_opencv_draw_points_where_opencv_does():
    cv2 = pytest.importorskip("cv2")
    K = numpy.array([[800, 0, 300], [0, 810, 250], [0, 0, 1.0]])
    camera = gloam.Camera.from_intrinsics(K, pixel_centre=0)
    point = numpy.array([0.3, -0.2, 4.0])  # y down, z ahead
    x, y = cv2.projectPoints(point[None], numpy.zeros(3), numpy.zeros(3), K, None)[0].ravel()
    # OpenCV's pixel centres are whole numbers.
    assert (x + 0.5, y + 0.5) == (pytest.approx(camera.cx + camera.fx * 0.3 / 4), pytest.approx(camera.cy - camera.fy * 0.2 / 4))


def test_fields_of_view():
    camera = gloam.Camera.from_fov(90, 400, 200)
    assert (camera.fx, camera.fy, camera.cx, camera.cy) == (pytest.approx(200), pytest.approx(200), 200, 100)
    upright = gloam.Camera.from_fov(90, 400, 200, axis="vertical", far=7)
    assert (upright.fx, upright.fy, upright.cx, upright.cy, upright.far) == (pytest.approx(100), pytest.approx(100), 200, 100, 7)
    for words, sentence in (({"degrees": 180}, "180 is not allowed"), ({"degrees": "wide"}, "degrees is of type str"),
                            ({"axis": "diagonal"}, "axis diagonal is not allowed"), ({"axis": 1}, "axis is of type int")):
        with pytest.raises(gloam.UsageError) as raised:
            gloam.Camera.from_fov(**{"degrees": 60, "width": 400, "height": 200, **words})
        assert sentence in str(raised.value), str(raised.value)


def test_a_transposed_pose_is_told():
    with pytest.raises(gloam.Error, match="camera_to_world is transposed: its translation is in the last row, as for row vectors; give camera_to_world.T"):
        gloam.Camera(9, 9, 4, 4, camera_to_world=VIEW.T)


def test_a_camera_in_another_unit_than_pixels_is_told():
    z = numpy.full((180, 320), 5, numpy.float32)
    notes = lambda camera: [note for note in gloam.run("gtao", depth=z, camera=camera, radius=1).notes if note.startswith("camera")]
    assert notes(gloam.Camera(277, 277, 160, 90)) == []
    assert notes(gloam.Camera(277, 277, 960, 540)) == ["camera: its principal point (960, 540) lies outside of the image of 320 x 180 pixels; fx, fy, cx "
                                                       "and cy are in pixels of this image"]
    assert "sees 179.4 degrees" in notes(gloam.Camera(0.87, 1.5, 0.5, 0.5))[0]
