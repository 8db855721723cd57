"""Renders a small frame whose colour is a sum of passes, passes.exr, and another with a transparent film, film.exr.

blender -b --factory-startup --python-exit-code 1 -P render_passes.py -- FOLDER

A floor, a wall and a box, a lamp that is a surface, a ball of glass, a glossy box, fog all around, the sky beside the wall.
"""
import math
import os
import sys

import bpy

PASSES = ("z", "normal", "position", "emit", "environment", "mist", "diffuse_direct", "diffuse_indirect", "diffuse_color", "glossy_direct",
          "glossy_indirect", "glossy_color", "transmission_direct", "transmission_indirect", "transmission_color", "cryptomatte_object")


def material(node, socket="Surface", **inputs):
    made = bpy.data.materials.new(node)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    shader, output = nodes.new(node), nodes.new("ShaderNodeOutputMaterial")
    for name, value in inputs.items():
        shader.inputs[name].default_value = value
    made.node_tree.links.new(shader.outputs[0], output.inputs[socket])
    return made


def add(kind, made, **place):
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**place)
    bpy.context.object.data.materials.append(made)


def add_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    diffuse = material("ShaderNodeBsdfDiffuse", Color=(0.7, 0.5, 0.3, 1))
    add("plane", diffuse, size=20)
    add("plane", diffuse, size=6, location=(-1, 4, 0), rotation=(math.pi / 2, 0, 0))
    add("cube", diffuse, size=1.5, location=(-1.5, 1, 0.75))
    add("cube", material("ShaderNodeEmission", Color=(1, 0.8, 0.5, 1), Strength=3), location=(1.2, 2.5, 0.5), size=1)
    add("uv_sphere", material("ShaderNodeBsdfGlass", Color=(0.9, 1, 0.9, 1), IOR=1.3), radius=0.7, location=(0, -0.5, 0.7))
    add("cube", material("ShaderNodeBsdfGlossy", Roughness=0.3), size=0.8, location=(2.6, 0, 0.4))
    add("cube", material("ShaderNodeVolumeScatter", "Volume", Density=0.05), size=12, location=(0, 0, 3))
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.5, 0.6, 0.8, 1)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0, -9, 3.2), (math.radians(79), 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return scene


def main(folder):
    scene = add_scene()
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 16, False
    layer = scene.view_layers[0]
    for name in PASSES:
        setattr(layer, "use_pass_" + name, True)
    layer.cycles.use_pass_volume_direct = layer.cycles.use_pass_volume_indirect = True
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 160, 90, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    for name, render.film_transparent in (("passes", False), ("film", True)):
        render.filepath = os.path.join(folder, name + ".exr")
        bpy.ops.render.render(write_still=True)


main(sys.argv[sys.argv.index("--") + 1])
