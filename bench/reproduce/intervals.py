"""How far a figure that is made again may be from the one in the page, and why so far."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Interval:
    """From the printed figure: units of its last digit, and a share of it."""
    name: str
    units: float
    share: float
    why: str
    is_time: bool = False

    def allowed(self, value, digits):
        off = (0.5 + self.units) * 10.0 ** -digits + self.share * abs(value)
        return value - off, value + off

    def words(self):
        return f"{self.name}: {self.units:g} of the last digit and {100 * self.share:g} %"


ERROR = Interval("error", 1, 0.01, "an error follows from the frame, the settings, the seed and the device's rounding alone")
EXACT = Interval("exact", 0, 0, "a count, and what is printed with few digits, follows from the scene alone")
SENSITIVE = Interval("sensitive", 1, 0.05, "a share of few pixels, a flicker and a difference of two errors magnify single pixels")
RATIO = Interval("ratio of times", 1, 0.35, "a ratio of times of one process holds for other machines, but not exactly, and other work disturbs it", True)
MACHINE = Interval("time of a machine", 1, 3, "milliseconds and seconds hold for one machine", True)
CHANGING = Interval("of a choice by time", 1, 0.25, "gloam chooses by times that it measures, so another choice may come out", True)
MEMORY = Interval("memory", 0, 0.15, "what is resident depends on the allocator, on the device's driver and on what overlaps")
INTERVALS = (ERROR, EXACT, SENSITIVE, RATIO, MACHINE, CHANGING, MEMORY)
