#!/usr/bin/env python3
"""How many conventions gloam tells by itself: frames stored in 24 ways each, read without a word on what they hold.

Each frame's depth and normals are written as files in other formats (NPY, PNG), and read again with the camera and nothing else, but what
FLAGS names. A reading is right if 95 % of the depths are within 2 % of the frame's, up to one factor where lengths cannot be known, and 95 % of
the normals within 5 degrees; told if a note says that the frame may be something else, or that a plane is not used; else silent.

  PYTHONPATH=build/python bench/conventions.py                       # the built-in frames
  PYTHONPATH=build/python bench/conventions.py FRAME.exr ...         # frames of one's own, with depth, normals and a camera
  PYTHONPATH=build/python bench/conventions.py --random 1,2          # and by cameras that are drawn from these numbers
  PYTHONPATH=build/python bench/conventions.py --only 'sRGB' --notes # those of a name, with what was told
"""
import argparse
import pathlib
import tempfile
import warnings

import cv2
import gloam
import numpy

FRAMES = ["banquet", "clockwork", "colonnade", "corridor", "courtyard", "fence", "foliage", "gallery", "hairball", "lounge", "statue", "temple"]
DOUBTS = ("though", "may be", "neighbours go on", "not used", "if all were turned", "fit no convention")


class Stored:
    """A frame's planes, and what conventions are made of."""

    def __init__(self, depth, camera, normal=None):
        self.depth, self.normal, self.camera = depth, normal, camera
        height, width = self.depth.shape
        x, y = (numpy.arange(width) + 0.5 - self.camera.cx) / self.camera.fx, (numpy.arange(height) + 0.5 - self.camera.cy) / self.camera.fy
        self.secant = numpy.sqrt(1 + x[None]**2 + y[:, None]**2)
        self.surface = numpy.isfinite(self.depth)
        self.z = numpy.where(self.surface, self.depth, 1).astype(float)
        self.nearest, self.farthest = self.z[self.surface].min(), self.z[self.surface].max()
        self.near, self.far = min(0.1, 0.9 * self.nearest), 2 * self.farthest

    # depth

    def floats(self, values, sky):
        return numpy.where(self.surface, values, sky).astype(numpy.float32)

    def whole(self, values, sky):
        return numpy.where(self.surface, numpy.clip(numpy.round(values), 0, 65535), sky).astype(numpy.uint16)

    def steps(self, share=1):  # of 16 bits, for the largest distance
        return 60000 * share / self.farthest

    def device(self):
        return self.far / (self.far - self.near) * (1 - self.near / self.z)

    def grey(self):
        """White near, black far, and black a little beyond the farthest."""
        black, white = 1.2 * self.farthest, 0.5 * self.nearest
        return (black - self.z) / (black - white)

    def clamped_grey(self):
        """As V-Ray's: what is beyond black is black."""
        black, white = numpy.percentile(self.z[self.surface], 95), 0.5 * self.nearest
        return numpy.clip((black - self.z) / (black - white), 0, 1)

    def packed(self):
        bits = numpy.where(self.surface, numpy.round(self.z / 1000 * (2**24 - 1)), 2**24 - 1).astype(numpy.int64)
        return numpy.stack([bits & 255, bits >> 8 & 255, bits >> 16], -1).astype(numpy.uint8)

    # normals

    def of(self, normals, none=0.0):
        is_any = (self.normal**2).sum(-1, keepdims=True) > 0.5
        return numpy.where(is_any, normals, none).astype(numpy.float32)

    def in_world(self):
        """View to world by the camera's pose."""
        return self.normal @ numpy.asarray(self.camera.camera_to_world)[:3, :3].T

    def picture(self, normals, curve=lambda share: share):
        return numpy.round(255 * self.of(curve(0.5 + 0.5 * normals))).astype(numpy.uint8)


def of_frame(frame):
    return Stored(frame["depth"], frame.camera, frame["normal"])


def srgb(linear):
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * numpy.maximum(linear, 0)**(1 / 2.4) - 0.055)


