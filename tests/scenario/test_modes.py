#!/usr/bin/env python3
"""A vehicle that is switched to manual mode or restarted has lost its order: its plan waits, and continues when it is back."""

import json
import signal
import unittest
import urllib.request

from scenario_case import FINISH_SECONDS, PLANS, STATUS_SECONDS, ScenarioCase, main

# Slow enough for a fault between two nodes, which are 2 m apart.
TIME_SCALE = 5
MAP_DEVIATION = 0.5
LR02 = """
[robots.LR02]
type = "LR"
manufacturer = "ACS"
serial = "LR02"
vehicle_type = "lr-base"
start_node = "N060"
ports = ["CP01"]
"""


class Modes(ScenarioCase):
    def post(self, path):
        request = urllib.request.Request(f"http://{self.http}{path}", method="POST")
        with urllib.request.urlopen(request, timeout=STATUS_SECONDS) as response:
            self.assertEqual(response.status, 202)

    def start_line(self, vehicles, *faults, overrides=(), tables=""):
        self.line.share_world()
        self.line.start_broker()
        started = [self.line.start_vehicles(TIME_SCALE, (vehicle,), faults=faults if vehicle.startswith("LR01") else ())
                   for vehicle in vehicles]
        for program in started:
            program.wait_ready()
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        self.mcs = self.line.start_mcs([PLANS[0]])
        self.trace = self.line.folder / "trace"
        site = self.line.site_dir
        config = self.line.folder / "acsd.toml"
        config.write_text((site / "acsd.toml").read_text().replace('"site.lif.json"', f'"{site / "site.lif.json"}"')
                          + tables)
        self.acsd = self.line.start_acsd(self.mcs.wait_ready()["ws"], arm, *overrides, config=config,
                                         arguments=("--trace", self.trace))
        self.http = self.acsd.wait_ready()["http"]
        return started[0]

    def finish(self, robot="LR01"):
        """The plan is completed, and everything was moved once, by this robot."""
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        self.assertEqual(self.mcs.tail(2), ["1 carriers delivered, 0 misplaced", "1 plans completed, 0 failed"])
        self.line.forget(self.acsd)
        self.acsd.stop()  # else the last line of the trace may be half written
        lines = (self.line.folder / "world.json.journal").read_text().splitlines()
        moves = [(event["from"], event["to"]) for event in map(json.loads, lines) if event["event"] == "CarrierMoved"]
        self.assertEqual(moves, [("A01.CP01", f"{robot}.CP01"), (f"{robot}.CP01", "A02.CP03")])

    def read_drives(self):
        """The nodes of each order to LR01 that is a drive, in the order of sending."""
        drives = []
        for file in sorted(self.trace.iterdir()):
            for entry in map(json.loads, file.read_text().splitlines()):
                if entry["link"] == "mqtt" and entry["direction"] == "out" and entry["topic"].endswith("/LR01/order"):
                    order = json.loads(entry["text"])
                    if order["orderUpdateId"] == 0 and len(order["nodes"]) > 1:
                        drives.append(order["nodes"])
        return drives

    def read_actions(self):
        """The actionType of each job order to LR01, in the order of sending."""
        types = []
        for file in sorted(self.trace.iterdir()):
            for entry in map(json.loads, file.read_text().splitlines()):
                if entry["link"] == "mqtt" and entry["direction"] == "out" and entry["topic"].endswith("/LR01/order"):
                    types += [action["actionType"] for node in json.loads(entry["text"])["nodes"]
                              for action in node["actions"]]
        return types

    def run_with_fault(self, fault):
        self.start_line(("LR01,type=LR", "CR01,type=CR,node=D-CHG02"), fault, overrides=("robot.load_timeout=1s",))
        self.finish()
        return self.read_drives()

    def assert_begins(self, nodes, *node_ids):
        self.assertEqual([node["nodeId"] for node in nodes[:len(node_ids)]], list(node_ids))

    def test_manual_mode_before_the_drive(self):
        drives = self.run_with_fault("LR01 mode for=3s")
        self.assert_begins(drives[0], "D-CHG01", "N045")
        self.assert_begins(drives[1], "D-A01.CP01", "N052")

    def test_manual_mode_on_a_node_of_the_drive(self):
        drives = self.run_with_fault("LR01 mode node=N046 for=2s")
        self.assert_begins(drives[0], "D-CHG01", "N045")
        self.assert_begins(drives[1], "N046", "N047")
        self.assert_begins(drives[2], "D-A01.CP01", "N052")

    def test_manual_mode_between_two_nodes_of_the_drive(self):
        drives = self.run_with_fault("LR01 mode node=N046 at=200ms for=2s")
        self.assert_begins(drives[1], "N046", "N047")
        self.assertGreater(drives[1][0]["nodePosition"]["allowedDeviationXY"], MAP_DEVIATION)
        self.assertEqual(drives[1][1]["nodePosition"]["allowedDeviationXY"], MAP_DEVIATION)

    def test_manual_mode_with_a_load_on_board(self):
        drives = self.run_with_fault("LR01 mode node=N060 for=2s")
        self.assert_begins(drives[1], "D-A01.CP01", "N052")
        self.assert_begins(drives[2], "N060", "N061")

    def test_manual_mode_at_the_dock_before_the_job(self):
        drives = self.run_with_fault("LR01 mode node=D-A01.CP01 for=2s")
        self.assert_begins(drives[1], "D-A01.CP01", "N052")

    def test_manual_mode_during_the_action(self):
        self.run_with_fault("LR01 mode node=D-A01.CP01 at=400ms for=2s")
        actions = self.read_actions()
        self.assertEqual(actions, ["pick", "pick", "drop"])

    def test_manual_mode_after_the_action(self):
        self.run_with_fault("LR01 mode node=N052 at=3s for=2s")
        self.assertEqual(self.read_actions(), ["pick", "drop"])

    def test_a_restart_during_the_drive(self):
        vehicle = self.start_line(("LR01,type=LR", "CR01,type=CR,node=D-CHG02"), "LR01 stuck node=N047 error=stuck level=WARNING")
        self.wait_for_status(self.http, lambda status: any(alarm["errorCode"] == "AGV-stuck" for alarm in status["alarms"]))
        self.line.forget(vehicle)
        vehicle.send_signal(signal.SIGKILL)
        vehicle.wait()
        self.line.start_vehicles(TIME_SCALE, ("LR01,type=LR,node=N047",)).wait_ready()
        self.finish()
        self.assert_begins(self.read_drives()[1], "N047", "N050")

    def test_a_vehicle_that_rejects_its_orders_is_unavailable_until_the_alarm_is_cleared(self):
        self.start_line(("LR01,type=LR", "CR01,type=CR,node=D-CHG02"), "LR01 refuse count=3")
        self.wait_for_status(self.http, lambda status: [
            (alarm["robotId"], alarm["level"]) for alarm in status["alarms"] if alarm["errorCode"] == "ACS-1012"
        ] == [("LR01", "heavy")])
        waits = self.read_status(self.http)["plans"][0]["waits"]["message"]
        self.assertIn("LR01: rejects its commands: the vehicle rejected the order", waits)
        self.post("/alarms/clear?robot=LR01&code=ACS-1012")
        self.finish()
        self.assertEqual(len([nodes for nodes in self.read_drives() if nodes[0]["nodeId"] == "D-CHG01"]), 4)

    def test_the_plan_of_a_vehicle_that_rejects_every_order_is_completed_by_another(self):
        self.start_line(("LR01,type=LR", "LR02,type=LR,node=N060", "CR01,type=CR,node=D-CHG02"), "LR01 refuse for=10m",
                        overrides=("tsc.initial=paused",), tables=LR02)
        self.wait_for_status(self.http, lambda status: all(
            robot["status"] not in ("Init", "Disconnected") for robot in status["robots"]))
        self.post("/tsc/resume")  # the nearest vehicle is LR01
        self.finish("LR02")
        self.assertEqual(len(self.read_drives()), 3)


if __name__ == "__main__":
    main()
