"""techniques: what gloam can compute, with its parameters."""

import collections

from . import _gloam

Parameter = collections.namedtuple("Parameter", ["name", "type", "default", "min", "max", "choices", "unit", "help"])
Parameter.__doc__ = "A parameter of a technique: its type, default, range and choices, and the unit that it is in."


class Technique:
    """What is known of a technique.

    name, summary, paper; reads, optional, writes, outputs, extras: names of planes; then: the filter that follows; views: how many it
    needs; caution; presets: settings by name; parameters: a dict of gloam.Parameter by name, whose default of None comes from the frame;
    variant: None, or a dict of what the technique is a variant of: of, layers, eyes, as for gloam.run.
    """

    def __init__(self, facts):
        self.__dict__.update(facts)
        self.parameters = {parameter["name"]: Parameter(**parameter) for parameter in facts["parameters"]}

    def __repr__(self):
        return f"<gloam.Technique {self.name}: {self.summary}; reads {', '.join(self.reads)}; writes {', '.join(self.outputs)}>"


def techniques():
    """All techniques: a dict of gloam.Technique by name, in the order of the names."""
    return {facts["name"]: Technique(facts) for facts in _gloam.techniques()}
