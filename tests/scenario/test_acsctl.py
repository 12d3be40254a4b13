#!/usr/bin/env python3
"""acsctl against an operator API that only answers: what each command prints, sends and returns."""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from operator_mock import PLANS, ROBOTS, OperatorMock

SECONDS = 30


class AcsctlCase(unittest.TestCase):
    bin_dir = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.mock = self.enterContext(OperatorMock())
        self.environment = {"PATH": os.environ["PATH"], "HOME": str(self.folder), "ACSCTL_URL": self.mock.url}

    def run_acsctl(self, *arguments, **options):
        return subprocess.run([self.bin_dir / "acsctl", *map(str, arguments)], capture_output=True, text=True,
                              env=self.environment, timeout=SECONDS, stdin=subprocess.DEVNULL, **options)

    def check(self, code, *arguments):
        """The standard output of a run with this exit code; with an error one line on standard error and no output."""
        result = self.run_acsctl(*arguments)
        self.assertEqual(result.returncode, code, (arguments, result.stdout, result.stderr))
        if code in (0, 5):
            self.assertEqual(result.stderr, "")
            return result.stdout
        self.assertEqual((result.stdout, result.stderr.count("\n")), ("", 1), arguments)
        return result.stderr


class Reading(AcsctlCase):
    def test_tables_fit_80_columns(self):
        for command in (("status",), ("plans",), ("plan", "PLAN_1"), ("robots",), ("robot", "LR01"), ("alarms",), ("links",),
                        ("queue",), ("site",), ("trace",), ("audit",)):
            output = self.check(0, *command)
            self.assertLessEqual(max(map(len, output.splitlines())), 80, command)
            self.assertNotIn("\x1b", output)

    def test_a_table_has_what_the_api_answered(self):
        lines = self.check(0, "plans").splitlines()
        self.assertEqual(lines[0].split(), ["PLAN", "STATUS", "ROBOT", "STEP", "PRIO", "AGE", "LOT", "REASON"])
        self.assertEqual(lines[1].split()[:3] + lines[2].split()[:3], ["PLAN_1", "InProgress", "LR01", "PLAN_2", "Pending", "-"])
        self.assertIn("No suitable robot", lines[2])
        status = self.check(0, "status")
        for text in ("0.1.0, running for 3 h 10 min", "no: The MQTT broker is not connected.",
                     "down for 3 s: connection refused", "Paused: Paused by kim.", "2: 1 Moving, 1 Stopped",
                     "1 heavy, 0 light", "3 reports without an Ack, the oldest for 10 s", "PlanReport of plan PLAN_1"):
            self.assertIn(text, status)
        self.assertIn("[N2] N3", self.check(0, "robot", "LR01"))
        self.assertIn("ACS-1002", self.check(0, "alarms"))

    def test_json_is_the_answer_of_the_api(self):
        self.assertEqual(json.loads(self.check(0, "plans", "--json")), {"plans": PLANS})
        self.assertEqual(json.loads(self.check(0, "robot", "LR02", "--json")), ROBOTS[1])
        self.assertEqual(len(self.check(0, "trace", "--json").splitlines()), 3)
        self.assertEqual([json.loads(line)["name"] for line in self.check(0, "--json", "audit").splitlines()], ["kim"])

    def test_options_become_the_query(self):
        self.check(0, "plans", "--state", "finished", "--robot", "LR 01", "--lot", "A&B", "--limit", "7")
        self.check(0, "trace", "--transaction", "T/1", "--limit", "1000")
        self.assertEqual(self.mock.requests[0]["query"], {"state": "finished", "robot": "LR 01", "lot": "A&B", "limit": "7"})
        self.assertEqual(self.mock.requests[1]["query"], {"transaction": "T/1", "limit": "1000"})
        self.check(1, "plan", "A/B?")
        self.assertEqual(self.mock.requests[-1]["path"], "/v1/plans/A%2FB%3F")

    def test_status_check_fails_where_attention_is_needed(self):
        self.check(5, "status", "--check")
        self.mock.status = {**self.mock.status, "ready": True, "links": [{"name": "mcs", "up": True}], "tsc": "Auto",
                            "alarms": {"heavy": 0, "light": 3}}
        self.check(0, "status", "--check")

    def test_why_follows_the_causes_and_names_remedies(self):
        output = self.check(5, "why", "PLAN_2")
        flat = " ".join(output.split())
        for text in ("Plan PLAN_2 does not move for 5 min: it is Pending, at position 1 of the queue.",
                     "No suitable robot is free.", "The TSC is Paused: Paused by kim.", "acsctl tsc resume",
                     "Robot LR01: busy with plan PLAN_1.", "Edge E1 is blocked for 0 s: wet floor.",
                     "acsctl unblock edge E1", "Robot LR02 is in maintenance.", "acsctl maintenance LR02 off",
                     "Heavy alarm ACS-1002 Robot disconnected of LR02 for 1 min: no state for 10 s.",
                     "Cause: The network is down.", "Remedy: Check the robot."):
            self.assertIn(text, flat)
        self.assertLessEqual(max(map(len, output.splitlines())), 80)
        self.assertIn("Plan PLAN_1 makes progress", self.check(0, "why", "PLAN_1"))
        self.assertIn("Robot LR02 needs attention", self.check(5, "why", "LR02"))
        everything = " ".join(self.check(5, "why").split())
        for text in ("The link mqtt is down for 3 s: connection refused.", "Plan PLAN_2 does not move", "Robot LR02 needs"):
            self.assertIn(text, everything)
        self.assertNotIn("Plan PLAN_1 makes", everything)
        self.assertIn("there is no plan or robot", self.check(1, "why", "PLAN_9"))
        answer = json.loads(self.check(5, "why", "PLAN_2", "--json"))
        self.assertTrue(answer["needsAttention"])
        self.assertEqual((answer["findings"][0]["subject"], answer["findings"][0]["id"]), ("plan", "PLAN_2"))


