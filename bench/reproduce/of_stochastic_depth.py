"""kernels/stochastic_depth/README.md"""
from catalogue import table
from intervals import RATIO, SENSITIVE
from recipes import named

PAGE = "kernels/stochastic_depth/README.md"
SAMPLES = ("1 sample", "2 samples", "4 samples", "8 samples", "16 samples")


@table(PAGE, "What it gives", minutes=6, shares="vermeer2021", within=RATIO)
def table_1(lab):
    _, times = lab.paper("vermeer2021")
    rows = [[named(times, "Table 1: AO alone*", samples, column) for column in ("ssao, not in the paper", "HBAO", "HBAO+")] for samples in SAMPLES]
    return [[(time["ratio"], None) if time["paper_ratio"] else time["ratio"] for time in row] for row in rows]


@table(PAGE, "What it gives", 2, minutes=6, shares="vermeer2021", within=SENSITIVE)
def gap(lab):
    facts, _ = lab.paper("vermeer2021")
    rows = []
    for scene in ("colonnade", "corridor", "courtyard", "fence", "hairball"):
        closed = [named(facts, "Gap to all layers*", scene, column) for column in (*SAMPLES, "4, compensation 1.3", "4, early_out=on")]
        rows.append([named(facts, "Error to all layers*", scene, "regular"), *(100 * share for share in closed)])
    return rows


@table(PAGE, "What it gives", 3, minutes=6, shares="vermeer2021", within=SENSITIVE)
def hidden_occluders(lab):
    facts, _ = lab.paper("vermeer2021")
    return [[100 * named(facts, "Layer of the nearest hidden occluder", scene, layer) for layer in ("1", "2", "3", "4", "5", "6", "7 to 31")]
            for scene in ("fence", "hairball", "colonnade", "corridor")]
