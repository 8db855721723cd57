"""kernels/contact_shadow/README.md"""
from catalogue import table
from intervals import SENSITIVE
from recipes import computed_share, effect_errors, effect_files

PAGE = "kernels/contact_shadow/README.md"
SCENES = ("gallery", "courtyard", "lounge")


@table(PAGE, "How near to the truth", minutes=1)
def errors(lab):
    return effect_errors(lab, "contact", SCENES)


def missed(lab, frame, preset):
    """Share of the surfaces that are shaded without the mask and lit with it."""
    import gloam
    settings = ("--length", 0.5, "--preset", preset)
    whole, masked = (gloam.read(lab.result("contact-shadow", frame, *settings, *mask)) for mask in ((), ("--only", "contact-mask")))
    surfaces = abs(whole["depth"]) < float("inf")
    return 100 * float(((whole["contact"] < 0.5) & (masked["contact"] > 0.5) & surfaces).sum() / surfaces.sum())


@table(PAGE, "contact-mask", minutes=1, within=SENSITIVE)
def mask(lab):
    frames = [str(effect_files(lab, "contact", "contact", scene)[0]) for scene in SCENES]
    wanted = [100 * computed_share(lab, "contact-shadow", frame, "--length", 0.5, "--only", "contact-mask") for frame in frames]
    return [[share, missed(lab, frame, "medium"), missed(lab, frame, "ultra")] for share, frame in zip(wanted, frames)]
