#!/usr/bin/env python3
"""Faults of a real line: acsctl why names the cause and the remedy of each, and nothing after it."""

import json
import pathlib
import shutil
import signal
import sqlite3
import subprocess

from line_faults import (ArmMotorOff, BrokerGone, DiskFull, EdgeBlocked, FaultCase, RegistrationRefused, ReportsRefused,
                         StationBlocked, VehicleKilled, VehicleLost)
from plan_samples import make_carrying_plan
from scenario_case import REPOSITORY, STATUS_SECONDS, main

COMMANDS = 3  # of an operator while the disk is full
UPDATES = 5  # of the event feed, from the first with the fault on
RUNBOOK = REPOSITORY / "docs" / "runbook"


class WhyCase(FaultCase):
    def explain(self, *subject):
        result = subprocess.run([self.line.bin_dir / "acsctl", "--url", f"http://{self.address}", "why", *subject, "--json"],
                                capture_output=True, text=True, timeout=STATUS_SECONDS)
        self.assertEqual(result.stderr, "")
        return json.loads(result.stdout)

    @staticmethod
    def list_texts(explanation):
        """Of each cause: its text, its cause and its remedies, as acsctl prints them."""
        return [" ".join([cause["text"], cause["cause"] or "", *cause["remedy"]])
                for finding in explanation["findings"] for cause in finding["causes"]]

    def check_explained(self, fault):
        """Each explanation has one entry with the cause and the remedy within a few updates from the fault on."""
        changes = self.begin(fault)
        missing = [fault.plans[-1], None]
        for _ in range(UPDATES):
            missing = [subject for subject in missing if not any(
                fault.cause in text and fault.remedy in text
                for text in self.list_texts(self.explain(*filter(None, [subject]))))]
            if not missing:
                break
            next(changes)
        self.assertEqual(missing, [], [self.list_texts(self.explain(*filter(None, [subject]))) for subject in missing])
        if fault.code is not None:
            alarm = next(alarm for alarm in self.read_status(self.address)["alarms"] if alarm["errorCode"] == fault.code)
            self.assertTrue(alarm["cause"] and alarm["remedy"])
            for language in ("en", "ko"):
                self.assertTrue(pathlib.Path(RUNBOOK / language / f"{fault.code}.md").exists())

    def start(self, kind):
        fault = kind(self)
        fault.start()
        self.assertEqual([finding for finding in self.explain()["findings"] if finding["subject"] == "acsd"
                          and finding["needsAttention"]], [])
        return fault

    def end(self, fault):
        fault.end()
        self.wait_until_over(fault)
        explanation = self.explain()
        self.assertFalse(explanation["needsAttention"], explanation)

    def check(self, kind):
        fault = self.start(kind)
        self.check_explained(fault)
        self.end(fault)


class Why(WhyCase):
    def test_the_broker_is_gone(self):
        self.check(BrokerGone)

    def test_the_mcs_refuses_the_registration(self):
        self.check(RegistrationRefused)

    def test_the_mcs_refuses_reports(self):
        self.check(ReportsRefused)

    def test_an_edge_is_blocked(self):
        self.check(EdgeBlocked)

    def test_a_robot_waits_for_a_blocked_station(self):
        self.check(StationBlocked)

    def test_a_vehicle_is_lost(self):
        self.check(VehicleLost)

    def read_connection_state(self, robot):
        """As the broker has retained it."""
        binary = shutil.which("mosquitto_sub")
        self.assertIsNotNone(binary, "mosquitto_sub is missing; run scripts/setup")
        topic = self.read_json(f"/v1/robots/{robot}")["topic"]
        message = subprocess.run([binary, "-p", str(self.line.broker_port), "-t", f"{topic}/connection", "-C", "1"], check=True,
                                 capture_output=True, timeout=STATUS_SECONDS).stdout
        return json.loads(message)["connectionState"]

    def test_the_program_of_a_vehicle_is_killed(self):
        fault = self.start(VehicleKilled)
        self.check_explained(fault)
        self.assertEqual(self.read_connection_state("LR01"), "CONNECTIONBROKEN")
        self.end(fault)

    def test_the_emergency_stop_of_an_arm_is_pressed(self):
        self.check(ArmMotorOff)


