"""kernels/outline_mask/README.md"""
from catalogue import table
from intervals import ERROR, MACHINE, RATIO, SENSITIVE
from recipes import named

PAGE = "kernels/outline_mask/README.md"
SCENES = ("courtyard", "temple", "corridor")
CAMERAS = "Table 1: 100 cameras, turned in their place, at a quarter of the pixels"
INTERVALS = [RATIO] * 5 + [SENSITIVE] * 5 + [MACHINE, RATIO, ERROR, ERROR]


@table(PAGE, "The paper's measurements again", minutes=4, shares="odssao2020", within=lambda row, column: INTERVALS[row])
def measurements(lab):
    facts, times = lab.paper("odssao2020")

    def fact(figure, row, factor=1):
        return [factor * named(facts, figure, row, scene) for scene in SCENES]

    def ratio(table, row):
        return [named(times, table, row, scene)["ratio"] for scene in SCENES]

    def beside_the_papers(values, of_the_paper=3):
        return [(value, None) if i < of_the_paper else value for i, value in enumerate(values)]

    missed = "pixels that miss 1/255 of AO and more"
    return [beside_the_papers(ratio("Table 1: AAO alone*", "only outline-mask")),
            ratio("Section 4: SAO alone*", "SAO, only outline-mask"),
            beside_the_papers(fact(CAMERAS, "outline-mask, average over average")),
            beside_the_papers(fact(CAMERAS, "outline-mask, worst over worst")),
            fact(CAMERAS, "corner-mask, cells of 8, average over average"),
            fact(f"{CAMERAS}: processed pixels", "outline-mask", 100),
            fact(f"Masks: {missed}", "outline-mask", 100),
            fact(f"Masks: {missed}", "outline-mask, SAO", 100),
            fact(f"{CAMERAS}: {missed}", "outline-mask", 100),
            fact(f"{CAMERAS}: {missed}", "corner-mask", 100),
            fact("Outlines: counting them*", "rays on the CPU", 1e-3),
            beside_the_papers(ratio("Section 5: the mask as AO*", "outline-ao, the same filter"), 1),
            fact("Section 5: error to rays", "AAO"),
            fact("Section 5: error to rays", "outline-ao, occlusion 0.25")]
