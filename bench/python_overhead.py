"""What a call of gloam.run costs beside the kernels and one copy of each array each way: ratios, each made in one process.

Usage: PYTHONPATH=build/python python3 bench/python_overhead.py [WIDTH HEIGHT [CALLS]]
"""

import statistics
import sys
import time

import numpy

import gloam


def milliseconds(work):
    begun = time.perf_counter()
    kept = work()
    return (time.perf_counter() - begun) * 1e3, kept


def main(width=1920, height=1080, calls=9):
    frame = gloam.capture("colonnade", width, height, ["normal"])
    arrays = {name: numpy.array(frame[name]) for name in ("depth", "normal")}
    camera = frame.camera
    print(gloam.Device())
    print(f"{width} x {height}, medians of {calls} calls; ratio: call / (kernels + copies)")
    for technique in ("gtao", "hbao+", "evidence"):
        call = lambda: gloam.run(technique, **arrays, camera=camera, radius=0.5)
        call()
        rows = []
        for _ in range(calls):
            wall, result = milliseconds(call)
            copies, _ = milliseconds(lambda: [array.copy() for array in (*arrays.values(), *result.values())])
            rows.append((wall, result.ms, copies, wall / (result.ms + copies)))
        wall, kernels, copies, ratio = (statistics.median(column) for column in zip(*rows))
        print(f"{technique:9} call {wall:6.1f} ms, kernels {kernels:6.1f}, copies {copies:4.1f}, ratio {ratio:.3f}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
