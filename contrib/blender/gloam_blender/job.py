"""From a scene to ambient occlusion in Blender: capture, gloam, image, group. A generator, so that a window stays alive."""
import dataclasses
import json
import os
import re
import tempfile

import bpy

from . import capture, compositor, exr_planes, program
from . import camera as cameras
from .errors import Problem


@dataclasses.dataclass
class Settings:
    frames: list  # numbers, rising
    output: str  # folder as a user writes it: see absolute_folder
    layer: str
    program: str = ""  # empty: found by itself
    technique: str = "ao"
    preset: str = ""
    radius: float = 0.0  # scene units; 0: from the frame's depths
    parameters: tuple = ()  # NAME=VALUE
    temporal: bool = False  # mean over the frames
    engine: str = "CYCLES"  # or SCENE
    overscan: float = 0.0  # share of the image's size on each side
    insert: bool = True  # the group into the compositor


@dataclasses.dataclass
class Progress:
    text: str
    share: float  # 0 to 1
    is_waiting: bool = False  # for another process


@dataclasses.dataclass
class Outcome:
    image: object = None
    group: object = None
    technique: str = ""  # as gloam names it; of `ao` the one that is the default
    folder: str = ""  # absolute
    radius: float = 0.0
    is_zooming: bool = False  # the lens differs between frames
    suffixes: dict = dataclasses.field(default_factory=dict)  # of files, by view
    files: list = dataclasses.field(default_factory=list)
    notes: list = dataclasses.field(default_factory=list)  # what a person should know
    done: list = dataclasses.field(default_factory=list)  # what was changed in the .blend


class Files:
    """Names in the output folder: of the .blend and the scene, since several may write into one folder.

    The camera JSON says whose the files are: other characters become `_`, so two names may lead to one.
    """

    def __init__(self, folder, scene):
        blend = bpy.data.filepath
        name = "_".join(filter(None, [os.path.splitext(os.path.basename(blend))[0], scene.name]))
        self.stem = os.path.join(folder, re.sub(r"[^\w\-]", "_", name))
        self.camera = f"{self.stem}.camera.json"
        # As seen from the folder, so that both can move together.
        self.owner = {"blend": relative(blend, folder), "scene": scene.name}

    def check_owner(self, frames, suffixes):
        """Throws Problem if a file that would be written is there and is of another .blend or scene, or of nobody known."""
        owner = self.read_cameras()
        if {key: owner.get(key) for key in self.owner} == self.owner:
            return
        names = [self.camera] + [name for number in map(four_digits, frames) for name in
                                 [self.frame(number), self.result(number), *(self.image(number, end) for end in suffixes)]]
        taken = next(filter(os.path.exists, names), None)
        if taken:
            whose = f"the scene '{owner['scene']}' of '{owner['blend'] or 'a .blend that is not saved'}'" if "blend" in owner else "something else"
            raise Problem(f"'{taken}' is there and belongs to {whose}: it would be lost; name another folder (--output, or Output in the panel)")

    def read_cameras(self):
        """The camera JSON; empty where there is none of ours."""
        try:
            with open(self.camera, encoding="utf-8") as file:
                document = json.load(file)
            return document if isinstance(document.get("frames"), dict) else {}
        except (OSError, ValueError, AttributeError):
            return {}

    def frame(self, number):
        return f"{self.stem}.{number}.exr"

    def result(self, number):
        return f"{self.stem}_ao.{number}.exr"

    def image(self, number, suffix=""):
        return f"{self.stem}_ao_rgb.{number}{suffix}.exr"


def four_digits(frame):
    return f"{frame:04d}"


def relative(path, folder):
    """A path as seen from a folder; empty for none."""
    try:
        return os.path.relpath(path, folder) if path else ""
    except ValueError:  # another drive of Windows
        return path


