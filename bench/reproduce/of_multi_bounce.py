"""kernels/multi_bounce/README.md"""
from catalogue import table
from recipes import BY_KIND, effect_errors, mean_of, row_of


@table("kernels/multi_bounce/README.md", "Errors", minutes=6)
def errors(lab):
    estimated = effect_errors(lab, "bounces", BY_KIND)
    folder = lab.folder_for("effect-bounces")
    printed = lab.program("bounces_fit.py", folder, *BY_KIND)
    rows = []
    for scene, (white, *by_evidence) in zip([*BY_KIND, "mean"], [*estimated, mean_of(estimated)]):
        rows.append([white, *row_of(printed, scene), *by_evidence])
    return rows