CV = numpy.float32([1, -1, -1])  # y down, z away
VIEW = lambda s: s.of(s.normal)
# By name: the depth, the normals, what is stated (FLAGS), and whether lengths are known.
CONVENTIONS = {
    "planar, floats": (lambda s: s.floats(s.z, numpy.inf), VIEW, {}, True),
    "planar, negative; normals y down, z away": (lambda s: s.floats(-s.z, -numpy.inf), lambda s: s.of(s.normal * CV), {}, True),
    "planar, 16 bits, unit stated": (lambda s: s.whole(s.z * s.steps(), 0), VIEW, lambda s: {"depth_scale": 1 / s.steps()}, True),
    "planar, 16 bits; normals 8 bits": (lambda s: s.whole(s.z * s.steps(), 0), lambda s: s.picture(s.normal), {}, False),
    "planar, 16 bits that wrap": (lambda s: numpy.mod(s.floats(numpy.round(s.z * s.steps(1.6)), 0), 65536).astype(numpy.uint16), VIEW, {}, False),
    "planar, rows from the bottom up": (lambda s: s.floats(s.z, numpy.inf)[::-1], VIEW, {}, True),
    "planar, 24 bits, low byte first": (lambda s: s.packed(), VIEW, {"depth_scale": 1000}, True),
    "planar, 24 bits, high byte first": (lambda s: s.packed()[..., ::-1], VIEW, {"depth_scale": 1000}, True),
    "along the ray, floats": (lambda s: s.floats(s.z * s.secant, numpy.inf), VIEW, {}, True),
    "along the ray, 16 bits; world normals 8 bits": (lambda s: s.whole(s.z * s.secant * s.steps(0.7), 0), lambda s: s.picture(s.in_world()), {}, False),
    "disparity, floats": (lambda s: s.floats(100 / s.z, 0), VIEW, {}, False),
    "disparity, 16 bits; normals 8 bits": (lambda s: s.whole(60000 * s.nearest / s.z, 0), lambda s: s.picture(s.normal), {}, False),
    "device depth, planes stated": (lambda s: s.floats(s.device(), 1), VIEW, lambda s: {"near": s.near, "far": s.far}, True),
    "device depth, nothing stated": (lambda s: s.floats(s.device(), 1), VIEW, {}, False),
    "device depth; normals 0 to 1, y down, z away": (lambda s: s.floats(s.device(), 1), lambda s: s.of(0.5 + 0.5 * s.normal * CV, 0.5), {}, False),
    "reversed, infinite far plane": (lambda s: s.floats(s.near / s.z, 0), VIEW, {}, False),
    "reversed, with a far plane; world normals": (lambda s: s.floats(1 - s.device(), 0), lambda s: s.of(s.in_world()), {}, False),
    "grey, white near, clamped": (lambda s: s.floats(s.clamped_grey(), 0), VIEW, {}, False),
    "grey, white near, 16 bits; normals 8 bits": (lambda s: s.whole(65535 * s.grey(), 0), lambda s: s.picture(s.normal), {}, False),
    "grey, white near, 16 bits, sRGB curve": (lambda s: s.whole(65535 * srgb(s.grey()), 0), VIEW, {}, False),
    "grey, black near, 16 bits": (lambda s: s.whole(65535 * (1 - s.grey()), 65535), VIEW, {}, False),
    "planar; normals 8 bits, sRGB curve": (lambda s: s.floats(s.z, numpy.inf), lambda s: s.picture(s.normal, srgb), {}, True),
    "planar, centimetres; world normals z up, left-handed": (lambda s: s.floats(100 * s.z, numpy.inf), lambda s: s.of(s.in_world()[..., [2, 0, 1]] * [-1, 1, 1]), {}, False),
    "planar; normals away from the eye": (lambda s: s.floats(s.z, numpy.inf), lambda s: s.of(-s.normal), {}, True),
}


def written(path, values):
    if values.dtype in (numpy.uint8, numpy.uint16):
        path = path.with_suffix(".png")
        cv2.imwrite(str(path), values if values.ndim == 2 else numpy.ascontiguousarray(values[..., ::-1]))
    else:
        path = path.with_suffix(".npy")
        numpy.save(path, numpy.ascontiguousarray(values))
    return path


