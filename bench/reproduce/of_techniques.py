"""docs/techniques.md: what script/update-techniques writes"""
from catalogue import page_of_text


@page_of_text("docs/techniques.md", minutes=0.1)
def page(lab):
    return lab.printed(lab.gloam, "list", "techniques", "--markdown")
