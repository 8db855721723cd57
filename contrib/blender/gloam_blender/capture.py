"""A G-buffer of a scene: passes sampled at pixel centres, rendered from a copy of the scene, and its cameras.

The user's scene is not changed: settings are changed in a copy that shares the objects, and of cameras copies are rendered too.
"""
import dataclasses
import os

import bpy
import numpy

from . import camera as cameras
from . import exr_planes, roughness
from .errors import Problem

EEVEE = ("BLENDER_EEVEE", "BLENDER_EEVEE_NEXT")

# Passes by the name of their switch in a view layer. Those that a version or an engine lacks are passed over.
PASSES = ("use_pass_z", "use_pass_normal", "use_pass_vector", "use_pass_diffuse_color")


def set_where_there(owner, **values):
    """Sets properties that this version of Blender has."""
    for name, value in values.items():
        if hasattr(owner, name):
            setattr(owner, name, value)


def engine_for(scene, wanted, notes):
    """The engine that renders the passes. wanted: `SCENE` or `CYCLES`. Throws Problem where it cannot render."""
    engine = scene.render.engine
    if wanted == "CYCLES" or engine not in ("CYCLES",) + EEVEE:
        if wanted != "CYCLES":
            notes.append(f"the engine {engine.title()} has no passes for gloam; Cycles renders them")
        engine = "CYCLES"
    if engine in EEVEE and bpy.app.background and bpy.app.version < (4, 0, 0) and not has_display():  # it would end Blender
        raise Problem("EEVEE renders only where there is a display; give --engine cycles, and Cycles renders the passes")
    if engine == "CYCLES" and not hasattr(bpy.types.Scene, "cycles"):
        raise Problem("the add-on Cycles Render Engine is switched off; switch it on in Preferences > Add-ons")
    return engine


def has_display():
    return os.name == "nt" or os.uname().sysname == "Darwin" or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY"))


def check_simulations(scene, notes):
    """Says what a copy of the scene would simulate anew."""
    world = scene.rigidbody_world
    if world and world.enabled and not world.point_cache.is_baked:
        notes.append("the rigid bodies are not baked: bake them (Scene > Rigid Body World > Cache), or they may stand elsewhere")


