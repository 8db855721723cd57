"""Scenes for the tests of the add-on: blocks and a ball on a floor before a wall, seen by different cameras."""
import math
import random

import bpy
from mathutils import Euler, Matrix

WIDTH, HEIGHT = 160, 120


def add_mesh(scene, add, material, **where):
    add(**where)
    bpy.context.object.data.materials.append(material)


def material_of(roughness):
    material = bpy.data.materials.new(f"rough {roughness}")
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = roughness
    return material


def build():
    """A fresh scene in Cycles, with a camera and without denoising; returns scene and camera."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, draw = bpy.context.scene, random.Random(1)
    floor, blocks = material_of(0.25), material_of(0.75)
    mesh = bpy.ops.mesh
    add_mesh(scene, mesh.primitive_plane_add, floor, size=20)
    add_mesh(scene, mesh.primitive_plane_add, floor, size=20, location=(0, 3, 0), rotation=(math.pi / 2, 0, 0))
    for _ in range(14):
        add_mesh(scene, mesh.primitive_cube_add, blocks, size=draw.uniform(0.3, 1.2), rotation=[draw.uniform(0, 3) for _ in range(3)],
                 location=(draw.uniform(-3, 3), draw.uniform(-2, 2.5), draw.uniform(0, 0.6)))
    add_mesh(scene, mesh.primitive_uv_sphere_add, blocks, radius=0.6, location=(0.3, 0, 0.6))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    camera.matrix_world = Matrix.Translation((1.5, -6, 2.8)) @ Euler((math.radians(70), 0, math.radians(12))).to_matrix().to_4x4()
    scene.camera = camera
    scene.world = bpy.data.worlds.new("world")
    scene.world.light_settings.distance = 0.5  # of Cycles' ambient occlusion
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 16, False
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    bpy.context.view_layer.update()
    return scene, camera


def frame(scene, camera):
    """One frame, with lens shift, and all that a capture has to switch off."""
    camera.data.shift_x, camera.data.shift_y = 0.12, -0.07
    camera.data.dof.use_dof, camera.data.dof.aperture_fstop = True, 0.1
    scene.render.use_motion_blur = True
    scene.view_layers[0].use_pass_mist = True


def animation(scene, camera):
    """Three frames of a camera that moves."""
    scene.frame_end = 3
    camera.keyframe_insert("location", frame=1)
    camera.location.x += 0.8
    camera.keyframe_insert("location", frame=3)
    scene.frame_set(1)


def stereo(scene, camera):
    """Two eyes, off-axis."""
    scene.render.use_multiview = True
    camera.data.stereo.interocular_distance, camera.data.stereo.convergence_distance = 0.2, 6


def orthographic(scene, camera):
    camera.data.type, camera.data.ortho_scale = "ORTHO", 7
    camera.data.shift_x = 0.05


KINDS = (frame, animation, stereo, orthographic)
