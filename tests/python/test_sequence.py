"""Sequences: the same bits as `gloam run` on a shot, also accumulated over time."""

import os
import signal
import threading
import time

import numpy
import pytest

import gloam


@pytest.fixture(scope="module")
def shot(command, tmp_path_factory):
    folder = tmp_path_factory.mktemp("shot")
    command("capture", "gallery", "-o", folder / "shot.####.exr", "--shot", "walk", "--frames", "1-6", "--size", "96x64", "--planes", "normal,motion")
    return folder


def test_frames_are_read_by_number(shot):
    sequence = gloam.Sequence(shot / "shot.####.exr")
    assert sequence.numbers == [1, 2, 3, 4, 5, 6] and len(sequence) == 6
    frames = list(sequence)
    assert [frame.name for frame in frames] == [f"shot.000{i}.exr" for i in range(1, 7)]
    assert numpy.array_equal(sequence[3]["depth"], frames[2]["depth"])
    assert sequence.read(3, ["normal"]).planes == ["normal"]
    assert repr(sequence) == "<gloam.Sequence 'shot.####.exr', frames 1-6>"
    assert gloam.Sequence(str(shot / "shot.%04d.exr"), frames=range(2, 6, 2)).numbers == [2, 4]
    assert gloam.Sequence(shot / "shot.####.exr", frames="1-9x2", missing="skip").numbers == [1, 3, 5]


@pytest.mark.parametrize("temporal", [False, True])
def test_a_run_gives_what_the_command_gives(temporal, shot, command, tmp_path):
    flags = ["--temporal"] if temporal else []
    command("run", "gtao", shot / "shot.####.exr", "-o", tmp_path / "ao.####.exr", "--radius", "0.5", "--float", "--outputs", "ao,ao_raw", *flags)
    numbers = []
    for result in gloam.Sequence(shot / "shot.####.exr").run("gtao", radius=0.5, temporal=temporal, outputs=["ao", "ao_raw"]):
        numbers.append(result.number)
        stored = gloam.read(tmp_path / f"ao.000{result.number}.exr", as_stored=True)
        for plane in ("ao", "ao_raw"):
            assert numpy.array_equal(result[plane], stored[plane]), (result.number, plane)
    assert numbers == [1, 2, 3, 4, 5, 6]


def test_accumulation_goes_on_beyond_the_first_frame(shot):
    sequence = gloam.Sequence(shot / "shot.####.exr")
    alone, together = list(sequence.run("gtao", radius=0.5)), list(sequence.run("gtao", radius=0.5, temporal=True))
    assert "frames" in together[3] and together[3]["frames"].max() > 2
    assert not numpy.array_equal(alone[3]["ao_raw"], together[3]["ao_raw"])


def test_a_technique_for_sequences_accumulates_by_itself(command, tmp_path):
    command("capture", "gallery", "-o", tmp_path / "shot.####.exr", "--shot", "walk", "--frames", "1-3", "--size", "64x48",
            "--planes", "normal,motion,color,roughness,reflectance")
    command("run", "temporal-sssr", tmp_path / "shot.####.exr", "-o", tmp_path / "out.####.exr", "--float")
    for result in gloam.Sequence(tmp_path / "shot.####.exr").run("temporal-sssr"):
        stored = gloam.read(tmp_path / f"out.000{result.number}.exr", as_stored=True)
        assert numpy.array_equal(result["reflection"], stored["reflection"])


def test_a_frame_that_fails_leaves_the_others(shot, tmp_path):
    for i in (1, 2, 3):
        (tmp_path / f"shot.000{i}.exr").write_bytes((shot / f"shot.000{i}.exr").read_bytes()[: 3000 if i == 2 else None])
    run = gloam.Sequence(tmp_path / "shot.####.exr").run("gtao", radius=0.5)
    assert next(run).number == 1
    with pytest.raises(gloam.Error, match="shot.0002.exr"):
        next(run)
    assert next(run).number == 3
    with pytest.raises(StopIteration):
        next(run)


def test_a_radius_of_its_own_for_each_frame_is_told_once(shot):
    import warnings

    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        results = list(gloam.Sequence(shot / "shot.####.exr").run("gtao"))
    # The header of a captured shot states one radius for all its frames.
    assert {result.radius_from for result in results} == {"scene"}
    assert [str(note.message) for note in told].count("radius: each frame has its own, made from its depths; radius=... gives one to all") == 0


