#!/usr/bin/env python3
"""What the map demands of vehicles: actions and trajectories are in orders, and an action that fails is repeated. Vehicles
that cannot do what it demands use other edges, or nothing is sent to them."""

import json
import shutil
import subprocess

from scenario_case import FINISH_SECONDS, PLANS, ScenarioCase, main

TIME_SCALE = 10
NODE_ACTION = {"actionType": "finePositioning", "requirementType": "REQUIRED", "blockingType": "HARD",
               "actionParameters": [{"key": "stationName", "value": "gate"}]}
EDGE_ACTION = {"actionType": "detectObject", "requirementType": "REQUIRED", "blockingType": "NONE",
               "actionParameters": [{"key": "objectType", "value": "cart"}]}
CURVE = {"degree": 2, "knotVector": [0, 0, 0, 1, 1, 1],
         "controlPoints": [{"x": 3.0, "y": 12.0}, {"x": 4.0, "y": 11.0}, {"x": 3.0, "y": 10.0}]}
# A way that is shorter than that of the example map, for vehicles that follow trajectories.
SHORT_CUT = {"edgeId": "N046-N050", "startNodeId": "N046", "endNodeId": "N050", "vehicleTypeEdgeProperties": [
    {"vehicleTypeId": "lr-base", "trajectory": {"degree": 1, "knotVector": [0, 0, 1, 1], "controlPoints": [
        {"x": 3.0, "y": 12.0}, {"x": 4.25, "y": 10.0}]}}]}
LINE_GUIDED = ("LR01,type=LR,profile=line-guided", "CR01,type=CR,node=D-CHG02")


class Map(ScenarioCase):
    def read_site(self):
        site = json.loads((self.line.site_dir / "site.lif.json").read_text())
        return site, site["layouts"][0]

    def write_map(self, node_id):
        """The example map with demands on the way of LR01 to its first station."""
        site, layout = self.read_site()
        node = next(node for node in layout["nodes"] if node["nodeId"] == node_id)
        edge = next(edge for edge in layout["edges"] if edge["edgeId"] == "N046-N047")
        node["vehicleTypeNodeProperties"][0]["actions"] = [NODE_ACTION]
        edge["vehicleTypeEdgeProperties"][0] |= {"actions": [EDGE_ACTION], "trajectory": CURVE}
        path = self.line.folder / "map.lif.json"
        path.write_text(json.dumps(site))
        return path

    def write_map_with_short_cut(self):
        site, layout = self.read_site()
        layout["edges"].append(SHORT_CUT)
        path = self.line.folder / "map.lif.json"
        path.write_text(json.dumps(site))
        return path

    def save_factsheet(self):
        """As a vehicle maker or an operator would: the retained factsheet of LR01 in a file."""
        binary = shutil.which("mosquitto_sub")
        self.assertIsNotNone(binary, "mosquitto_sub is missing; run scripts/setup")
        message = subprocess.run([binary, "-p", str(self.line.broker_port), "-t", "uagv/v2/ACS/LR01/factsheet", "-C", "1"],
                                 check=True, timeout=FINISH_SECONDS, stdout=subprocess.PIPE)
        path = self.line.folder / "factsheet.json"
        path.write_bytes(message.stdout)
        return path

    def start_vehicles(self, vehicles=("LR01,type=LR", "CR01,type=CR,node=D-CHG02"), faults=()):
        self.line.share_world()
        self.line.start_broker()
        self.line.start_vehicles(TIME_SCALE, vehicles, faults=faults).wait_ready()

    def start_acsd(self, *overrides):
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        self.mcs = self.line.start_mcs([PLANS[0]])
        self.trace = self.line.folder / "trace"
        self.acsd = self.line.start_acsd(self.mcs.wait_ready()["ws"], arm, *overrides, arguments=("--trace", self.trace))
        self.operator = self.acsd.wait_ready()["operator"]

    def finish(self):
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        self.assertEqual(self.mcs.tail(2), ["1 carriers delivered, 0 misplaced", "1 plans completed, 0 failed"])
        self.line.forget(self.acsd)
        self.acsd.stop()  # else the last line of the trace may be half written

    def run_plan(self, node_id, *faults):
        self.start_vehicles(faults=faults)
        self.start_acsd(f"site.map={self.write_map(node_id)}")
        self.finish()

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

    def read_driven_edges(self):
        return [edge["edgeId"] for order in self.read_messages("out", "order") for edge in order["edges"]]

    def test_a_vehicle_that_follows_trajectories_takes_the_short_cut(self):
        self.start_vehicles()
        self.start_acsd(f"site.map={self.write_map_with_short_cut()}")
        self.finish()
        self.assertIn("N046-N050", self.read_driven_edges())

    def test_edges_that_a_factsheet_file_does_not_allow_are_closed(self):
        self.start_vehicles(LINE_GUIDED)
        overrides = (f"site.map={self.write_map_with_short_cut()}", f"robots.LR01.factsheet_file={self.save_factsheet()}")
        self.start_acsd(*overrides)
        self.assertIn("lr-base does not use the edges N046-N050, because the factsheet of robots.LR01 does not allow what "
                      "the map demands there: the vehicle does not support order.edges.trajectory", self.acsd.log.read_text())
        self.finish()
        self.assertNotIn("N046-N050", self.read_driven_edges())
        self.assertIn("N047-N050", self.read_driven_edges())

    def test_nothing_is_sent_to_a_vehicle_whose_factsheet_does_not_allow_what_the_map_demands(self):
        self.start_vehicles(LINE_GUIDED)
        self.start_acsd(f"site.map={self.write_map_with_short_cut()}")
        self.wait_for_status(self.operator, lambda status: [
            (alarm["robotId"], alarm["level"]) for alarm in status["alarms"] if alarm["errorCode"] == "ACS-1013"
        ] == [("LR01", "heavy")] and status["plans"])
        status = self.read_status(self.operator)
        (alarm,) = [alarm for alarm in status["alarms"] if alarm["errorCode"] == "ACS-1013"]
        self.assertIn("the drive from N046 to N050 cannot be ordered: the vehicle does not support order.edges.trajectory",
                      alarm["message"])
        (plan,) = status["plans"]
        self.assertEqual(plan["status"], "Pending")
        self.line.forget(self.acsd)
        self.acsd.stop()
        self.assertEqual(self.read_driven_edges(), [])


if __name__ == "__main__":
    main()
