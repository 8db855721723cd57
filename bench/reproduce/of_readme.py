"""README.md"""
from catalogue import picture
from lab import OUT


@picture("README.md", "docs/images/gallery_difference.png", minutes=1)
def difference(lab):
    """As script/demo makes it."""
    frame = lab.frame("gallery", "960x540", "--peel", 8)
    truth, result = lab.made("truth.exr", "reference", "ao", frame, "-o", OUT, "--samples", 256), lab.made("ao.exr", "run", "ao", frame, "-o", OUT)
    return lab.made("difference.png", "compare", result, truth, "-o", OUT)
