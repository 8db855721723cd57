"""Writes a frame as images of other formats than EXR, under the names of docs/gbuffer.md. Usage: images.py FRAME.exr"""
import sys

import cv2
import gloam
import numpy

frame = gloam.read(sys.argv[1])
depth, normal, color = (numpy.array(frame[plane]) for plane in ("depth", "normal", "color"))
bytes_of = lambda shares: numpy.round(numpy.clip(shares, 0, 1) * 255).astype(numpy.uint8)
for number in (1, 2):
    numpy.save(f"depth.{number:04}.npy", depth)
    numpy.save(f"normal.{number:04}.npy", normal)
numpy.save("depth.npy", depth)
numpy.savez("arrays.npz", depth=depth, normals=normal, colors=color)
cv2.imwrite("d.png", numpy.where(numpy.isfinite(depth), numpy.round(depth * 1000), 0).astype(numpy.uint16))
cv2.imwrite("n.png", bytes_of(normal * 0.5 + 0.5)[..., ::-1])
cv2.imwrite("c.png", bytes_of(color)[..., ::-1])
cv2.imwrite("rough.png", bytes_of(numpy.full(depth.shape, 0.5)))
