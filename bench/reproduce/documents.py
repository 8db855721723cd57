"""Documents of `gloam bench` and `gloam stress` that pages are written from: row by row, figure by figure."""
import json
import pathlib
import shutil

import kept_results
from intervals import ERROR, EXACT, RATIO
from markdown import Number

DIGITS = 4  # places after the point to which pages show errors
KEYS = ("technique", "preset", "variant", "scene", "effect", "plane", "width", "case", "quantity", "from", "tilt", "direction", "camera", "name")
ROWS = ("results", "converged", "scales", "planes", "cases", "scenes")
# Milliseconds hold for one machine, and pages show ratios.
OF_ERROR = ("rmse_to_truth", "bias", "ssim", "flip", "rmse", "mean_change", "mae", "least", "truth_noise", "radius", "radius_pixels")


def read(path):
    """A document by its file, or by the folder whose bench.json it is."""
    path = pathlib.Path(path)
    return json.loads((path / "bench.json" if path.is_dir() else path).read_text())


def key_of(row):
    """What tells a row from others. Documents that are older than other effects do not say that theirs is "ao"."""
    return tuple(str(row[k]) for k in KEYS if row.get(k) not in (None, "", "ao") and not isinstance(row[k], (list, dict)))


def figures_of(row):
    """Figures of one row by name, with their intervals."""
    for name, value in row.items():
        if name == "ladder" and isinstance(value, dict):
            yield from ((f"ladder {step}", v, ERROR) for step, v in value.items() if isinstance(v, (int, float)))
        elif isinstance(value, bool) and name == "held":
            yield name, float(value), EXACT
        elif not isinstance(value, (int, float)) or isinstance(value, bool):
            continue
        elif name in OF_ERROR:
            yield name, value, ERROR
        elif name.startswith("ratio_to_"):
            yield name, value, RATIO


def rows_of(document):
    for part in ROWS:
        for row in document.get(part, []):
            yield (part, *key_of(row)), row


def pairs(kept, made):
    """Of each figure that the kept document has: where it stands, the number, the one made again, its interval."""
    new = dict(rows_of(read(made)))
    for key, row in rows_of(read(kept)):
        if key not in new:
            raise ValueError(f"{kept}: {', '.join(key)} was not made again")
        again = {name: value for name, value, _ in figures_of(new[key])}
        for name, value, interval in figures_of(row):
            if name in again:
                digits = 0 if interval is EXACT else DIGITS if interval is ERROR else 2
                yield f"{', '.join(key[1:])}, {name}", Number(f"{value:.{digits}f}", 0), again[name], interval


def merged(documents):
    """One document of several that were measured with the same flags, a scene each."""
    first = documents[0]
    for other in documents[1:]:
        for name, value in other.items():
            if isinstance(value, list) and name not in ("planes", "command"):
                first[name] += [row for row in value if row not in first[name]]
    return first


def write(entry, made, kept, root, lab):
    """The document, and the page that is written from it and those beside it, if any."""
    if not entry.pages:
        kept_results.keep(made, kept)
        return
    page, flags = entry.pages
    path, images = pathlib.Path(root) / page, made.parent / "images"
    beside = kept.parent / "images"  # where the document names its pictures, for as long as the page is made
    before = path.read_text()
    kept_results.keep(made, kept)
    if images.is_dir():
        shutil.copytree(images, beside, dirs_exist_ok=True)
    try:
        sources = sorted(str(file.relative_to(root)) for file in kept.parent.glob("*.json"))
        lab.run_again(lab.gloam, "report", *sources, "--markdown", page, *flags)
    finally:
        shutil.rmtree(beside, ignore_errors=True)
    if path.read_text().count("![") < before.count("!["):
        path.write_text(before)
        raise ValueError(f"{page} shows scenes whose pictures were not made; make all of the page before --write: script/reproduce {page} --write")
