"""Tables and pictures that cannot be made again, and tables whose numbers nobody measured"""
from catalogue import no_figures, record

LONG = "hours of programs that are built with sanitizers and other flags (script/fuzz)"
record("docs/fuzzing.md", "The last long runs", why=LONG)
OTHER_DEVICES = "needs OpenCL implementations that are not on one machine together"
record("docs/portability.md", "What was tried", why=OTHER_DEVICES)
record("docs/portability.md", "On GPUs", why="script/check-device on a GPU; script/update-devices makes the table from data/results/devices")
record("docs/portability.md", "Faults and peculiarities of implementations", why=OTHER_DEVICES)
record("docs/architecture.md", "docs/images/rooms.svg", why="script/rooms draws it, of CMake's list of rooms")
record("docs/view.md", "docs/images/view.png", why="a browser's window, with a pointer moved by hand")
no_figures("docs/portability.md", "What a device needs", why="requirements")
no_figures("docs/reference.md", "Truth: what `gloam reference` traces", why="definitions")
no_figures("kernels/temporal/README.md", "--temporal", why="defaults of parameters")
no_figures("docs/reproduce.md", "Intervals", why="what these intervals are")
record("kernels/ssr/README.md", "Sequences", why="the camera's path and the pixels that count as shown were not kept")
