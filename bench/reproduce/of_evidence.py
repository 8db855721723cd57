"""kernels/evidence/README.md"""
import math

import documents
from catalogue import picture, record, table
from intervals import ERROR, RATIO, SENSITIVE
from recipes import SCENES, capture, environment_errors, mean_of, rows_printed

PAGE = "kernels/evidence/README.md"
HEADING = "Where the coefficients come from"
MEASURED = [scene for scene in SCENES if scene not in ("clockwork", "plane")]
KINDS = ("architecture", "object", "thin")
MEDIUM, HIGH = "1 x 9 x 2 samples", "1 x 18 x 2 samples"
TERMS = {"depth": "depth", "back_depth": "back_depth", "sd-": "stochastic", "dp-": "peel"}


def cross_validations(lab):
    """By occluders and samples: scene, or kind for a mean, to errors of gtao, bitmask and evidence, and the share of open pixels that evidence darkens, %."""
    printed = lab.printed("sh", "-c", f"build/bench/bench_fit --folder {lab.folder_for('fit')} 2>/dev/null")
    found = {}
    for part in printed.split("\nOccluders by ")[1:]:
        occluders, samples = part.splitlines()[0].split(", ")
        rows = [row for row in rows_printed(part) if row[0] not in ("scene", "---")]
        kinds = [line.split("|")[2].strip() for line in part.splitlines() if line.startswith("|")][2:]
        found[occluders, samples] = {kind if name == "mean" else name: [cell[0] for cell in cells[1:]] for (name, cells), kind in zip(rows, kinds)}
    return found


@table(PAGE, HEADING, minutes=9, labels=2)
def cross_validation(lab):
    found = cross_validations(lab)

    def evidence(occluders, samples, row):
        return found[TERMS[occluders], samples][row][2]

    return [[*found["depth", MEDIUM][row][:3], found["depth", MEDIUM][row][3], *(evidence(how, MEDIUM, row) for how in ("back_depth", "sd-", "dp-")),
             *found["depth", HIGH][row][:3], evidence("dp-", HIGH, row)] for row in (*MEASURED, *KINDS)]


def of_kitchen(lab, technique, preset):
    frame = capture(lab, "kitchen/kitchen_exact.exr")
    return lab.compared(lab.result(technique, frame, "--radius", 0.3, "--preset", preset), capture(lab, "kitchen/kitchen_ao_ref.exr"))


def of_apartment(lab, technique, preset):
    """Of both eyes together."""
    result = lab.result(technique, capture(lab, "apartment_stereo/apartment_stereo_exact.exr"), "--radius", 0.4, "--preset", preset)
    eyes = [lab.compared(result, capture(lab, f"apartment_stereo/apartment_stereo_ao_ref_{view}.exr"), "--view", view) for view in ("left", "right")]
    return {"rmse": math.sqrt(sum(e["rmse"] ** 2 * e["pixels"] for e in eyes) / sum(e["pixels"] for e in eyes)),
            "ssim": sum(e["ssim"] for e in eyes) / 2}


WITH_SSIM = {("kitchen", "medium", "gtao"), ("kitchen", "ultra", "bitmask"), ("apartment", "medium", "gtao"), ("apartment", "ultra", "bitmask")}


@table(PAGE, HEADING, 2, minutes=3)
def real_frames(lab):
    rows = []
    for scene, measure in (("kitchen", of_kitchen), ("apartment", of_apartment)):
        for preset in ("low", "medium", "high", "ultra"):
            found = {technique: measure(lab, technique, preset) for technique in ("gtao", "bitmask", "evidence")}
            rows.append([(f["rmse"], f["ssim"]) if technique == "evidence" or (scene, preset, technique) in WITH_SSIM else f["rmse"]
                         for technique, f in found.items()])
    return rows