class FullDisk(WhyCase):
    def check_refused(self, fault):
        """Whatever a crash would lose; what only stops work is accepted."""
        answer = self.post("/v1/plans/P2/priority", {"priority": 7}, 503)
        self.assertIn("it would be lost in a crash", answer["error"])
        self.assertIn(fault.remedy, answer["error"])
        self.post("/v1/robots/CR01/maintenance", {"on": False}, 503)
        ack = self.stub.ask("ExecutionPlan", make_carrying_plan("P3"))
        self.assertEqual(ack["result"], "Fail", ack)
        self.assertIn(fault.remedy, ack["message"])
        self.assertEqual(self.stub.ask("AbortPlan", {"planId": "P1"})["result"], "Fail")
        self.assertIn("This is not stored", self.post("/v1/site/block", {"kind": "node", "id": "N001"})["message"])

    @staticmethod
    def count_audited(fault):
        """Commands that the files of the audit log have or, because they are on the same disk, state as lost."""
        lines = [line for path in (fault.directory / "audit").iterdir() for line in path.read_text().splitlines()]
        return sum(json.loads(line).get("lost", 1) for line in lines)

    def list_reports(self, start=0):
        return [message for message in self.stub.get(start) if message.command in ("PlanReport", "StepReport", "JobReport")]

    def test_the_disk_is_full(self):
        fault = self.start(DiskFull)
        self.check_explained(fault)
        status = self.read_json("/v1/status")
        self.assertFalse(status["ready"])
        (reason,) = status["notReadyReasons"]
        self.assertIn("the store cannot be written", reason)
        self.assertIn(fault.remedy, reason)
        self.check_refused(fault)
        self.assertEqual(self.count_audited(fault), 0)

        # The plan in progress ends. Its reports wait, and no plan is started.
        start = self.stub.count()
        self.wait_for_status(self.address, lambda status: [plan["planId"] for plan in status["plans"]] == ["P2"])
        self.assertEqual(self.read_json("/v1/plans/P1")["status"], "Completed")
        (plan,) = self.read_status(self.address)["plans"]
        self.assertEqual(plan["waits"]["message"], "The store is failing: no plan is started until it works again.")
        self.assertEqual(self.list_reports(start), [])

        fault.end()
        self.wait_until_over(fault)
        self.assertEqual(self.stub.ask("ExecutionPlan", make_carrying_plan("P3"))["result"], "Success")
        self.wait_for_plan("P3", "Completed")
        self.wait_until(lambda: self.count_audited(fault) == COMMANDS, "the audit log does not state a command")

        # Nothing is lost: every report came once, and a crash now finds everything stored.
        reports = [json.dumps(message.payload | {"command": message.command}, sort_keys=True) for message in self.list_reports()]
        self.assertEqual(len(reports), len(set(reports)))
        self.stub.wait_until_acks_are_read()
        self.line.forget(self.acsd)
        self.acsd.send_signal(signal.SIGKILL)
        self.acsd.stop()
        with sqlite3.connect(f"file:{fault.directory}/acsd.db?mode=ro", uri=True) as store:
            plans = dict(store.execute("SELECT plan_id, state FROM plans"))
        store.close()
        self.assertEqual(plans, {plan: "Completed" for plan in ("P1", "P2", "P3")})
        self.acsd = self.line.start_acsd(self.stub.address, self.arm)
        self.address = self.acsd.wait_ready()["operator"]
        self.assertEqual([(block["kind"], block["id"]) for block in self.read_json("/v1/site")["blocked"]], [("node", "N001")])
        self.assertEqual(self.read_json("/v1/plans")["plans"], [])

    def test_a_full_disk_that_is_found_when_a_file_is_synchronised_has_the_same_remedy(self):
        fault = self.start(DiskFull)
        fault.begin("fdatasync")
        self.wait_for_status(self.address, lambda status: any(fault.remedy in reason for reason in status["notReadyReasons"]))
        self.end(fault)


if __name__ == "__main__":
    main()
