"""An entry made again, compared with the page."""
import dataclasses
import pathlib

from catalogue import Entry
from markdown import Table, numbers_in, with_numbers

LEAST_PSNR = 38  # decibels, of a picture made again: noise of 8 bits is 59, another frame 10 to 20


@dataclasses.dataclass
class Outcome:
    entry: Entry
    compared: int = 0
    outside: list = dataclasses.field(default_factory=list)  # sentences
    left_out: int = 0  # numbers that are not made again
    words: set = dataclasses.field(default_factory=set)  # of the intervals
    rows: list = dataclasses.field(default_factory=list)  # of the table, with the new numbers
    header: list = dataclasses.field(default_factory=list)


def as_numbers(cell, count):
    if cell is None:
        return [None] * count
    return list(cell) if isinstance(cell, (tuple, list)) else [cell]


def check_cell(outcome, where, text, cell, interval):
    printed = numbers_in(text)
    values = as_numbers(cell, len(printed))
    if len(values) != len(printed):
        raise ValueError(f"{outcome.entry.name}, {where}: '{text}' has {len(printed)} numbers, and {len(values)} were made")
    for number, value in zip(printed, values):
        if value is None:
            outcome.left_out += 1
            continue
        outcome.compared += 1
        outcome.words.add(interval.words())
        low, high = interval.allowed(number.value, number.digits)
        if not low <= value <= high:
            outcome.outside.append(f"{where}: the page has {number.text}, made again {number.like(value)}; "
                                   f"{number.like(low)} to {number.like(high)} is within")
    return with_numbers(text, values)


def check_table(entry, root, lab):
    table = Table(pathlib.Path(root) / entry.page, entry.heading, entry.number)
    made = entry.make(lab)
    if len(made) != len(table.rows):
        raise ValueError(f"{entry.name}: the page has {len(table.rows)} rows, and {len(made)} were made")
    outcome = Outcome(entry, header=table.header)
    for y, (texts, cells) in enumerate(zip(table.rows, made)):
        label = " ".join(t for t in texts[:entry.labels] if t)
        if len(cells) != len(texts) - entry.labels:
            raise ValueError(f"{entry.name}, {label}: the page has {len(texts) - entry.labels} cells, and {len(cells)} were made")
        row = texts[:entry.labels]
        for x, (text, cell) in enumerate(zip(texts[entry.labels:], cells)):
            where = f"{label}, {table.header[entry.labels + x] or f'column {entry.labels + x + 1}'}"
            row.append(check_cell(outcome, where, text, cell, entry.interval(y, x)))
        outcome.rows.append(row)
    return outcome, table


def check_picture(entry, root, lab):
    import cv2  # only pictures need it
    made = entry.make(lab)
    kept = pathlib.Path(root) / entry.heading
    a, b = cv2.imread(str(kept), cv2.IMREAD_UNCHANGED), cv2.imread(str(made), cv2.IMREAD_UNCHANGED)
    outcome = Outcome(entry, compared=1, words={f"picture: a PSNR of {LEAST_PSNR} dB"})
    if a.shape != b.shape:
        outcome.outside.append(f"{entry.heading} is {a.shape[1]}x{a.shape[0]}, made again {b.shape[1]}x{b.shape[0]}")
    elif (psnr := cv2.PSNR(a, b)) < LEAST_PSNR:
        outcome.outside.append(f"{entry.heading}: a PSNR of {psnr:.1f} dB to {made}")
    return outcome, pathlib.Path(made)


def check(entry, root, lab):
    return (check_table if entry.number else check_picture)(entry, root, lab)
