"""kernels/evidence/README.md"""
from catalogue import table
from recipes import SCENES, environment_errors, mean_of

PAGE = "kernels/evidence/README.md"


@table(PAGE, "Light of an environment", minutes=12)
def environment(lab):
    rows = [[*cells[:2], *cells[3:]] for cells in environment_errors(lab, "light", "320x180", 64, SCENES)]  # without bent normals at low
    mean = mean_of(rows)
    return [*([sun for sun, _ in cells] for cells in [*rows, mean]), [sky for _, sky in mean]]
