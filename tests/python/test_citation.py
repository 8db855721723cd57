"""What others cite is what is built."""
import os
import pathlib
import re

ROOT = pathlib.Path(os.environ.get("GLOAM_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))


def field(name, text):
    return re.search(rf"^{name}: (.*)$", text, re.MULTILINE).group(1)


def test_citation_states_version_and_licence():
    citation = (ROOT / "CITATION.cff").read_text()
    built = re.search(r"project\(gloam VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    assert field("version", citation) == built
    assert (ROOT / "LICENSE").read_text().startswith(field("license", citation) + " License")


def test_citation_has_what_the_format_requires():
    # The Citation File Format 1.2.0 requires these four; each author is a person or an entity with a name.
    citation = (ROOT / "CITATION.cff").read_text()
    assert field("cff-version", citation) == "1.2.0"
    assert field("message", citation) and field("title", citation)
    assert re.search(r"^authors:\n  - (name|family-names): \S", citation, re.MULTILINE)
