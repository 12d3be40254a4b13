"""The rules that the example site, its configuration and the example plans keep.

Every check takes the data and returns a list of sentences, one for each error.
The lists of places are written out here and not imported from the generator: they are the reference map.
"""

import collections
import itertools
import json
import math
import pathlib
import re
import tomllib

VEHICLE_TYPES = ("lr-base", "cr-base")
CLEARANCE = 0.9  # metres between a node and a foreign node or edge; a vehicle is 0.8 m wide
FLOOR = (40.0, 20.0)
TOLERANCE = 1e-6


def number_places(prefix, count):
    return [f"{prefix}{i:02}" for i in range(1, count + 1)]


STOCKER_PORTS = number_places("ST01.CP", 6)
AREA_PORTS = number_places("A01.CP", 6) + number_places("A02.CP", 6)
SETS = number_places("A01.SET", 12) + number_places("A02.SET", 12)
CHARGERS = {"CHG01": "lr-base", "CHG02": "cr-base"}
STATIONS_OF_TYPE = {
    "lr-base": {*STOCKER_PORTS, *AREA_PORTS, "CHG01"},
    "cr-base": {*AREA_PORTS, *SETS, "CHG02"},
}
ALL_STATIONS = STATIONS_OF_TYPE["lr-base"] | STATIONS_OF_TYPE["cr-base"]


class Layout:
    """The one layout of a LIF file, with the look-ups shared by the checks."""

    def __init__(self, lif):
        self.layout = lif["layouts"][0]
        self.nodes = {node["nodeId"]: node for node in self.layout["nodes"]}
        self.edges = self.layout["edges"]
        self.stations = {station["stationId"]: station for station in self.layout["stations"]}
        self.docks = {station["interactionNodeIds"][0]: station_id for station_id, station in self.stations.items()
                      if station["interactionNodeIds"]}

    def point(self, node_id):
        position = self.nodes[node_id]["nodePosition"]
        return (position["x"], position["y"])

    def is_known(self, edge):
        return edge["startNodeId"] in self.nodes and edge["endNodeId"] in self.nodes

    def known_edges(self):
        return [edge for edge in self.edges if self.is_known(edge)]

    def lane_edges(self):
        return [edge for edge in self.known_edges()
                if edge["startNodeId"] not in self.docks and edge["endNodeId"] not in self.docks]

    def spur_edges(self):
        return [edge for edge in self.known_edges()
                if edge["startNodeId"] in self.docks or edge["endNodeId"] in self.docks]

    def length(self, edge):
        return math.dist(self.point(edge["startNodeId"]), self.point(edge["endNodeId"]))

    def heading(self, edge):
        (x1, y1), (x2, y2) = self.point(edge["startNodeId"]), self.point(edge["endNodeId"])
        return math.atan2(y2 - y1, x2 - x1)


def types_of(properties):
    return {entry["vehicleTypeId"] for entry in properties}


def is_same_angle(first, second):
    return abs(math.remainder(first - second, 2 * math.pi)) < 1e-6


def find_duplicates(values):
    return [value for value, count in collections.Counter(values).items() if count > 1]


# ---------------------------------------------------------------------------------------------------- schema


def close_objects_recursive(schema):
    """The same schema with no room for members that it does not name."""
    if isinstance(schema, list):
        return [close_objects_recursive(entry) for entry in schema]
    if not isinstance(schema, dict):
        return schema
    closed = {key: close_objects_recursive(value) for key, value in schema.items()}
    if schema.get("type") == "object" and "properties" in schema:
        closed["additionalProperties"] = False
    return closed


def check_schema(lif, schema):
    import jsonschema  # only here: all other checks run without it

    validator = jsonschema.Draft7Validator(close_objects_recursive(schema))
    return [f"schema: {'/'.join(str(part) for part in error.absolute_path)}: {error.message[:200]}"
            for error in validator.iter_errors(lif)]


# ---------------------------------------------------------------------------------------------------- layout


def check_shape(lif):
    """The preconditions of the other checks. The schema checks more, if it is available."""
    errors = []
    if lif.get("metaInformation", {}).get("lifVersion") != "1.0.0":
        errors.append("metaInformation.lifVersion is not 1.0.0")
    if len(lif.get("layouts", [])) != 1:
        return errors + ["there is not exactly one layout"]
    layout = Layout(lif)
    maps = {node.get("mapId") for node in layout.layout["nodes"]}
    if len(maps) != 1 or None in maps:
        errors.append(f"not one mapId on every node: {maps}")
    for edge in layout.edges:
        if any("trajectory" in entry for entry in edge["vehicleTypeEdgeProperties"]):
            errors.append(f"edge {edge['edgeId']} has a trajectory: edges are straight")
    return errors


