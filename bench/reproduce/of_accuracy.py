"""docs/accuracy.md, docs/accuracy-of-light.md: what script/accuracy measures, a scene at a time"""
import json
import shutil

import documents
from catalogue import measurements
from recipes import SCENES, capture

FAMILY = "hbao+,ssao,hbao,gtao,bitmask,evidence,dp-hbao,dp-gtao,dp-bitmask,dp-evidence"
OF_AO = ("docs/accuracy.md", ("--pictures", "docs/images/accuracy"))
OF_LIGHT = ("docs/accuracy-of-light.md", ())


def together(lab, name, scenes, *flags):
    """One document of a run for each scene, so that an interrupted one goes on with the next."""
    folders = [lab.bench(f"{name}-{scene}", "--scenes", scene, *flags) for scene in scenes]
    document = documents.merged([documents.read(folder) for folder in folders])
    path = lab.folder_for("documents") / f"{name}.json"
    for folder in folders:
        if (folder / "images").is_dir():
            shutil.copytree(folder / "images", path.parent / "images", dirs_exist_ok=True)
    path.write_text(json.dumps(document, indent=2) + "\n")
    return path


@measurements("docs/accuracy.md", "data/results/accuracy/scenes.json", minutes=30, pages=OF_AO)
def scenes(lab):
    return together(lab, "accuracy", ("courtyard", "corridor", "colonnade", "gallery"), "--no-growth", "--rounds", 5)


@measurements("docs/accuracy.md", "data/results/accuracy/further-scenes.json", minutes=12, pages=OF_AO)
def further_scenes(lab):
    return together(lab, "further", ("temple", "hairball", "fence", "foliage", "statue", "plane"), "--techniques", FAMILY,
                    "--presets", "low,medium,high", "--variants", "none", "--no-growth", "--rounds", 3)


@measurements("docs/accuracy.md", "data/results/accuracy/full-hd.json", minutes=3, pages=OF_AO)
def full_hd(lab):
    return together(lab, "full-hd", ("courtyard",), "--size", "1920x1080", "--rays", 64, "--techniques", "hbao+,bitmask,gtao,evidence",
                    "--presets", "medium", "--variants", "none", "--sweep", "directions=3", "--sweep", "steps=3", "--ladder", "none", "--no-growth",
                    "--no-checks", "--no-images")


@measurements("docs/accuracy-of-light.md", "data/results/light/scenes.json", minutes=12, pages=OF_LIGHT)
def light(lab):
    return together(lab, "light", SCENES, "--effects", "bounces,specular_occlusion,indirect,contact", "--size", "320x180", "--rays", 128,
                    "--variants", "none", "--no-growth", "--rounds", 9, "--no-images")


def own(lab, name, frame, truths, radius):
    folder = lab.bench(name, "--frame", capture(lab, frame), *(flag for truth in truths for flag in ("--truth", capture(lab, truth))),
                       "--radius", radius, "--rounds", 5, "--no-growth")
    return folder / "bench.json"


@measurements("docs/accuracy.md", "data/results/accuracy/kitchen_exact.json", minutes=8, pages=OF_AO)
def kitchen(lab):
    return own(lab, "kitchen", "kitchen/kitchen_exact.exr", ["kitchen/kitchen_ao_ref.exr"], 0.3)


@measurements("docs/accuracy.md", "data/results/accuracy/apartment_stereo_exact.json", minutes=8, pages=OF_AO)
def apartment(lab):
    truths = [f"apartment_stereo/apartment_stereo_ao_ref_{view}.exr" for view in ("left", "right")]
    return own(lab, "apartment", "apartment_stereo/apartment_stereo_exact.exr", truths, 0.4)
