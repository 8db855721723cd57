"""What the pages of the documentation need to be run by snippets.py, and what of them cannot run as written."""

from dataclasses import dataclass, field


@dataclass
class Page:
    prepare: str = ""  # commands that make what the page takes for granted
    python: str = ""  # what its Python takes for granted
    json: tuple = ()  # the file that each block of JSON is kept in, in their order
    instead: dict = field(default_factory=dict)  # {part of a command: (what is run in its place, why)}
    not_run: dict = field(default_factory=dict)  # {how commands begin: why they are not run, and what runs them}
    check: str = ""  # commands that succeed if the snippets made what the page says
    needs: tuple = ()  # programs and Python modules that script/bootstrap installs; without them the page is skipped
    build: dict = field(default_factory=dict)  # {name in build/: program in its place}


# Blocks of C, C++ and CMake, and the test that takes them from the page.
BUILT_ELSEWHERE = {"docs/cpp.md": "install.programs", "docs/adding-a-technique.md": "example.*"}

BUILD = "builds what runs here; every test needs the build before"
SANITIZED = "builds again with other flags, and takes many minutes; script/test --long runs it"
MINUTES = "takes minutes as written"
DEVICE = "TEXT stands for a part of a device's name"
FIRST_DEVICE = """"$(gloam list devices --json - | python3 -c 'import json, sys; print(json.load(sys.stdin)[0]["device"])')\""""

FRAME = "gloam capture gallery -o frame.exr --size 240x135\n"
SHOT = "gloam capture gallery -o 'shot.####.exr' --shot walk --frames 1-4 --size 160x90 --planes normal,color\n"
TRUTHS = "gloam reference ao 'shot.####.exr' -o 'truth.####.exr' --samples 8\n"
# A path of the length that a page needs.
PATH = """echo '{"width": 96, "height": 54, "fx": 64, "fy": 64, "cx": 48, "cy": 27, "frames": FRAMES,
  "path": [{"camera_to_world": [[1, 0, 0, 1.6], [0, 1, 0, 1.65], [0, 0, 1, 2.5], [0, 0, 0, 1]]},
           {"camera_to_world": [[1, 0, 0, 1.9], [0, 1, 0, 1.65], [0, 0, 1, 1.5], [0, 0, 0, 1]]}]}' > walk.json\n"""
GLB = """for name in house street; do python3 "$SNIPPETS/boxes.py" $name.glb; done\n"""
SMALL = "--scenes plane --techniques gtao --presets low --variants none --size 96x54 --rays 8 --rounds 1 --no-growth --no-checks"

