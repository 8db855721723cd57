"""The gloam command: where it is, what it offers, and runs of it."""
import json
import os
import shutil
import subprocess
import tempfile

from .errors import Problem

HERE = os.path.dirname(os.path.abspath(__file__))

# What a capture holds. Techniques that read more (peeled layers, outlines) run on frames of gloam's own.
PLANES = {"depth", "normal", "motion", "albedo", "roughness"}


def find(wanted=""):
    """Path of the program. wanted: what the user named, or empty: in PATH, or where this folder was installed. Throws Problem."""
    if wanted:
        found = shutil.which(wanted)
        if not found:
            raise Problem(f"'{wanted}' is no program; name the gloam command (build/gloam of its sources, or bin/gloam where installed)")
        return os.path.abspath(found)
    name = "gloam.exe" if os.name == "nt" else "gloam"
    beside = (os.path.join(HERE, "..", "..", "..", "..", "bin", name),  # PREFIX/share/gloam/blender/gloam_blender
              os.path.join(HERE, "..", "..", "..", "build", name))  # contrib/blender/gloam_blender
    for place in (shutil.which(name),) + beside:
        if place and os.access(place, os.X_OK):
            return os.path.abspath(place)
    raise Problem("the program gloam is not in PATH; install it (script/build, cmake --install build), or say where it is "
                  "(--gloam FILE, or Program in the add-on's preferences)")


class Run:
    """A run of gloam in the background. arguments: without the program's name."""

    def __init__(self, program, arguments):
        self.out, self.err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        try:
            self.process = subprocess.Popen([program, *arguments], stdin=subprocess.DEVNULL, stdout=self.out, stderr=self.err)
        except OSError as error:
            raise Problem(f"'{program}' does not start: {error.strerror}; name the gloam command") from error

    def is_done(self):
        return self.process.poll() is not None

    def stop(self):
        if not self.is_done():
            self.process.terminate()
            self.process.wait()

    @staticmethod
    def text(file):
        file.seek(0)
        return file.read().decode("utf-8", "replace")

    def lines_so_far(self):
        """Whole lines on standard output."""
        return [line for line in self.text(self.out).split("\n")[:-1] if line]

    def output(self):
        """Standard output when done. Throws Problem with gloam's own sentence if it failed."""
        status = self.process.wait()
        if status == 0:
            return self.text(self.out)
        said = [line.removeprefix("gloam: ") for line in self.text(self.err).splitlines() if line.startswith("gloam: ")]
        raise Problem(f"gloam: {said[0]}" if said else f"gloam ended with status {status} and said nothing: {self.process.args[0]}")


def ask(program, arguments):
    """The JSON that a short command prints. Throws Problem."""
    text = Run(program, [*arguments, "--json", "-"]).output()
    try:
        return json.loads(text)
    except ValueError as error:
        raise Problem(f"'{program}' is not gloam, or another version of it: it printed no JSON for {' '.join(arguments)}") from error


def techniques(program):
    """The techniques that make ambient occlusion of one capture, as `gloam list techniques --json` has them. Throws Problem."""
    return [t for t in ask(program, ["list", "techniques"]) if makes_occlusion(t) and set(t["reads"]) <= PLANES]


def makes_occlusion(technique):
    return "ao_raw" not in technique["reads"] and bool({"ao", "ao_raw"} & set(technique["writes"]))


def check_technique(program, name, preset):
    """Refuses what gloam cannot run on a capture, before anything is rendered. Throws Problem."""
    known = ask(program, ["list", "techniques"])
    found = {t["name"]: t for t in known}
    found["ao"] = next(t for t in known if "ao_raw" in t["default_for"])
    if name not in found:
        Run(program, ["list", "techniques", name]).output()  # throws gloam's own sentence, with a suggestion
        raise Problem(f"gloam has no technique '{name}'")
    technique = found[name]
    if not makes_occlusion(technique):
        raise Problem(f"the technique '{name}' makes no ambient occlusion; gloam list techniques shows those that do")
    lacking = sorted(set(technique["reads"]) - PLANES)
    if lacking:
        raise Problem(f"the technique '{name}' reads {', '.join(lacking)}, which Blender does not render; "
                      "gloam list techniques shows others")
    if preset and preset not in technique["presets"]:
        have = ", ".join(technique["presets"]) or "none"
        raise Problem(f"the technique '{name}' has no preset '{preset}'; its presets: {have}")
    return technique
