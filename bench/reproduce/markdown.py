"""Tables of pages: found by heading, read, compared number by number, written."""
import dataclasses
import re

NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+(?: \d{3})+(?!\d)|\d*\.?\d+)(?:e[-+]?\d+)?")


@dataclasses.dataclass
class Number:
    """A number as it is printed in a cell."""
    text: str
    start: int

    @property
    def value(self):
        return float(self.text.replace(" ", ""))

    @property
    def digits(self):
        """Places after the point; negative for an exponent's."""
        mantissa, _, exponent = self.text.replace(" ", "").partition("e")
        return len(mantissa.partition(".")[2]) - int(exponent or 0)

    def like(self, value):
        """Another value in the same form: sign, digits, and whether a zero stands before the point."""
        if "e" in self.text:
            places = len(self.text.partition("e")[0].partition(".")[2])
            mantissa, _, exponent = f"{value:.{places}e}".partition("e")
            return f"{mantissa}e{int(exponent)}"
        text = f"{value:{'+' if self.text.startswith('+') else ''}.{max(self.digits, 0)}f}"
        if re.match(r"[-+]?\.", self.text):
            text = re.sub(r"^([-+]?)0\.", r"\1.", text)
        return text


def numbers_in(cell):
    return [Number(m.group(), m.start()) for m in NUMBER.finditer(cell)]


def with_numbers(cell, values):
    """The cell with its numbers replaced; None keeps one."""
    out, end = "", 0
    for number, value in zip(numbers_in(cell), values):
        text = number.text if value is None else number.like(value)
        out += cell[end:number.start] + text
        end = number.start + len(number.text)
    return out + cell[end:]


def slug(heading):
    return re.sub(r"[^a-z0-9]+", "-", heading.lower()).strip("-")


class Table:
    """The n-th table below a heading of a page."""

    def __init__(self, path, heading, number=1):
        self.path, self.heading, self.number = path, heading, number
        self.lines = path.read_text().split("\n")
        self.first = self._find()
        self.header = cells_of(self.lines[self.first])
        self.rows = []
        for line in self.lines[self.first + 2:]:
            if not line.startswith("|"):
                break
            self.rows.append(cells_of(line))

    def _find(self):
        under, seen, fenced = "", 0, False
        for i, line in enumerate(self.lines[:-1]):
            fenced ^= line.startswith("```")
            if fenced:
                continue
            if line.startswith("#"):
                under, seen = line.lstrip("# "), 0
            is_first = line.startswith("|") and re.fullmatch(r"\|[ :|-]+\|", self.lines[i + 1])
            seen += bool(is_first)
            if is_first and under == self.heading and seen == self.number:
                return i
        raise LookupError(f"{self.path}: has no table {self.number} under '{self.heading}'")

    def write(self, rows):
        for i, cells in enumerate(rows):
            self.lines[self.first + 2 + i] = "|" + "".join(f" {cell} |" if cell else " |" for cell in cells)
        self.path.write_text("\n".join(self.lines))


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def tables_of(path):
    """Heading and number of each table of a page, with its rows."""
    under, number, fenced, lines = "", 0, False, path.read_text().split("\n")
    for i, line in enumerate(lines[:-1]):
        fenced ^= line.startswith("```")
        if fenced:
            continue
        if line.startswith("#"):
            under, number = line.lstrip("# "), 0
        if line.startswith("|") and re.fullmatch(r"\|[ :|-]+\|", lines[i + 1]):
            number += 1
            yield under, number, Table(path, under, number).rows


def looks_measured(rows):
    """Whether four cells or more are numbers, with units at most."""
    cells = [cell for row in rows for cell in row]
    return sum(bool(numbers_in(cell)) and bool(re.fullmatch(r"[\s*().,\d\-+%x/eEa-z]*", cell)) for cell in cells) >= 4


def pictures_of(path, root):
    """Files of the pictures that a page shows, below the root."""
    for name in re.findall(r"!\[[^\]]*\]\(([^)\s]+)\)", path.read_text()):
        yield str((path.parent / name).resolve().relative_to(root))