def check_folder(folder):
    """Makes the folder. Throws Problem if nothing can be written there."""
    try:
        os.makedirs(folder, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise Problem(f"the folder '{folder}' cannot be written: {error.strerror}; "
                      "name another one (--output, or Output in the panel)") from error


def absolute_folder(text):
    """An absolute folder. text: as a user writes it, `//` is beside the .blend. Where there is no .blend, it is in the temporary folder,
    with the number of the process at its end: another Blender may have a scene of the same name."""
    if text.startswith("//") and not bpy.data.filepath:
        return os.path.join(bpy.context.preferences.filepaths.temporary_directory or tempfile.gettempdir(), f"{text[2:]}-{os.getpid()}")
    return os.path.abspath(bpy.path.abspath(text))


def steps(scene, settings, outcome):
    """Yields Progress; fills the outcome. Throws Problem. Closing the generator ends the job and restores everything."""
    if not settings.frames:
        raise Problem("there is no frame to compute")
    if settings.frames[0] < 0:
        raise Problem(f"frame {settings.frames[0]} is before frame 0, and names of files have no place for a minus; "
                      "move the animation to later frames")
    outcome.folder = absolute_folder(settings.output)
    if settings.output.startswith("//") and not bpy.data.filepath:
        outcome.notes.append(f"the .blend is not saved, so files are written to '{outcome.folder}'")
    yield Progress("gloam: looking at the scene", 0)
    tool = program.find(settings.program)
    outcome.technique = program.check_technique(tool, settings.technique, settings.preset)["name"]
    cameras.check(scene.camera)
    check_folder(outcome.folder)
    capture.check_simulations(scene, outcome.notes)
    engine = capture.engine_for(scene, settings.engine, outcome.notes)
    files = Files(outcome.folder, scene)
    yield from captured(scene, settings, files, engine, tool, outcome)
    yield from computed(settings, files, tool, outcome)
    load(scene, settings, files, outcome)
    yield Progress("gloam: done", 1)


def captured(scene, settings, files, engine, tool, outcome):
    """Renders the frames and writes the cameras; after the first frame, asks gloam whether it can go on."""
    count = len(settings.frames)
    with capture.Capture(scene, settings.layer, engine, settings.overscan) as copy:
        outcome.suffixes = copy.suffixes()
        files.check_owner(settings.frames, outcome.suffixes.values() or [""])
        frames = {}
        for index, number in enumerate(settings.frames):
            yield Progress(f"gloam: rendering passes of frame {number}", 0.8 * index / count)
            copy.go_to(number)
            path = files.frame(four_digits(number))
            frames[str(number)] = copy.render(path)
            outcome.files.append(path)
            if index == 0:
                write_cameras(files, frames)
                first_look(settings, path, tool, outcome)
    write_cameras(files, frames)
    outcome.files.append(files.camera)
    outcome.is_zooming = len({focal_lengths(camera) for camera in frames.values()}) > 1
    if outcome.is_zooming and settings.temporal:
        outcome.notes.append("the lens is animated, which Blender's motion pass leaves out: the mean over frames follows cameras and depth "
                             "in its place, and begins anew on surfaces that move by themselves")


def focal_lengths(camera):
    return tuple(view.get("fx", view.get("pixels_per_unit")) for view in camera.get("views", [camera]))


def write_cameras(files, frames):
    """Adds the cameras of these frames to the JSON, one line for each; frames rendered by earlier runs keep theirs."""
    entries = {**files.read_cameras().get("frames", {}), **frames}
    lines = [f"  {json.dumps(number)}: {json.dumps(camera)}" for number, camera in sorted(entries.items(), key=lambda entry: int(entry[0]))]
    owner = "".join(f"{json.dumps(key)}: {json.dumps(value)}, " for key, value in files.owner.items())
    temporary = files.camera + ".part"
    try:
        with open(temporary, "w", encoding="utf-8") as file:
            file.write("{" + owner + '"frames": {\n' + ",\n".join(lines) + "\n}}\n")
        os.replace(temporary, files.camera)
    except OSError as error:
        raise Problem(f"'{files.camera}' cannot be written: {error.strerror}") from error


def first_look(settings, path, tool, outcome):
    """Takes the radius from the first frame where none is given, so that it stays the same over a shot, and lets gloam check
    everything that it was asked for, before the other frames are rendered."""
    found = program.ask(tool, ["info", path, "--normal-space", "world", "-q"])
    lacks = found["lacks"].get(outcome.technique)
    if lacks:
        raise Problem(f"the technique '{outcome.technique}' needs {' and '.join(lacks)}, which the scene does not give; "
                      "switch Stereoscopy on (Output properties), or take another technique")
    outcome.radius = settings.radius or found["radius"]
    program.ask(tool, ["plan", outcome.technique, path, "-q", *flags_of(settings, outcome)])


def flags_of(settings, outcome):
    flags = ["--normal-space", "world", "--radius", repr(outcome.radius)]
    if settings.temporal:
        flags += ["--temporal", *(["--plane", "motion=none"] if outcome.is_zooming else [])]
    if settings.preset:
        flags += ["--preset", settings.preset]
    for parameter in settings.parameters:
        flags += ["--set", parameter]
    return flags


def arguments_of(settings, files, outcome):
    number, more = four_digits(settings.frames[0]), []
    if len(settings.frames) > 1:
        number, more = "####", ["--frames", ",".join(map(str, settings.frames)), "--float"]
    return ["run", outcome.technique, files.frame(number), "-o", files.result(number), "--outputs", "ao", "--json", "-", *more,
            *flags_of(settings, outcome)]


def computed(settings, files, tool, outcome):
    """Runs gloam on the frames and converts what it wrote into images for Blender."""
    count = len(settings.frames)
    arguments = arguments_of(settings, files, outcome)
    run = program.Run(tool, arguments)
    try:
        while not run.is_done():
            done = min(count, len(run.lines_so_far())) if count > 1 else 0
            yield Progress(f"gloam: {outcome.technique} of frame {settings.frames[min(done, count - 1)]}",
                           0.8 + 0.15 * done / count, is_waiting=True)
        text = run.output()
    finally:
        run.stop()
    outcome.notes += notes_in(text)
    for index, number in enumerate(settings.frames):
        yield Progress(f"gloam: loading frame {number}", 0.95 + 0.05 * index / count)
        outcome.files.append(files.result(four_digits(number)))
        outcome.files += images_of(files, four_digits(number), outcome)


def notes_in(text):
    """Notes of the JSON documents that gloam printed, each once."""
    notes = []
    for part in [text] if text.lstrip().startswith("{\n") else text.splitlines():
        try:
            # That the margin is not written is what overscan is for.
            notes += [note for note in json.loads(part).get("notes", []) if note not in notes and not note.startswith("margin: ")]
        except ValueError:
            pass
    return notes


def images_of(files, number, outcome):
    """Cuts what gloam wrote to the user's render, and writes what Blender loads of a frame: one grey image for each view."""
    result = exr_planes.read(files.result(number))
    if result.window != result.display:
        result = exr_planes.cropped(result, result.display)
        exr_planes.write(files.result(number), result)
    planes, written = result.channels, []
    for view, suffix in outcome.suffixes.items() or [("", "")]:
        plane = planes[f"{view}.AO" if f"{view}.AO" in planes else "AO"]  # the first view's channels are without its name
        written.append(files.image(number, suffix))
        exr_planes.write_grey(written[-1], plane)
    return written


def load(scene, settings, files, outcome):
    """The image and the group of the scene."""
    first = files.image(four_digits(settings.frames[0]), next(iter(outcome.suffixes.values()), ""))
    outcome.image = compositor.load_image(scene, first, settings.frames, bool(outcome.suffixes))
    outcome.group = compositor.group_of(scene, outcome.image, settings.frames)
    if settings.insert:
        compositor.insert(scene, settings.layer, outcome.group, outcome)
