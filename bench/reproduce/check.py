"""An entry made again, compared with the page."""
import dataclasses
import pathlib
import typing

import documents
from catalogue import Entry
from intervals import EXACT
from markdown import Table, numbers_in, with_numbers

LEAST_PSNR = 38  # decibels, of a picture made again: noise of 8 bits is 59, another frame 10 to 20


@dataclasses.dataclass
class Outcome:
    entry: Entry
    compared: int = 0
    outside: list = dataclasses.field(default_factory=list)  # sentences
    left_out: int = 0  # numbers that are not made again
    words: set = dataclasses.field(default_factory=set)  # of the intervals
    text: str = ""  # what was made, for the folder
    write: typing.Callable = None  # puts it into the page


def as_numbers(cell, count):
    if cell is None:
        return [None] * count
    return list(cell) if isinstance(cell, (tuple, list)) else [cell]


def compare_number(outcome, where, number, value, interval):
    outcome.compared += 1
    outcome.words.add(interval.words())
    low, high = interval.allowed(number.value, number.digits)
    if not low <= value <= high:
        outcome.outside.append(f"{where}: the page has {number.text}, made again {number.like(value)}; "
                               f"{number.like(low)} to {number.like(high)} is within")


def check_cell(outcome, where, text, cell, interval):
    """The cell as it is made again, and as it is written into the page."""
    printed = numbers_in(text)
    values = as_numbers(cell, len(printed))
    if len(values) != len(printed):
        raise ValueError(f"{outcome.entry.name}, {where}: '{text}' has {len(printed)} numbers, and {len(values)} were made")
    for number, value in zip(printed, values):
        if value is None:
            outcome.left_out += 1
        else:
            compare_number(outcome, where, number, value, interval)
    return with_numbers(text, values)


def check_table(entry, root, lab, with_times):
    table = Table(pathlib.Path(root) / entry.page, entry.heading, entry.number)
    made = entry.make(lab)
    if len(made) != len(table.rows):
        raise ValueError(f"{entry.name}: the page has {len(table.rows)} rows, and {len(made)} were made")
    outcome, rows, for_page = Outcome(entry), [], []
    for y, (texts, cells) in enumerate(zip(table.rows, made)):
        label = " ".join(t for t in texts[:entry.labels] if t)
        if len(cells) != len(texts) - entry.labels:
            raise ValueError(f"{entry.name}, {label}: the page has {len(texts) - entry.labels} cells, and {len(cells)} were made")
        rows.append(texts[:entry.labels])
        for_page.append(texts[:entry.labels])
        for x, (text, cell) in enumerate(zip(texts[entry.labels:], cells)):
            where = f"{label}, {table.header[entry.labels + x] or f'column {entry.labels + x + 1}'}"
            interval = entry.interval(y, x)
            new = check_cell(outcome, where, text, cell, interval)
            rows[-1] = [*rows[-1], new]
            for_page[-1] = [*for_page[-1], text if interval.is_time and not with_times else new]
    lines = [table.header, ["---"] * len(table.header), *rows]
    outcome.text = "".join("| " + " | ".join(cells) + " |\n" for cells in lines)
    outcome.write = lambda: table.write(for_page)
    return outcome


def check_picture(entry, root, lab, _):
    import cv2  # only pictures need it
    made, kept = entry.make(lab), pathlib.Path(root) / entry.file
    outcome = Outcome(entry, compared=1, words={f"picture: a PSNR of {LEAST_PSNR} dB"}, text=f"{made}\n")
    # The same pixels in fewer bytes: pictures are kept with the source.
    outcome.write = lambda: cv2.imwrite(str(kept), cv2.imread(str(made), cv2.IMREAD_UNCHANGED), [cv2.IMWRITE_PNG_COMPRESSION, 9])
    a, b = cv2.imread(str(kept), cv2.IMREAD_COLOR), cv2.imread(str(made), cv2.IMREAD_COLOR)
    if a is None or b is None:
        outcome.outside.append(f"{kept if a is None else made} is no picture")
    elif a.shape != b.shape:
        outcome.outside.append(f"{entry.file} is {a.shape[1]}x{a.shape[0]}, made again {b.shape[1]}x{b.shape[0]}")
    elif (psnr := cv2.PSNR(a, b)) < LEAST_PSNR:
        outcome.outside.append(f"{entry.file}: a PSNR of {psnr:.1f} dB to {made}")
    return outcome


def check_page(entry, root, lab, _):
    made, kept = entry.make(lab), pathlib.Path(root) / entry.file
    outcome = Outcome(entry, words={"text: the same"}, text=made, write=lambda: kept.write_text(made))
    old, new = kept.read_text().splitlines(), made.splitlines()
    for i in range(max(len(old), len(new))):
        a, b = (lines[i] if i < len(lines) else "" for lines in (old, new))
        of_a, of_b = numbers_in(a), numbers_in(b)
        if a != b and entry.within is not EXACT and with_numbers(a, [0] * len(of_a)) == with_numbers(b, [0] * len(of_b)):
            for x, y in zip(of_a, of_b):
                compare_number(outcome, f"line {i + 1}", x, y.value, entry.interval(0, 0))
            continue
        outcome.compared += 1
        if a != b:
            outcome.outside.append(f"line {i + 1} is '{a}', made again '{b}'")
    return outcome


def check_measurements(entry, root, lab, _):
    made, kept = pathlib.Path(entry.make(lab)), pathlib.Path(root) / entry.file
    outcome = Outcome(entry, text=f"{made}\n", write=lambda: documents.write(entry, made, kept, root, lab))
    for where, number, value, interval in documents.pairs(kept, made):
        compare_number(outcome, where, number, value, interval)
    return outcome


def check(entry, root, lab, with_times=False):
    of_kind = {"table": check_table, "picture": check_picture, "page": check_page, "measurements": check_measurements}
    return of_kind[entry.kind](entry, root, lab, with_times)
