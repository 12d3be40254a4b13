#!/usr/bin/env python3
"""Faults of a real line: acsctl why names the cause and the remedy of each, and nothing after it."""

import json
import pathlib
import subprocess
import urllib.request

from link_proxy import LinkProxy
from mcs_stub import McsStub
from plan_samples import make_carrying_plan, make_tray_memory_plan
from scenario_case import FINISH_SECONDS, REPOSITORY, STATUS_SECONDS, TIME_SCALE, ScenarioCase, main
import operator_api  # which scenario_case makes known

UPDATES = 5  # of the event feed, from the first with the fault on
RUNBOOK = REPOSITORY / "docs" / "runbook"


class Why(ScenarioCase):
    def start_line(self, make_port=lambda port: port):
        """The base of LR01 is connected at a port of its own."""
        self.stub = McsStub()
        self.addCleanup(self.stub.close)
        self.line.start_broker()
        vehicles = [self.line.start_vehicles(TIME_SCALE, (vehicle,), port=port) for vehicle, port in (
            ("LR01,type=LR", make_port(self.line.broker_port)), ("CR01,type=CR,node=D-A02.CP01", self.line.broker_port))]
        self.arm = self.line.start_arm(TIME_SCALE).wait_ready()
        for vehicle in vehicles:
            vehicle.wait_ready()
        self.acsd = self.line.start_acsd(self.stub.address, self.arm)
        self.address = self.acsd.wait_ready()["operator"]
        for robot in ("LR01", "CR01"):
            self.stub.wait_for("RobotStatusUpdate", lambda message, robot=robot: message.payload["robotId"] == robot
                               and message.payload["robotStatus"] == "Idle")
        self.assertFalse(self.explain()["needsAttention"])

    def start_plan(self, plan):
        self.assertEqual(self.stub.ask("ExecutionPlan", plan)["result"], "Success")
        self.stub.wait_for("PlanReport", lambda message: message.payload["planId"] == plan["planId"]
                           and message.payload["status"] == "InProgress")

    def explain(self, *subject):
        result = subprocess.run([self.line.bin_dir / "acsctl", "--url", f"http://{self.address}", "why", *subject, "--json"],
                                capture_output=True, text=True, timeout=STATUS_SECONDS)
        self.assertEqual(result.stderr, "")
        return json.loads(result.stdout)

    def read_changes(self):
        """The changes of the event feed from now on, as they come."""
        with urllib.request.urlopen(f"http://{self.address}/v1/snapshot", timeout=STATUS_SECONDS) as response:
            after = json.load(response)["eventId"]
        with urllib.request.urlopen(f"http://{self.address}/v1/events?after={after}", timeout=FINISH_SECONDS) as feed:
            event = None
            for line in feed:
                if line.startswith(b"event: "):
                    event = line[7:].strip()
                elif line.startswith(b"data: ") and event == b"changes":
                    yield json.loads(line[6:])

    @staticmethod
    def list_texts(explanation):
        """Of each cause: its text, its cause and its remedies, as acsctl prints them."""
        return [" ".join([cause["text"], cause["cause"] or "", *cause["remedy"]])
                for finding in explanation["findings"] for cause in finding["causes"]]

    def check_explained(self, changes, has_fault, plan, cause, remedy, code=None):
        """After the fault is in the feed, each explanation has one entry with the cause and the remedy within a few updates."""
        for change in changes:
            if has_fault(change):
                break
        missing = [plan, None]
        for _ in range(UPDATES):
            missing = [subject for subject in missing if not any(
                cause in text and remedy in text for text in self.list_texts(self.explain(*filter(None, [subject]))))]
            if not missing:
                break
            next(changes)
        self.assertEqual(missing, [], [self.list_texts(self.explain(*filter(None, [subject]))) for subject in missing])
        if code is not None:
            alarm = next(alarm for alarm in self.read_status(self.address)["alarms"] if alarm["errorCode"] == code)
            self.assertTrue(alarm["cause"] and alarm["remedy"])
            for language in ("en", "ko"):
                self.assertTrue(pathlib.Path(RUNBOOK / language / f"{code}.md").exists())

    def check_over(self, *plans):
        """The plans complete, and nothing is left to explain."""
        for plan in plans:
            self.stub.wait_for("PlanReport", lambda message, plan=plan: message.payload["planId"] == plan
                               and message.payload["status"] == "Completed")
        self.wait_for_status(self.address, lambda status: not status["notReadyReasons"] and not status["alarms"])
        explanation = self.explain()
        self.assertFalse(explanation["needsAttention"], explanation)

    def test_a_vehicle_is_lost(self):
        proxies = []

        def make_port(port):
            proxies.append(LinkProxy(port))
            self.addCleanup(proxies[0].close)
            return proxies[0].port

        self.start_line(make_port)
        self.start_plan(make_carrying_plan("P1"))
        changes = self.read_changes()
        next(changes)
        proxies[0].cut()
        self.check_explained(changes, lambda change: any(alarm["errorCode"] == "ACS-1002" for alarm in change.get("alarms", [])),
                             "P1", "ACS-1002 Robot disconnected of LR01", "Check power, network and broker", "ACS-1002")
        proxies[0].mend()
        self.check_over("P1")

    def press_emergency_stop(self, value):
        request = urllib.request.Request(f"http://{self.arm['http']}/project/robot/emergency_stop",
                                         data=json.dumps({"val": value}).encode(), headers={"Content-Type": "application/json"})
        urllib.request.urlopen(request, timeout=STATUS_SECONDS).close()

    def test_the_emergency_stop_of_an_arm_is_pressed(self):
        self.start_line()
        changes = self.read_changes()
        self.press_emergency_stop(1)
        for change in changes:
            if any(alarm["errorCode"] == "ARM-motorOff" for alarm in change.get("alarms", [])):
                break
        self.assertEqual(self.stub.ask("ExecutionPlan", make_tray_memory_plan("P1", 2))["result"], "Success")
        self.check_explained(changes, lambda _: True, "P1", "ARM-motorOff Arm motor off of CR01",
                             "Release the emergency stop", "ARM-motorOff")
        self.press_emergency_stop(0)
        self.check_over("P1")


if __name__ == "__main__":
    main()
