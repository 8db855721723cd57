"""The panel, its settings, the button and the preferences."""
import bpy

from . import job, program
from .errors import Problem

# A list that Blender draws must be kept alive, and asking gloam for it takes 10 ms: it is asked once for each program.
known = {"program": None, "items": [], "presets": {}}
AUTOMATIC = ("ao", "Automatic", "What gloam takes for ambient occlusion by default")
# Blender 4.5 asks each path whether `//` may begin it.
RELATIVE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else set()
DEFAULT_PRESET = ("DEFAULT", "Default", "The technique's own defaults")


def preferences():
    addon = bpy.context.preferences.addons.get(__package__)
    return addon.preferences if addon else None


def named_program():
    own = preferences()
    return bpy.path.abspath(own.program) if own and own.program else ""


def ask_gloam():
    """Fills `known` for the program of the preferences."""
    if known["program"] == named_program():
        return
    known.update(program=named_program(), items=[AUTOMATIC], presets={})
    try:
        for technique in program.techniques(program.find(named_program())):
            known["items"].append((technique["name"], technique["name"], technique["summary"]))
            known["presets"][technique["name"]] = list(technique["presets"])
            if "ao_raw" in technique["default_for"]:
                known["presets"]["ao"] = list(technique["presets"])
    except Problem:
        pass  # the button says what is wrong


def technique_items(_self, _context):
    ask_gloam()
    return known["items"]


def preset_items(self, _context):
    ask_gloam()
    key = f"items of {self.technique}"
    if key not in known["presets"]:
        known["presets"][key] = [DEFAULT_PRESET] + [(name, name.capitalize(), "") for name in known["presets"].get(self.technique, [])]
    return known["presets"][key]


class GloamSettings(bpy.types.PropertyGroup):
    technique: bpy.props.EnumProperty(name="Technique", items=technique_items, description="How ambient occlusion is estimated")
    preset: bpy.props.EnumProperty(name="Preset", items=preset_items, description="More samples take longer, and have less noise")
    radius: bpy.props.FloatProperty(name="Radius", min=0, soft_max=10, precision=3, unit="LENGTH",
                                    description="Distance up to which occluders count; 0: from the first frame's depths")
    is_animation: bpy.props.BoolProperty(name="Animation", description="All frames from start to end; else the current frame")
    temporal: bpy.props.BoolProperty(name="Mean over Frames", description="Less noise and flicker: each surface's mean over the frames that showed it")
    overscan: bpy.props.FloatProperty(name="Overscan", min=0, max=50, subtype="PERCENTAGE",
                                      description="Of the image's size to render on each side, so that occluders beyond the border count")
    engine: bpy.props.EnumProperty(name="Passes by", items=(
        ("CYCLES", "Cycles", "One sample at each pixel's centre, depth as float"),
        ("SCENE", "Scene's Engine", "EEVEE writes depth as half: contours may show")))
    output: bpy.props.StringProperty(name="Output", default="//gloam", subtype="DIR_PATH", options=RELATIVE,
                                     description="Folder of frames, cameras and results; // is beside the .blend")
    insert: bpy.props.BoolProperty(name="Add to Compositor", default=True,
                                   description="Put the group (colour x AO) behind the Render Layers; else the group is only made")


class GloamPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(name="Program", subtype="FILE_PATH", description="The gloam command; empty: found in PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")
        try:
            self.layout.label(text=program.find(named_program()), icon="CHECKMARK")
        except Problem as problem:
            self.layout.label(text=sentence(problem), icon="ERROR")


def sentence(problem):
    text = str(problem)
    return text[:1].upper() + text[1:]


def settings_of(scene, layer):
    own = scene.gloam
    frames = [scene.frame_current]
    if own.is_animation:
        frames = list(range(scene.frame_start, scene.frame_end + 1, scene.frame_step))
    return job.Settings(frames=frames, output=own.output, layer=layer.name, program=named_program(),
                        technique=own.technique or "ao", preset="" if own.preset in ("", "DEFAULT") else own.preset, radius=own.radius,
                        temporal=own.temporal and own.is_animation, engine=own.engine, overscan=own.overscan / 100, insert=own.insert)


class RenderAmbientOcclusion(bpy.types.Operator):
    """Render the passes, let gloam make ambient occlusion of them, and load it as an image and a compositor group"""

    bl_idname = "gloam.ambient_occlusion"
    bl_label = "Ambient Occlusion"
    bl_options = {"REGISTER", "UNDO"}

    running = False

    @classmethod
    def poll(cls, _context):
        return not cls.running

    def begin(self, context):
        self.outcome = job.Outcome()
        self.steps = job.steps(context.scene, settings_of(context.scene, context.view_layer), self.outcome)

    def execute(self, context):
        """From a script: all at once."""
        self.begin(context)
        try:
            for _ in self.steps:
                pass
        except Problem as problem:
            return self.fail(problem)
        return self.succeed()

    def invoke(self, context, _event):
        self.begin(context)
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self.timer = manager.event_timer_add(0.05, window=context.window)
        manager.modal_handler_add(self)
        type(self).running = True
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.steps.close()
            self.end(context)
            self.report({"INFO"}, "Ambient occlusion was cancelled; nothing was loaded")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            progress = next(self.steps)
        except StopIteration:
            self.end(context)
            return self.succeed()
        except Problem as problem:
            self.end(context)
            return self.fail(problem)
        except BaseException:
            self.end(context)
            raise
        context.window_manager.progress_update(100 * progress.share)
        context.workspace.status_text_set(f"{progress.text} ({progress.share:.0%}); Esc cancels")
        return {"RUNNING_MODAL"}

    def end(self, context):
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        type(self).running = False

    def fail(self, problem):
        self.report({"ERROR"}, sentence(problem))
        return {"CANCELLED"}

    def succeed(self):
        for note in self.outcome.notes:
            self.report({"WARNING"}, sentence(note))
        for text in self.outcome.done:
            self.report({"INFO"}, sentence(text))
        self.report({"INFO"}, f"Ambient occlusion of radius {self.outcome.radius:g} is in the image '{self.outcome.image.name}'; "
                              f"{len(self.outcome.files)} files are in '{self.outcome.folder}'")
        return {"FINISHED"}


class GloamPanel(bpy.types.Panel):
    bl_idname = "RENDER_PT_gloam"
    bl_label = "gloam Ambient Occlusion"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        own, layout = context.scene.gloam, self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("technique", "preset", "radius", "overscan", "engine", "is_animation"):
            layout.prop(own, name)
        row = layout.row()
        row.enabled = own.is_animation
        row.prop(own, "temporal")
        layout.prop(own, "output")
        layout.prop(own, "insert")
        layout.operator(RenderAmbientOcclusion.bl_idname, icon="SHADING_RENDERED")


CLASSES = (GloamSettings, GloamPreferences, RenderAmbientOcclusion, GloamPanel)


def register():
    for item in CLASSES:
        bpy.utils.register_class(item)
    bpy.types.Scene.gloam = bpy.props.PointerProperty(type=GloamSettings)


def unregister():
    del bpy.types.Scene.gloam
    for item in reversed(CLASSES):
        bpy.utils.unregister_class(item)
