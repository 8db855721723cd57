"""Planes of the OpenEXR files that gloam writes (one part, lines, uncompressed or ZIP), and grey images that Blender reads.

Blender loads R G B of a file, or layers; a single channel `AO` it does not, and its Python has no other reader of OpenEXR.
"""
import os
import struct
import zlib

import numpy

from .errors import Problem

MAGIC = b"\x76\x2f\x31\x01"
TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
LINES_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8", "replace"), end + 1


def header_of(data):
    """Attributes by name, as bytes, and where the table of blocks begins."""
    attributes, at = {}, 8
    while data[at]:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        length, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + length]
        at += 4 + length
    return attributes, at + 1


def channels_of(attribute):
    channels, at = [], 0
    while attribute[at]:
        name, at = text_at(attribute, at)
        kind, = struct.unpack_from("<i", attribute, at)
        channels.append((name, TYPES[kind]))
        at += 16
    return channels


def undo_zip(block, length):
    if len(block) == length:
        return block  # what does not get smaller is stored as it is
    raw = numpy.frombuffer(zlib.decompress(block), numpy.uint8)
    raw = (numpy.cumsum(raw, dtype=numpy.uint32) - 128 * numpy.arange(len(raw), dtype=numpy.uint32)).astype(numpy.uint8)
    data = numpy.empty(length, numpy.uint8)
    half = (length + 1) // 2
    data[0::2], data[1::2] = raw[:half], raw[half:]
    return data.tobytes()


def read_channels(path):
    """All channels of a file: arrays of (height, width), float32, by name. Throws Problem for a file that is none of gloam's."""
    try:
        with open(path, "rb") as file:
            data = file.read()
        if data[:4] != MAGIC or struct.unpack_from("<i", data, 4)[0] & 0x1a00:
            raise ValueError("no EXR file of one part with lines")
        attributes, table = header_of(data)
        channels, compression = channels_of(attributes["channels"]), attributes["compression"][0]
        x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
        width, height, lines = x1 - x0 + 1, y1 - y0 + 1, LINES_PER_BLOCK[compression]
        planes = {name: numpy.empty((height, width), numpy.float32) for name, _ in channels}
        per_line = sum(kind.itemsize for _, kind in channels) * width
        for place in struct.unpack_from(f"<{-(-height // lines)}Q", data, table):
            y, size = struct.unpack_from("<2i", data, place)
            count = min(lines, y1 + 1 - y)
            block = data[place + 8:place + 8 + size]
            block = undo_zip(block, count * per_line) if compression else block
            rows, at = numpy.frombuffer(block, numpy.uint8).reshape(count, per_line), 0
            for name, kind in channels:
                bytes_of_row = kind.itemsize * width
                values = numpy.ascontiguousarray(rows[:, at:at + bytes_of_row]).view(kind)
                planes[name][y - y0:y - y0 + count] = values
                at += bytes_of_row
        return planes
    except (OSError, ValueError, KeyError, IndexError, struct.error, zlib.error) as error:
        raise Problem(f"'{path}' cannot be read: {error}") from error


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_grey(path, plane):
    """Writes an array of (height, width) as R, G and B, half, ZIP. Throws Problem where it cannot be written."""
    height, width = plane.shape
    half = numpy.ascontiguousarray(plane.astype("<f2"))
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", 1, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = MAGIC + struct.pack("<i", 2) + attribute("channels", "chlist", channels)
    header += attribute("compression", "compression", b"\x03") + attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    blocks = []
    for y in range(0, height, 16):
        rows = numpy.repeat(half[y:y + 16, None, :], 3, axis=1)  # B, G and R of each line
        blocks.append(struct.pack("<i", y) + packed(rows.tobytes()))
    places, at = [], len(header) + 8 * len(blocks)
    for block in blocks:
        places.append(at)
        at += len(block)
    temporary = path + ".part"
    try:
        with open(temporary, "wb") as file:
            file.write(header + struct.pack(f"<{len(places)}Q", *places) + b"".join(blocks))
        os.replace(temporary, path)
    except OSError as error:
        raise Problem(f"'{path}' cannot be written: {error.strerror}") from error


def packed(data):
    """A block with its size: compressed by ZIP as OpenEXR has it, or as it is where that is not smaller."""
    raw = numpy.frombuffer(data, numpy.uint8)
    split = numpy.concatenate((raw[0::2], raw[1::2])).astype(numpy.int16)
    split[1:] = split[1:] - split[:-1] + 128
    block = zlib.compress(split.astype(numpy.uint8).tobytes())
    block = block if len(block) < len(data) else data
    return struct.pack("<i", len(block)) + block