def check_ids(lif):
    layout = lif["layouts"][0]
    errors = []
    for what, key in (("nodes", "nodeId"), ("edges", "edgeId"), ("stations", "stationId")):
        errors += [f"{key} {value} is given twice" for value in find_duplicates(entry[key] for entry in layout[what])]
    for edge in layout["edges"]:
        if edge["edgeId"] != f"{edge['startNodeId']}-{edge['endNodeId']}":
            errors.append(f"edge {edge['edgeId']} is not named after its ends")
    return errors


def check_references(lif):
    layout = Layout(lif)
    errors = [f"edge {edge['edgeId']} begins or ends at an unknown node" for edge in layout.edges
                if not layout.is_known(edge)]
    for station_id, station in layout.stations.items():
        if station["interactionNodeIds"] != [f"D-{station_id}"] or f"D-{station_id}" not in layout.nodes:
            errors.append(f"station {station_id} has not exactly its own dock node")
    return errors


def check_stations(lif):
    layout = Layout(lif)
    errors = [f"station {station_id} is missing" for station_id in sorted(ALL_STATIONS - layout.stations.keys())]
    errors += [f"station {station_id} is not a place of the map"
                 for station_id in sorted(layout.stations.keys() - ALL_STATIONS)]
    for node_id, station_id in layout.docks.items():
        expected = {kind for kind, stations in STATIONS_OF_TYPE.items() if station_id in stations}
        if node_id in layout.nodes and types_of(layout.nodes[node_id]["vehicleTypeNodeProperties"]) != expected:
            errors.append(f"dock {node_id} is not for {sorted(expected)}")
    return errors


def check_numbering(lif):
    """Top row first, each row from left to right."""
    layout = Layout(lif)
    errors = []
    rows = [STOCKER_PORTS, AREA_PORTS[:6], AREA_PORTS[6:], SETS[:6], SETS[6:12], SETS[12:18], SETS[18:]]
    rows = [[layout.point(f"D-{place}") for place in row if f"D-{place}" in layout.nodes] for row in rows]
    for row in rows:
        if any(left[0] >= right[0] or left[1] != right[1] for left, right in zip(row, row[1:])):
            errors.append(f"the row that begins at {row[0]} is not numbered from left to right")
    for upper, lower in ((rows[3], rows[4]), (rows[5], rows[6])):
        if min(point[1] for point in upper) <= max(point[1] for point in lower):
            errors.append("the sets' upper row is not above the lower one")
    return errors


def check_extents(lif):
    layout = Layout(lif)
    errors = []
    places = {node_id: layout.point(node_id) for node_id in layout.nodes}
    places |= {station_id: (station["stationPosition"]["x"], station["stationPosition"]["y"])
               for station_id, station in layout.stations.items()}
    for name, (x, y) in places.items():
        if not (1.0 <= x <= FLOOR[0] - 1.0 and 1.0 <= y <= FLOOR[1] - 1.0):
            errors.append(f"{name} at ({x}, {y}) is off the floor")
    width, height = (max(values) - min(values) for values in zip(*places.values()))
    if width < 0.75 * FLOOR[0] or height < 0.6 * FLOOR[1]:
        errors.append(f"the site covers {width} m x {height} m only: are these metres?")
    return errors


# -------------------------------------------------------------------------------------------------- distances


