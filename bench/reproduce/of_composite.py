"""docs/composite.md"""
from catalogue import table
from lab import OUT

PLANES = "normal,color,ambient,albedo,metallic,roughness,reflectance"
# What the colour is said to hold keeps an effect out of the picture.
ROWS = ["ambient,shadows,reflection,indirect", "ambient,shadows,indirect", "ambient,shadows"]


def error(lab, picture, truth):
    found = lab.compared(picture, truth, "--plane", "color")
    return found["rmse"], found["flip"]


@table("docs/composite.md", "Its truth, and how near it comes", minutes=6)
def whole_pictures(lab):
    columns = []
    for scene in ("gallery", "courtyard", "lounge"):
        frame = lab.frame(scene, "480x270", "--planes", PLANES)
        truth = lab.truth("composite", frame, 256)
        pictures = [frame]
        for holds in ROWS:
            pictures.append(lab.made("picture.exr", "auto", frame, "-o", lab.unused("effects.exr"), "--mask", "never", "--color-holds", holds,
                                     "--composite", OUT))
        columns.append([error(lab, picture, truth) for picture in pictures])
    return [list(row) for row in zip(*columns)]
