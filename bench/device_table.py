"""What script/check-device found on devices, as the table of docs/portability.md.

    python3 bench/device_table.py [DIR NAME | --check]

DIR: a folder that script/check-device wrote; its figures become data/results/devices/NAME.json. Then the table is written anew from all
files of data/results/devices. --check: writes nothing, and fails where the table is another.
"""
import json
import pathlib
import sys

root = pathlib.Path(__file__).resolve().parent.parent
results = root / "data/results/devices"
page = root / "docs/portability.md"
begin, end = "<!-- devices: script/update-devices -->\n", "<!-- /devices -->\n"


def read(folder, name):
    return json.loads((folder / name).read_text())


def times_of(runs):
    """Medians in ms by size, technique and preset: of the whole plan, of its longest pass, and of all its others."""
    times = {}
    for entry in runs:
        run = entry["run"]
        longest = max(each["ms"]["median"] for each in run["passes"])
        total = run["total_ms"]["median"]
        times.setdefault(entry["size"], {})[f"{run['technique']} {entry['preset']}"] = {
            "total": round(total, 4), "longest pass": round(longest, 4), "others": round(total - longest, 4)}
    return times


def summary(folder):
    doctor, stress, bench = (read(folder, name) for name in ("doctor.json", "stress.json", "bench.json"))
    device = doctor["devices"][0]
    shot = json.loads((folder / "shot.json").read_text().strip().splitlines()[-1])
    return {
        "device": device["device"], "platform": device["platform"], "driver": device["driver"],
        "cpu": bench["cpu"], "cores": bench["cores"], "date": bench["date"], "commit": bench["commit"],
        "doctor": {"held": device["held"], "tests": len(device["tests"]),
                   "known_bits": sum(test["same_bits"] for test in device["tests"]), "lanes": device["lanes"],
                   "group": device["group"], "cold_ms": round(device["cold_ms"]), "warm_ms": round(device["warm_ms"])},
        "stress": {"techniques": len({case["technique"] for case in stress["cases"]}), "figures": len(stress["cases"]),
                   "beyond": sum(not case["held"] for case in stress["cases"]), "left": stress["left"]},
        "times": times_of(read(folder, "times.json")),
        "peaks": {name: round(value, 1) for name, value in bench["peaks"].items()},
        "shot": {name: round(shot[name], 1) for name in ("fps", "decode_ms", "compute_ms", "write_ms")},
    }


def hard_cases(stress):
    text = f"{stress['techniques']} techniques, {stress['figures']} figures, {stress['beyond']} beyond their bound"
    return text + (f"; not run: {', '.join(stress['left'])}" if stress["left"] else "")


def settings_by_technique(devices, size):
    """Presets, cheapest first, by technique."""
    presets = {}
    for device in devices:
        for setting in device["times"].get(size, {}):
            technique, preset = setting.split()
            presets.setdefault(technique, set()).add(preset)
    order = ["low", "medium", "high", "ultra"]
    return {technique: sorted(some, key=order.index) for technique, some in sorted(presets.items())}


def milliseconds(device, size, technique, presets):
    times = [device["times"].get(size, {}).get(f"{technique} {preset}") for preset in presets]
    return "; ".join(f"{time['total']:.3f} ({time['longest pass']:.3f})" if time else "-" for time in times)


def rows(devices):
    """The table's rows: a name and a cell for each device."""
    doctor = [each["doctor"] for each in devices]
    yield "", [f"{each['device']}" for each in devices]
    yield "driver", [f"{each['platform']} {each['driver']}" for each in devices]
    yield "host", [f"{each['cpu']}, {each['cores']} cores" for each in devices]
    yield "commit, date", [f"{each['commit']}, {each['date'][:10]}" for each in devices]
    yield "`gloam doctor`", [f"{'holds' if d['held'] else 'does not hold'}: {d['tests']} self-tests, {d['known_bits']} with the known bits"
                             for d in doctor]
    yield "fastest", [f"{d['lanes']} lane{'' if d['lanes'] == 1 else 's'}, groups of {d['group']}" for d in doctor]
    yield "first image, ms, nothing compiled; afterwards", [f"{d['cold_ms']}; {d['warm_ms']}" for d in doctor]
    yield "`gloam stress all --quick`", [hard_cases(each["stress"]) for each in devices]
    for size, pixels in (("full-hd", "1920x1080"), ("ultra-hd", "3840x2160")):
        for technique, presets in settings_by_technique(devices, size).items():
            yield f"`{technique}` {', '.join(presets)}, {pixels}", [milliseconds(each, size, technique, presets) for each in devices]
    yield "copy, GB/s; gathers, G/s; multiply-adds, Gflop/s", [
        f"{p['copy_gb_per_s']:.0f}; {p['gather_g_per_s']:.0f}; {p['fma_gflops']:.0f}" for p in (each["peaks"] for each in devices)]
    yield "shot of `gtao`, frames a second; decode, compute, write, ms a frame", [
        f"{s['fps']}; {s['decode_ms']}, {s['compute_ms']}, {s['write_ms']}" for s in (each["shot"] for each in devices)]


def table():
    devices = [json.loads(path.read_text()) for path in sorted(results.glob("*.json"))]
    lines = [f"| {name} | {' | '.join(cells)} |" for name, cells in rows(devices)]
    return "\n".join([lines[0], "|---" * (len(devices) + 1) + "|"] + lines[1:]) + "\n"


def rewritten(text):
    before, rest = text.split(begin)
    return before + begin + "\n" + table() + "\n" + end + rest.split(end)[1]


def main(arguments):
    if arguments == ["--check"]:
        text = page.read_text()
        sys.exit(None if rewritten(text) == text else f"{page}: the table is not that of data/results/devices; run script/update-devices")
    if len(arguments) not in (0, 2):
        sys.exit(__doc__)
    if arguments:
        results.mkdir(parents=True, exist_ok=True)
        (results / f"{arguments[1]}.json").write_text(json.dumps(summary(pathlib.Path(arguments[0])), indent=1) + "\n")
    page.write_text(rewritten(page.read_text()))


if __name__ == "__main__":
    main(sys.argv[1:])
