#!/usr/bin/env python3
"""Instant actions that an operator requests: acsd validates them, sends them to a real vehicle of vda-sim and shows their outcome."""

import json
import shutil
import signal
import subprocess
import urllib.request

from acsctl_case import AcsctlCase
from scenario_case import STATUS_SECONDS, TIME_SCALE, main
from production_line import find_free_port  # which scenario_case makes known

OFFERED = ["deleteMap", "downloadMap", "enableMap", "factsheetRequest", "initPosition", "logReport", "stateRequest"]
PROTOCOL = "2.1.0"  # with the actions of maps


class Actions(AcsctlCase):
    def setUp(self):
        super().setUp()
        self.line.start_broker()
        self.start_vehicles()
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        protocols = [f'robots.{robot_id}.protocol="{PROTOCOL}"' for robot_id in ("LR01", "CR01")]
        acsd = self.line.start_acsd(f"127.0.0.1:{find_free_port()}", arm, *protocols)
        self.use_acsd(acsd.wait_ready()["operator"])
        self.wait_for_robot("LR01", "Idle")
        with urllib.request.urlopen(self.environment["ACSCTL_URL"] + "/v1/snapshot", timeout=STATUS_SECONDS) as answer:
            self.first_event = json.load(answer)["eventId"]

    def start_vehicles(self, *options):
        vehicles = ("LR01,type=LR", "CR01,type=CR")
        self.vehicles = self.line.start_vehicles(TIME_SCALE, vehicles, options=("--protocol", PROTOCOL, *options))
        self.vehicles.wait_ready()

    def switch_vehicles_off(self):
        """As by a power failure."""
        self.line.forget(self.vehicles)
        self.vehicles.send_signal(signal.SIGKILL)
        self.vehicles.stop()

    def command_vehicles(self, line):
        binary = shutil.which("mosquitto_pub")
        self.assertIsNotNone(binary, "mosquitto_pub is missing; run scripts/setup")
        subprocess.run([binary, "-p", str(self.line.broker_port), "-q", "1", "-t", "vda-sim/control", "-m", line], check=True,
                       timeout=STATUS_SECONDS)

    def act(self, code, *arguments):
        return self.check(code, "action", "--yes", *arguments)

    def read_last(self, robot_id="LR01"):
        return self.read("actions", robot_id)["actions"][-1]

    def list_entries(self):
        """The texts of the events `action`."""
        events = map(json.loads, self.check(0, "events", "--json", "--after", self.first_event).splitlines())
        return [event["data"]["text"] for event in events if event["data"]["kind"] == "action"]

    def make_pose(self, **changes):
        """Where LR01 is, as the parameters of initPosition."""
        robot = self.read("robot", "LR01")
        (map_id,) = {node["mapId"] for node in self.read("site")["nodes"] if node["nodeId"] == robot["node"]}
        values = robot["pose"] | {"mapId": map_id, "lastNodeId": robot["node"]} | changes
        return [f"{key}={value}" for key, value in values.items()]

    def test_actions_are_performed_and_recorded(self):
        self.assertEqual([offer["actionType"] for offer in self.read("actions", "LR01")["offered"]], OFFERED)
        self.assertEqual(self.act(0, "LR01", "stateRequest", "--reason", "a test"), "stateRequest of LR01: Finished\n")
        self.assertEqual(self.act(0, "CR01", "factsheetRequest"), "factsheetRequest of CR01: Finished\n")
        self.assertIn("logReport of LR01: Finished: ", self.act(0, "LR01", "logReport", "reason=7"))
        last = self.read_last()
        self.assertEqual((last["actionType"], last["parameters"], last["status"]), ("logReport", {"reason": "7"}, "Finished"))
        version = ("mapId=cellar", "mapVersion=2")
        self.act(0, "LR01", "downloadMap", *version, "mapDownloadLink=http://127.0.0.1/cellar")
        self.act(0, "LR01", "enableMap", *version)
        self.act(5, "LR01", "deleteMap", "mapId=attic", "mapVersion=1")
        entries = self.list_entries()
        self.assertEqual(entries[:2], ["action stateRequest of LR01: requested: a test", "action stateRequest of LR01: Finished"])
        self.assertEqual(len(entries), 12)
        self.assertTrue(entries[-1].startswith("action deleteMap of LR01: Failed"), entries)
        line = self.read("audit", "--limit", "1")
        self.assertEqual((line["request"], line["status"]), ("/v1/robots/LR01/actions", 202))
        self.assertEqual(json.loads(line["body"])["actionType"], "deleteMap")
        self.environment["COLUMNS"] = "80"
        for command in (("actions", "LR01"), ("actions", "CR01")):
            self.assertLessEqual(max(map(len, self.check(0, *command).splitlines())), 80)

    def test_an_invalid_action_is_refused_with_what_is_allowed(self):
        sentence = self.act(1, "LR01", "initPosition", "x=1", "y=2", "theta=0", "mapId=M")
        self.assertIn("The parameter lastNodeId of initPosition is missing. Its parameters: x (NUMBER), y (NUMBER)", sentence)
        self.assertIn("the type NUMBER, found", self.act(1, "LR01", "initPosition", *self.make_pose(x="here")))
        self.assertIn('stateRequest has no parameter "x"', self.act(1, "LR01", "stateRequest", "x=1"))
        self.assertIn(f"It has: {', '.join(OFFERED)}.", self.act(1, "LR01", "selfDestruct"))
        for action, command in (("cancelOrder", "acsctl abort PLAN"), ("startPause", "acsctl pause PLAN"),
                                ("stopPause", "acsctl resume PLAN"), ("startCharging", "robots.NAME.charge"),
                                ("stopCharging", "charges its robots itself")):
            self.assertIn(command, self.act(1, "LR01", action))
        self.assertIn('There is no robot "LR09"', self.act(1, "LR09", "stateRequest"))
        self.assertIn("needs --yes", self.check(2, "action", "LR01", "stateRequest"))
        self.assertEqual((self.list_entries(), self.read("actions", "LR01")["actions"]), ([], []))

    def test_an_unavailable_robot_accepts_actions(self):
        self.assertIn("Failed", self.act(5, "LR01", "initPosition", *self.make_pose(x=1e9)))
        pose = self.make_pose()
        self.command_vehicles("LR01 lost")
        self.wait_for_robot("LR01", "Error")
        self.assertEqual(self.act(0, "LR01", "initPosition", *pose), "initPosition of LR01: Finished\n")
        self.wait_for_robot("LR01", "Idle")
        self.check(0, "maintenance", "LR01", "on")
        self.wait_for_robot("LR01", "Stopped")
        self.act(0, "LR01", "logReport", "reason=maintenance")
        self.check(0, "maintenance", "LR01", "off", "--yes")
        self.wait_for_robot("LR01", "Idle")
        self.command_vehicles("LR01 mode mode=SERVICE")
        self.wait_for_robot("LR01", "Manual")
        self.assertIn("SERVICE", self.act(1, "LR01", "logReport", "reason=mode"))
        self.act(0, "LR01", "stateRequest")

    def test_a_vehicle_that_is_switched_off_loses_its_actions(self):
        self.switch_vehicles_off()
        self.start_vehicles("--action-time", "logReport=10h")
        self.wait_for_robot("LR01", "Idle")
        self.assertIn("is sent to LR01", self.act(0, "LR01", "logReport", "reason=long", "--no-wait"))
        self.wait_until(lambda: self.read_last()["status"] == "Running", "the action is performed")
        self.assertEqual(self.read("robot", "LR01")["status"], "Idle")  # beside which it can work
        self.switch_vehicles_off()
        self.wait_for_robot("LR01", "Disconnected")
        self.assertIn("The robot is not connected.", self.act(1, "LR01", "stateRequest"))
        self.start_vehicles()
        self.wait_until(lambda: self.read_last()["status"] == "Unknown", "the action is lost")
        self.assertIn("no longer reports", self.read_last()["resultDescription"])
        self.assertIn("Unknown", self.list_entries()[-1])
        self.wait_for_robot("LR01", "Idle")
        self.act(0, "LR01", "stateRequest")


if __name__ == "__main__":
    main()
