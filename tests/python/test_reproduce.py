"""script/reproduce: that no figure of the pages escapes it, that it notices changes, and that it goes on where it stopped."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import pytest

SOURCE = pathlib.Path(os.environ["GLOAM_SOURCE_DIR"])
PROGRAM = SOURCE / "bench" / "reproduce"
sys.path.insert(0, str(PROGRAM))

import catalogue
import documents
from intervals import ERROR, EXACT, INTERVALS, RATIO
from markdown import Table, looks_measured, numbers_in, pictures_of, slug, tables_of, with_numbers

catalogue.load()
PAGES = [SOURCE / "README.md", *sorted(SOURCE.glob("docs/*.md")), *sorted(SOURCE.glob("kernels/*/README.md")),
         SOURCE / "bench/README.md", SOURCE / "data/README.md"]


# --- Nothing escapes

def written_whole():
    """Pages that a program writes, each of which is one entry."""
    of_documents = {e.pages[0] for e in catalogue.ENTRIES.values() if e.kind == "measurements" and e.pages}
    return of_documents | {e.page for e in catalogue.ENTRIES.values() if e.kind == "page"}


def test_every_table_with_figures_is_made_again_or_a_record():
    made = {(e.page, e.heading, e.number) for e in catalogue.ENTRIES.values() if e.kind == "table"}
    known, missing, tables = made | set(catalogue.RECORDS) | set(catalogue.NO_FIGURES), [], 0
    for path in PAGES:
        page = str(path.relative_to(SOURCE))
        for heading, number, rows in () if page in written_whole() else tables_of(path):
            tables += looks_measured(rows)
            if looks_measured(rows) and (page, heading, number) not in known:
                missing.append(f"{page}, '{heading}', table {number}")
    assert tables > 60
    assert not missing, "neither an entry nor a record of bench/reproduce: " + "; ".join(missing)


def test_every_picture_is_made_again_or_a_record():
    made = {e.file for e in catalogue.ENTRIES.values()} | {heading for _, heading, _ in catalogue.RECORDS}
    shown = {(str(path.relative_to(SOURCE)), file) for path in PAGES if str(path.relative_to(SOURCE)) != "docs/accuracy.md"
             for file in pictures_of(path, SOURCE)}
    assert len(shown) > 20
    missing = [f"{page}: {file}" for page, file in shown if file not in made]
    assert not missing, "neither an entry nor a record of bench/reproduce: " + "; ".join(missing)


def test_entries_and_records_name_what_is_there():
    for e in catalogue.ENTRIES.values():
        if e.kind == "table":
            assert Table(SOURCE / e.page, e.heading, e.number).rows, e.name
        else:
            assert (SOURCE / e.file).is_file(), e.name
    for page, heading, number in [*catalogue.RECORDS, *catalogue.NO_FIGURES]:
        if heading.startswith("docs/images/"):
            assert heading in pictures_of(SOURCE / page, SOURCE)
        else:
            assert Table(SOURCE / page, heading, number).rows


# --- Numbers of a page

@pytest.mark.parametrize("cell, values", [
    (".0318 .0317", [0.0318, 0.0317]), ("-48 %", [-48]), ("+.144", [0.144]), ("382 526", [382526]), ("1 000 000 each", [1000000]),
    ("2.6e-4 / 0.9e-4", [2.6e-4, 0.9e-4]), (".379 (+.144)", [0.379, 0.144]), ("**0.32**", [0.32]), ("`gtao` medium", []),
    ("78 %, 0.5", [78, 0.5]), ("refused", [])])
def test_numbers_of_a_cell(cell, values):
    assert [n.value for n in numbers_in(cell)] == values


@pytest.mark.parametrize("cell, values, written", [
    (".0318 .0317", [0.03204, 1.5], ".0320 1.5000"), ("-.0056 (-39 %)", [-0.00571, -40.2], "-.0057 (-40 %)"),
    ("+0.069", [-0.012], "-0.012"), ("3.3e-4", [2.04e-5], "2.0e-5"), ("0.97 (1.00)", [1.02, None], "1.02 (1.00)"), ("**.45**", [0.5], "**.50**")])
def test_new_numbers_have_the_form_of_the_old(cell, values, written):
    assert with_numbers(cell, values) == written


def test_intervals_end_where_they_say():
    low, high = ERROR.allowed(0.1, 3)  # one and a half of the last digit, and 1 %
    assert (low, high) == (pytest.approx(0.0975), pytest.approx(0.1025))
    assert EXACT.allowed(7, 0) == (6.5, 7.5)
    low, high = RATIO.allowed(1, 2)
    assert (low, high) == (pytest.approx(0.635), pytest.approx(1.365))
    assert all(interval.why for interval in INTERVALS)
    page = (SOURCE / "docs/reproduce.md").read_text()
    assert all(interval.why in " ".join(page.split()) for interval in INTERVALS), "docs/reproduce.md lists the intervals and their reasons"


def test_documents_are_compared_row_by_row(tmp_path):
    row = {"technique": "gtao", "preset": "low", "scene": "gallery", "rmse_to_truth": 0.1, "ratio_to_hbao_plus": 0.5, "ladder": {"t1": 0.02}}
    kept, made = tmp_path / "kept.json", tmp_path / "made.json"
    kept.write_text(json.dumps({"results": [row]}))
    made.write_text(json.dumps({"results": [{**row, "rmse_to_truth": 0.2}]}))
    found = {where: (number.value, value) for where, number, value, _ in documents.pairs(kept, made)}
    assert found == {"gtao, low, gallery, rmse_to_truth": (0.1, 0.2), "gtao, low, gallery, ratio_to_hbao_plus": (0.5, 0.5),
                     "gtao, low, gallery, ladder t1": (0.02, 0.02)}
    made.write_text(json.dumps({"results": []}))
    with pytest.raises(ValueError, match="gtao, low, gallery was not made again"):
        list(documents.pairs(kept, made))


# --- From end to end, with a page and an entry of its own

ENTRY = '''
from catalogue import table
from intervals import ERROR, RATIO

@table("docs/small.md", "Errors", minutes=0.1, within=lambda row, column: RATIO if column else ERROR)
def errors(lab):
    frame = lab.frame("slab", "48x27")
    truth = lab.truth("ao", frame, 32)
    return [[lab.compared(lab.result("gtao", frame, "--preset", preset), truth)["rmse"], 0.75] for preset in ("low", "high")]
'''
PAGE = "# A page\n\n## Errors\n\n| preset | RMSE | time |\n|---|---|---|\n| low | .900 | 0.70 |\n| high | .900 | 0.70 |\n"
# Says what it was called with; waits where it is told to.
WRAPPER = '#!/bin/sh\necho "$1 $2" >> {folder}/calls\nwhile [ -e {folder}/wait ] && [ "$1" = run ]; do sleep 0.05; done\nexec {gloam} "$@"\n'


@pytest.fixture
def small(tmp_path):
    program = tmp_path / "bench" / "reproduce"
    shutil.copytree(PROGRAM, program, ignore=shutil.ignore_patterns("of_*", "__pycache__"))
    (program / "of_small.py").write_text(ENTRY)
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "small.md").write_text(PAGE)
    wrapper = tmp_path / "gloam"
    wrapper.write_text(WRAPPER.format(folder=tmp_path, gloam=os.environ["GLOAM_BINARY"]))
    wrapper.chmod(0o755)
    return tmp_path


def command(folder, *arguments):
    return [sys.executable, str(folder / "bench" / "reproduce"), "--gloam", str(folder / "gloam"), *arguments]


def reproduce(folder, *arguments):
    return subprocess.run(command(folder, *arguments), capture_output=True, text=True)


def calls(folder):
    return (folder / "calls").read_text().split("\n")[:-1]


def test_a_table_is_written_and_then_holds_without_running_anything_again(small):
    first = reproduce(small, "--write")
    assert first.returncode == 1 and "low, RMSE: the page has .900, made again ." in first.stdout
    assert first.stderr == "reproduce: 2 figures are outside their intervals\n"
    done = calls(small)
    assert [call.split()[0] for call in done] == ["capture", "reference", "run", "compare", "run", "compare"]
    page = (small / "docs" / "small.md").read_text()
    assert ".900" not in page and page.startswith("# A page\n\n## Errors\n\n| preset | RMSE | time |\n|---|---|---|\n| low | .")
    assert page.count("0.70") == 2, "times are not written without --times"
    second = reproduce(small, "small/errors", "--write", "--times")
    assert second.returncode == 0 and "4 of 4 figures are within their intervals" in second.stdout
    assert calls(small) == done and (small / "docs" / "small.md").read_text().count("0.75") == 2


def test_an_interrupted_table_goes_on(small):
    (small / "wait").touch()
    process = subprocess.Popen(command(small), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    for _ in range(8000):
        if (small / "calls").exists() and "run gtao" in calls(small):
            break
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=500)
    assert process.returncode == 1 and said.endswith("reproduce: interrupted; what was made is kept, and the same command goes on\n")
    (small / "wait").unlink()
    before = calls(small)
    assert before == ["capture slab", "reference ao", "run gtao"]
    reproduce(small)
    assert [call.split()[0] for call in calls(small)[len(before):]] == ["run", "compare", "run", "compare"]


MEASURED = '''
from catalogue import measurements

@measurements("docs/small.md", "data/results/small/slab.json", minutes=0.1, pages=("docs/small.md", ()))
def slab(lab):
    return lab.bench("slab", *"--scenes slab --techniques gtao --presets low --variants none --size 48x27 --rays 8 --rounds 1 --ladder none".split(),
                     "--no-growth", "--no-checks", "--no-images") / "bench.json"
'''


def test_a_document_of_measurements_is_compared_and_its_page_written(small):
    (small / "bench" / "reproduce" / "of_small.py").write_text(MEASURED)
    kept = small / "data" / "results" / "small" / "slab.json"
    kept.parent.mkdir(parents=True)
    rows = [{"technique": "gtao", "preset": "low", "variant": "", "scene": "slab", "width": 48, "rmse_to_truth": 0.9}]
    kept.write_text(json.dumps({"results": rows}))
    done = reproduce(small, "--write")
    assert "gtao, low, slab, 48, rmse_to_truth: the page has 0.9000, made again 0." in done.stdout, done.stdout + done.stderr
    assert len(json.loads(kept.read_text())["results"]) >= 1
    page = (small / "docs" / "small.md").read_text()
    assert "data/results/small/slab.json" in page and "--markdown docs/small.md" in " ".join(page.split()) and "gtao" in page
    again = reproduce(small)
    assert again.returncode == 0, again.stdout + again.stderr


def test_a_document_that_no_page_is_written_from_is_replaced_alone(small):
    (small / "bench" / "reproduce" / "of_small.py").write_text(MEASURED.replace(', pages=("docs/small.md", ())', ""))
    kept, page = small / "data" / "results" / "small" / "slab.json", (small / "docs" / "small.md").read_text()
    kept.parent.mkdir(parents=True)
    kept.write_text(json.dumps({"results": [{"technique": "gtao", "preset": "low", "scene": "slab", "width": 48, "rmse_to_truth": 0.9}]}))
    reproduce(small, "--write")
    assert reproduce(small).returncode == 0
    assert (small / "docs" / "small.md").read_text() == page


def test_a_failing_command_is_told_in_one_line_and_the_rest_is_made(small):
    entry = small / "bench" / "reproduce" / "of_small.py"
    entry.write_text(ENTRY + ENTRY.replace('"Errors"', '"Others"').replace('"gtao"', '"gtoa"'))
    page = small / "docs" / "small.md"
    page.write_text(page.read_text() + page.read_text().replace("Errors", "Others"))
    done = reproduce(small)
    assert done.returncode == 1 and "failed: small/others" in done.stderr
    told = [line for line in done.stdout.splitlines() if line.startswith("small/others: failed: ")]
    assert len(told) == 1 and "did you mean 'gtao'?" in told[0] and "small/errors: 2 of 4" in done.stdout


def test_what_only_some_machines_have_is_left_out_in_one_line(small):
    needed = '    from recipes import capture; capture(lab, "no.exr")\n    frame ='
    (small / "bench" / "reproduce" / "of_small.py").write_text(ENTRY.replace("    frame =", needed))
    done = reproduce(small)
    assert done.returncode == 0 and "small/errors: left out: needs no.exr among the frames that are not part of the project" in done.stdout


@pytest.mark.parametrize("arguments, status, said", [
    (("smal",), 2, "reproduce: smal: no figure, table or page is called so; 'small' is; --list names them\n"),
    (("small/eror",), 2, "reproduce: small/eror: no figure, table or page is called so; 'small/errors' is; --list names them\n"),
    (("--gloam", "/nowhere/gloam"), 1, "reproduce: /nowhere/gloam: is not there; script/build makes it, or --gloam names another\n")])
def test_bad_input_is_told_in_one_line(small, arguments, status, said):
    done = reproduce(small, *arguments)
    assert (done.returncode, done.stderr) == (status, said)


def test_without_a_build_the_script_says_so(small):
    (small / "script").mkdir()
    shutil.copy(SOURCE / "script" / "reproduce", small / "script")
    environment = {**os.environ, "PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"}
    done = subprocess.run([small / "script" / "reproduce", "small"], capture_output=True, text=True, env=environment)
    assert (done.returncode, done.stderr) == (1, f"reproduce: {small}/build/gloam: is not there; script/build makes it, or --gloam names another\n")


def test_the_list_counts_what_is_shared_once_and_names_records():
    done = subprocess.run([sys.executable, str(PROGRAM), "--list"], capture_output=True, text=True)
    assert done.returncode == 0 and f"{len(catalogue.ENTRIES)} in all, " in done.stdout
    assert f"{len(catalogue.RECORDS)} are records, which cannot be made again:" in done.stdout
    entries = [e for e in catalogue.ENTRIES.values() if e.shares == "shi2022"]
    assert len(entries) > 1 and catalogue.minutes_of(entries) == entries[0].minutes
    assert slug("The paper, measured again") == "the-paper-measured-again"
