#!/usr/bin/env python3
"""Writes the example site: a VDMA LIF 1.0 layout, and a picture of it.

    scripts/make_site.py             writes examples/site/site.lif.json and examples/site/site.svg
    scripts/make_site.py --check     compares both files with what this script would write (exit code 1 if they differ)
    scripts/make_site.py --out FILE  writes the layout elsewhere;  --svg FILE  the picture

All lengths are whole millimetres until they are printed, so that the same input gives the same bytes everywhere.
"""

import argparse
import json
import math
import pathlib
import sys
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEFAULT_LIF = ROOT / "examples/site/site.lif.json"
DEFAULT_SVG = ROOT / "examples/site/site.svg"

MAP_ID = "floor-1"
LR = "lr-base"
CR = "cr-base"
BOTH = (LR, CR)

FLOOR_WIDTH = 40000
FLOOR_HEIGHT = 20000

# Lanes: a counter-clockwise loop, a lane through its middle, and two lanes across.
WEST, EAST = 3000, 37000
SOUTH, MIDDLE, NORTH = 4000, 10000, 16000
CROSS_UP, CROSS_DOWN = 19000, 21000

LANE_SPEED = 1.2  # m/s
SPUR_SPEED = 0.4  # m/s, in and out of a dock
LONGEST_LANE_EDGE = 2000  # a longer stretch gets nodes in between: finer steps let a follower come closer
SPUR = 1200  # lane to dock: a docked vehicle leaves the lane free
REACH = 700  # dock to the port of the equipment

UP, DOWN, LEFT = (0, 1), (0, -1), (-1, 0)


@dataclass
class Station:
    """A docking place: the lane point that its spur leaves, the direction of the spur, who may dock."""

    station_id: str
    name: str
    lane: tuple
    direction: tuple
    vehicle_types: tuple

    def at(self, distance):
        """The point so far from the lane, in the direction of the spur."""
        return (self.lane[0] + self.direction[0] * distance, self.lane[1] + self.direction[1] * distance)

    def node_id(self):
        return "D-" + self.station_id


@dataclass
class Site:
    lane_nodes: dict = field(default_factory=dict)  # point -> node id, in order of numbering
    lane_edges: list = field(default_factory=list)  # (point, point)
    stations: list = field(default_factory=list)


def make_area(area, first_x):
    """Two rows of six sets, back to back, and a row of six cassette ports that faces the lower row."""
    stations = []
    for i in range(6):
        x = first_x + 2000 * i
        lane = (x + 1000, MIDDLE)
        stations.append(Station(f"{area}.CP{i + 1:02}", f"{area} cassette port {i + 1}", lane, DOWN, BOTH))
    for i in range(12):
        x = first_x + 2000 * (i % 6)
        lane, direction = ((x, NORTH), DOWN) if i < 6 else ((x, MIDDLE), UP)
        stations.append(Station(f"{area}.SET{i + 1:02}", f"{area} set {i + 1}", lane, direction, (CR,)))
    return stations


def make_stations():
    stations = []
    for i in range(6):
        x = 24500 + 2000 * i
        stations.append(Station(f"ST01.CP{i + 1:02}", f"Stocker 1 cassette port {i + 1}", (x, SOUTH), DOWN, (LR,)))
    stations += make_area("A01", 5500)
    stations += make_area("A02", 23500)
    stations.append(Station("CHG01", "Charger of LR01", (WEST, 14000), LEFT, (LR,)))
    stations.append(Station("CHG02", "Charger of CR01", (WEST, 12000), LEFT, (CR,)))
    return stations