PAGES = {
    "README.md": Page(
        prepare=PATH.replace("FRAMES", "100") + """gloam capture gallery -o 'path.####.exr' --planes normal --size 96x54 --camera-path walk.json
            for i in $(seq 1001 1100); do mv path.0${i#1}.exr shot.$i.exr; done""",
        python="import numpy\n"
               "z = numpy.full((1080, 1920), 5, numpy.float32)\n"
               "n = numpy.tile(numpy.float32([0, 0, 1]), (1080, 1920, 1))",
        instead={
            "--budget 20ms": ("--budget 1h", "times of a busy machine"),
            "--error 0.12 --truth": ("--error 0.12 --all --techniques evidence --truth", "a minute is not enough on a busy machine"),
            "build/gloam bench -o out/loggia": (
                "build/gloam bench -o out/loggia --techniques hbao+,gtao --presets low --variants none --no-growth --no-checks", MINUTES)},
        not_run={"script/test": "would begin this test again",
                 "script/build": BUILD,
                 "script/package": "installs lintian and builds; script/try-package tries what it makes"},
        check="""for file in out/demo/ao_layers.exr difference.png look.html why.png out/loggia/report.html ao.1100.exr planes.png pair.png; do
                [ -s $file ]; done
            [ -x .local/bin/gloam ]"""),
    "CONTRIBUTING.md": Page(not_run={"script/sanitize": SANITIZED, "script/fuzz": SANITIZED}),
    "bench/README.md": Page(
        prepare=SHOT + "gloam capture gallery -o gallery.exr --size 96x54\n",
        instead={"bench_hbao_plus ": ("bench_hbao_plus --size=96x54 --benchmark_min_time=0.01 ", MINUTES),
                 "bench_denormals  ": ("bench_denormals --size=96x54 gtao bilateral  ", MINUTES),
                 "out/bounces gallery plane ": ("out/bounces plane --size 96x54 --samples 32 ", MINUTES),
                 "out/fit/without-gallery.json": ("data/effect_errors.json", "the table takes hours to make")},
        not_run={"script/build": BUILD, "PYTHONPATH=build/python python3 bench/picture_fit.py": "takes hours"},
        check="grep -q hbao+_8x4/gloam_fast hbao_plus.json && [ -s floor.0004.exr ]"),
    "data/README.md": Page(
        not_run={"cmake --build": BUILD},
        instead={"generate_data data  ": ("generate_data data 64", MINUTES)}),
    "docs/adding-a-technique.md": Page(
        build={"gloam": "tests/gloam_with_example"},
        not_run={"script/build": BUILD,
                 "build/bench/bench_kernels": "has the library's techniques, without those of the page; docs.bench_README runs it"}),
    "docs/benchmarking.md": Page(
        prepare=FRAME + SHOT + TRUTHS + GLB + """gloam reference ao frame.exr -o ao_ref.exr --samples 8
            mkdir -p kernels/evidence""",
        instead={
            " # built-in scenes, every": (f" {SMALL} # ", MINUTES),
            "--scenes all --size 1920x1080": ("--scenes plane --size 96x54 --rays 8", MINUTES),
            "--sweep steps=4,9,18": ("--sweep steps=4,9,18 --scenes plane --size 96x54 --rays 8", MINUTES),
            " # your own frame": (" --techniques gtao --presets low --variants none --no-growth # ", MINUTES),
            "--size 1920x1080 --rays 1": ("--size 320x180 --rays 1", MINUTES),
            "--scenes gallery,lounge": ("--scenes plane --size 96x54 --rays 8 --presets low --variants none --no-growth", MINUTES),
            "hbao+,gtao,ssao,hbao,alchemy --size 480x270 --processes 4": (
                "hbao+,gtao --scenes plane --size 96x54 --rays 8 --presets low --variants none --rounds 5 --processes 2", MINUTES),
            "--techniques gtao --google-benchmark": (f"{SMALL} --google-benchmark", MINUTES),
            "--baseline out/before/bench.json": ("--baseline out/before/bench.json --regression error", "times of a busy machine"),
            "--folder out/fit": ("--folder out/fit --scenes plane,gallery --occluders depth --presets medium --frames 2 --rays 16", MINUTES),
            "--folder out/interiors": ("--folder out/interiors --presets medium --frames 2 --rays 16", MINUTES),
            "--folder out/own": ("--folder out/own --frames 2 --rays 16", MINUTES)},
        not_run={"build/gloam bench -o out/vermeer2021": "takes 11 minutes; cli.Cli.APaperIsMeasuredAgain of script/test --long runs it, smaller"},
        check="""for n in bench steps mine light naive walk shot before after; do [ -s out/$n/bench.json ]; done
            python3 -c 'import json; assert len(json.load(open("out/walk/bench.json"))["sequence"]["frames"]) == 4'"""),
    "docs/blender.md": Page(
        prepare="""export BLENDER_USER_CONFIG=$PWD/config BLENDER_USER_SCRIPTS=$PWD/scripts
            blender -b --factory-startup --python-exit-code 1 -P tests/blender/addon/make.py -- animation $PWD/shot.blend $PWD/shot.obj 50""",
        needs=("blender",),
        check="""for file in gloam/shot_Scene_ao.0001.exr gloam/shot_Scene_ao_rgb.0003.exr shot_ao.blend ao.exr colour_x_ao.000{1,3}.png; do
            [ -s $file ]; done"""),
    "docs/cpp.md": Page(
        prepare="""cmake --install build --prefix $HOME/opt > install.log
            cp build/generated/programs/*.cpp .""",
        instead={"/opt/gloam": ("$HOME/opt", "tests write nothing outside their folder")},
        check="./in_memory && ./truth"),
    "docs/doctor.md": Page(),
    "docs/farm.md": Page(
        prepare=SHOT + f"""gloam stress gaussian --quick --json stress.1.json
            gloam stress normals --quick --json stress.2.json
            gloam bench -o out/bench.1 {SMALL}
            gloam bench -o out/bench.2 {SMALL.replace("plane", "slab")}""",
        not_run={"parallel": "GNU parallel is not among the packages of script/bootstrap; `sh -e` runs the same list above",
                 "sbatch": "needs a cluster; slurm.* run such a list where Slurm is installed"},
        check="[ $(wc -l < stress.txt) = 8 ] && [ $(wc -l < bench.txt) = 7 ] && [ -s ao.0004.exr ] && [ -s page.md ]"),
    "docs/choosing.md": Page(
        instead={"--size 960x540": ("--size 160x90", MINUTES)},
        not_run={"PYTHONPATH=build/python python3 bench/": "take an hour each"},
        check="for file in effects.exr picture.exr why.png; do [ -s $file ]; done"),
    "docs/composite.md": Page(
        instead={"--size 480x270": ("--size 96x54", MINUTES), "--samples 256": ("--samples 32", MINUTES)},
        check="[ -s picture.exr ] && [ -s truth.exr ]"),
    "docs/fuzzing.md": Page(
        not_run={"script/": SANITIZED},
        instead={"--runs 1000000 --seed 2": ("--runs 5000 --seed 2", MINUTES)}),
    "docs/gbuffer.md": Page(
        needs=("cv2",),
        prepare=FRAME + """gloam capture statue -o display.exr --display data/displays/small.json --size 60x420
            python3 "$SNIPPETS/images.py" frame.exr""",
        json=("camera.json",),
        check="[ -s views.png ] && [ -s line.png ] && gloam info frame.exr --camera camera.json | grep 'camera perspective, camera.json'"),
    "docs/light-field.md": Page(
        json=("desk.json",),
        check="[ -s line.png ] && [ -s each.module00.exr ] && gloam capture statue -o desk.exr --display desk.json --size 40x30"),
    "docs/memory.md": Page(prepare="gloam capture plane -o large.exr --size 2048x2048 --planes normal"),
    "docs/portability.md": Page(
        instead={"script/check-device NVIDIA": (f'GLOAM=gloam "$GLOAM_SOURCE_DIR/script/check-device" --quick {FIRST_DEVICE}', DEVICE),
                 "script/update-devices": ("true", "it writes into the source tree"),
                 "--device TEXT": (f"--device {FIRST_DEVICE}", DEVICE),
                 "gloam stress all": ("gloam stress gaussian", MINUTES),
                 "bench -o out/device": (f"bench -o out/device {SMALL}", MINUTES)},
        check="[ -s out/device/times.json ] && [ -s out/device/report.html ] && [ -s stress.json ]"),
    "docs/python.md": Page(
        needs=("cv2", "matplotlib", "pyopencl"),
        not_run={"python3 -m venv": "python.wheel does", "environment/bin/pip install": "builds; python.wheel does"},
        check="""for text in 'beside the box 0\\.' 'far from it 1\\.00' "UsageError: no technique 'gtoa' (did you mean 'gtao'?)" \\
                "no parameter 'radus' (did you mean 'radius'?)" "UsageError: plane 'depth' is of type list; an array is allowed" "MissingPlanes: sssr: needs 'color'" \\
                'Error: camera: fx is nan' '^1004 ' 'frame | radius: none is given'; do
                grep -- "$text" .log >/dev/null || { echo "nothing printed '$text'"; exit 1; }; done
            python3 "$SNIPPETS/figures.py" docs/python.md"""),
    "docs/benchmark.md": Page(check="[ -s out/board/leaderboard.html ]"),
    "docs/leaderboard.md": Page(
        prepare=f"gloam bench -o results/mine {SMALL}",
        instead={"set make gloam-1 -o": ("set make gloam-1 --only hard-plane -o", MINUTES)},
        check="[ -s results/leaderboard.html ] && [ -s board.html ] && [ -s table.json ] && grep -q 0b52f8145acb gloam-1.html"),
    "docs/report.md": Page(
        prepare=FRAME + f"gloam bench -o out/mine {SMALL.replace('plane', 'slab')}",
        instead={"bench -o out/bench": (f"bench -o out/bench {SMALL}", MINUTES)},
        check="[ -s out/bench/report.html ] && [ -s accuracy.md ]"),
    "docs/score.md": Page(
        json=("example.json",),
        instead={"--techniques gtao,evidence --presets low,medium": ("--techniques gtao --presets low --rounds 1", MINUTES)},
        check="""[ -s out/scores/report.html ] && grep -c submitted out/scores/report.html && grep -q '"plane AO"' out/again/bench.json
            gloam score theirs.exr --frame room.exr --truth room_truth.exr --json example.json -o out/example --no-images | grep 'My AO 1.2'"""),
    "docs/sequences.md": Page(
        json=("path.json", "cameras.json"),
        check="""for file in {ao,full,copy,graded,all}.0012 gtao.0001 gtao.0011 auto.0004 walk.0009 gears.0002 truth.000{1,2}; do
                [ -s $file.exr ]; done
            [ -s plot.png ] && [ -s difference.0004.png ] && [ -s flicker.json ] && [ ! -e gtao.0002.exr ]
            gloam info 'shot.####.exr' --frames 1-2 --camera cameras.json | grep -c '  cameras.json' | grep -x 2"""),
    "docs/reference.md": Page(
        prepare="gloam capture gallery -o sky.exr --size 64x32 --planes color",
        instead={"--samples 1024": ("--samples 32", MINUTES), "--size 960x540": ("--size 160x90", MINUTES)},
        check="for file in bounces specular indirect light contact; do [ -s $file.exr ]; done"),
    "docs/set.md": Page(
        instead={"set make gloam-1 -o sets/gloam-1": ("set make gloam-1 -o sets/gloam-1 --only hard-corner,gallery-display", MINUTES),
                 "set make gloam-1 --seed 7": ("set make small --seed 7", MINUTES)},
        check="[ -s sets/gloam-1/truths/hard-corner_ao.exr ] && [ -s small-seed7/manifest.json ]"),
    "docs/reproduce.md": Page(
        not_run={"script/reproduce stereo/indirect-light": "takes a minute or more", "script/reproduce  ": "takes hours"},
        check="grep 'techniques/page: .* are within' .log >/dev/null"),
    "docs/stereo.md": Page(
        check="[ -s inconsistency.png ] && [ -s both.png ]"),
    "docs/view.md": Page(check="[ -s frame.view.html ] && [ -s look.html ]"),
    "kernels/evidence/README.md": Page(
        instead={"--folder out/own": ("--folder out/own --presets medium --frames 2 --rays 16", MINUTES)},
        prepare=FRAME + GLB,
        check="[ -s ao.exr ]"),
    "kernels/ssr/README.md": Page(prepare=PATH.replace("FRAMES", "2"), check="[ -s r.0002.exr ]"),
}
