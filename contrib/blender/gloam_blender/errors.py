"""The one kind of error that a person is told."""


class Problem(Exception):
    """One sentence: what is wrong, and what to do."""
