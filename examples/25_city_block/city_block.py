"""A city block: buildings in rows around a courtyard, 30 mm from one to the next.

python3 examples/25_city_block/city_block.py > corner.yaml                # the corner building, two neighbours
python3 examples/25_city_block/city_block.py --ring 12 8 > block.yaml     # the block: 12 along x, 8 along y
"""

import argparse
from itertools import cycle

import pounding
from pounding import plan

GAP = 0.03  #: between neighbours [m]
STOREYS = (14, 6, 9, 20, 7, 11, 8, 16, 6, 12)  #: of the buildings in a row, over and over


def building(storeys, bays=2):
    """A frame with `bays` bays of 5 m along x and along y; the columns grow with the height."""
    column = round(0.3 + 0.02 * storeys, 2)
    return {
        "frame": {
            "material": {"E": "30 GPa"},
            "grid": {
                "storeys": storeys,
                "bays": [bays, bays],
                "storey_height": "3.2 m",
                "bay_width": "5 m",
                "columns": {"rectangle": [column, column]},
                "beams": {"rectangle": ["0.3 m", "0.5 m"]},
                "floor_mass": f"{25 * bays**2} t",
            },
        },
        "damping": "5 %",
    }


def corner():
    """The corner building faces one neighbour along x and one along y. It is larger, so the contacts are off
    its centre."""
    south = plan.row({"corner": building(9, bays=3), "south1": building(6)}, GAP)
    west = plan.row({"west1": building(7)}, GAP, along="y", start=(0, plan.extent(south).y1 + GAP))
    return {**south, **west}


def ring(along, across):
    """Rows on the four sides of a courtyard: `along` buildings in those along x, their corners included, `across` in
    those along y."""
    storeys = cycle(STOREYS)

    def side(name, count):
        return {f"{name}{i}": building(next(storeys)) for i in range(1, count + 1)}

    def street(name):
        return {f"{name}_west": building(9, bays=3), **side(name, along - 2), f"{name}_east": building(12, bays=3)}

    south = plan.row(street("south"), GAP)
    x1, y1 = plan.extent(south).x1, plan.extent(south).y1
    west = plan.row(side("west", across), GAP, along="y", start=(0, y1 + GAP))
    east = plan.row(side("east", across), GAP, along="y", start=(x1, y1 + GAP), align="high")
    inner = plan.extent(west).y1
    # The northern row is aligned with the northern street.
    north = plan.row(street("north"), GAP, start=(0, inner + GAP + 15), align="high")
    return {**south, **west, **east, **north}


def model(structures, title, tolerance="1e-4"):
    """These buildings, linked to all their neighbours, in an earthquake along x and y; and each of them alone."""
    motions = {
        axis: {"synthetic": {"seed": seed, "duration": "8 s", "pga": pga, "soil": "firm"}}
        for axis, seed, pga in (("x", 1, "0.35 g"), ("y", 2, "0.3 g"))
    }
    return pounding.Model(
        structures,
        [{"between": "neighbours", "points": 2, "law": "hertz_damped", "stiffness": 1.4e9, "restitution": 0.65}],
        ground_motion={"components": motions},
        analysis={"tolerance": tolerance},
        title=title,
        compare="no_pounding",
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--ring", type=int, nargs=2, metavar=("ALONG", "ACROSS"), help="a whole block instead of its corner"
    )
    given = parser.parse_args()
    if given.ring:
        made = model(ring(*given.ring), f"A city block of {2 * sum(given.ring)} buildings", tolerance="1e-3")
    else:
        made = model(corner(), "The corner of a city block")
    print(made.to_yaml(), end="")
