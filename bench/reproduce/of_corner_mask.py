"""kernels/corner_mask/README.md"""
from catalogue import table
from intervals import ERROR, RATIO, SENSITIVE
from recipes import computed_share, rmse, where_captured

PAGE = "kernels/corner_mask/README.md"
TECHNIQUES = ("hbao+", "gtao", "alchemy")
RADIUS = ("--radius", 0.5)


def plane(lab, name, technique, frame, *flags):
    """Of all views together."""
    import gloam
    import numpy
    values = gloam.read(lab.result(technique, frame, *flags), planes=[name])[name]
    return numpy.concatenate(values) if isinstance(values, list) else values


def of_mask(lab, frame, radius):
    """Shares of pixels: wanted, and for each technique left out although its filtered AO lies below 254/255."""
    mask = plane(lab, "mask", "corner-mask", frame, *radius)
    cells = [100 * float(mask.mean())]
    for technique in TECHNIQUES:
        whole, only = (plane(lab, "ao", technique, frame, *radius, *flags) for flags in ((), ("--only", "corner-mask")))
        cells.append(100 * float(((whole < 254 / 255) & (only == 1) & (mask == 0)).mean()))
    return cells


@table(PAGE, "What it costs and what it misses", minutes=2, within=SENSITIVE)
def corner_mask(lab):
    rows = [of_mask(lab, lab.frame(scene, "1920x1080", "--planes", "normal"), RADIUS) for scene in ("courtyard", "temple")]
    for name, radius in (("kitchen/kitchen_exact.exr", 0.3), ("apartment_stereo/apartment_stereo_exact.exr", 0.4)):
        rows.append(where_captured(lab, name, lambda frame: of_mask(lab, frame, ("--radius", radius))) or [None] * 4)
    return rows


def total_ms(lab, technique, frame, *flags):
    return lab.figures("run", technique, frame, "-o", lab.unused("result.exr"), "--repeat", 9, *flags)["total_ms"]["median"]


def differing(a, b):
    return 100 * float((abs(a - b) > 1 / 255).mean())


@table(PAGE, "hidden-mask", minutes=3, within=lambda row, column: (SENSITIVE, RATIO, SENSITIVE, ERROR)[column])
def hidden_mask(lab):
    masked, rows = ("--only", "hidden-mask", "--elsewhere", "gtao"), []
    for scene in ("courtyard", "colonnade", "corridor"):
        frame = lab.frame(scene, "1920x1080", "--planes", "normal", "--stochastic", 4)
        everywhere, with_mask, alone = (lab.result(technique, frame, *RADIUS, *flags)
                                        for technique, flags in (("sd-gtao", ()), ("sd-gtao", masked), ("gtao", ())))
        differences = [differing(plane(lab, "ao", "sd-gtao", frame, *RADIUS), plane(lab, "ao", technique, frame, *RADIUS, *flags))
                       for technique, flags in (("sd-gtao", masked), ("gtao", ()))]
        wanted = 100 * computed_share(lab, "sd-gtao", frame, *RADIUS, "--only", "hidden-mask", "--filter", "none")
        time = total_ms(lab, "sd-gtao", frame, *RADIUS, *masked) / total_ms(lab, "sd-gtao", frame, *RADIUS)
        rows.append([wanted, time, tuple(differences), tuple(rmse(lab, image, everywhere) for image in (with_mask, alone))])
    return rows
