"""Somebody who has installed gloam, has a folder with own files, and types commands there: what every first command owes to such a person."""

import os
import re
import shlex
import subprocess
import sys

import numpy

COMMANDS = ("run", "auto", "pick", "plan", "info", "compare", "capture", "view", "bench", "reference")


class User:
    help = {}  # of the commands: the same for all users

    def __init__(self, folder, cache):
        self.home, self.work = folder / "home", folder / "work"
        self.home.mkdir()
        self.work.mkdir()
        program = os.environ["GLOAM_BINARY"]
        # Kernels are compiled once for several users.
        self.environment = {"PATH": f"{os.path.dirname(program)}:/usr/bin:/bin", "HOME": str(self.home), "GLOAM_ONE_OPENCL": "1",
                            "GLOAM_CACHE_DIR": str(cache), "OPENCV_IO_ENABLE_OPENEXR": "1", "PYTHONDONTWRITEBYTECODE": "1",
                            "BLENDER_USER_CONFIG": str(self.home / "config"), "BLENDER_USER_SCRIPTS": str(self.home / "scripts")}

    def tell(self, line):
        done = subprocess.run(shlex.split(line), cwd=self.work, env=self.environment, capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def type(self, line):
        """Types a command, which has to do its work, to write what it says, and to propose nothing that does not work. Returns what it said."""
        before = set(self.work.iterdir())
        status, out, err = self.tell(line)
        assert status == 0, f"{line}: status {status}, {err}"
        if line.startswith("gloam "):
            wrote = re.findall(r"^wrote ([^\s:(]+)", out, re.MULTILINE)
            assert all((self.work / name).stat().st_size > 0 for name in wrote), (line, wrote)
            new = {path.name for path in set(self.work.iterdir()) - before}
            assert new <= set(wrote), f"{line}: wrote {new} without a word"
            assert "gloam info" in line or "--help" in line or wrote or "RMSE" in out, f"{line}: {out}"
            self.check_proposals(line, out + err)
        return out + err

    def flags_of(self, command):
        if command not in self.help:
            status, out, err = self.tell(f"gloam {command} --help-all")
            assert status == 0, err
            self.help[command] = set(re.findall(r"--[a-z][a-z-]*", out))
        return self.help[command]

    def check_proposals(self, line, said):
        """Every flag of a note is one of this command, or of one that the note names; what a note spells out is accepted."""
        own = line.split()[1]
        own = own if own in COMMANDS else "run"
        for note in re.findall(r"^(?:note|assumed): (.*)$", said, re.MULTILINE):
            named = {own} | {command for command in COMMANDS if re.search(rf"\b{command}\b", note)}
            # What info assumes, the other commands can be told.
            flags = set().union(*(self.flags_of(command) for command in named | ({"run"} if own == "info" else set())))
            proposed = set(re.findall(r"--[a-z][a-z-]*", note))
            assert proposed <= flags, f"{line}: {proposed - flags} of no such command: {note}"
            if len(named) > 1 or own not in ("run", "auto", "info"):
                continue
            whole = re.findall(r"--[a-z][a-z-]* (?:[a-z_]+=)?(?:[a-z][A-Za-z_.:-]*|[-x\d.,yz]+)(?= takes| darkens| says|[,;)]|$)", note)
            for flag in whole:
                status, _, err = self.tell(f"{line} {flag}") if own != "info" else self.tell(f"{line.split(' -')[0]} {flag}")
                assert status == 0, f"{line} {flag}: {err}"

    def channels(self, name):
        """As OpenCV opens an EXR or a PNG."""
        script = ("import sys, cv2, numpy\nimage = cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED)\n"
                  "assert image is not None, 'OpenCV opens it not'\nnumpy.save(sys.argv[2], image)")
        target = self.home / "opened.npy"
        done = subprocess.run([sys.executable, "-c", script, self.work / name, target], env=self.environment, capture_output=True, text=True)
        assert done.returncode == 0, (name, done.stderr)
        return numpy.load(target)

    def expect_grey(self, name, mean=None, off=0.02):
        """Ambient occlusion: neither black nor white, with shades between."""
        image = self.channels(name).astype(float)
        image = image / 255 if name.endswith(".png") else image
        assert numpy.isfinite(image).all() and image.min() >= 0 and image.max() <= 1
        assert 0.4 < image.mean() < 0.98 and image.std() > 0.02, (name, image.mean(), image.std())
        if mean is not None:
            assert abs(image.mean() - mean) < off, (name, image.mean(), mean)
        return image
