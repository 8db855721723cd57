"""An output of roughness in every material: no engine has a pass for it."""
import bpy

NAME = "Roughness"

# Shaders with one roughness, and its input. What has none counts as rough: no mirror image is expected of it.
SHADERS = {"BSDF_PRINCIPLED", "BSDF_GLOSSY", "BSDF_ANISOTROPIC", "BSDF_GLASS", "BSDF_REFRACTION"}
ROUGH = 1.0


def materials():
    """All materials with nodes: objects of instanced collections and geometry nodes use materials too, that no slot names."""
    return [m for m in bpy.data.materials if m.use_nodes and m.node_tree and not m.is_grease_pencil]


def outputs_in(tree):
    """The tree's own outputs of roughness."""
    return [node for node in tree.nodes if node.type == "OUTPUT_AOV" and aov_name(node) == NAME]


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
    """Adds an AOV to a view layer, and a node that fills it to each material; `remove` takes the nodes away again.

    A material that fills an AOV of this name itself stays as it is. layer: of a copy of the user's scene.
    """

    def __init__(self, layer):
        self.changed = []
        for aov in list(layer.aovs):
            if aov.name != NAME:
                layer.aovs.remove(aov)
        if not len(layer.aovs):
            layer.aovs.add().name = NAME
        layer.aovs[0].type = "VALUE"
        for material in materials():
            if not outputs_in(material.node_tree):
                self.add(material)

    def add(self, material):
        tree = material.node_tree
        active = tree.nodes.active
        node = tree.nodes.new("ShaderNodeOutputAOV")
        self.changed.append(material)
        set_aov_name(node, NAME)
        value = node.inputs["Value"]
        value.default_value = ROUGH
        shader = surface_shader(tree)
        source = shader.inputs.get("Roughness") if shader and shader.type in SHADERS else None
        if source and source.is_linked:
            tree.links.new(source.links[0].from_socket, value)
        elif source:
            value.default_value = source.default_value
        tree.nodes.active = active

    def remove(self):
        for material in self.changed:
            for node in outputs_in(material.node_tree):
                material.node_tree.nodes.remove(node)
        self.changed = []


def aov_name(node):
    return node.aov_name if hasattr(node, "aov_name") else node.name  # before Blender 4.2 its name


def set_aov_name(node, name):
    setattr(node, "aov_name" if hasattr(node, "aov_name") else "name", name)
