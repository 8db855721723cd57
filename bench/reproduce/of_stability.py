"""docs/stability.md: what script/stability measures, a technique at a time"""
import json
import pathlib

from catalogue import page_of_text
from intervals import SENSITIVE


@page_of_text("docs/stability.md", minutes=30, within=SENSITIVE)
def page(lab):
    techniques = json.loads(lab.printed(lab.gloam, "list", "techniques", "--json", "-"))
    files = [lab.stress(technique["name"], "--frames", 10000) for technique in techniques]
    page = pathlib.Path(lab.unused("stability.md"))
    lab.run_again(lab.gloam, "stress", *(word for file in files for word in ("--from", file)), "--markdown", page)
    return page.read_text()
