"""docs/light-field.md"""
from catalogue import picture
from lab import OUT

SHARED = {"minutes": 1, "shares": "eighty modules"}


def modules(lab):
    frame = lab.frame("statue", "640x480", "--display", lab.root / "data/displays/eighty.json")
    return lab.made("modules_ao.exr", "run", "lightfield-ssao", frame, "-o", OUT, "--keep-depth", "--radius", 0.4, "--set", "reuse=on")


@picture("docs/light-field.md", "docs/images/light_field_sheet.png", **SHARED)
def sheet(lab):
    return lab.made("sheet.png", "info", modules(lab), "--views", "module00,module26,module53", "--sheet", OUT)


@picture("docs/light-field.md", "docs/images/light_field_line.png", **SHARED)
def line(lab):
    return lab.made("line.png", "info", modules(lab), "--scan-line", OUT, "--row", 250)