def files_of(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


@pytest.mark.parametrize("temporal", [False, True])
def test_written_frames_have_the_pixels_of_the_command(temporal, shot, command, tmp_path):
    command("run", "gtao", shot / "shot.####.exr", "-o", tmp_path / "ao.####.exr", "--radius", "0.5", "--keep-depth", *(["--temporal"] if temporal else []))
    written = gloam.Sequence(shot / "shot.####.exr").write("gtao", tmp_path / "py.####.exr", radius=0.5, temporal=temporal, keep_depth=True)
    assert written == gloam.Written([1, 2, 3, 4, 5, 6], [], {})
    for number in written.done:
        ours, theirs = (gloam.read(tmp_path / f"{name}.000{number}.exr", as_stored=True) for name in ("py", "ao"))
        assert ours.planes == theirs.planes == ["ao", "depth"]
        for plane in ours.planes:
            assert numpy.array_equal(ours[plane], theirs[plane]), (number, plane)


@pytest.mark.parametrize("temporal", [False, True])
def test_an_interrupted_write_goes_on(temporal, shot, tmp_path):
    """Frames are links to a few files, so that there are many; Ctrl-C comes after some of them."""
    count = 150
    for folder in ("in", "whole", "cut"):
        (tmp_path / folder).mkdir()
    for number in range(1, count + 1):
        os.link(shot / f"shot.000{1 + number % 6}.exr", tmp_path / "in" / f"shot.{number:04}.exr")
    sequence = gloam.Sequence(tmp_path / "in" / "shot.####.exr")

    def write(folder, **more):
        return sequence.write("gtao", tmp_path / folder / "ao.####.exr", radius=0.5, temporal=temporal, **more)

    assert write("whole").done == list(range(1, count + 1))
    whole = files_of(tmp_path / "whole")

    def interrupt():
        while len(list((tmp_path / "cut").glob("ao.*"))) < 5:
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        write("cut", resume=True)
    thread.join()
    cut = files_of(tmp_path / "cut")
    assert 5 <= len(cut) < count and all(whole[name] == content for name, content in cut.items())
    rest = write("cut", resume=True)
    assert len(rest.skipped) == len(cut) and len(rest.done) == count - len(cut) and not rest.again
    assert files_of(tmp_path / "cut") == whole


def test_resuming_writes_again_what_was_made_in_another_way(shot, tmp_path):
    sequence = gloam.Sequence(shot / "shot.####.exr")
    out = tmp_path / "ao.####.exr"
    sequence.write("gtao", out, radius=0.5)
    assert sequence.write("gtao", out, radius=0.5, resume=True) == gloam.Written([], [1, 2, 3, 4, 5, 6], {})
    (tmp_path / "ao.0002.exr").write_bytes((tmp_path / "ao.0002.exr").read_bytes()[:-100])
    (tmp_path / "ao.0003.exr").unlink()
    assert sequence.write("gtao", out, radius=0.5, resume=True) == gloam.Written([2, 3], [1, 4, 5, 6], {2: "it is damaged"})
    for more in ({"radius": 0.6}, {"preset": "low"}, {"half": False}, {"compression": "none"}, {"keep_depth": True}, {"outputs": ["ao_raw"]}, {"seed": 3}):
        written = sequence.write("gtao", out, **{"radius": 0.5, **more}, resume=True)
        assert written.again == dict.fromkeys(range(1, 7), "it was made with other settings"), more
        sequence.write("gtao", out, radius=0.5)


def test_a_frame_that_cannot_be_written_leaves_the_others(shot, tmp_path):
    for i in (1, 2, 3):
        (tmp_path / f"shot.000{i}.exr").write_bytes((shot / f"shot.000{i}.exr").read_bytes()[: 3000 if i == 2 else None])
    with pytest.raises(gloam.Error, match="1 of 3 frames failed: 2; frame 2: .*shot.0002.exr"):
        gloam.Sequence(tmp_path / "shot.####.exr").write("gtao", tmp_path / "ao.####.exr", radius=0.5)
    assert sorted(path.name for path in tmp_path.glob("ao.*")) == ["ao.0001.exr", "ao.0003.exr"]


@pytest.mark.parametrize("call, sentence", [
    (lambda s: gloam.Sequence(s / "shot.####.exr").write("gtao", s / "shot.%04d.exr"), "would be written over an input"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").write("gtao", s / "ao.exr"), "has no place for the frame's number"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").write("gtao", s / "ao.####.png"), "name them with .exr"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").write("gtao", s / "ao.####.exr", compression="zap"), "zap"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").write("gtao", s / "ao.####.exr", resumme=True), "did you mean 'resume'?"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").write("normals", s / "ao.####.exr", temporal=True), "normals"),
    (lambda s: gloam.Sequence(s / "none.####.exr"), "no file of this pattern is there"),
    (lambda s: gloam.Sequence(s / "shot.exr"), "Sequence"),
    (lambda s: gloam.Sequence(s / "shot.####.exr", frames="1-9"), "are missing"),
    (lambda s: gloam.Sequence(s / "shot.####.exr", frames="one"), "frames one"),
    (lambda s: gloam.Sequence(s / "shot.####.exr", missing="skp"), "did you mean 'skip'?"),
    (lambda s: gloam.Sequence(s / "shot.####.exr")[17], "no frame 17; there are 1-6"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").run("gtoa"), "did you mean 'gtao'?"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").run("gtao", depth=numpy.ones((4, 4), numpy.float32)), "planes come with the frames"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").run("gtao", repeat=4), "repeat 4: times one frame"),
    (lambda s: gloam.Sequence(s / "shot.####.exr").run("normals", temporal=True), "normals"),
    (lambda s: next(gloam.Sequence(s / "shot.####.exr").run("sssr")), "needs 'color'"),
    (lambda s: next(gloam.Sequence(s / "shot.####.exr").run("gtao", radus=1)), "did you mean 'radius'?"),
])
def test_sequences_that_cannot_be(call, sentence, shot):
    with pytest.raises(gloam.Error) as raised:
        call(shot)
    assert sentence in str(raised.value) and "\n" not in str(raised.value), str(raised.value)


def test_threads_share_a_run(shot):
    expected = {result.number: result["ao"] for result in gloam.Sequence(shot / "shot.####.exr").run("gtao", radius=0.5)}
    for _ in range(5):
        run, results, failures = gloam.Sequence(shot / "shot.####.exr").run("gtao", radius=0.5), [], []

        def work():
            try:
                results.extend(run)
            except BaseException as error:
                failures.append(error)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert not failures
        assert sorted(result.number for result in results) == list(expected)
        for result in results:
            assert numpy.array_equal(result["ao"], expected[result.number]), result.number


def test_a_mistyped_keyword_is_suggested(shot):
    with pytest.raises(gloam.UsageError, match="no keyword 'temporall' .did you mean 'temporal'.."):
        gloam.Sequence(shot / "shot.####.exr").run("gtao", temporall=True)
