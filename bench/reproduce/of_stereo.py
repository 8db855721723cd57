"""docs/stereo.md"""
from catalogue import table
from intervals import RATIO
from recipes import of_each_view, pair, sets, where_captured

PAGE = "docs/stereo.md"
SCENES = ("courtyard", "colonnade", "gallery")
RADIUS = ("--radius", 0.5)
ALONE = sets(estimate="mono", reproject="off", filter="mono")
BOTH = sets(estimate="stereo", reproject="off", filter="mono")
TAKEN_OVER = sets(estimate="stereo", reproject="on", filter="mono")
FILTERED = sets(estimate="stereo", reproject="on", filter="stereo")
LETTERS = {"A": ALONE, "B": BOTH, "C": TAKEN_OVER, "D": FILTERED, "D, squares": sets(estimate="stereo", reproject="on", filter="stereo2d"),
           "E": sets(estimate="mono", reproject="on", filter="mono")}
NORMALS = ("--planes", "normal")


def apart(lab, technique, frame, *flags):
    """Mean inconsistency, times 100 000."""
    return 1e5 * lab.inconsistency(lab.result(technique, frame, *flags))


def errors(lab, technique, frame, *flags):
    """RMSE to 256 rays, within the radius, of either eye."""
    truth = lab.truth("ao", frame, 256, *RADIUS)
    return of_each_view(lab, lab.result(technique, frame, *RADIUS, *flags), truth)


@table(PAGE, "AO that both eyes agree on", 2, minutes=3, labels=4)
def letters(lab):
    everywhere = sets(other_eye="everywhere")
    rows = []
    for settings in LETTERS.values():
        cells = [apart(lab, "stereo-ao", pair(lab, scene, "960x540", *NORMALS), *RADIUS, *everywhere, *settings) for scene in SCENES]
        cells.append(where_captured(lab, "apartment_stereo/apartment_stereo_exact.exr",
                                    lambda frame: apart(lab, "stereo-ao", frame, "--radius", 0.4, *everywhere, *settings)))
        rows.append(cells)
    return rows


RESOLUTIONS = ("full", "half", "quarter")


def by_resolution(make):
    """What each eye upsampled by itself would give, in brackets, the command no longer makes."""
    return [make(name) for name in RESOLUTIONS]


@table(PAGE, "At a lower resolution", minutes=2, labels=2)
def resolutions(lab):
    large = {scene: pair(lab, scene, "960x540", *NORMALS) for scene in SCENES}
    small = pair(lab, "gallery", "480x270", *NORMALS)

    def far(scene, settings, bracketed):
        values = by_resolution(lambda name: apart(lab, "stereo-ao", large[scene], *RADIUS, *settings, "--resolution", name))
        return [values[0], *((value, None) if bracketed else value for value in values[1:])]

    def error(settings, bracketed):
        values = by_resolution(lambda name: errors(lab, "stereo-ao", small, *settings, "--resolution", name))
        return [values[0], *((*value, None, None) if bracketed else value for value in values[1:])]

    return [far("gallery", ALONE, False), *(far(scene, FILTERED, True) for scene in ("gallery", "courtyard", "colonnade")),
            error(ALONE, False), error(FILTERED, True)]


@table(PAGE, "At a lower resolution", 2, minutes=1)
def other_estimators_reduced(lab):
    frame, rows = pair(lab, "gallery", "480x270", *NORMALS), []
    for technique in ("stereo-gtao", "stereo-bitmask"):
        far = by_resolution(lambda name: apart(lab, technique, frame, *RADIUS, "--resolution", name))
        off = [errors(lab, technique, frame, "--resolution", name) for name in RESOLUTIONS[1:]]
        rows.append([far[0], *((value, None) for value in far[1:]), *((*value, None, None) for value in off)])
    return rows


@table(PAGE, "With other estimators", 2, minutes=2, labels=2)
def other_estimators(lab):
    rows = []
    for technique, letters_of in (("stereo-gtao", "ABCD"), ("stereo-bitmask", "ABCD"), ("stereo-sd-hbao+", "AD")):
        planes = (*NORMALS, "--stochastic", 4) if "-sd-" in technique else NORMALS
        for letter in letters_of:
            far = [apart(lab, technique, pair(lab, scene, "960x540", *planes), *RADIUS, *LETTERS[letter]) for scene in SCENES]
            off = [errors(lab, technique, pair(lab, scene, "480x270", *planes), *LETTERS[letter]) for scene in SCENES]
            rows.append([*far, *off])
    return rows


@table(PAGE, "Indirect light", minutes=1)
def indirect(lab):
    frames = [pair(lab, scene, "480x270") for scene in (*SCENES, "lounge")]
    rows = []
    for letter in "ABCD":
        results = [lab.result("stereo-indirect", frame, "--preset", "medium", *LETTERS[letter]) for frame in frames]
        far = [1e5 * lab.inconsistency(result) for result in results]
        off = [of_each_view(lab, result, lab.truth("indirect", frame, 64)) for result, frame in zip(results, frames)]
        rows.append([*far, *off])
    return rows


NAMES = {"A": "A: estimate mono, reproject off, filter mono", "B": "B: estimate stereo, reproject off, filter mono",
         "C": "C: estimate stereo, reproject on, filter mono", "D": "D: estimate stereo, reproject on, filter stereo",
         "E": "E: estimate mono, reproject on, filter mono", "F": "F: traced"}


@table(PAGE, "The paper, measured again", minutes=6, shares="shi2022")
def figure_10(lab):
    facts, _ = lab.paper("shi2022")

    def cells(letter, size):
        values = [facts.get((f"Figure 10, {size}: mean inconsistency", NAMES[letter], scene)) for scene in SCENES]
        if letter == "A":
            return values
        of_a = [facts[f"Figure 10, {size}: mean inconsistency", NAMES["A"], scene] for scene in SCENES]
        return [() if value is None else (value, 100 * value / a) for value, a in zip(values, of_a)]

    return [[*cells(letter, "1920x1080"), *cells(letter, "480x270")] for letter in NAMES]


@table(PAGE, "The paper, measured again", 2, minutes=6, shares="shi2022", within=RATIO)
def table_1(lab):
    _, times = lab.paper("shi2022")
    columns = [f"{size}, {resolution}" for size in ("1920x1080", "2468x2740") for resolution in ("full", "half")]

    def ratio(row, column):
        return next(t["ratio"] for (table, r, c), t in times.items() if table.startswith("Table 1") and (r, c) == (row, column))

    near, everywhere = ([ratio(row, column) for column in columns] for row in ("stereo: total", "everywhere: total"))
    return [near, [(value, None) for value in everywhere]]
