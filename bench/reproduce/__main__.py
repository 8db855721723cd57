"""Makes tables and pictures of the documentation again, and says which figures are outside their stated intervals."""
import argparse
import difflib
import os
import pathlib
import shutil
import sys
import time

import catalogue
from check import check
from lab import Failed, Lab

ROOT = pathlib.Path(__file__).resolve().parents[2]

EXAMPLES = """examples:
  script/reproduce --list
  script/reproduce composite                     all tables of docs/composite.md
  script/reproduce stereo/indirect-light         one table
  script/reproduce                               everything; goes on where it was stopped
  script/reproduce composite --write             puts the new figures into the page
"""


def arguments():
    parser = argparse.ArgumentParser(prog="script/reproduce", description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="FIGURE|TABLE|PAGE", help="default: all")
    parser.add_argument("--list", action="store_true", help="names, pages and minutes of what can be made again")
    parser.add_argument("--write", action="store_true", help="put the new figures into the pages")
    parser.add_argument("--times", action="store_true", help="with --write: times and ratios of times too, on an idle machine")
    parser.add_argument("--again", action="store_true", help="forget what earlier runs of this build made")
    parser.add_argument("--folder", default=str(ROOT / "out" / "reproduce"), help="what is made stays there; default: out/reproduce")
    parser.add_argument("--gloam", default=str(ROOT / "build" / "gloam"), help="default: build/gloam")
    return parser.parse_args()


def fail(text):
    sys.exit(f"reproduce: {text}")


def entries_for(names):
    try:
        return catalogue.chosen(names)
    except LookupError as error:
        known = sorted({n for e in catalogue.ENTRIES.values() for n in (e.name, e.name.split("/")[0])})
        near = difflib.get_close_matches(str(error.args[0]), known, 1)
        print(f"reproduce: {error.args[0]}: no figure, table or page is called so; "
              + (f"'{near[0]}' is; " if near else "") + "--list names them", file=sys.stderr)
        sys.exit(2)


def time_words(minutes):
    return f"{minutes:.0f} min" if minutes < 90 else f"{minutes / 60:.1f} h"


def listed(entries):
    width = max(len(e.name) for e in entries)
    for e in entries:
        print(f"{e.name:{width}}  {time_words(e.minutes):>7}  {e.page}")
    print(f"{len(entries)} in all, {time_words(catalogue.minutes_of(entries))} on two idle cores")


def listed_records():
    records = catalogue.RECORDS.values()
    print(f"\n{len(records)} are records, which cannot be made again:")
    for r in records:
        print(f"{r.page}, {r.heading}{f', table {r.number}' if r.number > 1 else ''}: {r.why}")


def tell(text):
    if sys.stderr.isatty():
        columns = shutil.get_terminal_size().columns - 1
        print(f"\r\033[K{text[:columns]}", end="", file=sys.stderr, flush=True)


def processors():
    """Seconds that commands have taken so far, of all cores together."""
    times = os.times()
    return times.children_user + times.children_system


def report(outcome):
    name = outcome.entry.name
    tell("")
    within = outcome.compared - len(outcome.outside)
    kept = f"; {outcome.left_out} are not made again" if outcome.left_out else ""
    print(f"{name}: {within} of {outcome.compared} figures are within their intervals ({'; '.join(sorted(outcome.words))}){kept}", flush=True)
    for line in outcome.outside:
        print(f"  {line}", flush=True)


def keep(outcome, folder, write):
    (pathlib.Path(folder) / (outcome.entry.name.replace("/", "-") + ".md")).write_text(outcome.text)
    if write:
        outcome.write()


def main():
    options = arguments()
    catalogue.load()
    entries = entries_for(options.names)
    if options.list:
        listed(entries)
        return options.names or listed_records()
    if not pathlib.Path(options.gloam).is_file():
        fail(f"{options.gloam}: is not there; script/build makes it, or --gloam names another")
    lab = Lab(ROOT, options.folder, options.gloam, tell)
    if options.again:
        lab.forget()
    print(f"{len(entries)} to make, about {time_words(catalogue.minutes_of(entries))} on two idle cores; what is made stays in {options.folder}",
          flush=True)
    outside, failed = 0, []
    for entry in entries:
        begun, used = time.monotonic(), processors()
        try:
            outcome = check(entry, ROOT, lab, options.times)
        except catalogue.NotHere as why:
            print(f"{entry.name}: left out: {why}", flush=True)
            continue
        except Exception as error:  # whatever it is, the others are made
            tell("")
            failed.append(entry.name)
            what = "" if isinstance(error, (Failed, ValueError)) else f"{type(error).__name__}: "
            print(f"{entry.name}: failed: {what}{error}", flush=True)
            continue
        report(outcome)
        keep(outcome, options.folder, options.write)
        outside += len(outcome.outside)
        if (seconds := time.monotonic() - begun) > 1:
            print(f"  took {seconds:.0f} s, and {processors() - used:.0f} s of processors", flush=True)
    if failed or outside:
        fail(f"{outside} figures are outside their intervals" + (f"; failed: {', '.join(failed)}" if failed else ""))


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("reproduce: interrupted; what was made is kept, and the same command goes on")
