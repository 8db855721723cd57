"""An output of roughness in every material: no engine has a pass for it.

Engines fill an output with 0 where a surface has no material, or one without nodes: a mirror. So a second output tells which pixels a
material has filled, and `with_default` makes the others rough.
"""
import bpy
import numpy

NAME = "Roughness"
FILLED = "gloamFilled"

# Shaders with one roughness, and its input. What has none counts as rough: no mirror image is expected of it.
SHADERS = {"BSDF_PRINCIPLED", "BSDF_GLOSSY", "BSDF_ANISOTROPIC", "BSDF_GLASS", "BSDF_REFRACTION"}
ROUGH = 1.0


def materials():
    """All materials with nodes: objects of instanced collections and geometry nodes use materials too, that no slot names."""
    return [m for m in bpy.data.materials if m.use_nodes and m.node_tree and not m.is_grease_pencil]


def outputs_in(tree, name):
    return [node for node in tree.nodes if node.type == "OUTPUT_AOV" and aov_name(node) == name]


def surface_shader(tree):
    """The shader node of a material's surface, through reroutes; None if there is none."""
    output = tree.get_output_node("ALL") or tree.get_output_node("CYCLES") or tree.get_output_node("EEVEE")
    socket = output.inputs.get("Surface") if output else None
    while socket and socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


class RoughnessOutputs:
    """Adds AOVs to a view layer, and nodes that fill them to each material; `remove` takes the nodes away again.

    A material that fills an AOV of the name `Roughness` itself keeps it. layer: of a copy of the user's scene.
    """

    def __init__(self, layer):
        self.added = []  # materials, each with the name of an output
        for aov in list(layer.aovs):
            layer.aovs.remove(aov)
        for name in (NAME, FILLED):
            aov = layer.aovs.add()
            aov.name, aov.type = name, "VALUE"
        for material in materials():
            tree = material.node_tree
            active = tree.nodes.active
            if not outputs_in(tree, NAME):
                self.fill_roughness(tree, self.add(material, NAME))
            self.add(material, FILLED).default_value = 1
            tree.nodes.active = active

    def add(self, material, name):
        """The input of a new output."""
        node = material.node_tree.nodes.new("ShaderNodeOutputAOV")
        set_aov_name(node, name)
        self.added.append((material, name))
        return node.inputs["Value"]

    @staticmethod
    def fill_roughness(tree, value):
        value.default_value = ROUGH
        shader = surface_shader(tree)
        source = shader.inputs.get("Roughness") if shader and shader.type in SHADERS else None
        if source and source.is_linked:
            tree.links.new(source.links[0].from_socket, value)
        elif source:
            value.default_value = source.default_value

    def remove(self):
        for material, name in self.added:
            for node in outputs_in(material.node_tree, name):
                material.node_tree.nodes.remove(node)
        self.added = []


def with_default(channels):
    """Channels of a rendered file without those that tell which pixels are filled: where none is, roughness is 1."""
    of = {name: filled_name(name) for name in channels if is_output(name, NAME)}
    kept = {name: plane for name, plane in channels.items() if not is_output(name, FILLED)}
    for name, filled in of.items():
        if filled in channels:
            kept[name] = numpy.where(channels[filled] > 0.5, channels[name], channels[name].dtype.type(ROUGH))
    return kept


def is_output(channel, name):
    """Whether a channel, such as `ViewLayer.Roughness.left.X`, is of an output of this name."""
    return f".{name}." in channel


def filled_name(channel):
    return channel.replace(f".{NAME}.", f".{FILLED}.")


def aov_name(node):
    return node.aov_name if hasattr(node, "aov_name") else node.name  # before Blender 4.2 its name


def set_aov_name(node, name):
    setattr(node, "aov_name" if hasattr(node, "aov_name") else "name", name)