def distance_to_segment(point, start, end):
    """Metres from the point to the nearest point of the segment."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    squared = dx * dx + dy * dy
    part = 0.0 if squared == 0.0 else ((point[0] - start[0]) * dx + (point[1] - start[1]) * dy) / squared
    part = min(1.0, max(0.0, part))
    return math.dist(point, (start[0] + part * dx, start[1] + part * dy))


def turn(first, second, third):
    """> 0: left turn at second, < 0: right turn, 0: straight."""
    value = (second[0] - first[0]) * (third[1] - first[1]) - (second[1] - first[1]) * (third[0] - first[0])
    return 0 if abs(value) < TOLERANCE else math.copysign(1, value)


def is_crossing(first, second):
    """Whether two segments without a common end have a point in common."""
    (p1, p2), (q1, q2) = first, second
    if turn(p1, p2, q1) * turn(p1, p2, q2) < 0 and turn(q1, q2, p1) * turn(q1, q2, p2) < 0:
        return True
    touches = (distance_to_segment(point, *segment) for segment, points in ((first, second), (second, first))
               for point in points)
    return min(touches) < TOLERANCE


def check_clearance(lif):
    layout = Layout(lif)
    errors = []
    for first, second in itertools.combinations(layout.nodes, 2):
        distance = math.dist(layout.point(first), layout.point(second))
        if distance < CLEARANCE - TOLERANCE:
            errors.append(f"nodes {first} and {second} are {distance:.3f} m apart")
    for edge in layout.known_edges():
        ends = (edge["startNodeId"], edge["endNodeId"])
        segment = [layout.point(end) for end in ends]
        for node_id in layout.nodes:
            distance = distance_to_segment(layout.point(node_id), *segment)
            if node_id not in ends and distance < CLEARANCE - TOLERANCE:
                errors.append(f"edge {edge['edgeId']} passes node {node_id} at {distance:.3f} m")
    return errors


def check_lengths(lif):
    layout = Layout(lif)
    errors = []
    for edges, least, most in ((layout.lane_edges(), 1.0, 3.0), (layout.spur_edges(), CLEARANCE, 1.5)):
        for edge in edges:
            length = layout.length(edge)
            if not least - TOLERANCE <= length <= most + TOLERANCE:
                errors.append(f"edge {edge['edgeId']} is {length:.3f} m long, not {least} to {most} m")
    return errors


def check_crossings(lif):
    layout = Layout(lif)
    errors = []
    for first, second in itertools.combinations(layout.known_edges(), 2):
        ends = [(edge["startNodeId"], edge["endNodeId"]) for edge in (first, second)]
        if set(ends[0]) & set(ends[1]):
            continue  # check_clearance finds an edge that runs along another one
        if is_crossing(*[[layout.point(end) for end in pair] for pair in ends]):
            errors.append(f"edges {first['edgeId']} and {second['edgeId']} cross without a common node")
    return errors


# ---------------------------------------------------------------------------------------------------- traffic


def check_lanes(lif):
    """One-way lanes, a counter-clockwise loop around everything, and a choice of routes inside it."""
    layout = Layout(lif)
    edges = layout.lane_edges()
    pairs = {(edge["startNodeId"], edge["endNodeId"]) for edge in edges}
    errors = [f"the lane between {start} and {end} runs both ways" for start, end in pairs
                if start < end and (end, start) in pairs]
    successors = collections.defaultdict(list)
    for start, end in sorted(pairs):
        successors[start].append(end)
    if not any(len(ends) > 1 for ends in successors.values()):
        errors.append("no lane branches off: there is no choice of routes")
    # Clockwise around the middle of the floor, seen from an edge of the outermost lanes, is a negative turn.
    points = {end: layout.point(end) for pair in pairs for end in pair}
    low = [min(point[axis] for point in points.values()) for axis in (0, 1)]
    high = [max(point[axis] for point in points.values()) for axis in (0, 1)]
    centre = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2)
    borders = [(axis, limit[axis]) for axis in (0, 1) for limit in (low, high)]
    outer = [(start, end) for start, end in sorted(pairs)
             if any(points[start][axis] == points[end][axis] == value for axis, value in borders)]
    errors += [f"lane edge {start}-{end} of the loop runs clockwise" for start, end in outer
                 if turn(centre, points[start], points[end]) < 0]
    around = sum(math.dist(points[start], points[end]) for start, end in outer)
    if abs(around - 2 * (high[0] - low[0] + high[1] - low[1])) > TOLERANCE:
        errors.append("the loop around the floor is not closed")
    return errors


def check_spurs(lif):
    """A dock has one way in and one way out, from and to a lane node that no other dock uses."""
    layout = Layout(lif)
    errors = []
    lane_nodes = []
    for dock in layout.docks:
        sources = [edge["startNodeId"] for edge in layout.known_edges() if edge["endNodeId"] == dock]
        targets = [edge["endNodeId"] for edge in layout.known_edges() if edge["startNodeId"] == dock]
        if len(sources) != 1 or sources != targets or sources[0] in layout.docks:
            errors.append(f"dock {dock} has not one lane node for in and out: {sources}, {targets}")
        else:
            lane_nodes += sources
    return errors + [f"lane node {node_id} serves two docks" for node_id in find_duplicates(lane_nodes)]


def check_edge_properties(lif):
    layout = Layout(lif)
    errors = []
    for edge in layout.known_edges():
        ends = [types_of(layout.nodes[edge[key]]["vehicleTypeNodeProperties"]) for key in ("startNodeId", "endNodeId")]
        leaves = edge["startNodeId"] in layout.docks
        is_spur = leaves or edge["endNodeId"] in layout.docks
        if types_of(edge["vehicleTypeEdgeProperties"]) != ends[0] & ends[1]:
            errors.append(f"edge {edge['edgeId']} is not for the vehicle types of both its ends")
        for entry in edge["vehicleTypeEdgeProperties"]:
            speed = entry.get("maxSpeed", 0.0)
            if not (0.3 <= speed <= 0.5 if is_spur else 1.0 <= speed <= 1.5):
                errors.append(f"edge {edge['edgeId']} allows {speed} m/s")
            orientation = (entry.get("orientationType"), entry.get("vehicleOrientation"))
            if orientation != ("TANGENTIAL", 180.0 if leaves else 0.0):
                errors.append(f"edge {edge['edgeId']} has orientation {orientation}")
            if not isinstance(entry.get("rotationAllowed"), bool):
                errors.append(f"edge {edge['edgeId']} has no rotationAllowed")
    return errors


def check_headings(lif):
    """A docked vehicle keeps the heading in which it entered; the angle is in radians, -pi to pi."""
    layout = Layout(lif)
    errors = []
    entry_heading = {edge["endNodeId"]: layout.heading(edge) for edge in layout.spur_edges()
                     if edge["endNodeId"] in layout.docks}
    for node_id, node in layout.nodes.items():
        for entry in node["vehicleTypeNodeProperties"]:
            theta = entry.get("theta")
            if theta is None:
                if node_id in layout.docks:
                    errors.append(f"dock {node_id} has no theta")
            elif abs(theta) > math.pi:
                errors.append(f"theta {theta} of node {node_id} is not in radians")
            elif node_id in entry_heading and not is_same_angle(theta, entry_heading[node_id]):
                errors.append(f"theta {theta} of dock {node_id} is not the heading of the edge that leads to it")
    return errors


def reachable_from(layout, start, vehicle_type):
    """The docks that the vehicle type can drive to; no way leads through another dock."""
    successors = collections.defaultdict(list)
    for edge in layout.known_edges():
        if vehicle_type in types_of(edge["vehicleTypeEdgeProperties"]):
            successors[edge["startNodeId"]].append(edge["endNodeId"])
    seen, open_nodes = {start}, [start]
    while open_nodes:
        node_id = open_nodes.pop()
        if node_id in layout.docks and node_id != start:
            continue
        fresh = [end for end in successors[node_id] if end not in seen]
        seen.update(fresh)
        open_nodes += fresh
    return {layout.docks[node_id] for node_id in seen if node_id in layout.docks}


def check_reachability(lif):
    layout = Layout(lif)
    errors = []
    for vehicle_type in VEHICLE_TYPES:
        own = STATIONS_OF_TYPE[vehicle_type]
        for station_id in sorted(own & layout.stations.keys()):
            reached = reachable_from(layout, f"D-{station_id}", vehicle_type)
            if own - reached:
                errors.append(f"{vehicle_type} finds no way from {station_id} to {sorted(own - reached)}")
            if reached - own:
                errors.append(f"{vehicle_type} may drive from {station_id} to {sorted(reached - own)}")
    return errors


LAYOUT_CHECKS = (
    check_shape, check_ids, check_references, check_stations, check_numbering, check_extents, check_clearance,
    check_lengths, check_crossings, check_lanes, check_spurs, check_edge_properties, check_headings, check_reachability,
)


# --------------------------------------------------------------------------------------- configuration and plans


def expand(text):
    """"A01.CP01.TP01-04" is TP01 to TP04 of A01.CP01; only the last segment can be a range. None: not a place."""
    match = re.fullmatch(r"((?:[A-Z]+\d{2,}\.)*[A-Z]+)(\d{2,})(?:-(\d{2,}))?", text)
    if match is None:
        return None
    first, last = int(match[2]), int(match[3] or match[2])
    return [f"{match[1]}{i:02}" for i in range(first, last + 1)] or None


def expand_all(texts, where, errors):
    places = []
    for text in texts:
        expanded = expand(text)
        if expanded is None:
            errors.append(f"{where}: {text} is neither a place nor a range of places")
        places += expanded or []
    errors += [f"{where}: {place} is given twice" for place in find_duplicates(places)]
    return places


def expected_ports():
    return ({f"{port}.TP{i:02}" for port in AREA_PORTS for i in range(1, 5)}
            | {f"{place}.MP{i:02}" for place in SETS for i in range(1, 33)})


def check_config(config, lif):
    layout = Layout(lif)
    errors = []
    if set(expand_all(config["site"]["ports"], "site.ports", errors)) != expected_ports():
        errors.append("site.ports is not the reference map's")
    for name, robot in config["robots"].items():
        where = f"robots.{name}"
        own = STATIONS_OF_TYPE.get(robot["vehicle_type"], set())
        if robot["start_node"] not in layout.nodes or robot["start_node"] != f"D-{robot['home']}":
            errors.append(f"{where}.start_node is not the dock of its home")
        if robot["home"] not in own:
            errors.append(f"{where}.home is no station of {robot['vehicle_type']}")
        ports = expand_all(robot["ports"], f"{where}.ports", errors)
        for child in expand_all(robot.get("child_ports", []), f"{where}.child_ports", errors):
            if child.rpartition(".")[0] not in ports:
                errors.append(f"{where}.child_ports: {child} is in no port of the robot")
    for name, action in config["actions"].items():
        if ("vehicle_action" in action) == ("arm_program" in action):
            errors.append(f"actions.{name} has not one of vehicle_action and arm_program")
        if not any(robot["type"] == action["robot"] for robot in config["robots"].values()):
            errors.append(f"actions.{name}: no robot is a {action['robot']}")
        if "arm_program" in action and not any("arm" in robot for robot in config["robots"].values()
                                               if robot["type"] == action["robot"]):
            errors.append(f"actions.{name}: no {action['robot']} has an arm")
    return errors


# Tables whose keys are names of the site: each counts as one key.
FREE_TABLES = ("parameters", "arm_inputs", "load_positions")


def list_keys_recursive(table, prefix=""):
    keys = []
    for key, value in table.items():
        if isinstance(value, dict) and key not in FREE_TABLES:
            keys += list_keys_recursive(value, f"{prefix}{key}.")
        else:
            keys.append(prefix + key)
    return keys


def list_sample_keys(text):
    """Keys that a configuration shows in comments only, as "# key = value", in tables that may be comments too."""
    table, keys = "", set()
    for line in text.splitlines():
        if match := re.match(r"^(?:# )?\[(\[?)([a-zA-Z0-9_.\"]+)\]", line):
            table = match[2].replace('"', "")
            keys.update({table} if match[1] else ())
        elif match := re.match(r"^# ([a-zA-Z_.]+) = ", line):
            keys.add(f"{table}.{match[1]}")
    return keys


def check_key_table(config, text, document):
    """The document's tables of keys and the file, read and as text, name the same keys."""
    def make_general(keys):
        names = {re.sub(r"^(robots|actions)\.[^.]+", r"\1.NAME", key) for key in keys}
        names = {re.sub(r"\.maps\.[^.]+", ".maps.MAPID", name) for name in names}
        names = {re.sub(r"\.NAME\.options\..+", ".NAME.options", name) for name in names}  # whose keys each driver defines
        return {re.sub(r"^stations\..+\.", "stations.NAME.", name) for name in names}
    used = make_general(list_keys_recursive(config))
    listed = set(re.findall(r"^\| `([a-zA-Z_.]+)` \|", document, re.MULTILINE))
    listed = {key for key in listed if "." in key}
    return ([f"key {key} is not documented" for key in sorted(used - listed)]
            + [f"documented key {key} is not in acsd.toml"
               for key in sorted(listed - used - make_general(list_sample_keys(text)))])


def check_plan(plan, config):
    """Every place of the plan exists, and the action is one of the configuration's."""
    errors = []
    robots = config["robots"].values()
    places = ALL_STATIONS | set(expand_all(config["site"]["ports"], "site.ports", errors))
    own_places = set(expand_all([text for robot in robots for text in robot["ports"] + robot.get("child_ports", [])],
                                "robots", errors))
    places |= {f"AMR.{place}" for place in own_places}
    jobs = [job for step in plan["steps"] for job in step["jobs"]]
    errors += [f"jobId {job_id} is given twice" for job_id in find_duplicates(job["jobId"] for job in jobs)]
    if [step["stepNo"] for step in plan["steps"]] != list(range(1, len(plan["steps"]) + 1)):
        errors.append("the steps are not numbered from 1")
    for step in plan["steps"]:
        if step["action"] not in config["actions"]:
            errors.append(f"no action {step['action']} is configured")
        if step["position"] not in ALL_STATIONS:
            errors.append(f"no station {step['position']}")
        errors += [f"no place {job[key]}" for job in step["jobs"] for key in ("from", "to") if job[key] not in places]
    return errors


def read_json(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def read_toml(path):
    return tomllib.loads(pathlib.Path(path).read_text(encoding="utf-8"))
