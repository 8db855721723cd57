"""kernels/specular_occlusion/README.md"""
from catalogue import table
from recipes import BY_KIND, effect_errors, mean_of


@table("kernels/specular_occlusion/README.md", "Errors", minutes=6)
def errors(lab):
    rows = effect_errors(lab, "specular-occlusion", BY_KIND)
    # The program puts AO, converged, beside AO.
    return [[*cells[:2], *cells[3:6], cells[2], *cells[6:]] for cells in [*rows, mean_of(rows)]]
