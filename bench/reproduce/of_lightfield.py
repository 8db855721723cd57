"""kernels/lightfield/README.md"""
from catalogue import table
from intervals import ERROR, MACHINE, RATIO
from recipes import named

PAGE = "kernels/lightfield/README.md"
TECHNIQUES = ("lightfield-ssao", "lightfield-hbao+")
ALL = ("reuse=off", *(f"reuse=on, key_views={spacing}" for spacing in (2, 4, 8)))
MODELS = ("5011 faces, for", "29520 faces", "212574 faces", "5011 faces, once more")  # as asked for
PAPER = {"minutes": 20, "shares": "doronin2017"}


@table(PAGE, "Measured", **PAPER, within=lambda row, column: RATIO if column else MACHINE)
def table_1(lab):
    _, times = lab.paper("doronin2017", "--rays", 256)
    rows = [named(times, "Table 1: AO of one module", f"{model}*", "all passes") for model in MODELS]
    return [[(rows[0]["ms"], None), *((row["ratio"], None) for row in rows[1:3]), rows[3]["ratio"]]]


@table(PAGE, "Measured", 2, **PAPER, within=lambda row, column: (MACHINE if column % 4 == 0 else RATIO) if row == 1 else ERROR)
def modules(lab):
    facts, times = lab.paper("doronin2017", "--rays", 256)

    def fact(what, names=ALL, factor=1):
        return [factor * named(facts, f"80 modules: {what}", name, technique) if name in names else () for technique in TECHNIQUES for name in ALL]

    def time(technique, name):
        of = named(times, f"Section 5: 80 modules, {technique}", name, "80 views")
        return of["ms"] / 1000 if name == "reuse=off" else of["ratio"]

    computed = [100 if name == "reuse=off" else 100 * named(facts, "80 modules: computed, of all surfaces", name, technique)
                for technique in TECHNIQUES for name in ALL]
    return [[None] * 8, [time(technique, name) for technique in TECHNIQUES for name in ALL], computed,
            fact("RMSE to converged AO, eight modules in the middle"), fact("RMSE to rays, the middle module"),
            fact("RMSE to reuse=off", ALL[1:]), fact("inconsistency of neighbours")]


POINTS = ("spiral", "random", "jittered", "latin_square", "poisson_disk")
SHAPES = ("5 radii, half ball", "5 radii, half shell", "1 radius, half ball", "the paper: 5 radii, shell, any range")


@table(PAGE, "Measured", 3, **PAPER, within=lambda row, column: RATIO if column == len(POINTS) else ERROR)
def points(lab):
    facts, times = lab.paper("doronin2017", "--rays", 256)
    rows = []
    for shape in SHAPES:
        errors = [(named(facts, "Section 6: RMSE to rays, with Gaussian", shape, points),
                   named(facts, "Section 6: noise, RMSE to the same of 256 points, with Gaussian", shape, points)) for points in POINTS]
        rows.append([*errors, named(times, "Section 6: time", shape, POINTS[0])["ratio"] or 1])
    return rows
