"""kernels/stochastic_depth/README.md"""
from catalogue import no_figures, table
from intervals import RATIO, SENSITIVE
from recipes import named

PAGE = "kernels/stochastic_depth/README.md"
SAMPLES = ("1 sample", "2 samples", "4 samples", "8 samples", "16 samples")


COLUMNS = ("SSAO: alchemy", "SSAO: sao", "HBAO", "HBAO+", "ssao, not in the paper")
SCENES = ("colonnade*", "gallery*", "courtyard*", "hairball*")
GAPS = ("colonnade", "corridor", "courtyard", "fence", "hairball")
VIEWS = ("two, full resolution", "two, half resolution", "two, the second alone at half")


def ratios(lab, of_table, rows, columns):
    """Ratios; those of the paper, in brackets, are not measured."""
    _, times = lab.paper("vermeer2021")
    cells = [[named(times, of_table, row, column) for column in columns] for row in rows]
    return [[(time["ratio"], None) if time["paper_ratio"] else time["ratio"] for time in row] for row in cells]


def closed_by(lab, columns):
    facts, _ = lab.paper("vermeer2021")
    return [[100 * named(facts, "Gap to all layers*", scene, column) for column in columns] for scene in GAPS]


no_figures(PAGE, "stochastic-depth", why="parameters and their values")


@table(PAGE, "Which map", minutes=11, shares="vermeer2021", within=SENSITIVE)
def maps(lab):
    return closed_by(lab, ("4 samples", "4, alpha 0.25", "4, hidden, alpha 0.2", "4, hidden, alpha 0.25", "4, hidden, alpha 0.3",
                           "4, nearest hidden"))


@table(PAGE, "Which map", 2, minutes=11, shares="vermeer2021", within=SENSITIVE)
def nearest_hidden(lab):
    return closed_by(lab, [f"{samples}, nearest hidden" for samples in (1, 2, 4, 8, 16)])


@table(PAGE, "Which map", 3, minutes=11, shares="vermeer2021", within=SENSITIVE)
def behind_sheets(lab):
    facts, _ = lab.paper("vermeer2021")
    columns = ("4 samples", "nearest hidden", "relevant, alpha 0.25", "nearest relevant")
    return [[100 * named(facts, "Figure 8*", f"{sheets} extra layers", column) for column in columns] for sheets in (0, 1, 5, 10)]


@table(PAGE, "What it gives", minutes=11, shares="vermeer2021", within=RATIO)
def table_1(lab):
    return ratios(lab, "Table 1: AO alone, colonnade for Sponza", SAMPLES, COLUMNS)


@table(PAGE, "Times with the map", minutes=11, shares="vermeer2021", within=RATIO)
def table_2(lab):
    rows = [f"{row}, {size}" for size in ("full", "half") for row in ("regular HBAO+", *SAMPLES)]
    return ratios(lab, "Table 2: HBAO+ with its map", rows[1:], SCENES)


@table(PAGE, "Times with the map", 2, minutes=11, shares="vermeer2021", within=RATIO)
def table_3(lab):
    return ratios(lab, "Table 3: two views, gallery for Sibenik", VIEWS, SAMPLES[:4])


@table(PAGE, "What it gives", 2, minutes=11, shares="vermeer2021", within=SENSITIVE)
def gap(lab):
    facts, _ = lab.paper("vermeer2021")
    rows = []
    for scene in GAPS:
        closed = [named(facts, "Gap to all layers*", scene, column) for column in (*SAMPLES, "4, compensation 1.3", "4, early_out=on")]
        rows.append([named(facts, "Error to all layers*", scene, "regular"), *(100 * share for share in closed)])
    return rows


@table(PAGE, "What it gives", 3, minutes=11, shares="vermeer2021", within=SENSITIVE)
def hidden_occluders(lab):
    facts, _ = lab.paper("vermeer2021")
    return [[100 * named(facts, "Layer of the nearest hidden occluder", scene, layer) for layer in ("1", "2", "3", "4", "5", "6", "7 to 31")]
            for scene in ("fence", "hairball", "colonnade", "corridor")]
