"""Everything that a run may not change, as text: the settings of scenes, cameras, materials and objects, and all names."""
import bpy

SKIPPED = {"rna_type", "bl_rna", "is_evaluated", "original", "session_uuid", "users", "depsgraph", "objects", "all_objects", "node_tree",
           "preview", "is_updated", "is_updated_data", "tag", "asset_data", "view_center",
           "denoiser", "colorspace_settings", "sequencer_colorspace_settings"}


def value_of(struct, prop, depth):
    value = getattr(struct, prop.identifier)
    if prop.type == "POINTER":
        return "None" if value is None else value.name if isinstance(value, bpy.types.ID) else text_of(value, depth - 1)
    if prop.type == "COLLECTION":
        return [item.name if isinstance(item, bpy.types.ID) else text_of(item, depth - 1) for item in value]
    return tuple(value) if getattr(prop, "is_array", False) and prop.type != "STRING" else value


def text_of(struct, depth):
    if depth < 0:
        return ""
    return "{" + ", ".join(f"{p.identifier}: {value_of(struct, p, depth)}" for p in struct.bl_rna.properties if p.identifier not in SKIPPED) + "}"


def nodes_of(tree):
    links = [(link.from_node.name, link.from_socket.name, link.to_node.name, link.to_socket.name) for link in tree.links]
    active = tree.nodes.active.name if tree.nodes.active else ""
    return f"{[text_of(node, 0) for node in tree.nodes]} {links} active {active}"


def lines():
    """By what it is about, the state of the file."""
    found = {}
    for scene in bpy.data.scenes:
        found[f"scene {scene.name}"] = text_of(scene, 3)
        found[f"markers {scene.name}"] = str([(m.name, m.frame, m.camera and m.camera.name) for m in scene.timeline_markers])
    for kind in ("cameras", "objects", "worlds", "materials"):
        for item in getattr(bpy.data, kind):
            found[f"{kind} {item.name}"] = text_of(item, 2)
    for material in bpy.data.materials:
        if material.node_tree:
            found[f"nodes {material.name}"] = nodes_of(material.node_tree)
    for kind in ("scenes", "cameras", "objects", "materials", "meshes", "actions", "worlds", "images", "node_groups", "collections",
                 "linestyles"):
        found[f"names of {kind}"] = str(sorted(item.name for item in getattr(bpy.data, kind) if item.name != "Render Result"))
    return found


def difference(before, after):
    return [key for key in sorted(before.keys() | after.keys()) if before.get(key) != after.get(key)]
