"""kernels/ssr/README.md"""
from catalogue import record, table
from recipes import environment_errors, pair, sets

PAGE = "kernels/ssr/README.md"


@table(PAGE, "A map as environment", minutes=4)
def environment(lab):
    return environment_errors(lab, "reflection", "480x270", 64, ("gallery", "courtyard", "lounge", "temple", "statue"))
