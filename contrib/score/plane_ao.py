#!/usr/bin/env python3
"""Ambient occlusion that gloam has not got: how far the surfaces around a pixel rise above the pixel's tangent plane.

An example of a method of one's own for `gloam score --command` (docs/score.md). Needs NumPy alone:

    plane_ao.py --in FRAME.exr --out AO.exr|AO.png --camera CAMERA.json --radius R [--samples N] [--power P]

Each of N offsets is the same for all pixels, on a spiral whose size follows the depth. A sample within the radius adds the sine of its angle
above the plane.
"""

import argparse
import json

import numpy

import exr


def cameras_of(path):
    with open(path) as file:
        document = json.load(file)
    shared = {key: value for key, value in document.items() if key != "views"}
    return [{**shared, **view} for view in document.get("views", [{}])]


def positions_of(depth, camera):
    y, x = numpy.mgrid[:depth.shape[0], :depth.shape[1]].astype(numpy.float32) + 0.5
    return numpy.stack([(x - camera["cx"]) / camera["fx"] * depth, (camera["cy"] - y) / camera["fy"] * depth, -depth])


def normals_of(positions):
    """From the nearer of the two neighbours each way, so that edges do not round."""
    def along(axis):
        before = positions - numpy.roll(positions, 1, axis)
        after = numpy.roll(positions, -1, axis) - positions
        return numpy.where(abs(before[2]) < abs(after[2]), before, after)
    normal = numpy.cross(along(1), along(2), axis=0)  # y is up, rows go down
    return normal / numpy.maximum(numpy.linalg.norm(normal, axis=0), 1e-20)


def occlusion(depth, camera, radius, samples):
    height, width = depth.shape
    background = ~numpy.isfinite(depth)
    depth = numpy.where(background, 1e6, depth)
    positions = positions_of(depth, camera)
    normals = normals_of(positions)
    rows, columns = numpy.mgrid[:height, :width]
    reach = numpy.minimum(radius * camera["fx"] / depth, width / 4)
    total = numpy.zeros_like(depth)
    for i in range(samples):
        distance, angle = (i + 0.5) / samples, 2.39996 * i
        x = numpy.clip(columns + numpy.rint(reach * distance * numpy.cos(angle)).astype(int), 0, width - 1)
        y = numpy.clip(rows + numpy.rint(reach * distance * numpy.sin(angle)).astype(int), 0, height - 1)
        away = positions[:, y, x] - positions
        length = numpy.maximum(numpy.linalg.norm(away, axis=0), 1e-20)
        sine = numpy.maximum((away * normals).sum(0) / length - 0.05, 0)
        total += sine * (length < radius)
    ao = numpy.clip(1 - 3 * total / samples, 0, 1)
    return numpy.where(background, 1, ao).astype(numpy.float32)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--in", dest="frame", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--camera", required=True)
    parser.add_argument("--radius", type=float, required=True)
    parser.add_argument("--samples", type=int, default=24)
    parser.add_argument("--power", type=float, default=1, help="the image is AO to this power")
    flags = parser.parse_args()
    planes, views = exr.read(flags.frame)
    images = {}
    for i, camera in enumerate(cameras_of(flags.camera)):
        # the first view's channels have no view in their names
        prefix = "" if i == 0 else views[i] + "."
        images[prefix + "AO"] = occlusion(planes[prefix + "Z"], camera, flags.radius, flags.samples) ** flags.power
    if flags.out.endswith(".png"):
        exr.write_png(flags.out, images["AO"])
    else:
        exr.write(flags.out, images, views)


if __name__ == "__main__":
    main()
