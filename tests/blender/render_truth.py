"""Renders an OBJ file with Blender's Cycles, one sample position per pixel: its centre.

blender -b --factory-startup --python-exit-code 1 -P render_truth.py -- KIND SCENE.obj CAMERA.json RADIUS SAMPLES SEED OUT.exr

KIND: "ao", the ambient-occlusion pass within RADIUS; or "white_light", the picture of surfaces with the albedo 0.6 under a sky of 1.

The OBJ holds triangles only and is taken in its own axes. The camera JSON is as docs/gbuffer.md has it.
"""
import json
import os
import sys

import bpy
import mathutils

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import cycles_ao  # noqa: E402


def read_obj(path):
    vertices, faces = [], []
    with open(path) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append(tuple(float(w) for w in words[1:4]))
            elif words[:1] == ["f"]:
                faces.append(tuple(int(w.split("/")[0]) - 1 for w in words[1:]))
    return vertices, faces


def add_camera(scene, camera):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = 36
    data.lens = camera["fx"] / camera["width"] * data.sensor_width
    data.clip_start, data.clip_end = 0.001, 1e5
    item = bpy.data.objects.new("camera", data)
    item.matrix_world = mathutils.Matrix(camera["camera_to_world"])
    scene.collection.objects.link(item)
    scene.camera = item


def light_white(scene, mesh):
    """A sky of 1 and a grey diffuse surface, and no limit on light or its paths."""
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (1, 1, 1, 1), 1
    material = bpy.data.materials.new("grey")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    grey, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    grey.inputs["Color"].default_value = (0.6, 0.6, 0.6, 1)
    material.node_tree.links.new(grey.outputs["BSDF"], output.inputs["Surface"])
    mesh.materials.append(material)
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 128
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0


def main(kind, scene_file, camera_file, radius, samples, seed, out):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    mesh = bpy.data.meshes.new("mesh")
    vertices, faces = read_obj(scene_file)
    mesh.from_pydata(vertices, [], faces)
    scene.collection.objects.link(bpy.data.objects.new("mesh", mesh))
    with open(camera_file) as text:
        camera = json.load(text)
    add_camera(scene, camera)

    scene.world = bpy.data.worlds.new("world")
    if kind == "white_light":
        light_white(scene, mesh)
    else:
        scene.world.light_settings.distance = float(radius)
    scene.render.engine = "CYCLES"
    cycles_ao.set_up(scene, samples)
    scene.cycles.seed = int(seed)
    scene.view_layers[0].use_pass_ambient_occlusion = kind == "ao"
    scene.render.resolution_x, scene.render.resolution_y = camera["width"], camera["height"]
    scene.render.resolution_percentage = 100
    scene.render.filepath = out
    bpy.ops.render.render(write_still=True)


main(*sys.argv[sys.argv.index("--") + 1:])
