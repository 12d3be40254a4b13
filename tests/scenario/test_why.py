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
            return self.follow_changes(json.load(response)["eventId"])

    def follow_changes(self, after):
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

    def test_the_broker_is_gone(self):
        self.start_line()
        self.start_plan(make_carrying_plan("P1"))
        changes = self.read_changes()
        port = self.line.broker_port
        self.line.forget(self.line.broker)
        self.line.broker.stop()
        self.check_explained(
            changes, lambda change: any(link["name"] == "mqtt" and not link["up"] for link in
                                        change.get("status", {}).get("links", [])),
            "P1", "The link mqtt is down", "Check the MQTT broker and the network to it.")
        self.line.start_broker(port)
        self.check_over("P1")

    def test_the_mcs_refuses_the_registration(self):
        self.start_line()
        self.start_plan(make_carrying_plan("P1"))
        changes = self.read_changes()
        self.stub.refused = ("Registration",)
        self.stub.reset_link()
        self.check_explained(
            changes, lambda change: any(not link["up"] and "Refused by the test" in (link["reason"] or "") for link in
                                        change.get("status", {}).get("links", [])),
            "P1", "Refused by the test", "it must accept the registration of this ACS")
        self.stub.refused = ()
        self.check_over("P1")

    def test_the_mcs_refuses_reports(self):
        self.start_line()
        self.stub.refused = ("JobReport", "StepReport")
        changes = self.read_changes()
        self.assertEqual(self.stub.ask("ExecutionPlan", make_carrying_plan("P1"))["result"], "Success")
        self.check_explained(changes, lambda change: change.get("status", {}).get("refusedReports", {}).get("count", 0) > 0,
                             "P1", "of plan P1: Refused by the test.", "Correct the plan in the MCS")
        self.stub.refused = ()
        self.check_over("P1")

    def test_an_edge_is_blocked(self):
        self.start_line()
        with urllib.request.urlopen(f"http://{self.address}/v1/site", timeout=STATUS_SECONDS) as response:
            site = json.load(response)
        docks = next(station["nodeIds"] for station in site["stations"] if station["stationId"] == "A01.CP01")
        edges = [edge["edgeId"] for edge in site["edges"] if edge["endNodeId"] in docks]
        for edge in edges:
            answer = operator_api.post(self.address, "/v1/site/block", {"kind": "edge", "id": edge, "reason": "wet floor"})
            self.assertEqual(answer[0], 202, answer)
        changes = self.read_changes()
        self.assertEqual(self.stub.ask("ExecutionPlan", make_carrying_plan("P1"))["result"], "Success")
        self.check_explained(changes, lambda change: any(plan["waits"] for plan in change.get("plans", [])),
                             "P1", f"Edge {edges[0]} is blocked", f"acsctl unblock edge {edges[0]}")
        for edge in edges:
            self.assertEqual(operator_api.post(self.address, "/v1/site/unblock", {"kind": "edge", "id": edge})[0], 202)
        self.check_over("P1")

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