@table(PAGE, HEADING, 3, minutes=4, within=RATIO)
def against_time(lab):
    folder = lab.bench("evidence", "--scenes", "gallery", "--size", "1920x1080", "--techniques", "hbao+,gtao,bitmask,evidence", "--variants", "none",
                       "--ladder", "none", "--no-growth", "--no-checks", "--no-images")
    found = {(r["technique"], r["preset"]): r for r in documents.read(folder)["results"]}
    names, presets = ("ratio_to_hbao_plus", "rmse_to_truth"), ("low", "medium", "high", "ultra")
    return [[tuple(found[technique, preset][name] for name in names) for preset in presets]
            for technique in ("gtao", "bitmask", "evidence")]


@table(PAGE, HEADING, 4, minutes=1, within=lambda row, column: SENSITIVE if column == 4 else ERROR)
def spectrum(lab):
    frame, truth = capture(lab, "kitchen/kitchen_exact.exr"), capture(lab, "kitchen/kitchen_ao_ref.exr")
    images = [lab.result(technique, frame, "--radius", 0.3, "--preset", preset)
              for technique, preset in (("gtao", "medium"), ("bitmask", "medium"), ("evidence", "medium"), ("gtao", "ultra"), ("evidence", "ultra"))]
    rows = dict(rows_printed(lab.printed(lab.root / "build/bench/bench_spectrum", truth, *images)))
    return [[cell[0] for cell in rows[image][1:]] for image in images]


record(PAGE, "Open surfaces stay open", why="the terms before are no longer part of the project")
record(PAGE, "docs/images/evidence_faults.png", why="shows the terms and the history before, which are no longer part of the project")
record(PAGE, "A second look", why="made once with the Python module: the frame before as the second of two arrays of stereo-evidence")


@table(PAGE, "Light of an environment", minutes=12)
def environment(lab):
    rows = [[*cells[:2], *cells[3:]] for cells in environment_errors(lab, "light", "320x180", 64, SCENES)]  # without bent normals at low
    mean = mean_of(rows)
    return [*([sun for sun, _ in cells] for cells in [*rows, mean]), [sky for _, sky in mean]]


CROP = (330, 270)
CROPS = (("gallery", (330, 330)), ("lounge", (700, 480)), ("courtyard", (640, 560)))  # left and top


def labelled(rows, columns, names):
    """A grey picture of images in rows, with a label above each column and beside each row."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    import numpy
    margin, gap, dpi = 26, 4, 100
    height, width = rows[0][0].shape
    total = (margin + len(columns) * (width + gap), margin + len(rows) * (height + gap))
    figure = Figure(figsize=(total[0] / dpi, total[1] / dpi), dpi=dpi, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    style = {"fontsize": 10, "ha": "center", "va": "center"}
    for y, (name, images) in enumerate(zip(names, rows)):
        bottom = total[1] - margin - y * (height + gap) - height
        figure.text(margin / 2 / total[0], (bottom + height / 2) / total[1], name, rotation=90, **style)
        for x, image in enumerate(images):
            figure.figimage(image, margin + x * (width + gap), bottom, cmap="gray", vmin=0, vmax=1, origin="upper")
    for x, label in enumerate(columns):
        figure.text((margin + x * (width + gap) + width / 2) / total[0], 1 - margin / 2 / total[1], label, **style)
    canvas.draw()
    return numpy.asarray(canvas.buffer_rgba())[..., 0]


@picture(PAGE, "docs/images/evidence_crops.png", minutes=0.5)
def crops(lab):
    import cv2
    import gloam
    rows = []
    for scene, (x, y) in CROPS:
        frame = lab.frame(scene, "1920x1080", "--planes", "normal")
        images = [lab.result("gtao", frame, "--preset", "medium"), lab.result("evidence", frame, "--preset", "medium"), lab.truth("ao", frame, 64)]
        rows.append([gloam.read(image)["ao"][y:y + CROP[1], x:x + CROP[0]] for image in images])
    path = lab.folder_for("crops") / "evidence_crops.png"
    picture_of_all = labelled(rows, ("gtao, medium", "evidence, medium", "truth, 64 rays"), [scene for scene, _ in CROPS])
    cv2.imwrite(str(path), picture_of_all, [cv2.IMWRITE_PNG_COMPRESSION, 9])
    return path
