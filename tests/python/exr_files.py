"""EXR files as other programs store them: any channel names, parts and attributes, uncompressed. gloam itself writes its own names alone."""

import struct

import numpy

KINDS = {numpy.dtype(numpy.uint32): 0, numpy.dtype(numpy.float16): 1, numpy.dtype(numpy.float32): 2}


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def stored(name, value):
    """An attribute as OpenEXR stores a text, a number or a matrix of 4 x 4."""
    if isinstance(value, str):
        return attribute(name, "string", value.encode())
    if numpy.ndim(value) == 2:
        return attribute(name, "m44f", numpy.asarray(value, "<f4").tobytes())
    return attribute(name, "float", struct.pack("<f", value))


def write_exr(path, parts, attributes={}):
    """parts: a dict of channels (name: array of rows) for a file of one part, or several such dicts by the names of the parts."""
    several = isinstance(next(iter(parts.values())), dict)
    named = parts if several else {"": parts}
    headers, rows = [], []
    for part, channels in named.items():
        channels = dict(sorted(channels.items()))
        height, width = next(iter(channels.values())).shape
        box = struct.pack("<4i", 0, 0, width - 1, height - 1)
        listed = b"".join(name.encode() + b"\0" + struct.pack("<i4B2i", KINDS[plane.dtype], 0, 0, 0, 0, 1, 1) for name, plane in channels.items())
        header = attribute("channels", "chlist", listed + b"\0") + attribute("compression", "compression", b"\0")
        header += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0")
        header += stored("pixelAspectRatio", 1.0) + attribute("screenWindowCenter", "v2f", bytes(8)) + stored("screenWindowWidth", 1.0)
        if several:
            header += stored("name", part) + stored("type", "scanlineimage") + attribute("chunkCount", "int", struct.pack("<i", height))
        headers.append(header + b"".join(stored(name, value) for name, value in attributes.items()) + b"\0")
        rows.append([b"".join(plane[y].tobytes() for plane in channels.values()) for y in range(height)])
    longest = max(len(name) for channels in named.values() for name in channels)
    flags = (0x1000 if several else 0) | (0x400 if longest > 31 else 0)
    start = struct.pack("<2i", 20000630, 2 | flags) + b"".join(headers) + (b"\0" if several else b"")
    at, offsets, chunks = len(start) + 8 * sum(map(len, rows)), b"", []
    for index, lines in enumerate(rows):
        for y, line in enumerate(lines):
            chunk = (struct.pack("<i", index) if several else b"") + struct.pack("<2i", y, len(line)) + line
            offsets += struct.pack("<q", at)
            at += len(chunk)
            chunks.append(chunk)
    path.write_bytes(start + offsets + b"".join(chunks))


def layer(name, plane, suffixes, kind=numpy.float32, behind=0):
    """Channels NAME.X, NAME.Y, ... of an array with components last; `behind` where its values are not finite."""
    plane = numpy.where(numpy.isfinite(plane), plane, behind).astype(kind)
    plane = plane.reshape(*plane.shape[:2], -1)
    return {(name + "." if name else "") + suffix: numpy.ascontiguousarray(plane[..., i]) for i, suffix in enumerate(suffixes)}


def in_the_world(frame):
    """Positions and normals of a captured frame, in its world; NaN and 0 on the background."""
    camera, depth = frame.camera, numpy.array(frame["depth"], float)
    pose = numpy.array(camera.camera_to_world, float)
    y, x = numpy.mgrid[:depth.shape[0], :depth.shape[1]] + 0.5
    depth = numpy.where(numpy.isfinite(depth), depth, numpy.nan)
    view = numpy.stack([(x - camera.cx) / camera.fx * depth, -(y - camera.cy) / camera.fy * depth, -depth], -1)
    return view @ pose[:3, :3].T + pose[:3, 3], numpy.array(frame["normal"], float) @ pose[:3, :3].T
