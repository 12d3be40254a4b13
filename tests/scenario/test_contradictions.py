#!/usr/bin/env python3
"""A vehicle whose states contradict its order or the map: reported, counted and survived, and never two vehicles in one place.

The vehicle is held at a node and does not publish; the test publishes a state of its own in its name instead.
"""

import datetime
import json
import shutil
import subprocess
import time
import urllib.request

from scenario_case import STATUS_SECONDS, main
from traced_line import VEHICLES, TracedLineCase

HELD = ("LR01 stuck node=N047 for=4s error=held level=WARNING", "LR01 silence topic=state node=N047 at=100ms for=4s")
SILENT_AFTER = 0.3  # s
FORGED = 1_000_000  # first headerId of a state of the test
OTHER_NODE = "N060"
LR02 = f"""
[robots.LR02]
type = "LR"
manufacturer = "ACS"
serial = "LR02"
vehicle_type = "lr-base"
start_node = "{OTHER_NODE}"
ports = ["CP01"]
"""


class Contradictions(TracedLineCase):
    def start_held(self, vehicles=VEHICLES, tables=""):
        self.start_line(*HELD, vehicles=vehicles, tables=tables, overrides=("tsc.initial=paused",))
        self.resume_with_all_vehicles()
        self.wait_for_error("held")
        time.sleep(SILENT_AFTER)

    def forge_state(self, **changes):
        state = self.find_last_state()
        now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%S.%f")[:-3] + "Z"
        state.update(changes, headerId=state["headerId"] + FORGED, timestamp=now)
        binary = shutil.which("mosquitto_pub")
        self.assertIsNotNone(binary, "mosquitto_pub is missing; run scripts/setup")
        subprocess.run([binary, "-p", str(self.line.broker_port), "-q", "1", "-t", "uagv/v2/ACS/LR01/state", "-m",
                        json.dumps(state)], check=True, timeout=10)

    def wait_for_oddity(self, kind):
        def is_counted():
            with urllib.request.urlopen(f"http://{self.http}/metrics", timeout=STATUS_SECONDS) as response:
                return f'acsd_robot_oddities_total{{kind="{kind}",robot="LR01"}} 1\n' in response.read().decode()

        self.wait_for(is_counted, kind)
        self.assertRegex(self.acsd.log.read_text(), f"warning.*contradiction.*{kind}")

    def finish(self, robot="LR01"):
        super().finish(robot)
        nodes = {}
        for direction, vehicle, topic, message in self.read_trace():
            if topic == "state" and message["headerId"] < FORGED:
                nodes[vehicle] = message["lastNodeId"]
            elif topic == "order" and direction == "out":
                taken = {node for other, node in nodes.items() if other != vehicle}
                released = {node["nodeId"] for node in message["nodes"] if node["released"]}
                self.assertEqual(released & taken, set(), f"{vehicle}: {message}")

    def test_an_unknown_operating_mode(self):
        self.start_held()
        self.forge_state(operatingMode="STARTUP")
        self.wait_for_oddity("unreadable_message")
        self.assertRegex(self.acsd.log.read_text(), "operatingMode.*STARTUP")
        self.finish()
        self.assert_begins(self.read_drives()[1], "D-A01.CP01", "N052")

    def test_a_position_that_jumps(self):
        self.start_held()
        position = self.find_last_state()["agvPosition"]
        self.forge_state(agvPosition={**position, "x": position["x"] + 20})
        self.wait_for_oddity("far_from_node")
        self.finish()
        self.assert_begins(self.read_drives()[1], "D-A01.CP01", "N052")

    def test_a_vehicle_that_reports_the_node_of_another(self):
        self.start_held(vehicles=(VEHICLES[0], f"LR02,type=LR,node={OTHER_NODE}", VEHICLES[1]), tables=LR02)
        self.forge_state(lastNodeId=OTHER_NODE)
        self.wait_for_status(self.operator, lambda status: [
            alarm["robotId"] for alarm in status["alarms"] if alarm["errorCode"] == "ACS-1003"] == ["LR01"])
        self.finish()

    def test_a_state_of_another_order(self):
        self.start_held()
        self.forge_state(orderId="OTHER", orderUpdateId=0)
        self.wait_for(lambda: "cancelOrder" in [
            action["actionType"] for message in self.read_messages("out", "instantActions")
            for action in message["actions"]], "the order of another master is cancelled")
        self.finish()

    def test_an_order_that_was_accepted_and_dropped_in_silence(self):
        self.start_line("LR01 silence topic=state node=N047 at=100ms for=3s", "LR01 mode node=N047 for=1s at=200ms")
        self.finish()
        self.assertNotIn("MANUAL", [state["operatingMode"] for state in self.read_messages("in", "state")])
        self.assertGreater(len(self.read_drives()), 2)


if __name__ == "__main__":
    main()
