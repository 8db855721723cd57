"""Runs the snippets of a page of documentation, in their order, as they stand there.

Usage: snippets.py PAGE             runs one page (README.md, docs/view.md) in a folder of its own
       snippets.py PAGE FOLDER      the same in this folder, which keeps what the snippets write, unchecked
       snippets.py --all PAGE...    runs nothing: no page beside these has snippets, and each is well formed; prints counts

A fenced block without a word behind the fence, or with `sh`, is a block of commands; `python` and `json` are what they say;
`console` has commands behind "$ " and what they print ("..." stands for anything). `text` is run by nobody: output, formulas,
lists of files. `c`, `cpp` and `cmake` are built by other tests. What a page needs, and what cannot run as written: pages.py.

Environment: GLOAM_SOURCE_DIR, GLOAM_BUILD_DIR; PYTHONPATH leads to the module. Exit status 77: the page needs what is not installed.
"""

import contextlib
import dataclasses
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from pages import BUILT_ELSEWHERE, PAGES, Page

SOURCE = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"])
BUILD = pathlib.Path(os.environ["GLOAM_BUILD_DIR"])
LOG = ".log"
CHECK_LOG = ".check.log"
MARK = "snippet of line "


class Fault(Exception):
    pass


@dataclasses.dataclass
class Block:
    kind: str
    line: int  # of the fence
    text: str


@dataclasses.dataclass
class Command:
    line: int
    text: str
    expected: str | None = None  # output, of a `console`
    reason: str = ""  # of a change, or why it is not run
    is_run: bool = True


def blocks_of(text):
    blocks, fence = [], None
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        if not line.lstrip().startswith("```"):
            if fence:
                fence.text += line
        elif fence:
            blocks.append(fence)
            fence = None
        else:
            fence = Block(line.strip()[3:], number, "")
    if fence:
        raise Fault(f"line {fence.line}: the block has no end")
    return blocks


def is_whole(text):
    """Whether bash waits for no further line."""
    return not text.endswith("\\\n") and subprocess.run(["bash", "-n", "-c", text], capture_output=True).returncode == 0


def commands_of(block):
    commands, text = [], ""
    for number, line in enumerate(block.text.splitlines(keepends=True), block.line + 1):
        if block.kind == "console":
            if line.startswith("$ "):
                commands.append(Command(number, line[2:], ""))
            elif commands:
                commands[-1].expected += line
            continue
        if not text and (not line.strip() or line.lstrip().startswith("#")):
            continue
        text += line
        if is_whole(text):
            commands.append(Command(number - text.count("\n") + 1, text))
            text = ""
    if text:
        raise Fault(f"line {block.line}: the shell waits for more after '{text.strip()}'")
    return commands


def changed(command, page, used):
    """The command as it is run: see Page.instead and Page.not_run."""
    for start, reason in page.not_run.items():
        if command.text.startswith(start):
            used.add(start)
            return dataclasses.replace(command, is_run=False, reason=reason)
    for old, (new, reason) in page.instead.items():
        if old in command.text:
            used.add(old)
            command = dataclasses.replace(command, text=command.text.replace(old, new), reason=reason)
    return command


def read(name):
    """The page's blocks, each with its commands."""
    page, used = PAGES.get(name, Page()), set()
    try:
        blocks = [(block, [changed(c, page, used) for c in commands_of(block)] if block.kind in ("", "sh", "console") else [])
                  for block in blocks_of((SOURCE / name).read_text())]
    except Fault as fault:
        raise Fault(f"{name}: {fault}")
    for block, _ in blocks:
        if block.kind in ("c", "cpp", "cmake"):
            if name not in BUILT_ELSEWHERE:
                raise Fault(f"{name}:{block.line}: no test is known to build this block (BUILT_ELSEWHERE of tests/docs/pages.py)")
        elif block.kind not in ("", "sh", "console", "python", "json", "text"):
            raise Fault(f"{name}:{block.line}: no kind of block '{block.kind}'; output and formulas are text")
    unused = [start for start in [*page.not_run, *page.instead] if start not in used]
    if unused:
        raise Fault(f"{name}: tests/docs/pages.py makes an exception for what the page does not have: {unused}")
    documents = sum(block.kind == "json" for block, _ in blocks)
    if documents != len(page.json):
        raise Fault(f"{name}: {documents} blocks of JSON, and tests/docs/pages.py names {len(page.json)} files for them")
    return page, blocks


def count(blocks):
    commands = [c for _, of_block in blocks for c in of_block]
    kinds = [block.kind for block, _ in blocks]
    return {"commands as written": sum(c.is_run and not c.reason for c in commands),
            "with a change": sum(c.is_run and bool(c.reason) for c in commands),
            "not run": sum(not c.is_run for c in commands),
            "Python blocks": kinds.count("python"), "JSON blocks": kinds.count("json")}


def in_words(counts):
    return ", ".join(f"{n} {what}" for what, n in counts.items() if n) or "nothing to run"


