"""Scenes, their G-buffers and their truth."""

from . import _files, _gloam, _run, _words
from ._gloam import Camera, Frame, UsageError


class Scene:
    """A scene, kept for several captures and references: a name of gloam.scenes(), or the path of an OBJ, glTF or GLB file.

    Settings of built-in scenes by keyword: gloam.Scene("statue", faces=50000). `cameras` has the names of its cameras, `ao_radius` the radius, scene
    units, that suits it, or None.
    Raises gloam.Error for a name that is neither, and for a file that cannot be read.
    """

    def __init__(self, name, **settings):
        self._held = _gloam.HeldScene(_words.path("scene", name), _words.settings(settings))

    @property
    def name(self):
        return self._held.name

    @property
    def faces(self):
        return self._held.faces

    @property
    def cameras(self):
        return self._held.cameras

    @property
    def ao_radius(self):
        return self._held.ao_radius or None

    @property
    def notes(self):
        return self._held.notes

    def __repr__(self):
        return f"<gloam.Scene '{self.name}', {self.faces} faces, cameras {', '.join(self.cameras)}>"


def _scene(scene, settings):
    if isinstance(scene, Scene):
        if settings:
            raise _words.refusal(f"{_gloam.enumerate(list(settings))}: a gloam.Scene is made already; give them to gloam.Scene")
        return scene._held
    return Scene(scene, **settings)._held


def scenes():
    """The built-in scenes: a dict of names and what each is, in one line."""
    return {facts["name"]: facts["summary"] for facts in _gloam.scenes()}


def capture(scene, width=1920, height=1080, planes=None, *, camera=None, eye=None, target=None, fov=None, peel=0, peel_light=False,
            margin=0, stochastic=0, stereo=None, convergence=None, **settings):
    """A G-buffer of a scene, a gloam.Frame of width x height pixels, sampled at pixel centres.

    scene: a gloam.Scene, a name of gloam.scenes(), or a path; settings of a built-in scene by keyword.
    planes: names of planes beside depth: normal, albedo, color, roughness, reflectance, position, back_depth, instance (default: these), ambient,
        metallic, emission.
    camera: the name of one of the scene's cameras, or a gloam.Camera with a pose; or eye and target, points (x, y, z) in scene units; default: the
        scene's first.  fov: horizontal field of view, degrees.
    peel: depth layers to store, 0 to 64.  peel_light: also colour and normal of each layer, for dp-indirect.
    margin: pixels to render around the picture, on each side, or (left and right, top and bottom): occluders there count, and frame.picture cuts
        arrays to the picture.  stochastic: samples of a stochastic depth map, 0 to 16.
    stereo: distance of two eyes, scene units, with the camera between them; convergence: their depth without disparity.
    Raises gloam.Error. Ctrl-C ends the call within a moment.
    """
    if camera is not None and not isinstance(camera, Camera):
        camera = _words.text("camera", camera)
    width, height = 1920 if width is None else width, 1080 if height is None else height
    margin = margin if isinstance(margin, (tuple, list)) else (margin, margin)
    if len(margin) != 2:
        raise _words.refusal(f"margin: {len(margin)} numbers are not allowed; give the pixels on each side, or (left and right, top and bottom)")
    words = {"width": _words.integer("width", width), "height": _words.integer("height", height), "planes": _words.names("planes", planes),
             "camera": camera, "eye": _words.point("eye", eye), "target": _words.point("target", target), "fov": _words.number("fov", fov),
             "peel": _words.integer("peel", peel) or 0, "peel_light": bool(peel_light), "stochastic": _words.integer("stochastic", stochastic) or 0,
             "margin": tuple(_words.integer("margin", pixels) or 0 for pixels in margin),
             "stereo": _words.number("stereo", stereo), "convergence": _words.number("convergence", convergence)}
    frame = _gloam.capture(_scene(scene, settings), words)
    _words.note(frame.notes, stacklevel=2)
    return frame


