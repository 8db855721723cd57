"""kernels/gtao/README.md"""
from catalogue import table
from intervals import SENSITIVE
from recipes import SCENES, effect_errors, effect_files

PAGE = "kernels/gtao/README.md"
OF_FIREFLIES = ("lounge", "gallery", "courtyard", "banquet")


@table(PAGE, "Indirect light", minutes=12)
def indirect(lab):
    return effect_errors(lab, "indirect", SCENES)


def compared(lab, scene, *settings):
    frame, truth = map(str, effect_files(lab, "indirect", "indirect", scene))
    return lab.compared(lab.result("indirect", frame, *settings), truth, "--plane", "indirect"), truth


def mean_light(lab, truth):
    """Over the surfaces, of the three components."""
    import gloam
    plane = gloam.read(truth, planes=["indirect", "depth"])
    return float(plane["indirect"][abs(plane["depth"]) < float("inf")].mean())


def with_bias(lab, scene, *settings):
    found, truth = compared(lab, scene, "--preset", "medium", *settings)
    return found["rmse"], found["bias"], 100 * found["bias"] / mean_light(lab, truth)


@table(PAGE, "Fireflies", minutes=4, within=SENSITIVE)
def fireflies(lab):
    rows = [[with_bias(lab, scene, *settings) for scene in OF_FIREFLIES]
            for settings in ((), *(("--brightest", most) for most in (2, 1, 0.5)))]
    # The same: nothing on these scenes is as bright.
    rows[1][1:] = [()] * 3
    rows[2][1] = ()
    # The other four were tried outside the project.
    return [*rows, *[[None] * 4] * 4]


@table(PAGE, "Fireflies", 2, minutes=2)
def more_slices(lab):
    settings = (("--preset", "high"), ("--preset", "high", "--rays", 4), ("--preset", "medium", "--directions", 2),
                ("--preset", "high", "--directions", 2))
    return [[compared(lab, scene, *flags)[0]["rmse"] for scene in OF_FIREFLIES] for flags in settings]
