"""How far a figure that is made again may be from the one in the page."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Interval:
    """From the printed figure: units of its last digit, and a share of it."""
    name: str
    units: float
    share: float

    def allowed(self, value, digits):
        off = (0.5 + self.units) * 10.0 ** -digits + self.share * abs(value)
        return value - off, value + off

    def words(self):
        return f"{self.name}: {self.units:g} of the last digit and {100 * self.share:g} %"


# Errors follow from the frame, the settings and the device's rounding alone.
ERROR = Interval("error", 1, 0.01)
# Counts, and means over pixels of references, follow from the scene alone.
EXACT = Interval("exact", 0, 0)
# Shares and small differences of errors magnify single pixels.
SENSITIVE = Interval("sensitive", 1, 0.05)
# Ratios of times of one process; milliseconds only hold for one machine.
RATIO = Interval("ratio of times", 1, 0.35)
MACHINE = Interval("time of a machine", 1, 3)
