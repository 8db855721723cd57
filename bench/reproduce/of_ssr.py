"""kernels/ssr/README.md"""
from catalogue import table
from intervals import ERROR, RATIO, SENSITIVE
from recipes import environment_errors, named, pair, sets

PAGE = "kernels/ssr/README.md"


@table(PAGE, "A map as environment", minutes=4)
def environment(lab):
    return environment_errors(lab, "reflection", "480x270", 64, ("gallery", "courtyard", "lounge", "temple", "statue"))


# The other eye's rays were chosen in other ways by code that is not part of the project.
ALONE = sets(reprojection="off")
OF_THE_OTHER_EYE = [ALONE, *[None] * 7, sets(other_neighbours=5), sets(other_neighbours=21), sets(other_neighbours=25), None, ("sssr", "--rays", 2)]
MATERIALS = ("--planes", "normal,color,roughness,reflectance,back_depth,instance")


def reflected(lab, frame, settings):
    technique, *flags = settings if settings[0] == "sssr" else ("stereo-ssr", *settings)
    return lab.result(technique, frame, *flags)


def figures(lab, frame, result, view):
    return lab.compared(result, lab.truth("reflection", frame, 64), "--plane", "reflection", "--view", view)


@table(PAGE, "Which rays of the other eye count", minutes=1)
def rays_that_count(lab):
    frames = [pair(lab, scene, "480x270", *MATERIALS) for scene in ("gallery", "lounge", "banquet")]
    rows = []
    for settings in OF_THE_OTHER_EYE:
        if settings is None:
            rows.append([None] * 4)
            continue
        results = [reflected(lab, frame, settings) for frame in frames]
        left = [figures(lab, frame, result, "left") for frame, result in zip(frames, results)]
        rows.append([tuple(found[name] for found in left) for name in ("ssim", "flip", "rmse")])
        rows[-1].append(tuple(lab.inconsistency(result) for result in results))
    return rows


@table(PAGE, "Which rays of the other eye count", 2, minutes=6)
def rays_at_a_larger_size(lab):
    rows = []
    for settings in (("sssr",), None, sets(other_neighbours=21)):
        rows.append([None] * 8 if settings is None else [])
        for frame in (pair(lab, scene, "960x540", *MATERIALS) for scene in ("gallery", "lounge") if settings):
            result = reflected(lab, frame, settings)
            eyes = [figures(lab, frame, result, view) for view in ("left", "right")]
            rows[-1] += [tuple(eye[name] for eye in eyes) for name in ("ssim", "flip", "rmse")] + [lab.inconsistency(result)]
    return rows


PAPERS_SCENES = ("gallery", "lounge", "banquet")


def within_of_the_paper(row, column):
    return RATIO if row < 3 or row in (15, 20, 21) else SENSITIVE if row > 15 else ERROR


@table(PAGE, "The paper measured again", minutes=20, shares="wu2024", within=within_of_the_paper)
def wu2024(lab):
    facts, times = lab.paper("wu2024", "--rays", 256)

    def ratio(column):
        return [(named(times, f"Table 3: {scene}*", "stereo-ssr", column)["ratio"], None) for scene in PAPERS_SCENES]

    def of_eye(what, eye, technique):
        return [next(v for (f, r, c), v in facts.items() if f == f"Table 2: {what}" and r.startswith(scene) and r.endswith(eye) and c == technique)
                for scene in PAPERS_SCENES]

    def of_eyes(what, technique):
        return list(zip(of_eye(what, "left", technique), of_eye(what, "right", technique)))

    def module(figure, row, column):
        return [next(v for (f, r, c), v in facts.items()
                     if f.startswith(f"Figures 10 to 14: {scene}") and f.endswith(figure) and (r, c) == (row, column)) for scene in PAPERS_SCENES]

    def time(row):
        return [named(times, "Equal samples and marching: time", row, scene)["ratio"] for scene in PAPERS_SCENES]

    def unseen(figure, column, factor=1):
        return [factor * next(v for (f, r, c), v in facts.items() if f.endswith(figure) and f.startswith("Section 5.4") and r.startswith(scene)
                              and r.endswith("left") and c == column) for scene in PAPERS_SCENES]

    apart, shown = "how far the errors of both eyes are apart", "where 90 % of the reflection is shown too"
    ssim = [[(value, None) for value in of_eye("SSIM to the truth", eye, technique)]
            for eye in ("left", "right") for technique in ("sssr", "stereo-ssr")]
    pairs = [of_eyes(what, technique) for what in ("FLIP to the truth", "RMSE to the truth", "RMSE to the truth, of what a screen shows")
             for technique in ("sssr", "stereo-ssr")]
    without = list(zip(*(module("SSIM", f"without {part}", "left") for part in ("traversal", "fade", "reprojection"))))
    return [ratio("traversal"), ratio("spatial filter"), ratio("total"), *ssim, *pairs, without,
            module("SSIM", "sssr, 2 rays (equal samples)", "left"), time("sssr, 2 rays"),
            *(module(apart, technique, where) for where in ("where both see the surface", shown) for technique in ("sssr", "stereo-ssr")),
            time("sssr, pixel by pixel"), time("sssr, cells know the nearest depth alone"),
            unseen("pixels", "below 10 % shown", 100), unseen("bias", "below 10 % shown"), unseen("bias", "over 90 % shown")]
