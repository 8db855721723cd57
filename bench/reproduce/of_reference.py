"""docs/reference.md"""
from catalogue import record, table
from intervals import ERROR, MACHINE
from lab import OUT
from recipes import SCENES

PAGE = "docs/reference.md"


def surfaces(path, plane):
    """The plane's values at surfaces, one row a pixel."""
    import gloam
    frame = gloam.read(path, planes=[plane, "depth"])
    return frame[plane][abs(frame["depth"]) < float("inf")]


def luminance(colours):
    return float((colours @ [0.2126, 0.7152, 0.0722]).mean())


@table(PAGE, "What the built-in scenes have to measure", minutes=1)
def scenes(lab):
    rows = []
    for scene in SCENES:
        frame = lab.frame(scene, "240x135")
        color, albedo = (surfaces(frame, plane) for plane in ("color", "albedo"))
        reflected = [100 * luminance(surfaces(lab.truth("indirect", frame, 64, *flags), "indirect") * albedo) / luminance(color)
                     for flags in ((), ("--radius", "inf"))]
        means = [float(surfaces(lab.truth(kind, frame, 64), kind).mean()) for kind in ("ao", "bounces", "specular_occlusion")]
        stated = lab.figures("reference", "ao", frame, "-o", lab.unused("truth.exr"), "--samples", 32)["radius"]
        rows.append([stated, *reflected, *means])
    return rows


KINDS = (("ao",), ("bounces",), ("specular_occlusion",), ("indirect",), ("environment",), ("contact",), ("contact", "--light-angle", 1.5))


@table(PAGE, "What they take", minutes=9, within=lambda row, column: ERROR if column % 2 else MACHINE)
def what_they_take(lab):
    rows = []
    for kind, *flags in KINDS:
        cells = []
        for scene in ("courtyard", "lounge"):
            frame = lab.frame(scene, "960x540")
            sky = lab.made("sky.exr", "capture", scene, "-o", lab.unused("of_sky.exr"), "--size", "96x54", "--sky", OUT)
            light = ("--environment", sky) if kind == "environment" else ()
            told = lab.figures("reference", kind, frame, "-o", lab.unused("truth.exr"), "--samples", 256, *flags, *light)
            cells += [told["seconds"], told["noise"]]
        rows.append(cells)
    return rows


record(PAGE, "How exact they are", why="the largest errors of tests/analytic, which compare them with bounds and print none")
