"""docs/gbuffer.md"""
from catalogue import table

PAGE = "docs/gbuffer.md"
MEANINGS = {"planar": "planar distance along the viewing axis, by which", "ray": "distance along the ray, by which",
            "linear": "1/z is a linear function of it"}


def stored(depth, camera):
    """Depth of a frame as files may hold it, each with the meaning that is to be told."""
    import numpy
    height, width = depth.shape
    x, y = (numpy.arange(width) + 0.5 - camera.cx) / camera.fx, (numpy.arange(height) + 0.5 - camera.cy) / camera.fy
    secant = numpy.sqrt(1 + x[None] ** 2 + y[:, None] ** 2)
    surface = numpy.isfinite(depth)
    near, far = 0.1, 2 * depth[surface].max()
    return [("planar", depth), ("ray", depth * secant), ("linear", numpy.where(surface, 100 / depth, 0)),
            ("linear", numpy.where(surface, far / (far - near) * (1 - near / depth), 1))]


def of_frame(lab, frame, fov=None):
    """For each of them: whether it is read right, told, not told, told wrongly."""
    import gloam
    import numpy
    camera = frame.camera
    own = float(numpy.degrees(2 * numpy.arctan(frame.width / 2 / camera.fx)))
    rows = []
    for meaning, values in stored(frame["depth"], camera):
        file = lab.folder_for("meanings") / "depth.npy"
        numpy.save(file, values.astype(numpy.float32))
        read = gloam.read(file, fov=fov or own)
        note = next(note for note in read.notes if note.startswith("depth: taken as"))
        told = [name for name, words in MEANINGS.items() if words in note]
        is_right = numpy.allclose(read["depth"], frame["depth"], rtol=1e-4)
        rows.append((is_right, told == [meaning], not told, bool(told) and told != [meaning]))
    return rows


def scenes():
    import gloam
    return [gloam.capture(name, 640, 360, ["depth"]) for name in gloam.scenes()]


@table(PAGE, "Conventions inside", 2, minutes=1)
def meanings_of_depth(lab):
    of_frames = [of_frame(lab, frame) for frame in scenes()]
    return [[(sum(frame[row][column] for frame in of_frames),) for column in range(4)] for row in range(4)]
