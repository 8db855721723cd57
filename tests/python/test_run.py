"""Results are those of the command, bit for bit, whatever the frame is given as."""

import threading
import time

import numpy
import pytest

import gloam


def planes_of(path, names):
    read = gloam.read(path, as_stored=True)
    return {name: numpy.array(read[name]) for name in names}


def assert_same(result, stored):
    for name, values in stored.items():
        assert numpy.array_equal(result[name], values), name


@pytest.fixture(scope="module")
def file(tmp_path_factory, frame):
    path = tmp_path_factory.mktemp("run") / "frame.exr"
    gloam.write(path, frame)
    return path


@pytest.mark.parametrize("technique, keywords, flags", [
    ("gtao", {"radius": 0.5}, ["--radius", "0.5"]),
    ("ao", {}, []),
    ("hbao+", {"radius": 0.3, "preset": "low", "filter": "none"}, ["--radius", "0.3", "--preset", "low", "--filter", "none"]),
    ("gtao", {"radius": 0.5, "resolution": "half", "seed": 3}, ["--radius", "0.5", "--resolution", "half", "--seed", "3"]),
    ("bitmask", {"radius": 0.5, "math": "precise", "lanes": 4}, ["--radius", "0.5", "--math", "precise", "--lanes", "4"]),
    ("gtao", {"radius": 0.5, "extras": ["bent_normal"], "jitter": False}, ["--radius", "0.5", "--with", "bent_normal", "--set", "jitter=off"]),
    ("gtao", {"radius": 0.5, "settings": {"bilateral.half_width": 2}}, ["--radius", "0.5", "--set", "bilateral.half_width=2"]),
    ("sssr", {}, []),
    ("ao", {"layers": "one", "eyes": "one"}, ["--layers", "one", "--eyes", "one"]),
])
def test_a_frame_gives_what_the_command_gives(technique, keywords, flags, file, frame, command, tmp_path):
    result = gloam.run(technique, gloam.read(file), **keywords)
    command("run", technique, file, "-o", tmp_path / "out.exr", "--float", "--outputs", ",".join(result), *flags)
    assert_same(result, planes_of(tmp_path / "out.exr", result))
    assert_same(gloam.run(technique, file, **keywords), dict(result))


def test_layers_and_eyes_choose_variants(frame):
    pair = gloam.capture("colonnade", 60, 40, ["normal"], stereo=0.065, peel=2)
    layered = gloam.run("gtao", pair, radius=0.5, layers="peeled")
    assert layered.technique == "dp-gtao"
    assert all(numpy.array_equal(a, b) for a, b in zip(layered["ao"], gloam.run("dp-gtao", pair, radius=0.5)["ao"]))
    assert gloam.run("gtao", pair, radius=0.5, eyes="both").technique == "stereo-gtao"
    for keywords, sentence in [(dict(technique="gtao", layers="peeled", eyes="both"), "gtao: has no variant layers='peeled' eyes='both'; there are gtao, "),
                               (dict(technique="dp-gtao", layers="stochastic"), "dp-gtao: is gtao with layers='peeled', which layers='stochastic' contradicts"),
                               (dict(technique="gtao", layers="peel"), "layers peel is not allowed (did you mean 'peeled'?)")]:
        with pytest.raises(gloam.UsageError) as raised:
            gloam.run(frame=frame, **keywords)
        assert sentence in str(raised.value)
    assert gloam.techniques()["stereo-sd-hbao+"].variant == {"of": "hbao+", "layers": "stochastic", "eyes": "both"}
    assert gloam.techniques()["gtao"].variant is None


def test_arrays_give_what_the_command_gives(file, command, tmp_path):
    command("run", "gtao", file, "-o", tmp_path / "out.exr", "--radius", "0.5", "--float", "--outputs", "ao,ao_raw")
    read = gloam.read(file)  # a header keeps its camera as float: another one gives other last bits
    depth, normal = numpy.array(read["depth"]), numpy.array(read["normal"])
    result = gloam.run("gtao", depth=depth, normal=normal, camera=read.camera, radius=0.5)
    assert list(result) == ["ao", "ao_raw"]
    assert_same(result, planes_of(tmp_path / "out.exr", result))


