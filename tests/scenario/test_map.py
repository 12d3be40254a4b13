#!/usr/bin/env python3
"""What the map demands of vehicles: actions and trajectories are in orders, and an action that fails is repeated."""

import json

from scenario_case import FINISH_SECONDS, PLANS, ScenarioCase, main

TIME_SCALE = 10
NODE_ACTION = {"actionType": "finePositioning", "requirementType": "REQUIRED", "blockingType": "HARD",
               "actionParameters": [{"key": "stationName", "value": "gate"}]}
EDGE_ACTION = {"actionType": "detectObject", "requirementType": "REQUIRED", "blockingType": "NONE",
               "actionParameters": [{"key": "objectType", "value": "cart"}]}
CURVE = {"degree": 2, "knotVector": [0, 0, 0, 1, 1, 1],
         "controlPoints": [{"x": 3.0, "y": 12.0}, {"x": 4.0, "y": 11.0}, {"x": 3.0, "y": 10.0}]}


class Map(ScenarioCase):
    def write_map(self, node_id):
        """The example map with demands on the way of LR01 to its first station."""
        site = json.loads((self.line.site_dir / "site.lif.json").read_text())
        layout = site["layouts"][0]
        node = next(node for node in layout["nodes"] if node["nodeId"] == node_id)
        edge = next(edge for edge in layout["edges"] if edge["edgeId"] == "N046-N047")
        node["vehicleTypeNodeProperties"][0]["actions"] = [NODE_ACTION]
        edge["vehicleTypeEdgeProperties"][0] |= {"actions": [EDGE_ACTION], "trajectory": CURVE}
        path = self.line.folder / "map.lif.json"
        path.write_text(json.dumps(site))
        return path

    def run_plan(self, node_id, *faults):
        self.line.share_world()
        self.line.start_broker()
        vehicles = self.line.start_vehicles(TIME_SCALE, ("LR01,type=LR", "CR01,type=CR,node=D-CHG02"), faults=faults)
        vehicles.wait_ready()
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        mcs = self.line.start_mcs([PLANS[0]])
        self.trace = self.line.folder / "trace"
        acsd = self.line.start_acsd(mcs.wait_ready()["ws"], arm, f"site.map={self.write_map(node_id)}",
                                    arguments=("--trace", self.trace))
        acsd.wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assertEqual(mcs.tail(2), ["1 carriers delivered, 0 misplaced", "1 plans completed, 0 failed"])
        self.line.forget(acsd)
        acsd.stop()  # else the last line of the trace may be half written

    def read_messages(self, direction, topic):
        for file in sorted(self.trace.iterdir()):
            for entry in map(json.loads, file.read_text().splitlines()):
                if entry["link"] == "mqtt" and entry["direction"] == direction \
                        and entry["topic"].endswith(f"/LR01/{topic}"):
                    yield json.loads(entry["text"])

    def read_last_states(self, action_type):
        """The last state of each action of the type, in the order of their first states."""
        states = {}
        for message in self.read_messages("in", "state"):
            for action in message["actionStates"]:
                if action["actionType"] == action_type:
                    states[action["actionId"]] = action["actionStatus"]
        return list(states.values())

    def read_drives(self):
        return [order for order in self.read_messages("out", "order")
                if order["orderUpdateId"] == 0 and len(order["nodes"]) > 1]

    def test_the_actions_of_the_map_are_performed_once_and_its_trajectory_is_sent(self):
        self.run_plan("N046")
        self.assertEqual(self.read_last_states("finePositioning"), ["FINISHED"])
        self.assertEqual(self.read_last_states("detectObject"), ["FINISHED"])
        edge = next(edge for edge in self.read_drives()[0]["edges"] if edge["edgeId"] == "N046-N047")
        self.assertEqual(edge["trajectory"], CURVE)

    def test_an_action_that_fails_at_a_station_is_repeated_before_the_job(self):
        self.run_plan("D-A01.CP01", "LR01 action-fails type=finePositioning")
        self.assertEqual(self.read_last_states("finePositioning"), ["FAILED", "FINISHED"])
        jobs = [order["nodes"][0]["actions"] for order in self.read_messages("out", "order") if len(order["nodes"]) == 1]
        self.assertEqual([action["actionType"] for actions in jobs for action in actions],
                         ["finePositioning", "pick", "drop"])


if __name__ == "__main__":
    main()