def is_right(read, stored, knows_lengths):
    if "normal" not in read.planes:
        return False
    both = numpy.isfinite(read["depth"]) & stored.surface
    if both.sum() < 0.8 * stored.surface.sum():
        return False
    factors = read["depth"][both] / stored.z[both]
    apart = numpy.abs(factors / (1 if knows_lengths else numpy.median(factors)) - 1)
    cosines = (read["normal"] * stored.normal).sum(-1)[both & ((stored.normal**2).sum(-1) > 0.5)]
    return bool(numpy.percentile(apart, 95) < 0.02 and numpy.percentile(cosines, 5) > numpy.cos(numpy.radians(5)))


def outcome(frame, convention, folder):
    """"right", "told" or "silent", and the notes on depth and normals."""
    stored = of_frame(frame)
    depth, normal, flags, knows_lengths = CONVENTIONS[convention]
    files = written(folder / "depth", depth(stored)), written(folder / "normal", normal(stored))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", gloam.Note)
        read = gloam.read(files[0], planes=["depth", "normal"], plane_files={"normal": files[1]}, camera=frame.camera, **(flags(stored) if callable(flags) else flags))
    notes = [note for note in read.notes if note.startswith(("depth", "normal"))]
    if is_right(read, stored, knows_lengths):
        return "right", notes
    return ("told" if any(doubt in note for note in notes for doubt in DOUBTS) else "silent"), notes


def outcomes(frames, folder, only=""):
    """For each convention and each frame, what became of it."""
    return {convention: {name: outcome(frame, convention, folder) for name, frame in frames.items()} for convention in CONVENTIONS if only in convention}


def built_in():
    return {name: gloam.capture(name, 640, 360, ["depth", "normal"]) for name in FRAMES}


def drawn(seed, names=FRAMES):
    """Built-in scenes, each by a camera drawn at random: on a line of sight of its own camera, towards something that this one sees."""
    frames = {}
    for name in names:
        scene, draw = gloam.Scene(name), numpy.random.default_rng([seed, *name.encode()])
        seen = gloam.capture(scene, 160, 90, ["position"])
        points = seen["position"][numpy.isfinite(seen["depth"])].astype(float)
        first = numpy.asarray(seen.camera.camera_to_world)[:3, 3]
        while name + str(seed) not in frames:
            along, target = points[draw.integers(len(points), size=2)]
            words = {"eye": tuple(first + draw.uniform(0.1, 0.7) * (along - first)), "target": tuple(target), "fov": draw.uniform(35, 100)}
            depth = gloam.capture(scene, 160, 90, ["depth"], **words)["depth"]
            surface = depth[numpy.isfinite(depth)]
            if surface.size > 0.5 * depth.size and numpy.percentile(surface, 1) > 0.05 * numpy.median(surface):
                frames[name + str(seed)] = gloam.capture(scene, 640, 360, ["depth", "normal"], **words)
    return frames


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("frames", nargs="*", metavar="FRAME.exr", help="frames with depth, normals and a camera; default: the built-in ones")
    parser.add_argument("--random", default="", metavar="N,N", help="also the built-in scenes by cameras that are drawn from each of these numbers")
    parser.add_argument("--only", default="", metavar="TEXT", help="conventions that have this in their names")
    parser.add_argument("--notes", action="store_true", help="what was told of those that are not right")
    chosen = parser.parse_args()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", gloam.Note)
        frames = {pathlib.Path(path).stem: gloam.read(path, planes=["depth", "normal"]) for path in chosen.frames} or built_in()
        for seed in filter(None, chosen.random.split(",")):
            frames.update(drawn(int(seed)))
    total = {"right": 0, "told": 0, "silent": 0}
    with tempfile.TemporaryDirectory() as folder:
        for convention, by_frame in outcomes(frames, pathlib.Path(folder), chosen.only).items():
            counts = {word: sum(found == word for found, _ in by_frame.values()) for word in total}
            total = {word: total[word] + counts[word] for word in total}
            print(f"{convention:55s}" + "".join(f"{count:4d} {word}" for word, count in counts.items()) + "  " +
                  " ".join(f"{name}:{found}" for name, (found, _) in by_frame.items() if found != "right"), flush=True)
            for name, (found, notes) in by_frame.items():
                if chosen.notes and found != "right":
                    print("    " + name + "\n      " + "\n      ".join(notes))
    print(f"{sum(total.values())} readings: " + ", ".join(f"{count} {word}" for word, count in total.items()))


if __name__ == "__main__":
    main()
