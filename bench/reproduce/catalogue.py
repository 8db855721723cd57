"""What of the documentation can be made again, each with the function that makes it, and what cannot, with the reason."""
import dataclasses
import importlib
import pathlib
import typing

from intervals import ERROR, EXACT, Interval
from markdown import slug

ENTRIES, RECORDS, NO_FIGURES = {}, {}, {}


class NotHere(Exception):
    """What an entry needs that only some machines have, in words."""


@dataclasses.dataclass
class Entry:
    kind: str  # table, picture, page or measurements
    name: str  # "stereo/indirect-light"
    page: str
    minutes: float  # on two idle cores, without anything kept
    make: typing.Callable
    heading: str = ""  # of a table
    number: int = 1  # of a table under its heading
    labels: int = 1  # columns of words at the left
    within: typing.Any = ERROR  # an Interval, or a function of row and column (both from 0, of cells without labels)
    file: str = ""  # of what is not a table
    shares: str = ""  # entries with the same word are made by one command, which takes `minutes` once
    pages: tuple = ()  # of measurements: the page that is written from them, and flags of `gloam report`

    def interval(self, row, column):
        return self.within if isinstance(self.within, Interval) else self.within(row, column)


@dataclasses.dataclass
class Record:
    """A table or a picture that cannot be made again, and why."""
    page: str
    heading: str  # of a picture its file
    number: int
    why: str


def stem_of(page):
    path = pathlib.PurePosixPath(page)
    return path.parent.name if path.name == "README.md" and path.parent.name else path.stem.lower()


def _add(entry):
    if entry.name in ENTRIES:
        raise ValueError(f"two entries are called {entry.name}")
    ENTRIES[entry.name] = entry


def table(page, heading, number=1, *, minutes, labels=1, within=ERROR, shares=""):
    """Of a function that returns the cells of the table's rows, without the labels: a number, a tuple of numbers as the cell has them in
    order, or None for a cell that is not made again."""
    def register(make):
        name = f"{stem_of(page)}/{slug(heading)}" + (f"-{number}" if number > 1 else "")
        _add(Entry("table", name, page, minutes, make, heading, number, labels, within, shares=shares))
        return make
    return register


def picture(page, file, *, minutes, shares=""):
    """Of a function that returns the path of a picture made again, for the one at `file`."""
    def register(make):
        _add(Entry("picture", f"{stem_of(page)}/{pathlib.PurePosixPath(file).name}", page, minutes, make, file=file, shares=shares))
        return make
    return register


def page_of_text(page, *, minutes, within=EXACT, shares=""):
    """Of a function that returns a page's whole text, which a program writes. Other numbers are compared within `within`."""
    def register(make):
        _add(Entry("page", f"{stem_of(page)}/page", page, minutes, make, within=within, file=page, shares=shares))
        return make
    return register


def measurements(page, file, *, minutes, pages=()):
    """Of a function that returns a document like the one at `file`, from which pages are written."""
    def register(make):
        _add(Entry("measurements", f"{stem_of(page)}/{pathlib.PurePosixPath(file).stem}", page, minutes, make, file=file, pages=pages))
        return make
    return register


def record(page, heading, number=1, *, why):
    """A table under a heading, or a picture by its file, that cannot be made again."""
    RECORDS[page, heading, number] = Record(page, heading, number, why)


def no_figures(page, heading, number=1, *, why):
    """A table whose numbers nobody measured."""
    NO_FIGURES[page, heading, number] = why


def load():
    here = pathlib.Path(__file__).parent
    for module in sorted(here.glob("of_*.py")):
        importlib.import_module(module.stem)
    return ENTRIES


def chosen(words):
    """The entries that words name: an entry, all of a page, or all."""
    if not words:
        return list(ENTRIES.values())
    found = {}
    for word in words:
        those = [e for e in ENTRIES.values() if word in (e.name, e.name.split("/")[0], e.page, e.heading, e.file)]
        if not those:
            raise LookupError(word)
        found.update({e.name: e for e in those})
    return list(found.values())


def minutes_of(entries):
    """What is shared counts once."""
    times = {}
    for e in entries:
        times[e.shares or e.name] = max(e.minutes, times.get(e.shares or e.name, 0))
    return sum(times.values())
