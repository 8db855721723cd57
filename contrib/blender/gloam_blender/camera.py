"""The camera of a scene as gloam reads it: docs/gbuffer.md, "Cameras"."""
import math

from .errors import Problem

# A parent that is scaled along one axis shears the camera: its axes are then this far from right angles.
SHEAR_ALLOWED = 1e-4


def check(camera):
    """Refuses a camera that has no matrix in gloam. camera: object or None. Throws Problem."""
    if camera is None:
        raise Problem("the scene has no camera; add one (Add > Camera) and make it the scene's "
                      "(View > Cameras > Set Active Object as Camera)")
    if camera.type != "CAMERA":
        raise Problem(f"the scene's camera '{camera.name}' is no camera object; make a camera the scene's")
    kind = camera.data.type
    if kind not in ("PERSP", "ORTHO"):
        raise Problem(f"the camera '{camera.name}' is {'panoramic' if kind == 'PANO' else kind.lower()}: "
                      "its image is not flat, and gloam reads perspective and orthographic cameras; "
                      "set Type in the camera's Lens panel")


def size(render):
    """Width and height of the whole image in pixels, without the render region."""
    return (render.resolution_x * render.resolution_percentage // 100,
            render.resolution_y * render.resolution_percentage // 100)


def fits_width(data, render):
    """Whether the sensor's size belongs to the image's width, as the sensor fit says."""
    if data.sensor_fit != "AUTO":
        return data.sensor_fit == "HORIZONTAL"
    width, height = size(render)
    return render.pixel_aspect_x * width >= render.pixel_aspect_y * height


def sensor_size(data):
    """Sensor size along the axis of the sensor fit, mm."""
    return data.sensor_height if data.sensor_fit == "VERTICAL" else data.sensor_width


def intrinsics(data, render, shift_x):
    """Focal lengths (of an orthographic camera: pixels per scene unit) and principal point, pixels from the top left corner."""
    width, height = size(render)
    aspect = render.pixel_aspect_y / render.pixel_aspect_x  # a pixel's height in widths
    extent = width if fits_width(data, render) else aspect * height  # of the sensor, in pixels of the width
    fx = extent / data.ortho_scale if data.type == "ORTHO" else extent * data.lens / sensor_size(data)
    return {"fx": fx, "fy": fx / aspect,
            "cx": width / 2 - shift_x * extent, "cy": height / 2 + data.shift_y * extent / aspect}


def rigid(camera, name):
    """The camera's pose without its scale, in double precision. Throws Problem, with the name, for a pose that is no rotation."""
    world = camera.matrix_world
    columns = [world.col[i].to_3d() for i in range(3)]
    lengths = [math.sqrt(sum(float(x) ** 2 for x in c)) for c in columns]
    if min(lengths) == 0:
        raise Problem(f"the camera '{name}' is scaled to 0; clear its scale (Object > Clear > Scale)")
    x, y, z = ([float(v) / length for v in column] for column, length in zip(columns, lengths))
    cosines = [abs(sum(a * b for a, b in zip(*pair))) for pair in ((x, y), (y, z), (z, x))]
    volume = sum(x[i] * (y[(i + 1) % 3] * z[(i + 2) % 3] - y[(i + 2) % 3] * z[(i + 1) % 3]) for i in range(3))
    if max(cosines) > SHEAR_ALLOWED or volume < 0:
        raise Problem(f"the camera '{name}' is {'mirrored' if volume < 0 else 'sheared'} by its own scale or a "
                      "parent's; clear that scale (Object > Clear > Scale)")
    return [[x[row], y[row], z[row], float(world[row][3])] for row in range(3)] + [[0.0, 0.0, 0.0, 1.0]]


def product(a, b):
    """Product of two 4x4 matrices in double precision, which mathutils does not have."""
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def turned(angle):
    c, s = math.cos(angle), math.sin(angle)
    return [[c, 0.0, s, 0.0], [0.0, 1.0, 0.0, 0.0], [-s, 0.0, c, 0.0], [0.0, 0.0, 0.0, 1.0]]


def moved(x):
    return [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]


def eye(data, is_left):
    """Pose of an eye in the camera's space, and its lens shift in x. The same as Blender's own (BKE_camera_multiview_*)."""
    stereo = data.stereo
    shift = data.shift_x
    if stereo.pivot == ("LEFT" if is_left else "RIGHT"):
        return moved(0.0), shift
    part = 0.5 if stereo.pivot == "CENTER" else 1.0
    sign = part if is_left else -part
    distance, convergence = stereo.interocular_distance, stereo.convergence_distance
    if stereo.convergence_mode == "TOE":
        # Each eye turns by this angle towards the point of convergence; with the pivot in one eye, the other turns by all of it.
        angle = math.atan(distance / 2 / convergence)
        if stereo.pivot == "CENTER":
            return product(moved(-distance * sign), turned(-angle * (1 if is_left else -1))), shift
        half = turned(-angle * (1 if is_left else -1))
        return product(product(half, moved(-distance * sign)), half), shift
    if stereo.convergence_mode == "OFFAXIS":
        shift += distance / data.sensor_width * data.lens / convergence * sign
    return moved(-distance * sign), shift


def view_of(camera, label, render, shown, name=None, is_left=None):
    """One view of the camera JSON. camera: evaluated object; label: what the user calls it; shown: the part of the rendered image that
    its pixels are counted in (first column and row, and those after the last); is_left: of two eyes, which; None: no eye. Throws
    Problem."""
    data = camera.data
    pose, shift_x = rigid(camera, label), data.shift_x
    if is_left is not None:
        offset, shift_x = eye(data, is_left)
        pose = product(pose, offset)
    values = intrinsics(data, render, shift_x)
    values["cx"] -= shown[0]
    values["cy"] -= shown[1]
    view = {"view": name} if name else {}
    view["camera_type"] = data.type
    if data.type == "ORTHO":
        view["pixels_per_unit"] = values["fx"]
        if values["fx"] != values["fy"]:
            view["projection_gl"] = orthographic(values, (shown[2] - shown[0], shown[3] - shown[1]), data.clip_start, data.clip_end)
    else:
        view.update(fx=values["fx"], fy=values["fy"])
    view.update(cx=values["cx"], cy=values["cy"], near=data.clip_start, far=data.clip_end, camera_to_world=pose)
    return view


def orthographic(values, pixels, near, far):
    """An OpenGL projection, rows first: a camera JSON has no other place for pixels that are not square."""
    width, height = pixels
    return [[2 * values["fx"] / width, 0.0, 0.0, 2 * values["cx"] / width - 1],
            [0.0, 2 * values["fy"] / height, 0.0, 1 - 2 * values["cy"] / height],
            [0.0, 0.0, -2 / (far - near), -(far + near) / (far - near)],
            [0.0, 0.0, 0.0, 1.0]]


def document(views):
    """The camera JSON of one frame, of its views: see view_of."""
    return views[0] if len(views) == 1 else {"views": views}
