"""Writes a room with boxes on its floor as a GLB file. Usage: boxes.py OUT.glb"""

import json
import struct
import sys

FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def box(low, high):
    return [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]


boxes = [box((-4, 0, -4), (4, 3, 4))] + [box((x, 0, z), (x + 0.8, 0.5 + 0.3 * i, z + 0.8))
                                         for i, (x, z) in enumerate(((-3, -3), (-1, -2), (1, -3), (2, 0), (-2, 1)))]
points = [point for corners in boxes for point in corners]
triangles = [8 * i + face[k] for i in range(len(boxes)) for face in FACES for k in (0, 1, 2, 0, 2, 3)]
vertices, indices = struct.pack(f"<{3 * len(points)}f", *sum(points, [])), struct.pack(f"<{len(triangles)}H", *triangles)
document = json.dumps({
    "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
                   "min": [min(p[a] for p in points) for a in range(3)], "max": [max(p[a] for p in points) for a in range(3)]},
                  {"bufferView": 1, "componentType": 5123, "count": len(triangles), "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": len(vertices)},
                    {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(indices)}],
    "buffers": [{"byteLength": len(vertices) + len(indices)}]}).encode()
document += b" " * (-len(document) % 4)
binary = vertices + indices + b"\0" * (-(len(vertices) + len(indices)) % 4)
with open(sys.argv[1], "wb") as file:
    file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(document) + len(binary)))
    file.write(struct.pack("<I4s", len(document), b"JSON") + document)
    file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)
