"""The result in Blender: an image, a compositor group (colour x AO), and the group behind the Render Layers."""
import bpy

from .errors import Problem

IMAGE_NODE = "AO image"


def named_of(collection, scene):
    """What an earlier run made for the scene; None if there is none."""
    return next((item for item in collection if item.get("gloam_scene") == scene.name), None)


def load_image(scene, path, frames, is_multiview):
    """The image of the files: one, or a sequence. path: of the first frame, and of the first view, by whose end Blender finds others."""
    image = named_of(bpy.data.images, scene)
    if image is None:
        image = bpy.data.images.load(path)
        image.name = f"gloam AO {scene.name}"
        image["gloam_scene"] = scene.name
        image.use_fake_user = True
    image.source = "SEQUENCE" if len(frames) > 1 else "FILE"
    image.use_multiview = is_multiview
    if is_multiview:
        image.views_format = "INDIVIDUAL"
    image.filepath = shortest(path)
    image.colorspace_settings.name = "Non-Color"
    image.reload()
    return image


def shortest(path):
    """Relative to the .blend where there is one, so that both can move together."""
    try:
        return bpy.path.relpath(path) if bpy.data.filepath else path
    except ValueError:  # another drive of Windows
        return path


def group_of(scene, image, frames):
    """The compositor group of the scene, made anew or brought up to date."""
    group = named_of(bpy.data.node_groups, scene)
    if group is None:
        group = new_group(f"gloam AO {scene.name}")
        group["gloam_scene"] = scene.name
    node = group.nodes.get(IMAGE_NODE)
    if node is None:
        raise Problem(f"the compositor group '{group.name}' has no node '{IMAGE_NODE}' any more; delete the group and run again")
    node.image = image
    if len(frames) > 1:
        node.frame_start, node.frame_offset = frames[0], frames[0] - 1
        node.frame_duration = frames[-1] - frames[0] + 1
        node.use_auto_refresh = True
    return group


def new_socket(group, direction, kind, name):
    if hasattr(group, "interface"):  # Blender 4
        return group.interface.new_socket(name=name, in_out=direction, socket_type=kind)
    return (group.inputs if direction == "INPUT" else group.outputs).new(kind, name)


def new_group(name):
    group = bpy.data.node_groups.new(name, "CompositorNodeTree")
    group.use_fake_user = True
    new_socket(group, "INPUT", "NodeSocketColor", "Image")
    strength = new_socket(group, "INPUT", "NodeSocketFloat", "Strength")
    strength.default_value, strength.min_value, strength.max_value = 1, 0, 1
    new_socket(group, "OUTPUT", "NodeSocketColor", "Image")
    new_socket(group, "OUTPUT", "NodeSocketColor", "AO")
    nodes, links = group.nodes, group.links
    entry, image, mix, leave = (nodes.new(kind) for kind in ("NodeGroupInput", "CompositorNodeImage", multiply_kind(), "NodeGroupOutput"))
    image.name = image.label = IMAGE_NODE
    entry.location, image.location, mix.location, leave.location = (-300, 100), (-300, -60), (0, 60), (240, 60)
    mix.blend_type = "MULTIPLY"
    if mix.bl_idname == "ShaderNodeMix":
        mix.data_type = "RGBA"
    factor, colour, factor_of_colour = colour_inputs(mix)
    links.new(entry.outputs["Strength"], factor)
    links.new(entry.outputs["Image"], colour)
    links.new(image.outputs["Image"], factor_of_colour)
    links.new(next(o for o in mix.outputs if o.enabled), leave.inputs["Image"])
    links.new(image.outputs["Image"], leave.inputs["AO"])
    return group


def multiply_kind():
    return "CompositorNodeMixRGB" if hasattr(bpy.types, "CompositorNodeMixRGB") else "ShaderNodeMix"  # Blender 5 has the latter


def colour_inputs(mix):
    """The factor and the two colours of a mix node."""
    enabled = [socket for socket in mix.inputs if socket.enabled]
    return enabled[0], enabled[1], enabled[2]


def tree_of(scene, notes):
    """The scene's compositor, made where there is none; None where it is there and switched off."""
    if hasattr(scene, "compositing_node_group"):  # Blender 5
        if scene.compositing_node_group is None:
            tree = bpy.data.node_groups.new(f"Compositing {scene.name}", "CompositorNodeTree")
            new_socket(tree, "OUTPUT", "NodeSocketColor", "Image")
            layers, leave = tree.nodes.new("CompositorNodeRLayers"), tree.nodes.new("NodeGroupOutput")
            leave.location = (600, 0)
            layers.scene = scene
            tree.links.new(layers.outputs["Image"], leave.inputs["Image"])
            scene.compositing_node_group = tree
        return scene.compositing_node_group
    if scene.node_tree is None:
        scene.use_nodes = True  # makes Render Layers and Composite
    elif not scene.use_nodes:
        notes.append("the compositor is switched off and has nodes; the group is not in it: switch on Use Nodes and add it")
        return None
    return scene.node_tree


def insert(scene, layer, group, outcome):
    """Puts the group behind the Render Layers of the view layer, once. The outcome says that, or why not."""
    tree = tree_of(scene, outcome.notes)
    if tree is None:
        return
    if any(getattr(node, "node_tree", None) == group for node in tree.nodes):
        return
    layers = next((n for n in tree.nodes if n.bl_idname == "CompositorNodeRLayers" and n.scene in (None, scene) and n.layer == layer), None)
    if layers is None:
        outcome.notes.append(f"the compositor has no Render Layers of '{layer}'; add the group '{group.name}' where it belongs (Add > Group)")
        return
    node = tree.nodes.new("CompositorNodeGroup")
    node.node_tree = group
    node.location = (layers.location.x + layers.width + 40, layers.location.y)
    image = layers.outputs["Image"]
    for link in list(image.links):
        tree.links.new(node.outputs["Image"], link.to_socket)
    tree.links.new(image, node.inputs["Image"])
    outcome.done.append(f"the group '{group.name}' is in the compositor, behind the Render Layers")
