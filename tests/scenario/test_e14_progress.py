#!/usr/bin/env python3
"""e14_progress: what it prints is what the vehicle did, according to the floor and to the vehicle's own states."""

import collections
import json
import shutil
import unittest

from scenario_case import FINISH_SECONDS, SITE, TIME_SCALE, ScenarioCase, main

START = "D-CHG01"  # vda-sim starts its first vehicle here.
LAYOUT = json.loads((SITE / "site.lif.json").read_text())["layouts"][0]
POSITIONS = {node["nodeId"]: node["nodePosition"] for node in LAYOUT["nodes"]}


def find_route(start, target):
    """Edges of a shortest route."""
    ways = {start: []}
    waiting = collections.deque([start])
    while waiting:
        here = waiting.popleft()
        for edge in LAYOUT["edges"]:
            if edge["startNodeId"] == here and edge["endNodeId"] not in ways:
                ways[edge["endNodeId"]] = [*ways[here], edge]
                waiting.append(edge["endNodeId"])
    return ways[target]


def make_order(edges, station, map_id="floor-1"):
    """An order with the whole route, and a pick at its end."""
    pick = {"actionType": "pick", "actionId": "pick-1", "blockingType": "HARD", "actionParameters": [
        {"key": "stationType", "value": "rack"}, {"key": "loadType", "value": "cassette"},
        {"key": "stationName", "value": station}]}
    names = [edges[0]["startNodeId"], *[edge["endNodeId"] for edge in edges]]
    nodes = [{"nodeId": name, "sequenceId": 2 * i, "released": True, "actions": [pick] if name == names[-1] else [],
              "nodePosition": {**POSITIONS[name], "mapId": map_id}} for i, name in enumerate(names)]
    return {"headerId": 0, "timestamp": "2025-11-21T00:00:00.000Z", "version": "2.0.0", "manufacturer": "", "serialNumber": "",
            "orderId": "order-1", "orderUpdateId": 0, "nodes": nodes, "edges": [
                {"edgeId": edge["edgeId"], "sequenceId": 2 * i + 1, "released": True, "startNodeId": edge["startNodeId"],
                 "endNodeId": edge["endNodeId"], "actions": []} for i, edge in enumerate(edges)]}


class Progress(ScenarioCase):
    def start_lesson(self, station, **changes):
        """The broker, a vehicle, a recorder of the states, and the lesson with an order to this station."""
        self.line.share_world()
        port = self.line.start_broker()
        self.line.start_vehicles(TIME_SCALE, ("LR01,type=LR",)).wait_ready()
        self.states = self.line.start("states", "-p", port, "-t", "uagv/v2/ACS/LR01/state", "-F", "%p",
                                      binary=shutil.which("mosquitto_sub"))
        edges = find_route(START, f"D-{station}")
        self.route = [START, *[edge["endNodeId"] for edge in edges]]
        order = self.line.folder / "order.json"
        order.write_text(json.dumps(make_order(edges, station, **changes)))
        return self.line.start("e14_progress", "127.0.0.1", port, order)

    def read_lines(self, program):
        return program.log.read_text().splitlines()

    def read_journal(self):
        return [json.loads(line) for line in (self.line.folder / "world.json.journal").read_text().splitlines()]

    def test_a_drive_and_a_pick(self):
        lesson = self.start_lesson("A01.CP01")
        self.assertEqual(lesson.wait(FINISH_SECONDS), 0)
        reached = [f"LR01: node {node} reached" for node in self.route]
        self.assertEqual(self.read_lines(lesson), ["connected", "LR01: online", "LR01: order-1 accepted", *reached,
                                                   "LR01: pick finished", "LR01: order-1 finished"])
        self.states.stop()
        seen = [state["lastNodeId"] for state in map(json.loads, self.read_lines(self.states)) if state["orderId"] == "order-1"]
        self.assertEqual([node for node in self.route if node in seen], list(dict.fromkeys(seen)))
        self.assertEqual(seen[-1], self.route[-1])
        moves = [event for event in self.read_journal() if event["event"] == "CarrierMoved"]
        self.assertEqual(moves, [{"event": "CarrierMoved", "robot": "LR01", "carrier": "CASSETTE_01", "from": "A01.CP01",
                                  "to": "LR01.CP01"}])

    def test_a_pick_from_an_empty_place_fails(self):
        lesson = self.start_lesson("A01.CP03")
        self.assertEqual(lesson.wait(FINISH_SECONDS), 1)
        self.assertEqual(self.read_lines(lesson)[-2:], ["LR01: pick failed", "LR01: order-1 finished"])
        self.assertNotIn("CarrierMoved", [event["event"] for event in self.read_journal()])
        self.assertEqual(self.read_journal()[-1]["stations"], ["A01.CP03"])

    def test_an_order_for_another_map_is_rejected(self):
        lesson = self.start_lesson("A01.CP01", map_id="another-floor")
        self.assertEqual(lesson.wait(FINISH_SECONDS), 1)
        self.assertIn("LR01: order-1 rejected: ", self.read_lines(lesson)[-1])
        self.assertEqual([event["stations"] for event in self.read_journal()], [["CHG01"]])


if __name__ == "__main__":
    main()