class Failing(AcsctlCase):
    def test_each_failure_has_its_exit_code(self):
        self.assertIn("There is no PLAN_9.", self.check(1, "plan", "PLAN_9"))
        self.check(2, "plans", "--state", "odd")
        self.check(2, "plan")
        self.check(2)
        self.mock.token = "secret"
        self.assertIn("The token is not valid.", self.check(4, "plans"))
        self.environment["ACSCTL_TOKEN"] = "secret"
        self.check(0, "plans")
        self.environment["ACSCTL_URL"] = "http://127.0.0.1:1"
        self.assertIn("cannot connect", self.check(3, "plans"))
        self.environment["ACSCTL_URL"] = "http://acsd.example"
        self.assertIn("without encryption", self.check(2, "plans"))

    def test_garbage_is_an_error_and_not_a_crash(self):
        for raw in ((200, b"", "application/json"), (200, b"{", "application/json"), (200, b"\x00\xff", "application/json"),
                    (200, b"[" * 100_000, "application/json"), (200, b"[]", "application/json"),
                    (200, b'{"plans":[{}]}', "application/json"), (200, b'{"plans":[{"planId":1}]}', "application/json"),
                    (200, b'{"plans":null}', "application/json"), (302, b"", "text/html"), (404, b"not found", "text/plain"),
                    (500, b"<html>", "text/html"), (200, b'{"plans":[],"plans":[]}', "application/json")):
            self.mock.raw = raw
            self.assertIn("not one of acsd's operator API", self.check(6, "plans"), raw)
        self.mock.raw = (200, b" " * (33 * 1024 * 1024), "application/json")
        self.check(6, "plans")

    def test_a_name_cannot_send_codes_to_the_terminal(self):
        self.mock.robots = [{**ROBOTS[0], "robotId": "\x1b[2J\u202eLR01\x9b", "reason": "a\nb"}]
        output = self.check(0, "robots")
        self.assertNotRegex(output, "[\x1b\u202e\x9b]")
        self.assertEqual(len(output.splitlines()), 2)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    arguments, rest = parser.parse_known_args()
    AcsctlCase.bin_dir = arguments.bin
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)


if __name__ == "__main__":
    main()
