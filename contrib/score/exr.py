"""EXR files of floats with NumPy alone: as much of the format as scores need (scanlines, uncompressed or ZIP)."""

import struct
import zlib

import numpy

TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
ROWS = {0: 1, 2: 1, 3: 16}  # rows of a block: uncompressed, ZIPS, ZIP


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_of(data):
    if data[:4] != b"v/1\x01" or data[5] & 0x1a:
        raise ValueError("no EXR of one part with scanlines")
    attributes, at = {}, 8
    while data[at]:
        name, at = text_at(data, at)
        kind, at = text_at(data, at)
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channels_of(attribute):
    channels, at = [], 0
    while attribute[at]:
        name, at = text_at(attribute, at)
        channels.append((name, TYPES[struct.unpack_from("<i", attribute, at)[0]]))
        at += 16
    return channels


def unzipped(block):
    """Undoes the predictor and the split in even and odd bytes."""
    values = numpy.frombuffer(zlib.decompress(block), numpy.uint8).astype(numpy.int64)
    values[1:] -= 128
    values = numpy.cumsum(values).astype(numpy.uint8)
    half = (len(values) + 1) // 2
    out = numpy.empty_like(values)
    out[::2], out[1::2] = values[:half], values[half:]
    return out.tobytes()


def read(path):
    """{channel: array of rows}, floats of 32 bits; and the names of the views."""
    with open(path, "rb") as file:
        data = file.read()
    header, at = header_of(data)
    channels, compression = channels_of(header["channels"]), header["compression"][0]
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    planes = {name: numpy.empty((height, width), numpy.float32) for name, _ in channels}
    row_bytes = width * sum(kind.itemsize for _, kind in channels)
    for offset in struct.unpack_from(f"<{-(-height // ROWS[compression])}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        rows = min(ROWS[compression], y1 + 1 - y)
        block = data[offset + 8:offset + 8 + size]
        block = block if size == rows * row_bytes else unzipped(block)
        at_row = 0
        for row in range(y - y0, y - y0 + rows):
            for name, kind in channels:
                planes[name][row] = numpy.frombuffer(block, kind, width, at_row)
                at_row += width * kind.itemsize
    views = []
    if "multiView" in header:
        text = header["multiView"]
        while text:
            size, = struct.unpack_from("<i", text)
            views.append(text[4:4 + size].decode())
            text = text[4 + size:]
    return planes, views


def write(path, planes, views=()):
    """Floats of 32 bits, uncompressed."""
    names = sorted(planes)
    height, width = planes[names[0]].shape

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    channels = b"".join(name.encode() + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in names) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = b"v/1\x01" + struct.pack("<i", 2)
    head += attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0")
    head += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box)
    head += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    if views:
        texts = b"".join(struct.pack("<i", len(view)) + view.encode() for view in views)
        head += attribute("multiView", "stringvector", texts)
    head += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    rows = numpy.stack([planes[name].astype("<f4") for name in names], 1)
    size = 4 * width * len(names)
    with open(path, "wb") as file:
        file.write(head)
        file.write(struct.pack(f"<{height}Q", *(len(head) + 8 * height + y * (8 + size) for y in range(height))))
        for y in range(height):
            file.write(struct.pack("<2i", y, size) + rows[y].tobytes())


def write_png(path, values):
    """Grey of 16 bits; 1 is white."""
    grey = numpy.rint(65535 * numpy.clip(numpy.nan_to_num(values, nan=1), 0, 1)).astype(">u2")
    rows = b"".join(b"\0" + row.tobytes() for row in grey)

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", grey.shape[1], grey.shape[0], 16, 0, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))