class Folder:
    """Looks like the source tree to what runs in it; what is written into it stays in it."""

    def __init__(self, path, page):
        self.path = path
        (path / "build").mkdir()
        for entry in BUILD.iterdir():
            (path / "build" / entry.name).symlink_to(entry)
        for name, target in page.build.items():
            (path / "build" / name).unlink(missing_ok=True)
            (path / "build" / name).symlink_to(BUILD / target)
        for name in ("bench", "contrib", "tests"):
            (path / name).symlink_to(SOURCE / name)
        for name in ("data", "script"):
            shutil.copytree(SOURCE / name, path / name)
        # The build is done, and no test may start another; scripts that begin with it find this.
        (path / "script" / "build").write_text("#!/bin/sh\n")
        # python3 is the interpreter that the module was built for, and ~ this folder.
        (path / "bin").mkdir()
        (path / "bin" / "python3").symlink_to(sys.executable)
        (path / "bin" / "gloam").symlink_to(path / "build" / "gloam")
        caches = os.environ.get("XDG_CACHE_HOME", str(pathlib.Path.home() / ".cache"))
        self.environment = {**os.environ, "HOME": str(path), "XDG_CACHE_HOME": caches, "PATH": f"{path / 'bin'}:{os.environ['PATH']}",
                            "GLOAM_CACHE_DIR": str(path / "cache"), "SNIPPETS": str(pathlib.Path(__file__).parent)}

    def bash(self, script, into=LOG):
        with open(self.path / into, "a") as log:
            return subprocess.run(["bash", "-e", "-o", "pipefail", "-c", script], cwd=self.path, env=self.environment,
                                  stdin=subprocess.DEVNULL, stdout=log, stderr=log).returncode

    def log(self, of=LOG):
        return (self.path / of).read_text(errors="replace")


def run_commands(name, commands, folder):
    """One shell for the block, as a reader has, so that `cd` and `export` last."""
    shown = [c for c in commands if c.is_run]
    for c in shown:
        if c.expected is None:
            c.text = f"echo '{MARK}'{c.line} $(date +%s.%N)\n{c.text}"
        else:
            c.text = f"echo '{MARK}'{c.line} $(date +%s.%N)\n{c.text.rstrip()} || true\n"
    status = folder.bash("".join(c.text for c in shown))
    log = folder.log()
    if status:
        line, rest = log.rpartition(MARK)[2].split(" ", 1)
        raise Fault(f"{name}:{line}: exit status {status}\n{rest[-3000:]}")
    for c in shown:
        if c.expected is not None:
            printed = log.rpartition(f"{MARK}{c.line} ")[2].split("\n", 1)[1].partition(MARK)[0]
            if not re.fullmatch(re.escape(c.expected).replace(r"\.\.\.", ".*"), printed, flags=re.DOTALL):
                raise Fault(f"{name}:{c.line}: the page says\n{c.expected}and the command prints\n{printed}")


def run_python(name, block, names, folder):
    os.chdir(folder.path)
    with open(LOG, "a") as log, contextlib.redirect_stdout(log):
        print(f"{MARK}{block.line} {time.time()}")
        exec(compile("\n" * block.line + block.text, name, "exec"), names)


def run(name, path, is_checked):
    page, blocks = read(name)
    for program in page.needs:
        if not shutil.which(program) and not importlib.util.find_spec(program):
            print(f"{name}: not run, for {program} is not installed")
            return 77
    folder = Folder(path, page)
    # A page's own commands and modules have this environment, and the caches of a user.
    os.environ.update({key: folder.environment[key] for key in ("XDG_CACHE_HOME", "GLOAM_CACHE_DIR")})
    if folder.bash(page.prepare):
        raise Fault(f"{name}: what the page needs could not be made\n{folder.log()[-3000:]}")
    names, documents = {}, iter(page.json)
    exec(page.python, names)
    for block, commands in blocks:
        if commands:
            run_commands(name, commands, folder)
        elif block.kind == "python":
            run_python(name, block, names, folder)
        elif block.kind == "json":
            json.loads(block.text)
            (path / next(documents)).write_text(block.text)
    log = folder.log()
    # Its trace has all that it looks for, and would be found in the log.
    if is_checked and folder.bash(f"set -x\n{page.check}", CHECK_LOG):
        raise Fault(f"{name}: the snippets ran, but what they made is not what is expected\n{folder.log(CHECK_LOG)[-3000:]}")
    tell(name, blocks, log)
    return 0


def tell(name, blocks, log):
    times = re.findall(rf"^{MARK}(\d+) ([\d.]+)$", log, flags=re.MULTILINE)
    ends = [float(begin) for _, begin in times[1:]] + [time.time()]
    for (line, begin), end in zip(times, ends):
        print(f"{name}:{line}: {end - float(begin):.1f} s")
    for c in [c for _, of_block in blocks for c in of_block if c.reason]:
        print(f"{name}:{c.line}: {'with a change' if c.is_run else 'not run'}: {c.reason}")
    of_processors = sum(os.times()[:4])
    print(f"{name}: {in_words(count(blocks))}; {of_processors:.0f} s of processors")


def check_all(names):
    pages = [p for p in sorted(SOURCE.rglob("*.md")) if not re.match(r"(build|out|\.)", str(p.relative_to(SOURCE)))]
    left = [str(p.relative_to(SOURCE)) for p in pages if "```" in p.read_text() and str(p.relative_to(SOURCE)) not in names]
    if left:
        raise Fault(f"these pages have snippets and no test: {' '.join(left)}; run cmake again, or add them to tests/docs/CMakeLists.txt")
    gone = [name for name in [*PAGES, *BUILT_ELSEWHERE] if name not in names]
    if gone:
        raise Fault(f"tests/docs/pages.py has pages without snippets: {' '.join(gone)}")
    counts = [count(read(name)[1]) for name in names]
    print(f"{len(names)} pages: " + in_words({what: sum(c[what] for c in counts) for what in counts[0]}))
    return 0


if __name__ == "__main__":
    try:
        if sys.argv[1] == "--all":
            sys.exit(check_all(sys.argv[2:]))
        if len(sys.argv) > 2:
            sys.exit(run(sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), False))
        with tempfile.TemporaryDirectory(prefix="gloam-snippets-") as place:
            sys.exit(run(sys.argv[1], pathlib.Path(place), True))
    except Fault as fault:
        sys.exit(f"{fault}")