def test_arrays_are_float32_contiguous_and_the_callers(arrays, frame):
    result = gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5, extras=["bent_normal"])
    assert result["ao"].shape == (90, 150) and result["bent_normal"].shape == (90, 150, 3)
    for values in result.values():
        assert values.dtype == numpy.float32 and values.flags.c_contiguous and values.flags.writeable
    kept = result["ao"].copy()
    gloam.run("gtao", **arrays, camera=frame.camera, radius=0.1)
    assert numpy.array_equal(result["ao"], kept)
    result["ao"][:] = 0  # nobody else has it


def test_arrays_are_not_changed_and_may_be_the_same(arrays, frame):
    depth = arrays["depth"].copy()
    depth.flags.writeable = False
    result = gloam.run("gtao", depth=depth, back_depth=depth, normal=arrays["normal"], camera=frame.camera, radius=0.5)
    assert_same(result, gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5))
    assert numpy.array_equal(depth, arrays["depth"])


def test_a_width_without_padding_is_the_same_image(frame):
    wide = gloam.capture("colonnade", 160, 90, ["normal"])
    result = gloam.run("gtao", depth=wide["depth"], normal=wide["normal"], camera=wide.camera, radius=0.5)
    assert result["ao"].shape == (90, 160) and result["ao"].flags.c_contiguous
    assert_same(gloam.run("gtao", wide, radius=0.5), result)


def test_a_result_says_what_it_is(arrays, frame):
    result = gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5, repeat=3)
    assert (result.technique, result.radius, result.radius_from, result.views) == ("gtao", 0.5, "flag", [""])
    assert result.notes == [] and len(result.total_ms) == 3 and result.ms > 0
    assert [step.name for step in result.passes] == ["gtao/estimate", "bilateral/separable"]
    assert "gtao" in repr(result) and "ao (90, 150)" in repr(result) and "radius 0.5" in repr(result)
    assert result.attributes["gloamTechnique"] == "gtao" and result.device_bytes > 0


def test_a_radius_made_from_the_frame_is_told(arrays, frame):
    with pytest.warns(gloam.Note, match="radius: none is given, so it is made from the frame"):
        result = gloam.run("gtao", **arrays, camera=frame.camera)
    assert result.radius_from == "frame" and result.radius > 0
    assert any("made from the frame" in note for note in result.notes)


def test_a_radius_that_does_not_suit_is_told(arrays, frame):
    with pytest.warns(gloam.Note, match="few occluders are that near"):
        result = gloam.run("gtao", **arrays, camera=frame.camera, radius=1e-4)
    assert any("few occluders" in note for note in result.notes)


def test_two_eyes_are_lists():
    pair = gloam.capture("colonnade", 96, 64, stereo=0.065)
    assert pair.views == ["left", "right"]
    from_frame = gloam.run("stereo-gtao", pair, radius=0.5)
    left, right = from_frame["ao"]
    assert left.shape == right.shape == (64, 96) and not numpy.array_equal(left, right)
    from_arrays = gloam.run("stereo-gtao", depth=pair["depth"], normal=pair["normal"], camera=pair.camera, radius=0.5)
    for name in from_frame:
        for a, b in zip(from_frame[name], from_arrays[name]):
            assert numpy.array_equal(a, b), name


def test_layers_are_one_array():
    layered = gloam.capture("fence", 96, 64, ["normal"], peel=4)
    stack = numpy.stack([layered[f"peel.0{i}"] for i in range(4)])
    result = gloam.run("dp-gtao", depth=layered["depth"], normal=layered["normal"], peel=stack, camera=layered.camera, radius=0.5)
    assert numpy.array_equal(result["ao"], gloam.run("dp-gtao", layered, radius=0.5)["ao"])