def reference(frame, scene=None, *, samples=None, radius=None, what="ao", falloff="none", bounces=None, length=None,
              light_direction=None, light_position=None, light_angle=None, environment=None, environment_axes=None, environment_turn=None, color_holds=None,
              ambient=None, seed=0,
              checkpoint=None, settings=None, **scene_settings):
    """The ray-traced truth of a frame: a gloam.Frame with the planes ao and ao_noise (or those of another kind), depth and cameras.

    frame: a gloam.Frame with depth and a camera with a pose, or a path.  scene: as for gloam.capture; default: the built-in one that the frame
    names.  what: "ao", "reflection", "bounces" (ambient light with light reflected between surfaces), "specular_occlusion" (openness of a
        glossy lobe), "indirect" (light from the surfaces around), "environment" (light of an environment from open directions) "contact"
        (share of a light that arrives past what is near) or "composite" (color with all of these parts of its light, each once).
    samples: rays (of bounces: paths) per pixel, rounded up to a multiple of 32; default 256, of reflections 1024.
    radius: reach of an occluder, scene units, or inf; default: the frame's, else the scene's, else made from the frame.
    falloff: "none", or a technique whose contribution is traced (settings={"hbao+.bias": 0.2}).  bounces: reflections after which a path of
        bounces ends, 0 to 1024; default 128.  seed: 0 or more.
    length: of contact, reach of an occluder, scene units, or inf; default as for radius.  light_direction: towards the light, or light_position, scene
        units, as (x, y, z) in the world; default: the scene's sun.  light_angle: angular radius of the light, degrees; default 0.
    environment: path of a lat-long EXR file.  environment_axes: "openexr" (default: +y is up, the middle looks along +z) or "blender" (+z is up,
        the middle looks along +x).  environment_turn: degrees about the up axis, counter-clockwise seen from above.
    color_holds: of composite, what color holds beside direct light ("ambient,shadows"); default: as the frame's attribute gloamColorHolds says.
    ambient: of composite, radiance (r, g, b) of an even sky, for frames without the plane ambient.
    checkpoint: path of a file in which the work is saved every 15 s; after Ctrl-C the same call goes on from there.
    `numbers` of the result has aoRadius (scene units), aoSamples, aoNoise (RMS), of other kinds with the name of their plane.
    Raises gloam.Error, also if the frame does not show the scene. Ctrl-C ends the call within a moment.
    """
    if _words.is_path(frame):
        frame = _gloam.read([_words.path("frame", frame)], _words.reading(), [])
    if not isinstance(frame, Frame):
        raise _words.refusal(f"frame is of type {type(frame).__name__}; a gloam.Frame or a path is allowed")
    words = {"what": _words.text("what", what) or "ao", "falloff": _words.text("falloff", falloff) or "none", "samples": _words.integer("samples", samples),
             "radius": _words.number("radius", radius), "seed": _words.integer("seed", seed) or 0,
             "bounces": _words.integer("bounces", bounces), "length": _words.number("length", length),
             "light_direction": _words.point("light_direction", light_direction),
             "light_position": _words.point("light_position", light_position), "light_angle": _words.number("light_angle", light_angle),
             "environment": "" if environment is None else _words.path("environment", environment),
             "environment_axes": "" if environment_axes is None else _words.text("environment_axes", environment_axes),
             "environment_turn": _words.number("environment_turn", environment_turn),
             "color_holds": _words.text("color_holds", color_holds) or "", "ambient": _words.point("ambient", ambient),
             "checkpoint": "" if checkpoint is None else _words.path("checkpoint", checkpoint),
             "settings": _words.settings(scene_settings), "falloff_settings": _words.settings(settings)}
    held = None if scene is None else _scene(scene, scene_settings)
    truth = _gloam.reference(frame, held, words)
    _words.note([text for text in truth.notes if text not in frame.notes], stacklevel=2)
    return truth
