"""README.md"""
from catalogue import picture
from lab import OUT


@picture("README.md", "docs/images/gallery_difference.png", minutes=0.2)
def difference(lab):
    """As script/demo makes it, at half the size."""
    import cv2
    frame = lab.frame("gallery", "960x540", "--peel", 8)
    truth, result = lab.made("truth.exr", "reference", "ao", frame, "-o", OUT, "--samples", 256), lab.made("ao.exr", "run", "ao", frame, "-o", OUT)
    whole = cv2.imread(lab.made("difference.png", "compare", result, truth, "-o", OUT))
    path = lab.folder_for("readme") / "gallery_difference.png"
    cv2.imwrite(str(path), cv2.resize(whole, (whole.shape[1] // 2, round(whole.shape[0] / 2 + 0.01)), interpolation=cv2.INTER_AREA),
                [cv2.IMWRITE_PNG_COMPRESSION, 9])
    return path