class Capture:
    """A copy of a scene that renders G-buffers. Use it in a `with` statement: it removes the copy again.

    scene: the user's; layer: name of the view layer; engine: see engine_for; overscan: share of the image's size to add on
    each side. `padding` is that in pixels; `shown` is where in the rendered image the user's render lies. Throws Problem.
    """

    def __init__(self, scene, layer, engine, overscan=0.0):
        self.user_scene = scene
        self.layer = layer
        self.engine = engine
        self.scene = None
        self.added = []  # cameras, to be removed
        self.roughness = None
        width, height = cameras.size(scene.render)
        self.padding = round(width * overscan), round(height * overscan)  # pixels on each side
        x0, y0, x1, y1 = region(scene.render)
        self.shown = x0 + self.padding[0], y0 + self.padding[1], x1 + self.padding[0], y1 + self.padding[1]

    def __enter__(self):
        try:
            self.before = (self.user_scene.frame_current, self.user_scene.frame_subframe, self.user_scene.camera)
            self.scene = self.user_scene.copy()
            self.scene.name = f"gloam of {self.user_scene.name}"
            self.change_render()
            self.change_passes()
            self.change_engine()
            self.pick_cameras()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if self.roughness:
            self.roughness.remove()
        if self.scene:
            # Blender 3.4 counts the users of a copied compositor twice, and complains when the scene goes.
            if getattr(self.scene, "node_tree", None):
                self.scene.node_tree.nodes.clear()
            self.scene.user_clear()
            bpy.data.scenes.remove(self.scene)
        self.remove_cameras()
        self.scene, self.roughness = None, None
        frame, subframe, camera = self.before
        if (self.user_scene.frame_current, self.user_scene.frame_subframe) != (frame, subframe):
            self.user_scene.frame_set(frame, subframe=subframe)
            self.user_scene.camera = camera

    # --- What is changed in the copy.

    def change_render(self):
        render = self.scene.render
        render.engine = self.engine
        # Compositing would write the user's File Output nodes again.
        set_where_there(render, use_compositing=False, use_sequencer=False, use_motion_blur=False, use_freestyle=False,
                        use_border=False, use_crop_to_border=False, use_stamp=False, film_transparent=False, filter_size=0.0)
        if hasattr(self.scene, "compositing_node_group"):
            self.scene.compositing_node_group = None
        else:
            self.scene.use_nodes = False
        for marker in self.scene.timeline_markers:
            marker.camera = None  # they would set the scene's camera in place of its copy
        if self.padding != (0, 0):
            width, height = cameras.size(render)
            render.resolution_x, render.resolution_y = width + 2 * self.padding[0], height + 2 * self.padding[1]
            render.resolution_percentage = 100
        image = render.image_settings
        if hasattr(image, "media_type"):
            image.media_type = "MULTI_LAYER_IMAGE"
        image.file_format = "OPEN_EXR_MULTILAYER"
        image.color_depth = "32"
        image.exr_codec = "ZIP"  # DWA damages normals
        image.views_format = "MULTIVIEW"
        set_where_there(image, use_exr_interleave=True)  # Blender 5 writes a part for each pass otherwise
        set_where_there(render, use_file_extension=True, use_overwrite=True, use_placeholder=False, use_persistent_data=False)

    def change_passes(self):
        layers = self.scene.view_layers
        if self.layer not in layers:
            raise Problem(f"the scene has no view layer '{self.layer}'; it has {', '.join(layer.name for layer in layers)}")
        for layer in list(layers):
            if layer.name != self.layer:
                layers.remove(layer)
        layer = layers[0]
        layer.use = True
        for name in [p.identifier for p in layer.bl_rna.properties if p.identifier.startswith("use_pass_") and not p.is_readonly]:
            set_where_there(layer, **{name: name in PASSES or name == "use_pass_position" and layer.use_pass_position})
        set_where_there(layer, use_freestyle=False)
        for group in (getattr(layer, name, None) for name in ("cycles", "eevee")):
            for pass_name in [p.identifier for p in group.bl_rna.properties] if group else []:
                if pass_name.startswith("use_pass_") or pass_name == "denoising_store_passes":
                    setattr(group, pass_name, False)
        self.roughness = roughness.RoughnessOutputs(layer)

    def change_engine(self):
        """One sample through each pixel's centre: depth between two surfaces belongs to neither."""
        cycles, eevee = getattr(self.scene, "cycles", None), getattr(self.scene, "eevee", None)
        if cycles:
            set_where_there(cycles, samples=1, use_adaptive_sampling=False, use_denoising=False, time_limit=0.0,
                            pixel_filter_type="BLACKMAN_HARRIS", filter_width=0.01, max_bounces=0, film_exposure=1.0, use_layer_samples="IGNORE")
        if eevee:
            set_where_there(eevee, taa_render_samples=1, use_motion_blur=False, use_overscan=False)

    # --- Cameras.

    def pick_cameras(self):
        """Copies of the scene's cameras without depth of field, one for each view."""
        self.remove_cameras()
        scene, render, self.source = self.scene, self.scene.render, self.user_scene.camera
        cameras.check(self.source)
        used = [view for view in render.views if view.use]
        if render.use_multiview and not used:
            raise Problem("stereoscopy is on, and no view is used; switch a view on (Output > Stereoscopy)")
        if render.use_multiview and render.views_format == "MULTIVIEW":
            # Views with cameras of their own, which Blender finds by the ends of their names.
            self.views = [(view.name, self.copy_of(camera_of_view(self.user_scene, view), view.camera_suffix), None) for view in used]
        elif render.use_multiview:
            eyes = self.copy_of(self.source)
            self.check_eyes(eyes)
            self.views = [(view.name, eyes, view.name == "left") for view in used]
        else:
            self.views = [("", self.copy_of(self.source), None)]
        scene.camera = self.views[0][1]

    def remove_cameras(self):
        for item in self.added:
            data = item.data
            bpy.data.objects.remove(item)
            bpy.data.cameras.remove(data)
        self.added = []

    def check_eyes(self, camera):
        if camera.data.stereo.use_spherical_stereo and camera.data.type == "PERSP" and self.engine == "CYCLES":
            raise Problem("spherical stereo bends the rays of each eye, and no flat camera describes them; "
                          "switch Spherical Stereo off in the camera's Stereoscopy panel")

    def copy_of(self, item, suffix=""):
        """suffix: of a view with a camera of its own; Blender looks for such cameras in the scene."""
        cameras.check(item)
        copy = item.copy()
        copy.data = item.data.copy()
        self.added.append(copy)
        copy.name = name = f"gloam camera{suffix}"
        copy.data.dof.use_dof = False
        self.add_overscan(copy.data)
        if suffix:
            self.scene.collection.objects.link(copy)
            if copy.name != name:
                raise Problem(f"an object is named '{name}' already, and Blender finds cameras of views by name; rename it")
        return copy

    def add_overscan(self, data):
        """Lets a camera see as much more as the image has become larger."""
        if self.padding == (0, 0):
            return
        render, (width, height) = self.user_scene.render, cameras.size(self.user_scene.render)
        # The sensor's fit stays that of the image without the border, which may have another aspect.
        is_of_width, sensor = cameras.fits_width(data, render), cameras.sensor_size(data)
        data.sensor_fit = "HORIZONTAL" if is_of_width else "VERTICAL"
        more = 1 + 2 * (self.padding[0] / width if is_of_width else self.padding[1] / height)
        data.sensor_width = data.sensor_height = sensor * more
        data.ortho_scale *= more
        data.shift_x /= more
        data.shift_y /= more

    def check_overscan(self, item, evaluated):
        """Key frames of the camera undo what add_overscan did."""
        names = ("sensor_width", "sensor_height", "ortho_scale", "shift_x", "shift_y")
        if self.padding != (0, 0) and any(getattr(item.data, name) != getattr(evaluated.data, name) for name in names):
            raise Problem("the camera's lens shift, sensor size or orthographic scale is animated, and overscan cannot follow it; "
                          "set overscan to 0, or clear these key frames")

    def suffixes(self):
        """The ends of file names, by the name of the view, in the order of the views; empty without stereoscopy."""
        return {v.name: v.file_suffix for name, _, _ in self.views for v in self.scene.render.views if name and v.name == name}

    # --- Frames.

    def go_to(self, frame):
        """Sets the frame. The user's scene stays as it is, with values that have no key frame yet, where it is at the frame."""
        if frame != self.user_scene.frame_current:
            self.user_scene.frame_set(frame)  # drivers may read it there, and markers choose the camera
            if self.user_scene.camera != self.source:
                self.pick_cameras()
        self.scene.frame_current, self.scene.frame_subframe = frame, self.user_scene.frame_subframe

    def render(self, path):
        """Renders the current frame into an EXR file; returns the camera JSON. Throws Problem."""
        part = path.removesuffix(".exr") + ".part.exr"
        self.scene.render.filepath = part
        self.rendered = None  # the camera JSON or a Problem
        bpy.app.handlers.frame_change_post.append(self.record)
        try:
            bpy.ops.render.render(write_still=True, scene=self.scene.name, layer=self.layer)
            if isinstance(self.rendered, Problem):
                raise self.rendered
            exr_planes.write(path, self.finished(exr_planes.read(part)))
        except RuntimeError as error:
            raise Problem(f"Blender did not render '{self.user_scene.name}': {first_line(error)}") from error
        except OSError as error:
            raise Problem(f"Blender wrote no '{path}' ({error.strerror}); its own messages in the terminal say why") from error
        finally:
            bpy.app.handlers.frame_change_post.remove(self.record)
            if os.path.exists(part):
                os.remove(part)
        return self.rendered

    def finished(self, image):
        """A rendered image whose display window is the user's render. Colour is left out: it has one sample of direct light."""
        x0, y0, x1, y1 = self.shown
        width, height = image.window[2], image.window[3]
        channels = {name: plane for name, plane in image.channels.items() if not roughness.is_output(name, "Combined")}
        return dataclasses.replace(image, channels=roughness.with_default(channels), window=(-x0, -y0, width - x0, height - y0),
                                   display=(0, 0, x1 - x0, y1 - y0))

    def record(self, scene, depsgraph):
        """Called when the renderer has evaluated a frame: what it sees then is the camera, key frames and drivers included."""
        moment = (self.scene.frame_current, self.scene.frame_subframe)
        if scene.name != self.scene.name or (depsgraph.scene.frame_current, depsgraph.scene.frame_subframe) != moment or self.rendered:
            return  # for motion vectors it evaluates other frames too
        try:
            self.rendered = self.camera(depsgraph)
        except Problem as problem:
            self.rendered = problem

    def camera(self, depsgraph):
        views = []
        for name, item, is_left in self.views:
            evaluated = item.evaluated_get(depsgraph)
            cameras.check(evaluated)
            if evaluated.data.dof.use_dof:
                raise Problem(f"the depth of field of '{self.source.name}' is switched by key frames or a driver, and depth would be "
                              "blurred; remove them")
            self.check_overscan(item, evaluated)
            views.append(cameras.view_of(evaluated, self.source.name, self.scene.render, self.shown, name, is_left))
        x0, y0, x1, y1 = self.shown
        return {"width": x1 - x0, "height": y1 - y0, **cameras.document(views)}


def first_line(error):
    return str(error).strip().removeprefix("Error: ").splitlines()[0]


def camera_of_view(scene, view):
    """The camera of a view of Multi-View, as Blender finds it: the scene's camera with the end of its name replaced."""
    name = scene.camera.name
    ends = sorted((v.camera_suffix for v in scene.render.views if name.endswith(v.camera_suffix)), key=len)
    if not ends:
        return scene.camera
    return scene.objects.get(name[:len(name) - len(ends[-1])] + view.camera_suffix, scene.camera)


def region(render):
    """What is left of the image by Crop to Render Region: first column and row, and those after the last, from the top."""
    width, height = cameras.size(render)
    if not (render.use_border and render.use_crop_to_border):
        return 0, 0, width, height

    def at(share, length):
        return int(numpy.float32(share) * numpy.float32(length))  # as Blender computes it

    return (at(render.border_min_x, width), height - at(render.border_max_y, height),
            at(render.border_max_x, width), height - at(render.border_min_y, height))
