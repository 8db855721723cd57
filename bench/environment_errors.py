"""Errors of light of an environment, and of reflections that see one, against ray-traced truth on built-in scenes, as tables in Markdown.

    python3 bench/environment_errors.py light FOLDER [GLOAM [SIZE [SAMPLES [SCENE ...]]]]        by default build/gloam, 480x270, 128 rays, all scenes
    python3 bench/environment_errors.py reflection FOLDER [GLOAM [SIZE [SAMPLES [SCENE ...]]]]   by default gallery, courtyard, lounge, temple, statue

Frames and truths are kept in FOLDER and made once. RMSE over the foreground, mean of the three components.

light: under a sky with a low sun, and in parentheses under the scene's own sky, which is nearly even. "open" is the error without
occlusion, "AO" that of ambient occlusion times the light on the open surface.
reflection: sssr with a black environment, with the mean of the scene's sky from everywhere, with the sky as a map, and with the map and
specular occlusion, within the scene's radius and without end. After the RMSE, the SSIM.
"""
import json
import math
import struct
import sys

from error_table import all_scenes, call, figures, print_table

OPEN = ["--method", "normal", "--radius", "0"]
CONVERGED = ["--directions", "32", "--steps", "64"]
LIGHT = [("open", OPEN), ("AO", ["--method", "normal"])]
LIGHT += [(f"bent normal, {preset}", ["--method", "bent_normal", "--preset", preset]) for preset in ("low", "medium", "ultra")]
LIGHT += [("bent normal, converged", ["--method", "bent_normal", *CONVERGED])]
LIGHT += [(f"slices, {preset}", ["--preset", preset]) for preset in ("low", "medium", "high", "ultra")]
LIGHT += [("slices, converged", CONVERGED)]
REFLECTING = ("gallery", "courtyard", "lounge", "temple", "statue")


def low_sun(width=256, height=128, elevation=25, size=6):
    """A blue sky over dark ground, and a sun whose light spreads over about `size` degrees, which sends as much as the sky."""
    to_sun = [math.cos(math.radians(elevation)) * math.sin(1.0), math.sin(math.radians(elevation)),
              math.cos(math.radians(elevation)) * math.cos(1.0)]
    sharpness = 2 / math.radians(size) ** 2
    rows = []
    for y in range(height):
        latitude = math.pi / 2 - (y + 0.5) / height * math.pi
        up, level = math.sin(latitude), math.cos(latitude)
        row = []
        for x in range(width):
            longitude = math.pi - (x + 0.5) / width * 2 * math.pi
            toward = [level * math.sin(longitude), up, level * math.cos(longitude)]
            sun = 0.5 * sharpness * math.exp(sharpness * (sum(a * b for a, b in zip(toward, to_sun)) - 1))
            sky = (0.25, 0.45, 0.9) if up > 0 else (0.1, 0.08, 0.06)
            row.append([sky[i] + sun * (1, 0.85, 0.6)[i] for i in range(3)])
        rows.append(row)
    return rows


def write_map(path, rows):
    """An uncompressed EXR file of floats, by the layout of the OpenEXR file format."""
    height, width = len(rows), len(rows[0])

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<i4B2i", 2, 0, 0, 0, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    header = struct.pack("<2i", 20000630, 2)
    header += attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box)
    header += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    size = 12 * width
    first = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header)
        file.write(struct.pack(f"<{height}Q", *(first + y * (size + 8) for y in range(height))))
        for y, row in enumerate(rows):
            file.write(struct.pack("<2i", y, size))
            for component in (2, 1, 0):
                file.write(struct.pack(f"<{width}f", *(pixel[component] for pixel in row)))


def frame_of(gloam, folder, scene, size):
    frame, sky = folder / f"{scene}.exr", folder / f"{scene}_sky.exr"
    if not frame.exists() or not sky.exists():
        call(gloam, "capture", scene, "-o", frame, "--size", size, "--sky", sky)
    return frame, sky


def light_errors(gloam, folder, scene, size, samples):
    frame, sky = frame_of(gloam, folder, scene, size)
    sun, result = folder / "low_sun.exr", folder / "result.exr"
    if not sun.exists():
        write_map(sun, low_sun())
    errors = {name: [] for name, _ in LIGHT}
    for light in (sun, sky):
        truth = folder / f"{scene}_under_{light.stem}.exr"
        if not truth.exists():
            call(gloam, "reference", "environment", frame, "-o", truth, "--environment", light, "--samples", samples)
        for name, settings in LIGHT:
            call(gloam, "run", "environment", frame, "-o", result, "--float", "--environment", light, *settings)
            errors[name].append(figures(gloam, result, truth, "environment")["rmse"])
    return {name: f"{under_sun:.4f} ({under_sky:.4f})" for name, (under_sun, under_sky) in errors.items()}


def reflection_errors(gloam, folder, scene, size, samples):
    frame, sky = frame_of(gloam, folder, scene, size)
    truth, result = folder / f"{scene}_reflection.exr", folder / "result.exr"
    if not truth.exists():
        call(gloam, "reference", "reflection", frame, "-o", truth, "--samples", samples)

    def error(source, *settings):
        call(gloam, "run", "sssr", source, "-o", result, "--float", *settings)
        found = figures(gloam, result, truth, "reflection")
        return f"{found['rmse']:.4f} ({found['ssim']:.3f})"

    def occluded(*settings):
        copy = folder / f"{scene}_with_occlusion.exr"
        call(gloam, "run", "specular-occlusion", frame, "--into", copy, "--float", *settings)
        return error(copy, "--environment", sky)

    mean = json.loads(call(gloam, "info", sky, "--json", "-"))["planes"][0]["mean"]
    constant = [word for name in "rgb" for word in (f"--environment_{name}", mean)]
    return {"black": error(frame), "constant": error(frame, *constant), "map": error(frame, "--environment", sky),
            "map, specular occlusion": occluded(), "map, specular occlusion without end": occluded("--radius", "inf")}


def main(what, folder, gloam="build/gloam", size="480x270", samples="128", *scenes):
    cells_of = {"light": light_errors, "reflection": reflection_errors}[what]
    chosen = scenes or (all_scenes(gloam) if what == "light" else REFLECTING)
    print_table(folder, chosen, lambda folder, scene: cells_of(gloam, folder, scene, size, samples))


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in ("light", "reflection"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
