"""The example site with thousands of nodes more."""

import copy
import json

from scenario_case import SITE

DISTANCE = 2.0  # metres between two nodes of the grid
GRID_WIDTH = 100  # nodes


def make_large_site(path, count):
    """Writes a LIF file: beside the floor of the example a grid of `count` nodes, with an edge in each direction between
    neighbours and from the floor to the grid."""
    site = json.loads((SITE / "site.lif.json").read_text())
    layout = site["layouts"][0]
    node, edge = layout["nodes"][0], layout["edges"][0]
    right = 10.0 + max(place["nodePosition"]["x"] for place in layout["nodes"])

    def get_id(number):
        return f"G{number:05}"

    def connect(start, end):
        for first, last in ((start, end), (end, start)):
            layout["edges"].append(copy.deepcopy(edge) | {"edgeId": f"{first}-{last}", "startNodeId": first, "endNodeId": last})

    connect(node["nodeId"], get_id(0))
    for number in range(count):
        row, column = divmod(number, GRID_WIDTH)
        place = {"x": right + DISTANCE * column, "y": DISTANCE * row}
        layout["nodes"].append(copy.deepcopy(node) | {"nodeId": get_id(number), "nodePosition": place})
        if column > 0:
            connect(get_id(number - 1), get_id(number))
        if row > 0:
            connect(get_id(number - GRID_WIDTH), get_id(number))
    path.write_text(json.dumps(site))
    return len(layout["nodes"]), len(layout["edges"])
