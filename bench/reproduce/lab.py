"""Runs the commands that a table needs, and keeps what they made: a second run goes on where the first one stopped."""
import contextlib
import fcntl
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

import documents

OUT = object()  # stands for the output's path among the arguments of `made`


class Failed(Exception):
    """A command that did not end well, with its last line."""


def fingerprint(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:16]


class Lab:
    """Files by the command that makes them. Another build of gloam makes all anew."""

    def __init__(self, root, folder, gloam, tell=lambda text: None):
        self.root, self.folder = pathlib.Path(root), pathlib.Path(folder)
        self.gloam, self.tell = str(gloam), tell
        self.build = fingerprint(gloam)
        self.folder.mkdir(parents=True, exist_ok=True)

    def made(self, name, *arguments):
        """The path of a file, or of files of a pattern (`shot.####.exr`), that `gloam ARGUMENTS` writes to OUT."""
        place = self._place(name, arguments)
        path = place / name
        with self._alone_at(place):
            if not (place / "done").exists():  # else what is there is a part, with which `gloam reference` goes on
                self._run([self.gloam, *(str(path) if a is OUT else str(a) for a in arguments), "-q"])
                (place / "done").write_text("\n".join("OUT" if a is OUT else str(a) for a in arguments) + "\n")
        return str(path)

    def figures(self, *arguments):
        """What `gloam ARGUMENTS --json -` prints, kept."""
        file = self._place("figures.json", arguments).with_suffix(".json")
        if not file.exists():
            text = self._run([self.gloam, *map(str, arguments), "--json", "-", "-q"])
            self._keep(file, text)
        return json.loads(file.read_text())

    def printed(self, *command, environment=None):
        """What another program of the project prints, kept. Paths are relative to the project."""
        file = self._place("printed.txt", command).with_suffix(".txt")
        if not file.exists():
            self._keep(file, self._run([str(c) for c in command], environment))
        return file.read_text()

    def program(self, name, *arguments):
        """What a Python program of bench/ prints, kept. `arguments` may name folders of `folder_for`, in which it keeps its own files."""
        return self.printed(sys.executable, f"bench/{name}", *arguments)

    def usage(self, *arguments):
        """What `gloam ARGUMENTS` takes: seconds of the clock and of the processors, and the most that was resident, MiB. Kept."""
        file = self._place("usage.json", arguments).with_suffix(".json")
        if not file.exists():
            self.tell(" ".join(map(str, ("gloam", *arguments))))
            begun = time.monotonic()
            process = subprocess.Popen([self.gloam, *map(str, arguments), "-q"], cwd=self.root, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE)
            said = process.stderr.read().decode()
            _, status, used = os.wait4(process.pid, 0)
            if status:
                raise Failed(f"gloam {' '.join(map(str, arguments))}: {(said.strip().splitlines() or ['failed'])[-1]}")
            self._keep(file, json.dumps({"wall": time.monotonic() - begun, "processors": used.ru_utime + used.ru_stime, "peak": used.ru_maxrss / 1024}))
        return json.loads(file.read_text())

    def text(self, name, text):
        """The path of a small file that a command reads."""
        path = self.folder_for("texts") / name
        path.write_text(text)
        return str(path)

    def run_again(self, *command, fine=(0,)):
        """Runs another program of the project, whatever it has made before. `fine`: its exit statuses that are no failure."""
        return self._run([str(c) for c in command], fine=fine)

    def bench(self, name, *arguments):
        """The folder that `gloam bench ARGUMENTS` fills, however long it takes. Interrupted, it goes on with the frames and truths that are there."""
        if not {"--paper", "--set", "--time"}.intersection(arguments):
            arguments = (*arguments, "--all")
        place = self._place("bench", (name, *arguments)).with_name(f"bench-{name}")
        mark, words = place / "done", "\n".join(map(str, arguments)) + "\n"
        with self._alone_at(place):
            if not mark.exists() or mark.read_text() != words:
                self._run([self.gloam, "bench", "-o", str(place), *map(str, arguments), "-q"])
                mark.write_text(words)
        return place

    def stress(self, technique, *arguments):
        """The document of `gloam stress`, which ends with 1 where a figure is beyond its bound."""
        file = self._place("stress.json", (technique, *arguments)).with_suffix(".json")
        if not file.exists():
            part = file.with_suffix(".part")
            file.parent.mkdir(parents=True, exist_ok=True)
            self._run([self.gloam, "stress", technique, *map(str, arguments), "--json", str(part)], fine=(0, 1))
            part.replace(file)
        return file

    def paper(self, name, *arguments):
        """Figures of `gloam bench --paper`: (figure, row, column) to value, and times: (table, row, column) to the row."""
        document = documents.read(self.bench(name, "--paper", name, *arguments))
        return ({(f["figure"], f["row"], f["column"]): f["value"] for f in document["facts"]},
                {(t["table"], t["row"], t["column"]): t for t in document["paper"]})

    def unused(self, name):
        """A path for what a command has to write and no table reads."""
        return str(self.folder_for("unused") / name)

    def folder_for(self, name):
        """A folder that a program may keep its own files in."""
        place = self.folder / self.build / name
        place.mkdir(parents=True, exist_ok=True)
        return place

    def forget(self):
        shutil.rmtree(self.folder / self.build, ignore_errors=True)

    # What tables do most often.

    def frame(self, scene, size, *flags):
        return self.made("frame.exr", "capture", scene, "-o", OUT, "--size", size, *flags)

    def shot(self, scene, size, *flags):
        return self.made("frame.####.exr", "capture", scene, "-o", OUT, "--size", size, *flags)

    def truth(self, kind, frame, samples, *flags):
        name = os.path.basename(frame).replace("frame", "truth")
        return self.made(name, "reference", kind, frame, "-o", OUT, "--samples", samples, *flags)

    def result(self, technique, frame, *flags):
        name = os.path.basename(frame).replace("frame", "result")
        return self.made(name, "run", technique, frame, "-o", OUT, "--float", "--keep-depth", *flags)

    def compared(self, test, truth, *flags):
        return self.figures("compare", test, truth, *flags)

    def inconsistency(self, result, *flags):
        return self.figures("compare", "--stereo", result, *flags)["inconsistency"]["mean"]

    @contextlib.contextmanager
    def _alone_at(self, place):
        """While a folder is made: another run of script/reproduce waits for it."""
        place.mkdir(parents=True, exist_ok=True)
        with open(place / "lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield

    def _place(self, name, arguments):
        words = [name, *("OUT" if a is OUT else str(a).replace(str(self.folder), "") for a in arguments)]
        return self.folder / self.build / hashlib.sha256("\0".join(words).encode()).hexdigest()[:20]

    def _keep(self, file, text):
        file.parent.mkdir(parents=True, exist_ok=True)
        part = file.with_suffix(".part")
        part.write_text(text)
        part.replace(file)

    def _run(self, command, environment=None, fine=(0,)):
        self.tell(" ".join(os.path.basename(command[0]) if i == 0 else word for i, word in enumerate(command)))
        done = subprocess.run(command, cwd=self.root, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              env={**os.environ, **(environment or {})})
        if done.returncode not in fine:
            lines = (done.stderr or done.stdout).strip().splitlines()
            raise Failed(f"{' '.join(command)}: {lines[-1] if lines else f'exit status {done.returncode}'}")
        return done.stdout
