"""Planes of OpenEXR files of one part with lines, uncompressed or ZIP, as Blender and gloam write them: reading, cropping, writing.

Blender loads R G B of a file, or layers; a single channel `AO` it does not, and its Python has no other reader of OpenEXR.
"""
import concurrent.futures
import dataclasses
import os
import struct
import zlib

import numpy

from .errors import Problem

MAGIC = b"\x76\x2f\x31\x01"
NOT_LINES = 0x1a00  # tiled, deep or of several parts
TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
LINES_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP
ZIP = b"\x03"
LEVEL = 4  # of zlib: 6 takes twice the time for a hundredth of the size


@dataclasses.dataclass
class Image:
    channels: dict  # arrays of (height, width), as stored, by name
    window: tuple  # of the arrays: first column and row, and those after the last
    display: tuple  # the image that a viewer shows
    attributes: list = dataclasses.field(default_factory=list)  # all others: name, type, bytes
    flags: int = 2  # version, and whether names are long


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8", "replace"), end + 1


def header_of(data):
    """Attributes, each with name, type and bytes, and where the table of blocks begins."""
    attributes, at = [], 8
    while data[at]:
        name, at = text_at(data, at)
        kind, at = text_at(data, at)
        length, = struct.unpack_from("<i", data, at)
        attributes.append((name, kind, data[at + 4:at + 4 + length]))
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


def window_of(attribute):
    x0, y0, x1, y1 = struct.unpack("<4i", attribute)
    return x0, y0, x1 + 1, y1 + 1


def undo_zip(block, length):
    if len(block) == length:
        return block  # what does not get smaller is stored as it is
    raw = numpy.frombuffer(zlib.decompress(block), numpy.uint8)
    raw = (numpy.cumsum(raw, dtype=numpy.uint32) - 128 * numpy.arange(len(raw), dtype=numpy.uint32)).astype(numpy.uint8)
    data = numpy.empty(length, numpy.uint8)
    half = (length + 1) // 2
    data[0::2], data[1::2] = raw[:half], raw[half:]
    return data.tobytes()


def read(path):
    """An image with all channels of a file. Throws Problem for a file of another form."""
    try:
        with open(path, "rb") as file:
            data = file.read()
        flags, = struct.unpack_from("<i", data, 4)
        if data[:4] != MAGIC or flags & NOT_LINES:
            raise ValueError("no EXR file of one part with lines")
        listed, table = header_of(data)
        attributes = {name: value for name, _, value in listed}
        window = window_of(attributes["dataWindow"])
        planes = planes_in(data, table, channels_of(attributes["channels"]), attributes["compression"][0], window)
        others = [entry for entry in listed if entry[0] not in ("channels", "compression", "dataWindow", "displayWindow", "lineOrder")]
        return Image(planes, window, window_of(attributes["displayWindow"]), others, flags)
    except (OSError, ValueError, KeyError, IndexError, struct.error, zlib.error) as error:
        raise Problem(f"'{path}' cannot be read: {error}") from error


def planes_in(data, table, channels, compression, window):
    width, height, lines = window[2] - window[0], window[3] - window[1], LINES_PER_BLOCK[compression]
    planes = {name: numpy.empty((height, width), kind) for name, kind in channels}
    per_line = sum(kind.itemsize for _, kind in channels) * width

    def take(place):
        y, size = struct.unpack_from("<2i", data, place)
        first, count = y - window[1], min(lines, window[3] - y)
        block = data[place + 8:place + 8 + size]
        block = undo_zip(block, count * per_line) if compression else block
        rows, at = numpy.frombuffer(block, numpy.uint8).reshape(count, per_line), 0
        for name, kind in channels:
            values = numpy.ascontiguousarray(rows[:, at:at + kind.itemsize * width]).view(kind)
            planes[name][first:first + count] = values
            at += kind.itemsize * width

    in_threads(take, struct.unpack_from(f"<{-(-height // lines)}Q", data, table))
    return planes


def in_threads(work, items):
    """zlib and NumPy release Python's lock."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(work, items))


def read_channels(path):
    """All channels of a file: arrays of (height, width), float32, by name. Throws Problem."""
    return {name: plane.astype(numpy.float32) for name, plane in read(path).channels.items()}


def cropped(image, window):
    """What an image shows in a window, which it covers."""
    x0, y0 = window[0] - image.window[0], window[1] - image.window[1]
    rows, columns = slice(y0, y0 + window[3] - window[1]), slice(x0, x0 + window[2] - window[0])
    return dataclasses.replace(image, window=tuple(window),
                               channels={name: plane[rows, columns] for name, plane in image.channels.items()})


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def channel_list(channels):
    kinds = {kind: number for number, kind in TYPES.items()}
    entries = [name.encode() + b"\0" + struct.pack("<iB3xii", kinds[plane.dtype], 0, 1, 1) for name, plane in channels]
    return b"".join(entries) + b"\0"


def box(window):
    return struct.pack("<4i", window[0], window[1], window[2] - 1, window[3] - 1)


def write(path, image):
    """Writes an image as ZIP, whole or not at all. Throws Problem where it cannot be written."""
    channels = sorted(image.channels.items())
    header = MAGIC + struct.pack("<i", image.flags) + attribute("channels", "chlist", channel_list(channels))
    header += attribute("compression", "compression", ZIP) + attribute("dataWindow", "box2i", box(image.window))
    header += attribute("displayWindow", "box2i", box(image.display)) + attribute("lineOrder", "lineOrder", b"\0")
    header += b"".join(attribute(*entry) for entry in image.attributes) + b"\0"
    x0, first, x1, end = image.window

    def block(y):
        rows = [numpy.ascontiguousarray(plane[y:y + 16]).view(numpy.uint8).reshape(-1, plane.itemsize * (x1 - x0)) for _, plane in channels]
        return struct.pack("<i", first + y) + packed(numpy.concatenate(rows, axis=1).tobytes())

    blocks = in_threads(block, range(0, end - first, 16))
    places, at = [], len(header) + 8 * len(blocks)
    for each in blocks:
        places.append(at)
        at += len(each)
    temporary = path + ".part"
    try:
        with open(temporary, "wb") as file:
            file.write(header + struct.pack(f"<{len(places)}Q", *places) + b"".join(blocks))
        os.replace(temporary, path)
    except OSError as error:
        if os.path.exists(temporary):
            os.remove(temporary)
        raise Problem(f"'{path}' cannot be written: {error.strerror}") from error


def packed(data):
    """A block with its size: compressed by ZIP as OpenEXR has it, or as it is where that is not smaller."""
    raw = numpy.frombuffer(data, numpy.uint8)
    split = numpy.concatenate((raw[0::2], raw[1::2])).astype(numpy.int16)
    split[1:] = split[1:] - split[:-1] + 128
    block = zlib.compress(split.astype(numpy.uint8).tobytes(), LEVEL)
    block = block if len(block) < len(data) else data
    return struct.pack("<i", len(block)) + block


def write_grey(path, plane):
    """Writes an array of (height, width) as R, G and B, half. Throws Problem where it cannot be written."""
    height, width = plane.shape
    half = plane.astype("<f2")
    needed = [("pixelAspectRatio", "float", struct.pack("<f", 1)), ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
              ("screenWindowWidth", "float", struct.pack("<f", 1))]
    window = (0, 0, width, height)
    write(path, Image({name: half for name in "BGR"}, window, window, needed))