def test_a_stack_takes_the_place_of_all_layers_of_a_frame():
    layered = gloam.capture("fence", 96, 64, ["normal"], peel=4)
    two = numpy.stack([layered[f"peel.0{i}"] for i in range(2)])
    expected = gloam.run("dp-gtao", depth=layered["depth"], normal=layered["normal"], peel=two, camera=layered.camera, radius=0.5)
    assert not numpy.array_equal(expected["ao"], gloam.run("dp-gtao", layered, radius=0.5)["ao"])
    assert_same(gloam.run("dp-gtao", layered, peel=two, radius=0.5), expected)


def test_a_mask_may_be_an_array(arrays, frame):
    mask = numpy.zeros((90, 150), numpy.float32)
    mask[:, :75] = 1
    whole = gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5)
    part = gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5, only=mask)
    assert numpy.array_equal(part["ao"][:, :75], whole["ao"][:, :75])
    assert part.skipped_share > 0.2 and (part["ao"][:, 110:] == 1).all()
    assert_same(gloam.run("gtao", frame, radius=0.5, only=mask), part)


def test_an_array_takes_the_place_of_a_frames_plane(arrays, frame):
    depth = arrays["depth"] * numpy.float32(0.5)
    depth[0, 0] = numpy.nan
    expected = gloam.run("gtao", depth=depth, normal=arrays["normal"], camera=frame.camera, radius=0.5)
    assert_same(gloam.run("gtao", frame, depth=depth, radius=0.5), expected)
    assert numpy.array_equal(frame["depth"], arrays["depth"])


@pytest.mark.parametrize("technique", ["gtao", "hbao+", "evidence", "ssao", "volumetric", "hbao"])
def test_strips_give_the_same_estimate(technique):
    frame = gloam.capture("colonnade", 96, 600, ["normal"], fov=30)
    whole = gloam.run(technique, frame, radius=0.1, jitter=False, math="precise")
    divided = gloam.run(technique, frame, radius=0.1, jitter=False, math="precise", strips=3)
    assert len(divided.passes) == len(whole.passes) and divided.device_bytes < whole.device_bytes
    for plane in ("ao", "ao_raw"):
        difference = numpy.abs(divided[plane] - whole[plane])
        # Rows have other coordinates in a strip, and so the last bits of positions. Now and then a sample moves by a pixel.
        assert difference.mean() < 2e-5 and (difference > 1e-3).mean() < 1e-3, (plane, difference.max())
    jittered = gloam.run(technique, frame, radius=0.1, strips=3), gloam.run(technique, frame, radius=0.1)
    assert abs(jittered[0]["ao"].mean() - jittered[1]["ao"].mean()) < 0.01


def test_a_device_is_kept_with_its_kernels(arrays, frame):
    gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5)
    text = gloam.devices()[0].name[:4]
    first = gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5, device=text)
    own = gloam.Device(text)
    assert own.lanes >= 1 and own.memory > 0 and own.name in repr(own)
    assert_same(gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5, device=own), first)


def test_memory_does_not_grow(arrays, frame):
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096

    def calls(count):
        for _ in range(count):
            gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5)

    calls(100)
    before = resident()
    calls(1000)
    # 1000 results of 54 kB each are 108 MB.
    assert resident() - before < 8 << 20


def test_threads_share_a_device(arrays, frame):
    expected = gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5)
    failures = []

    def work():
        try:
            for _ in range(10):
                assert_same(gloam.run("gtao", **arrays, camera=frame.camera, radius=0.5), expected)
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_other_threads_run_meanwhile():
    big = gloam.capture("colonnade", 1280, 720, ["normal"])
    gloam.run("evidence", big, radius=0.5)
    done = threading.Event()

    def work():
        for _ in range(5):
            gloam.run("evidence", big, radius=0.5, preset="ultra")
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    steps = 0
    while not done.is_set():
        time.sleep(0.001)
        steps += 1
    thread.join()
    # With the interpreter's lock held, this thread gets a turn between the five calls only.
    assert steps > 20
