"""Settings that the scripts of these tests share: Cycles' ambient-occlusion pass, its rays through the pixels' centres."""


def set_up(scene, samples):
    """Of all layers the first has the passes of ambient occlusion and depth. The distance of occluders is the world's."""
    cycles, image, layer = scene.cycles, scene.render.image_settings, scene.view_layers[0]
    cycles.samples = int(samples)
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 0.01
    layer.use_pass_ambient_occlusion = layer.use_pass_z = True
    image.file_format, image.color_depth = "OPEN_EXR_MULTILAYER", "32"