def fill(points):
    """Nodes in between wherever two neighbours are farther apart than LONGEST_LANE_EDGE."""
    result = [points[0]]
    for start, end in zip(points, points[1:]):
        length = abs(end[0] - start[0]) + abs(end[1] - start[1])
        parts = math.ceil(length / LONGEST_LANE_EDGE)
        for i in range(1, parts + 1):
            result.append(tuple(a + (b - a) * i // parts for a, b in zip(start, end)))
    return result


def make_lane(start, end, stops):
    """The points of the one-way lane from start to end: every stop on it, in the direction of travel."""
    def along(point):
        return abs(point[0] - start[0]) + abs(point[1] - start[1])

    def is_between(point):
        return all(min(a, b) <= p <= max(a, b) for p, a, b in zip(point, start, end))

    return fill(sorted({start, end} | {stop for stop in stops if is_between(stop)}, key=along))


def make_site():
    site = Site(stations=make_stations())
    crossings = {(x, y) for x in (WEST, CROSS_UP, CROSS_DOWN, EAST) for y in (SOUTH, MIDDLE, NORTH)}
    stops = crossings | {station.lane for station in site.stations}
    lanes = [
        ((WEST, SOUTH), (EAST, SOUTH)),
        ((EAST, SOUTH), (EAST, NORTH)),
        ((EAST, NORTH), (WEST, NORTH)),
        ((WEST, NORTH), (WEST, SOUTH)),
        ((WEST, MIDDLE), (EAST, MIDDLE)),
        ((CROSS_UP, SOUTH), (CROSS_UP, NORTH)),
        ((CROSS_DOWN, NORTH), (CROSS_DOWN, SOUTH)),
    ]
    for start, end in lanes:
        points = make_lane(start, end, stops)
        for point in points:
            site.lane_nodes.setdefault(point, f"N{len(site.lane_nodes) + 1:03}")
        site.lane_edges += zip(points, points[1:])
    return site


def metres(millimetres):
    return millimetres / 1000


def position(point):
    return {"x": metres(point[0]), "y": metres(point[1])}


def lif_node(node_id, point, vehicle_types, theta=None):
    properties = [{"vehicleTypeId": vehicle_type} | ({} if theta is None else {"theta": theta})
                  for vehicle_type in vehicle_types]
    return {"nodeId": node_id, "mapId": MAP_ID, "nodePosition": position(point),
            "vehicleTypeNodeProperties": properties}


def lif_edge(start_id, end_id, vehicle_types, orientation, may_rotate, speed):
    properties = [{"vehicleTypeId": vehicle_type, "vehicleOrientation": orientation, "orientationType": "TANGENTIAL",
                   "rotationAllowed": may_rotate, "maxSpeed": speed} for vehicle_type in vehicle_types]
    return {"edgeId": f"{start_id}-{end_id}", "startNodeId": start_id, "endNodeId": end_id,
            "vehicleTypeEdgeProperties": properties}


def lif_layout(site):
    nodes = [lif_node(node_id, point, BOTH) for point, node_id in site.lane_nodes.items()]
    edges = [lif_edge(site.lane_nodes[start], site.lane_nodes[end], BOTH, 0.0, True, LANE_SPEED)
             for start, end in site.lane_edges]
    stations = []
    for station in site.stations:
        lane_id, dock_id, allowed = site.lane_nodes[station.lane], station.node_id(), station.vehicle_types
        # A node's theta is in radians, an edge's vehicleOrientation in degrees: so the schema has it.
        theta = math.atan2(station.direction[1], station.direction[0])
        nodes.append(lif_node(dock_id, station.at(SPUR), allowed, theta))
        edges.append(lif_edge(lane_id, dock_id, allowed, 0.0, False, SPUR_SPEED))
        edges.append(lif_edge(dock_id, lane_id, allowed, 180.0, False, SPUR_SPEED))
        stations.append({"stationId": station.station_id, "interactionNodeIds": [dock_id],
                         "stationName": station.name, "stationPosition": position(station.at(SPUR + REACH))})
    return {
        "layoutId": "reference-site",
        "layoutName": "Reference site",
        "layoutVersion": "1",
        "layoutLevelId": "level-1",
        "layoutDescription": "A stocker, two areas of six cassette ports and twelve sets, and two chargers.",
        "nodes": nodes,
        "edges": edges,
        "stations": stations,
    }


def lif_text(site):
    """The file: one node, edge or station per line, so that a change shows as the lines that it touches."""
    layout = lif_layout(site)
    meta = {
        "projectIdentification": "ACS SDK example site",
        "creator": "scripts/make_site.py",
        "exportTimestamp": "2025-11-21T00:00:00Z",  # of the layout's version, not of the run
        "lifVersion": "1.0.0",
    }
    lines = ["{", '  "metaInformation": ' + json.dumps(meta) + ",", '  "layouts": [', "    {"]
    members = []
    for key, value in layout.items():
        if isinstance(value, list):
            rows = ",\n".join("        " + json.dumps(row) for row in value)
            members.append(f'      "{key}": [\n{rows}\n      ]')
        else:
            members.append(f'      "{key}": {json.dumps(value)}')
    lines += [",\n".join(members), "    }", "  ]", "}"]
    return "\n".join(lines) + "\n"


def svg_text(site):
    """The picture: 30 pixels per metre, y upwards as on the map."""
    scale, margin = 30, 20

    def place(point):
        return (margin + round(point[0] * scale / 1000, 1), margin + round((FLOOR_HEIGHT - point[1]) * scale / 1000, 1))

    def line(start, end, css):
        (x1, y1), (x2, y2) = place(start), place(end)
        return f'<line class="{css}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>'

    def arrow(start, end):
        (x1, y1), (x2, y2) = place(start), place(end)
        angle = round(math.degrees(math.atan2(y2 - y1, x2 - x1)))
        x, y = round((x1 + x2) / 2, 1), round((y1 + y2) / 2, 1)
        return f'<path class="arrow" d="M5,0 L-4,-4 L-4,4 Z" transform="translate({x},{y}) rotate({angle})"/>'

    def box(css, x, y, size):
        return f'<rect class="dock {css}" x="{round(x, 1)}" y="{round(y, 1)}" width="{size}" height="{size}" rx="3"/>'

    def text(css, x, y, label):
        return f'<text class="{css}" x="{round(x, 1)}" y="{round(y, 1)}">{label}</text>'

    width = 2 * margin + FLOOR_WIDTH * scale // 1000
    height = 2 * margin + FLOOR_HEIGHT * scale // 1000
    rows = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">',
        "<title>The reference site: lanes, docks and stations</title>",
        "<style>",
        "text { font-family: sans-serif; text-anchor: middle; fill: #222 }",
        ".floor { fill: #fff; stroke: #888 } .grid { stroke: #eee } .lane { stroke: #4a78b5; stroke-width: 2 }",
        ".spur { stroke: #999; stroke-width: 1.5 } .arrow { fill: #4a78b5 } .node { fill: #4a78b5 }",
        ".dock { stroke: #222 } .both { fill: #f2c14e } .lr { fill: #7fb069 } .cr { fill: #d98880 }",
        ".id { font-size: 9px } .nid { font-size: 6px; fill: #4a78b5 } .key { font-size: 11px; text-anchor: start }",
        "</style>",
        f'<rect width="{width}" height="{height}" fill="#f7f7f7"/>',
        f'<rect class="floor" x="{margin}" y="{margin}" width="{width - 2 * margin}" height="{height - 2 * margin}"/>',
    ]
    rows += [line((x, 0), (x, FLOOR_HEIGHT), "grid") for x in range(5000, FLOOR_WIDTH, 5000)]
    rows += [line((0, y), (FLOOR_WIDTH, y), "grid") for y in range(5000, FLOOR_HEIGHT, 5000)]
    rows += [line(station.lane, station.at(SPUR), "spur") for station in site.stations]
    rows += [line(start, end, "lane") for start, end in site.lane_edges]
    rows += [arrow(start, end) for start, end in site.lane_edges]
    for point, node_id in site.lane_nodes.items():
        x, y = place(point)
        rows.append(f'<circle class="node" cx="{x}" cy="{y}" r="2.5"/>')
        rows.append(text("nid", x + 10, y - 4, node_id))
    for station in site.stations:
        css = "both" if station.vehicle_types == BOTH else "lr" if station.vehicle_types == (LR,) else "cr"
        x, y = place(station.at(SPUR))
        rows.append(box(css, x - 12, y - 12, 24))
        rows.append(text("id", x, y + (24 if station.direction == DOWN else -16), station.station_id))
    for i, (css, label) in enumerate([("both", f"{LR} and {CR}"), ("lr", LR), ("cr", CR)]):
        x, y = margin + 15 + 160 * i, height - margin - 30
        rows.append(box(css, x, y, 14))
        rows.append(text("key", x + 20, y + 11, label))
    rows.append(text("key", width - margin - 200, height - margin - 19, "grid 5 m, floor 40 m x 20 m"))
    rows.append("</svg>")
    return "\n".join(rows) + "\n"


def is_current(path, text):
    if path.is_file() and path.read_text(encoding="utf-8") == text:
        return True
    print(f"{path} is not what scripts/make_site.py writes: run scripts/make_site.py", file=sys.stderr)
    return False


def main():
    parser = argparse.ArgumentParser(description="Writes the example site and its picture.")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a file is out of date")
    parser.add_argument("--out", type=pathlib.Path, default=DEFAULT_LIF, metavar="FILE", help="the LIF file")
    parser.add_argument("--svg", type=pathlib.Path, default=DEFAULT_SVG, metavar="FILE", help="the picture")
    arguments = parser.parse_args()
    site = make_site()
    files = [(arguments.out, lif_text(site)), (arguments.svg, svg_text(site))]
    if arguments.check:
        # A list, not a generator: every file that is out of date is named.
        return 0 if all([is_current(path, text) for path, text in files]) else 1
    for path, text in files:
        path.write_text(text, encoding="utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
