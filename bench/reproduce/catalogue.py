"""What of the documentation can be made again: tables and pictures, each with the function that makes it."""
import dataclasses
import importlib
import pathlib
import typing

from intervals import ERROR, Interval
from markdown import slug

ENTRIES = {}


class NotHere(Exception):
    """What an entry needs that only some machines have, in words."""


@dataclasses.dataclass
class Entry:
    name: str  # "stereo/indirect-light"
    page: str
    minutes: float  # on two idle cores, without anything kept
    make: typing.Callable
    labels: int = 1  # columns of words at the left
    within: typing.Any = ERROR  # an Interval, or a function of row and column (both from 0, of cells without labels)
    heading: str = ""
    number: int = 1

    def interval(self, row, column):
        return self.within if isinstance(self.within, Interval) else self.within(row, column)


def stem_of(page):
    path = pathlib.PurePosixPath(page)
    return path.parent.name if path.name == "README.md" and path.parent.name else path.stem.lower()


def _add(entry):
    if entry.name in ENTRIES:
        raise ValueError(f"two entries are called {entry.name}")
    ENTRIES[entry.name] = entry


def table(page, heading, number=1, *, minutes, labels=1, within=ERROR):
    """Of a function that returns the cells of the table's rows, without the labels: a number, a tuple of numbers as the cell has them in
    order, or None for a cell that is not made again."""
    def register(make):
        name = f"{stem_of(page)}/{slug(heading)}" + (f"-{number}" if number > 1 else "")
        _add(Entry(name, page, minutes, make, labels, within, heading, number))
        return make
    return register


def picture(page, path, *, minutes):
    """Of a function that returns the path of a picture made again, for the one at `path`."""
    def register(make):
        _add(Entry(f"{stem_of(page)}/{pathlib.PurePosixPath(path).name}", page, minutes, make, heading=path, number=0))
        return make
    return register


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
        those = [e for e in ENTRIES.values() if word in (e.name, e.name.split("/")[0], e.page, e.heading)]
        if not those:
            raise LookupError(word)
        found.update({e.name: e for e in those})
    return list(found.values())
