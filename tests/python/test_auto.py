"""gloam.auto and gloam.pick decide as the command does, and give its planes."""

import numpy
import pytest

import gloam

FLAGS = ["--mask", "always", "--math", "precise", "--radius", "0.5"]
WORDS = {"mask": "always", "math": "precise", "radius": 0.5}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("auto") / "frame.exr"
    gloam.write(path, gloam.capture("colonnade", 150, 90))
    return path


def decisions(effects):
    """Effects without times, and without reasons, which name an option as each caller spells it."""
    return [{name: value for name, value in effect.items() if not name.startswith("ms") and name != "why"} for effect in effects]


def reasons(effects):
    return {effect["name"]: effect["why"] for effect in effects}


def planes_of(path, names):
    read = gloam.read(path, as_stored=True)
    return {name: numpy.array(read[name]) for name in names}


def test_auto_decides_and_computes_as_the_command_does(file, command, tmp_path):
    told = command("auto", file, "-o", tmp_path / "out.exr", "--float", "--keep-depth", *FLAGS, as_json=True)
    for frame in (file, gloam.read(file)):
        result = gloam.auto(frame, **WORDS)
        assert decisions(result.effects) == decisions(told["effects"])
        assert any(effect["wanted"] for effect in result.effects) and "ao" in result
        for name, values in planes_of(tmp_path / "out.exr", (name for name in result if not name.endswith("_raw"))).items():
            assert numpy.array_equal(result[name], values), name
        assert set(told) - set(result.facts) == {"memory_bytes"}
        assert (result.radius, result.radius_from) == (0.5, "flag")
        own, the_command = (reasons(effects) for effects in (result.effects, told["effects"]))
        assert {name for name in own if own[name] != the_command[name]} == {"light of an environment"}
        assert "settings=" in own["light of an environment"] and "--set" in the_command["light of an environment"]
    gloam.write(tmp_path / "own.exr", result)
    stored, own = gloam.read(tmp_path / "out.exr"), gloam.read(tmp_path / "own.exr")
    assert stored.planes == [plane for plane in own.planes if not plane.endswith("_raw")] and numpy.array_equal(stored["depth"], own["depth"])


def test_the_composite_is_that_of_the_command(file, command, tmp_path):
    flags = [*FLAGS, "--color-holds", "none", "--ambient", "0.5,0.6,0.8"]
    told = command("auto", file, "--composite", tmp_path / "picture.exr", *flags, as_json=True)
    result = gloam.auto(file, composite=True, color_holds="none", ambient=(0.5, 0.6, 0.8), **WORDS)
    assert result.facts["composite"] == told["composite"]
    half = numpy.array(gloam.read(tmp_path / "picture.exr", as_stored=True)["color"])
    assert numpy.allclose(result.composite, half, rtol=1e-3, atol=1e-3)
    assert gloam.auto(file, **WORDS).composite is None


def test_light_of_its_own_stays(command, tmp_path):
    frame = gloam.capture("lounge", 96, 54, ["normal", "color", "emission"])
    words = {"color_holds": "ambient,shadows,indirect,reflection", "radius": 0.5, "mask": "never"}
    result = gloam.auto(frame, composite=True, **words)
    colour, emission, ao = (numpy.array(each, numpy.float64) for each in (frame["color"], frame["emission"], result["ao"][..., None]))
    assert result.facts["not_darkened"] == ["emission"] and any("emission is not darkened" in note for note in result.notes)
    assert numpy.abs(result.composite - (emission + (colour - emission) * ao)).max() < 1e-5
    assert numpy.abs(result.composite - colour * ao).max() > 0.05
    arrays = {plane: frame[plane] for plane in ("depth", "normal", "color", "emission")}
    assert numpy.abs(gloam.auto(**arrays, camera=frame.camera, composite=True, **words).composite - result.composite).max() < 1e-5
    gloam.write(tmp_path / "frame.exr", frame)
    told = command("auto", tmp_path / "frame.exr", "--composite", tmp_path / "c.exr", "--mask", "never", "--radius", "0.5", "--color-holds",
                   words["color_holds"], as_json=True)
    assert told["not_darkened"] == ["emission"]
    assert numpy.abs(gloam.read(tmp_path / "c.exr", as_stored=True)["color"] - result.composite).max() < 1e-5


def test_a_goal_chooses(file):
    result = gloam.auto(file, error=1000.0, radius=0.5, preset="low", resolution="full")
    assert result.facts["goal_met"] is True and result.facts["error_goal"] == 1000
    assert result.facts["chosen"] == []  # nothing has to be computed for an error that large


def test_a_budget_may_be_frames_per_second(file):
    result = gloam.auto(file, budget="0.001fps", radius=0.5, preset="low", resolution="full")
    assert result.facts["budget_ms"] == pytest.approx(1e6) and result.facts["goal_met"] is True
    assert result.facts["why"].startswith("the most accurate within 1e+06 ms, for 0.001fps: ")


@pytest.mark.parametrize("keywords, words", [
    ({"budget": 20.0}, "colour"),
    ({"composite": True}, "no colour"),
    ({"budget": 20.0, "error": 0.1}, "give one of them"),
    ({"budget": 0}, "above 0"),
    ({"budget": "60hz"}, "budget 60hz is not allowed.*60fps"),
    ({"budget": [20]}, "budget is of type list"),
    ({"mask": "sometimes"}, "mask"),
    ({"presett": "low"}, "preset"),
])
def test_what_cannot_be_decided_is_refused(keywords, words, arrays, frame):
    with pytest.raises(gloam.UsageError, match=words):
        gloam.auto(**arrays, camera=frame.camera, **keywords)


def test_pick_gives_what_the_command_gives(file, command, tmp_path):
    truth = gloam.reference(file, samples=16, radius=0.5)
    gloam.write(tmp_path / "truth.exr", truth)
    techniques = ["hbao+", "ssao"]
    told = command("pick", file, "--error", "1", "--truth", tmp_path / "truth.exr", "--techniques", ",".join(techniques), as_json=True)
    for frame, reference in ((file, tmp_path / "truth.exr"), (gloam.read(file), truth)):
        picked = gloam.pick(frame, error=1.0, truth=reference, techniques=techniques)
        assert set(told) - set(picked) == {"command", "radius_pixels", "memory_bytes"}
        assert picked["technique"] in techniques and picked["radius"] == 0.5 and picked["radius_from"] == "truth"
        errors = {(each["technique"], each["preset"], each["resolution"]): each["rmse"] for each in told["finalists"]}
        both = [each for each in picked["finalists"] if (each["technique"], each["preset"], each["resolution"]) in errors]
        assert both
        for each in both:
            assert each["rmse"] == pytest.approx(errors[each["technique"], each["preset"], each["resolution"]], abs=1e-6)


@pytest.mark.parametrize("keywords, words", [
    ({}, "give either"),
    ({"budget": 20.0, "error": 0.1}, "give one of them"),
    ({"budget": 0}, "above 0"),
    ({"budget": "20"}, "budget 20 is not allowed.*60fps"),
    ({"budget": 20.0, "by": "looks"}, "looks"),
    ({"budget": 20.0, "techniques": ["gtoa"]}, "gtao"),
    ({"budget": 20.0, "fof": 60}, "fov"),
])
def test_what_cannot_be_picked_is_refused(keywords, words, file):
    with pytest.raises(gloam.UsageError, match=words):
        gloam.pick(file, **keywords)
