#!/usr/bin/env python3
"""acsctl against an operator API that only answers: what each command prints, sends and returns."""

import argparse
import contextlib
import fcntl
import json
import os
import pathlib
import pty
import signal
import socket
import ssl
import struct
import subprocess
import sys
import tarfile
import tempfile
import termios
import time
import unittest

from operator_mock import ALARMS, NOW, PLANS, ROBOTS, WAITS, OperatorMock, make_plan

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

    def run_on_terminal(self, *arguments, typed="", columns=100):
        """(exit code, everything that the terminal shows)"""
        process_id, terminal = pty.fork()
        if process_id == 0:
            os.execve(self.bin_dir / "acsctl", ["acsctl", *map(str, arguments)], {**self.environment, "TERM": "xterm"})
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 30, columns, 0, 0))
        os.write(terminal, typed.encode())
        shown = b""
        with contextlib.suppress(OSError):  # the end of the program
            while part := os.read(terminal, 65536):
                shown += part
        os.close(terminal)
        return os.waitstatus_to_exitcode(os.waitpid(process_id, 0)[1]), shown.decode(errors="replace")

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
    def test_tables_fit_the_columns_of_the_environment(self):
        self.environment["COLUMNS"] = "80"
        for command in (("status",), ("plans",), ("plan", "PLAN_1"), ("robots",), ("robot", "LR01"), ("alarms",), ("links",),
                        ("queue",), ("site",), ("trace",), ("audit",), ("actions", "LR01")):
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

    def test_an_alarm_has_its_step_and_job(self):
        self.mock.alarms = [{**ALARMS[0], "planId": "PLAN_1", "stepNo": 3, "jobId": "JOB_" + "7" * 30}, ALARMS[0]]
        titles, *rows = [line.split() for line in self.check(0, "alarms").splitlines()]
        self.assertEqual(titles[4:7], ["PLAN", "STEP", "JOB"])
        self.assertEqual([row[5:8] for row in rows], [["PLAN_1", "3", "JOB_" + "7" * 30], ["-", "-", "-"]])
        self.environment["COLUMNS"] = "100"
        self.assertRegex(self.check(0, "alarms"), "JOB_7+… .* no state for 10 s\n")

    def test_a_file_or_a_pipe_has_everything(self):
        job = {"jobId": "J" * 200, "from": "A" * 60, "to": "B" * 60, "status": "Completed"}
        plan = make_plan("P" * 150, "Pending", waits={**WAITS, "message": "No robot. " * 30})
        plan["steps"] = [{**plan["steps"][0], "jobs": [job], "carrierIds": ["C" * 100]}]
        self.mock.plans = [plan, PLANS[0]]
        output = self.check(0, "plan", plan["planId"])
        for text in (job["jobId"], job["from"], job["to"], "C" * 100, "No robot. " * 29):
            self.assertIn(text, output)
        lines = self.check(0, "plans").splitlines()
        self.assertIn("No robot. " * 29, lines[1])
        self.assertLess(len(lines[2]), 250)
        self.assertIn("No robot. " * 29, self.check(5, "why", plan["planId"]))
        self.environment["COLUMNS"] = "60"
        for command in ("plans", "plan"):
            output = self.check(0, command, *([plan["planId"]] if command == "plan" else []))
            self.assertLessEqual(max(map(len, output.splitlines())), 60)

    def test_nothing_is_stated_as_a_sentence(self):
        self.mock.plans = []
        self.assertEqual(self.check(0, "plans"), "No unfinished plan; --state finished lists the others.\n")
        self.assertEqual(self.check(0, "plans", "--robot", "LR09"), "No such plan.\n")
        self.mock.events = [b": keep-alive\n\n"]
        self.assertEqual(self.check(0, "events"), "No events.\n")
        self.assertEqual(self.check(0, "events", "--after", "2"), "No events after 2.\n")
        self.assertEqual(self.check(0, "events", "--after", "99"), "No events after 99; the newest is 2.\n")
        self.assertEqual(self.check(0, "events", "--json"), "")

    def test_a_finished_plan_has_the_number_of_its_steps(self):
        plan = make_plan("P1", "Completed", endedAt=NOW, stepNo=0)
        plan["steps"] = [{**step, "status": status} for step, status in zip(plan["steps"], ("Completed", "Skipped"))]
        self.mock.plans = [plan]
        self.assertRegex(self.check(0, "plan", "P1"), r"Step +2/2\n")
        self.assertRegex(self.check(0, "plans"), r" 2/2 ")

    def test_the_numbers_of_steps_may_have_gaps(self):
        plan = make_plan("P1", "InProgress", stepNo=20)
        plan["steps"] = [{**step, "stepNo": 10 * step["stepNo"]} for step in plan["steps"]]
        self.mock.plans = [plan]
        self.assertRegex(self.check(0, "plans"), r" 2/2 ")
        plan["stepNo"] = 10
        self.assertRegex(self.check(0, "plan", "P1"), r"Step +1/2\n")
        plan["stepNo"] = 0
        self.assertRegex(self.check(0, "plans"), r" 0/2 ")

    def test_a_terminal_has_colours_unless_they_are_refused(self):
        self.assertIn("\x1b[1mROBOT", self.run_on_terminal("robots")[1])
        self.assertNotIn("\x1b", self.run_on_terminal("robots", "--no-color")[1])
        self.environment["NO_COLOR"] = "1"
        self.assertNotIn("\x1b", self.run_on_terminal("robots")[1])

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
        self.mock.status = {**self.mock.status, "ready": True, "tsc": "Auto", "alarms": {"heavy": 0, "light": 3}, "links": [
            {"name": "mcs", "up": True}, {"name": "mqtt", "up": True, "broker": "mqtt://broker-1:1883"}]}
        self.assertIn("up: mqtt://broker-1:1883\n", self.check(0, "status", "--check"))

    def test_why_follows_the_causes_and_names_remedies(self):
        output = self.check(5, "why", "PLAN_2")
        flat = " ".join(output.split())
        for text in ("Plan PLAN_2 does not move for 5 min: it is Pending, at position 1 of the queue.",
                     "No suitable robot is free.", "The TSC is Paused: Paused by kim.", "acsctl tsc resume",
                     "Robot LR01: busy with plan PLAN_1.", "Edge E1 is blocked for 0 s: wet floor.",
                     "acsctl unblock edge E1", "Robot LR02: in maintenance.", "acsctl maintenance LR02 off",
                     "Heavy alarm ACS-1002 Robot disconnected of LR02 for 1 min: no state for 10 s.",
                     "Cause: The network is down.", "Remedy: Check the robot."):
            self.assertIn(text, flat)
        self.environment["COLUMNS"] = "80"
        self.assertLessEqual(max(map(len, self.check(5, "why", "PLAN_2").splitlines())), 80)
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
        self.assertIn('expected active, waiting, unfinished, finished, found "odd"', self.check(2, "plans", "--state", "odd"))
        self.assertIn('expected entry, changes, or both with a comma, found "x,entry"',
                      self.check(2, "events", "--types", "x,entry"))
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

    def test_an_output_that_is_not_written_is_an_error(self):
        for command in (("--help",), ("plans", "--help"), ("--version",), ("plans",), ("completion", "bash")):
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = subprocess.run([self.bin_dir / "acsctl", *command], stdout=full, stderr=subprocess.PIPE, text=True,
                                      env=self.environment, timeout=SECONDS, check=False)
            self.assertEqual((done.returncode, done.stderr), (7, "acsctl: the output could not be written\n"), command)

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

    def test_the_reason_of_a_refusal_without_json_is_shown(self):
        self.mock.raw = (403, b'host name "vm" is not allowed: use the IP address\n', "text/plain; charset=utf-8")
        self.assertIn('HTTP status 403: host name "vm" is not allowed: use the IP', self.check(4, "plans"))
        self.mock.raw = (502, b"<html>bad gateway</html>", "text/html")
        self.assertNotIn("may have executed", self.check(6, "plans"))
        self.assertIn("may have executed", self.check(6, "pause", "PLAN_1"))

    def test_an_interim_answer_is_not_the_answer(self):
        self.mock.interim = 3
        self.assertIn("PLAN_1", self.check(0, "plans"))
        self.assertIn("PLAN_1", self.check(0, "events"))
        self.check(0, "pause", "PLAN_1")
        self.mock.interim = 1000
        self.check(6, "plans")

    def test_a_name_cannot_send_codes_to_the_terminal(self):
        self.mock.robots = [{**ROBOTS[0], "robotId": "\x1b[2J\u202eLR01\x9b", "reason": "a\nb"}]
        output = self.check(0, "robots")
        self.assertNotRegex(output, "[\x1b\u202e\x9b]")
        self.assertEqual(len(output.splitlines()), 2)
        evil = "X\x1b]52;c;QUFB\x07\u202e\x9b2J\x7f"
        self.mock.status = {**self.mock.status, "links": [
            {"name": evil, "up": False, "reason": evil, "since": None}, {"name": "mqtt", "up": True, "broker": evil}]}
        self.mock.plans = [{**PLANS[0], "planId": "P\x9b"}, {**PLANS[0], "planId": "P\u202e"}, PLANS[0]]
        for command in (("status",), ("links",), ("status", "--json"), ("plans", "--json"), ("__complete", "plan", "")):
            self.assertNotRegex(self.run_acsctl(*command).stdout, "[\x1b\u202e\x9b\x7f]", command)
        self.assertEqual(self.check(0, "__complete", "plan", ""), "PLAN_1\n")


CHANGES = (
    (("cancel", "PLAN_1", "--reason", "wrong lot"), "/v1/plans/PLAN_1/cancel", {"reason": "wrong lot"}),
    (("abort", "PLAN_1"), "/v1/plans/PLAN_1/abort", None),
    (("pause", "PLAN_1"), "/v1/plans/PLAN_1/pause", None),
    (("resume", "PLAN_1"), "/v1/plans/PLAN_1/resume", None),
    (("priority", "PLAN_1", "7"), "/v1/plans/PLAN_1/priority", {"priority": 7}),
    (("resolve", "PLAN_1", "J 1", "again"), "/v1/plans/PLAN_1/jobs/J%201/resolve", {"outcome": "again"}),
    (("skip", "PLAN_1", "2"), "/v1/plans/PLAN_1/steps/2/skip", None),
    (("maintenance", "LR01", "off"), "/v1/robots/LR01/maintenance", {"on": False}),
    (("carriers", "LR01", "C_01", "--", "-"), "/v1/robots/LR01/carriers", {"carrierIds": ["C_01", None, None]}),
    (("clear", "LR01", "ACS-1004", "--plan", "PLAN_1"), "/v1/alarms/clear",
     {"robotId": "LR01", "errorCode": "ACS-1004", "planId": "PLAN_1"}),
    (("tsc", "pause"), "/v1/tsc/pause", None),
    (("tsc", "resume"), "/v1/tsc/resume", None),
    (("block", "station", "B02", "--reason", "wet floor"), "/v1/site/block",
     {"kind": "station", "id": "B02", "reason": "wet floor"}),
    (("unblock", "node", "N1"), "/v1/site/unblock", {"kind": "node", "id": "N1"}),
)
CONTROLS = ("cancel", "abort", "pause", "resume")
WITHOUT_QUESTION = ("pause", "priority", "block")


class Changing(AcsctlCase):
    def test_each_command_is_one_post_with_a_key(self):
        for arguments, path, body in CHANGES:
            outcome = f"acsctl plan {arguments[1]} and acsctl events show the outcome.\n" if arguments[0] in CONTROLS else ""
            self.assertEqual(self.check(0, *([*arguments[:1], "--yes", *arguments[1:]])), f"Accepted: {path}\n{outcome}")
            request = self.mock.requests[-1]
            self.assertEqual((request["method"], request["path"]), ("POST", path))
            self.assertEqual((request["body"], request["type"]) if body is None else json.loads(request["body"]),
                             ("", None) if body is None else body)
        keys = [request["key"] for request in self.mock.requests]
        self.assertEqual(len(set(keys)), len(CHANGES))
        for key in keys:
            self.assertRegex(key, r"\A[A-Za-z0-9._-]{1,64}\Z")

    def test_without_a_terminal_a_command_that_lets_robots_move_needs_yes(self):
        for arguments, *_ in CHANGES:
            if arguments[0] not in WITHOUT_QUESTION and arguments != ("tsc", "pause"):
                self.assertIn("needs --yes", self.check(2, *arguments), arguments)
        self.check(0, "maintenance", "LR01", "on")
        self.assertEqual(len(self.mock.requests), 1)

    def test_a_terminal_is_asked(self):
        for answer, code, sent in (("y", 0, 1), ("n", 1, 1), ("", 1, 1), ("yes", 0, 2)):
            exit_code, output = self.run_on_terminal("abort", "PLAN_1", typed=f"{answer}\n")
            self.assertIn("Abort plan PLAN_1? [y/N]", output)
            self.assertEqual((exit_code, len(self.mock.requests)), (code, sent), output)

    def test_a_refused_command_prints_the_sentence(self):
        for status in (400, 404, 409, 503):
            self.mock.refusal = (status, "The plan has ended.")
            self.assertEqual(self.check(1, "pause", "PLAN_1"), "acsctl: The plan has ended.\n")
        self.mock.refusal = (503, "The store is busy.", ("Retry-After", "1"))
        self.assertEqual(self.check(1, "pause", "PLAN_1"), "acsctl: The store is busy. Try again in 1 s.\n")
        self.mock.refusal = (403, "A viewer may not send commands.")
        self.check(4, "pause", "PLAN_1")

    def test_a_lost_connection_is_repeated_once_with_the_same_key(self):
        self.mock.losses = 1
        self.check(0, "pause", "PLAN_1")
        first, second = self.mock.requests
        self.assertEqual(first["key"], second["key"])
        self.mock.losses = 2
        self.assertIn("may have executed", self.check(3, "pause", "PLAN_1"))
        self.assertEqual(len(self.mock.requests), 4)

    def test_an_answer_that_does_not_come_is_a_time_limit(self):
        self.mock.raw = (200, b"{}", "application/json")
        with socket.create_server(("127.0.0.1", 0)) as silent:
            self.environment["ACSCTL_URL"] = f"http://127.0.0.1:{silent.getsockname()[1]}"
            self.assertIn("no answer within 200ms", self.check(3, "plans", "--timeout", "200ms"))


class Acting(AcsctlCase):
    """`action` and `actions`."""

    def act(self, code, *arguments):
        return self.check(code, "action", "--yes", "LR01", *arguments)

    def test_an_action_has_typed_parameters_and_waits_for_its_outcome(self):
        self.assertEqual(self.act(0, "initPosition", "x=1.50", "mapId=2", 'note={"a": 1}', "other=a=b", "--reason", "moved"),
                         "initPosition of LR01: Finished: done\n")
        methods = [(request["method"], request["path"]) for request in self.mock.requests]
        self.assertEqual(methods, [(method, "/v1/robots/LR01/actions") for method in ("GET", "POST", "GET", "GET")])
        request = self.mock.requests[1]
        self.assertEqual(json.loads(request["body"]), {"actionType": "initPosition", "reason": "moved", "parameters": {
            "x": 1.5, "mapId": "2", "note": {"a": 1}, "other": "a=b"}})
        self.assertRegex(request["key"], r"\A[A-Za-z0-9._-]{1,64}\Z")
        output = self.check(0, "actions", "LR01")
        for text in ("initPosition", "Finished", "done", "A0", "x=NUMBER mapId=STRING [note=OBJECT]"):
            self.assertIn(text, output)

    def test_the_outcome_is_the_exit_code(self):
        for status in ("Failed", "Unknown"):
            self.mock.outcomes = [(status, "no space")]
            self.assertEqual(self.act(5, "stateRequest"), f"stateRequest of LR01: {status}: no space\n")
        self.mock.outcomes = []
        self.assertEqual(self.act(0, "stateRequest", "--no-wait"), "Accepted: /v1/robots/LR01/actions\n")
        self.mock.outcomes = [("Running", ""), ("Failed", "no")]
        self.assertEqual(json.loads(self.act(5, "stateRequest", "--json"))["status"], "Failed")

    def test_a_refused_or_invalid_action_is_an_error(self):
        for code, arguments in ((2, ("initPosition", "x")), (2, ("initPosition", "=1")), (2, ("initPosition", "x=1", "x=2")),
                                (2, ("stateRequest", "--watch"))):
            self.act(code, *arguments)
        self.assertEqual([request for request in self.mock.requests if request["method"] == "POST"], [])
        self.mock.refusal = (409, "The robot is not connected.")
        self.assertEqual(self.act(1, "stateRequest"), "acsctl: The robot is not connected.\n")
        self.assertIn("There is no actions.", self.check(1, "action", "--yes", "LR09", "stateRequest"))
        self.assertIn("Send stateRequest to LR01? Without a terminal", self.check(2, "action", "LR01", "stateRequest"))

    def test_an_action_that_may_have_been_executed_is_stated(self):
        warning = "acsd may have executed the command"
        for raw in ((504, b"<html>", "text/html"), (202, b"{}", "application/json")):
            self.mock.raw_post = raw
            self.assertIn(warning, self.act(6, "stateRequest"))
        self.mock.raw_post = (404, b"<html>", "text/html")
        self.assertNotIn(warning, self.act(6, "stateRequest"))
        self.mock.raw_post = None
        self.mock.read_actions = (lambda read: lambda: {} if self.mock.actions else read())(self.mock.read_actions)
        self.assertIn("stateRequest was sent", self.act(6, "stateRequest"))

    def test_an_outcome_controls_no_terminal(self):
        self.mock.outcomes = [("Failed", "\u009b2J")]
        self.assertIn("\\u009b2J", self.act(5, "stateRequest", "--json"))

    def test_a_lost_outcome_is_stated(self):
        self.mock.add_action = lambda request: "A9"  # as after a restart
        result = self.run_acsctl("action", "-y", "LR01", "stateRequest")
        self.assertEqual((result.returncode, result.stdout), (5, ""))
        self.assertIn("the outcome is not known", result.stderr)


class Following(AcsctlCase):
    def start(self, *arguments):
        process = subprocess.Popen([self.bin_dir / "acsctl", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, env=self.environment)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for_requests(self, count):
        deadline = time.monotonic() + SECONDS
        while len(self.mock.requests) < count:
            self.assertLess(time.monotonic(), deadline, "it does not connect again")
            time.sleep(0.02)

    def test_events_of_the_past_end(self):
        self.assertEqual(self.check(0, "events").splitlines(),
                         ["23:10:00.000 plan    plan PLAN_1: Pending -> InProgress on LR01",
                          "23:10:00.000 alarm   alarm ACS-1002 of LR02 is set"])
        lines = self.check(0, "events", "--after", "1", "--json").splitlines()
        self.assertEqual([json.loads(line)["id"] for line in lines], [2])
        (entry, *_) = self.mock.make_events(0)[1:]
        self.mock.events = [entry, b"event: changes\nid: 2\ndata: {}\n\n"]
        self.assertIn("PLAN_1", self.check(0, "events", "--limit", "1"), "an event of another type does not count")
        self.assertEqual(self.mock.requests[-1]["query"]["after"], "0")
        self.mock.events = [entry, entry.replace(b"id: 1", b"id: 2")]
        self.assertEqual(len(self.check(0, "events", "--limit", "1", "--json").splitlines()), 1)
        self.mock.events = [b"event: reset\ndata: {}\n\n"]
        self.assertEqual(self.check(0, "events"), "No events.\n")
        self.check(1, "events", "--after", "1")
        self.mock.events = [b"event: entry\nid: 1\ndata: odd\n\n"]
        self.check(6, "events")

    def test_follow_continues_until_an_interrupt(self):
        self.mock.events_end = False
        self.mock.events = [b"event: entry\nid: 7\nda", b'ta: {"time":"2026-11-27T23:10:00.000Z","kind":"tsc","text":"TSC: ',
                            'Paused 정지"}\n\n'.encode(), b'event: changes\nid: 8\ndata: {"plans":[{"planId":"P1"}]}\n\n']
        process = self.start("events", "--follow", "--types", "entry,changes")
        self.assertEqual(process.stdout.readline(), "23:10:00.000 tsc     TSC: Paused 정지\n")
        self.assertEqual(process.stdout.readline(), "changes plans P1\n")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(SECONDS), 0)

    def test_follow_connects_again_after_the_last_event(self):
        process = self.start("events", "--follow", "--after", "0")
        for _ in range(2):
            process.stdout.readline()
        self.wait_for_requests(2)
        self.assertEqual([request["query"]["after"] for request in self.mock.requests[:2]], ["0", "2"])
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(SECONDS), 0)

    def test_follow_connects_again_after_the_loss_of_its_first_stream(self):
        self.mock.events_end = False
        for reset in (True, False):
            with self.subTest(reset=reset):
                self.mock.requests.clear()
                self.mock.stream_loss.clear()
                self.mock.stream_reset = reset
                process = self.start("events", "--follow", "--after", "1")
                self.assertIn("ACS-1002", process.stdout.readline())
                self.mock.stream_loss.set()
                self.assertIn("connecting again", process.stderr.readline())
                self.wait_for_requests(2)
                self.assertEqual([request["query"]["after"] for request in self.mock.requests[:2]], ["1", "2"])
                process.send_signal(signal.SIGTERM)
                self.assertEqual(process.wait(SECONDS), 0)

    def test_follow_connects_again_if_its_first_stream_is_refused_for_a_time(self):
        self.mock.stream_refusal = (503, b'{"error":"Too many event streams are open."}', "application/json")
        process = self.start("events", "--follow")
        self.assertEqual(process.stderr.readline(), "acsctl: Too many event streams are open.; connecting again\n")
        self.mock.stream_refusal = None
        self.wait_for_requests(3)
        self.assertEqual([request["path"] for request in self.mock.requests[:3]], ["/v1/snapshot"] + 2 * ["/v1/events"])
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(SECONDS), 0)

    def test_all_events_that_acsd_still_has_are_shown(self):
        self.mock.newest_event = 5000
        for oldest in (4998, 4996, 4979, 905):
            self.mock.oldest_event = oldest
            lines = self.check(0, "events", "--limit", "1000", "--json").splitlines()
            self.assertEqual([json.loads(line)["id"] for line in lines], list(range(max(oldest, 4001), 5001)))

    def test_follow_continues_after_a_standby_and_misses_nothing(self):
        process = self.start("events", "--follow")
        self.wait_for_requests(2)
        self.mock.stream_refusal = (503, b'{"error":"This acsd does not lead."}', "application/json")
        self.wait_for_requests(3)
        self.mock.stream_refusal = None
        self.wait_for_requests(4)
        requests = [(request["path"], request["query"].get("after")) for request in self.mock.requests[:4]]
        self.assertEqual(requests, [("/v1/snapshot", None)] + 3 * [("/v1/events", "2")])
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(SECONDS), 0)

    def test_watch_repeats_until_an_interrupt(self):
        process = self.start("links", "--watch", "0.1", "--json")
        for _ in range(3):
            self.assertEqual(len(json.loads(process.stdout.readline())["links"]), 2)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(SECONDS), 0)
        self.check(2, "abort", "PLAN_1", "--yes", "--watch")
        self.environment["ACSCTL_URL"] = "http://127.0.0.1:1"
        self.check(3, "links", "--watch")


class SilentNameServer(AcsctlCase):
    def setUp(self):
        super().setUp()
        library = self.bin_dir / "libscenario_held_resolver.so"
        if not library.exists():
            self.skipTest("not built with sanitizers")
        self.gate = self.folder / "resolver"
        os.mkfifo(self.gate)
        self.environment |= {"LD_PRELOAD": str(library), "ACS_HELD_RESOLVER": str(self.gate),
                             "ACSCTL_URL": self.mock.url.replace("127.0.0.1", "acsd.test")}

    def start(self, *arguments):
        process = subprocess.Popen([self.bin_dir / "acsctl", "--timeout", "1h", *arguments], stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, env=self.environment)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for_lookup(self, process):
        """A second thread asks for the name."""
        deadline = time.monotonic() + SECONDS
        while len(os.listdir(f"/proc/{process.pid}/task")) < 2:
            self.assertLess(time.monotonic(), deadline, "it asks for no name")
            time.sleep(0.02)

    def test_the_time_limit_applies_to_the_name(self):
        for command in (("plans",), ("events",), ("links", "--watch")):
            self.assertIn("no connection within 1s", self.check(3, *command, "--timeout", "1s"), command)

    def test_an_interrupt_ends_the_command(self):
        for command in (("events", "--follow"), ("events", "--follow", "--after", "1"), ("links", "--watch")):
            for number in (signal.SIGINT, signal.SIGTERM):
                process = self.start(*command)
                self.wait_for_lookup(process)
                process.send_signal(number)
                self.assertEqual((process.wait(SECONDS), process.stdout.read()), (0, b""), command)

    def test_a_late_answer_is_used(self):
        process = self.start("links")
        os.close(os.open(self.gate, os.O_WRONLY))  # waits until the name is asked for
        self.assertEqual(process.wait(SECONDS), 0)
        self.assertIn(b"mqtt", process.stdout.read())


class Configuring(AcsctlCase):
    def test_contexts_are_stored_with_mode_0600(self):
        del self.environment["ACSCTL_URL"]
        self.mock.token = "secret"
        token = self.folder / "token"
        token.write_text("secret\n")
        for mode in (0o604, 0o640, 0o620):
            token.chmod(mode)
            self.assertIn("chmod go-rwx", self.check(2, "plans", "--url", self.mock.url, "--token-file", token))
        token.chmod(0o600)
        self.check(0, "context", "set", "line1", "--url", self.mock.url, "--token-file", token)
        self.check(0, "context", "set", "line2", "--url", "http://127.0.0.1:1")
        config = self.folder / ".config" / "acsctl" / "config.toml"
        self.assertEqual(config.stat().st_mode & 0o777, 0o600)
        self.check(0, "plans")
        self.check(3, "plans", "--context", "line2")
        self.check(0, "context", "use", "line2")
        self.check(3, "plans")
        self.environment["ACSCTL_CONTEXT"] = "line1"
        self.check(0, "plans")
        self.check(2, "plans", "--context", "line3")
        self.assertIn('no context "line3"; there are: line1, line2', self.check(1, "context", "use", "line3"))
        del self.environment["ACSCTL_CONTEXT"]
        self.check(4, "plans", "--url", self.mock.url)  # without the token of a context
        listed = json.loads(self.check(0, "context", "list", "--json"))["contexts"]
        self.assertEqual([(context["name"], context["current"]) for context in listed], [("line1", False), ("line2", True)])
        self.check(0, "context", "remove", "line1")
        self.check(2, "plans", "--context", "line1")
        config.chmod(0o640)
        self.assertIn("chmod 600", self.check(2, "context", "list"))

    def test_a_token_of_standard_input_is_not_shown(self):
        result = subprocess.run([self.bin_dir / "acsctl", "context", "set", "a", "--url", self.mock.url, "--token-stdin"],
                                input="secret\n", capture_output=True, text=True, env=self.environment, timeout=SECONDS)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.mock.token = "secret"
        self.check(0, "plans", "--context", "a")
        for command in (("context", "list"), ("context", "list", "--json")):
            self.assertNotIn("secret", self.check(0, *command))

    def set_token(self, token):
        return subprocess.run([self.bin_dir / "acsctl", "context", "set", "a", "--url", self.mock.url, "--token-stdin"],
                              input=token, capture_output=True, text=True, env=self.environment, timeout=SECONDS)

    def test_no_file_is_written_that_cannot_be_read(self):
        result = self.set_token("x" * 3_000_000)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("at most 4096 characters", result.stderr)
        self.assertFalse((self.folder / ".config").exists())
        self.assertEqual(self.set_token("x" * 4096).returncode, 0)
        config = self.folder / ".config" / "acsctl" / "config.toml"
        before = config.read_bytes()
        for number in range(12):
            result = self.run_acsctl("context", "set", f"b{number}", "--url", self.mock.url, "--ca", "x" * 100_000)
        self.assertEqual(result.returncode, 7)
        self.assertIn("would exceed", result.stderr)
        self.assertIn("b1", self.check(0, "context", "list"))
        self.assertNotEqual(config.read_bytes(), before)

    def test_without_a_folder_there_is_no_configuration(self):
        work = self.folder / "work"
        (work / ".config" / "acsctl").mkdir(parents=True)
        trap = work / ".config" / "acsctl" / "config.toml"
        trap.write_text('current = "a"\n[contexts.a]\nurl = "http://127.0.0.1:1"\n')
        trap.chmod(0o600)
        url = self.environment.pop("ACSCTL_URL")
        for home, config_home in ((None, None), (".", None), (None, ".config")):
            self.environment = {"PATH": self.environment["PATH"]}
            self.environment.update({name: value for name, value in (("HOME", home), ("XDG_CONFIG_HOME", config_home)) if value})
            result = self.run_acsctl("context", "list", cwd=work)
            self.assertEqual(result.returncode, 2, (home, config_home))
            self.assertIn("set HOME or XDG_CONFIG_HOME", result.stderr)
            self.assertNotIn("127.0.0.1:1/", self.run_acsctl("plans", "--timeout", "1s", cwd=work).stderr)
            self.assertEqual(self.run_acsctl("plans", "--url", url, cwd=work).returncode, 0)

    def test_a_symbolic_link_stays_and_its_target_is_written(self):
        folder = self.folder / ".config" / "acsctl"
        folder.mkdir(parents=True)
        target = self.folder / "dotfiles.toml"
        (folder / "config.toml").symlink_to(target)
        self.assertIn("No such file", self.check(7, "context", "set", "a", "--url", self.mock.url))
        target.touch(0o600)
        self.check(0, "context", "set", "a", "--url", self.mock.url)
        self.assertTrue((folder / "config.toml").is_symlink())
        self.assertIn("[contexts.a]", target.read_text())
        self.assertEqual(target.stat().st_mode & 0o777, 0o600)

    @unittest.skipIf(os.geteuid() != 0, "only root can give a file to another user")
    def test_a_configuration_of_another_user_is_refused(self):
        self.check(0, "context", "set", "a", "--url", self.mock.url)
        config = self.folder / ".config" / "acsctl" / "config.toml"
        os.chown(config, 65534, 65534)
        del self.environment["ACSCTL_URL"]
        self.assertIn("belongs to another user", self.check(2, "plans"))
        self.assertIn("belongs to another user", self.check(2, "context", "list"))

    def test_completion_names_commands_plans_and_robots(self):
        def complete(*words):
            return self.check(0, "__complete", *words).split()

        self.assertIn("plans", complete(""))
        self.assertEqual(complete("why", ""), ["LR01", "LR02", "PLAN_1", "PLAN_2"])
        self.assertEqual(complete("robot", "LR02"), ["LR02"])
        self.assertEqual(complete("resolve", "PLAN_1", "J", ""), ["again", "done", "failed"])
        self.assertEqual(complete("tsc", "r"), ["resume"])
        self.assertEqual(complete("unblock", "edge", ""), ["E1"])
        self.assertEqual(complete("clear", "LR02", ""), ["ACS-1002"])
        self.assertEqual(complete("action", "LR01", ""), ["initPosition", "stateRequest"])
        self.assertEqual(complete("action", ""), ["LR01", "LR02"])
        self.environment["ACSCTL_URL"] = "http://127.0.0.1:1"
        self.assertEqual(complete("plan", ""), [])
        self.assertIn("compadd", self.check(0, "completion", "zsh"))

    def complete_in_bash(self, line):
        """The line after TAB in an interactive bash."""
        process_id, terminal = pty.fork()
        if process_id == 0:
            path = f"{self.bin_dir.resolve()}:{self.environment['PATH']}"
            os.execvpe("bash", ["bash", "--norc", "--noprofile", "-i"],
                       {**self.environment, "PATH": path, "TERM": "dumb", "PS1": "", "HISTFILE": ""})
        self.addCleanup(os.waitpid, process_id, 0)
        self.addCleanup(os.close, terminal)
        # The line is printed, not executed.
        os.write(terminal, b'eval "$(acsctl completion bash)"; acsctl() { if [[ $1 == __complete ]]; '
                           b'then command acsctl "$@"; else printf "<%s>" "$@"; printf "END\\n"; fi; }; '
                           b'bind "set bell-style none"\n' + line.encode() + b"\t\n")
        shown = b""
        while b"END\r\n" not in shown.replace(b'END\\n', b""):
            part = os.read(terminal, 65536)
            self.assertTrue(part, shown)
            shown += part
        os.write(terminal, b"exit\n")
        return shown.decode().rsplit("\n<", 1)[1].split("END")[0].strip("<>").split("><")

    def test_bash_completes_words_with_its_word_breaks(self):
        self.mock.plans = [{**PLANS[0], "planId": name} for name in ("P:1-A", "L=1", "-X")]
        for line, words in (("acsctl tsc p", ["tsc", "pause"]), ("acsctl plan P:", ["plan", "P:1-A"]),
                            ("acsctl plan P", ["plan", "P:1-A"]), ("acsctl plan L=", ["plan", "L=1"]),
                            (f"acsctl --url {self.mock.url} plan P:1", ["--url", self.mock.url, "plan", "P:1-A"]),
                            (f"acsctl --url={self.mock.url}  pri", [f"--url={self.mock.url}", "priority"]),
                            ("acsctl plans --state=f", ["plans", "--state=finished"]),
                            ("acsctl plan -- -", ["plan", "--", "-X"])):
            self.assertEqual(self.complete_in_bash(line), words, line)

    def test_a_bundle_has_everything_but_the_token(self):
        self.mock.token = self.environment["ACSCTL_TOKEN"] = "secret-token"
        file = self.folder / "bundle.tar.gz"
        self.check(0, "bundle", file)
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)
        with tarfile.open(file, "r:gz") as archive:
            contents = {pathlib.PurePath(member.name).name: archive.extractfile(member).read() for member in archive}
        self.assertEqual(sorted(contents), sorted((
            "manifest.json", "status.json", "snapshot.json", "plans.json", "plans-finished.json", "robots.json", "alarms.json",
            "links.json", "queue.json", "site.json", "audit.ndjson", "trace.ndjson", "openapi.json")))
        self.assertEqual(json.loads(contents["robots.json"]), {"robots": ROBOTS})
        self.assertEqual([entry["name"] for entry in json.loads(contents["manifest.json"])["files"] if entry["error"]], [])
        self.assertNotIn(b"secret-token", b"".join(contents.values()))
        self.assertIn("File exists", self.check(7, "bundle", file))
        self.mock.token = None
        self.check(0, "bundle", self.folder / "b", "--http-url", self.mock.url)
        self.assertNotIn("secret-token", str([request["authorization"] for request in self.mock.requests
                                              if request["path"] == "/metrics"]))
        with tarfile.open(self.folder / "b") as archive:
            self.assertIn("metrics.txt", [pathlib.PurePath(name).name for name in archive.getnames()])
        self.environment["ACSCTL_URL"] = "http://127.0.0.1:1"
        self.check(3, "bundle", self.folder / "c")
        self.assertFalse((self.folder / "c").exists())

    def test_an_answer_that_is_not_of_its_route_is_no_file_of_a_bundle(self):
        read = self.mock.read
        self.mock.read = lambda path, query: ((200, b"<html>login</html>", "text/html")
                                              if path in ("/v1/robots", "/v1/trace") else read(path, query))
        file = self.folder / "b.tar.gz"
        result = self.run_acsctl("bundle", file)
        self.assertEqual((result.returncode, result.stderr), (6, ""), result.stdout)
        self.assertIn("not in it: robots.json: the answer is not that of acsd: its content is text/html", result.stdout)
        with tarfile.open(file, "r:gz") as archive:
            contents = {pathlib.PurePath(member.name).name: archive.extractfile(member).read() for member in archive}
        self.assertIn("plans.json", contents)
        self.assertNotIn(b"login", b"".join(contents.values()))
        faulty = {entry["name"] for entry in json.loads(contents["manifest.json"])["files"] if entry["error"]}
        self.assertEqual(faulty, {"robots.json", "trace.ndjson"})
        self.mock.read = lambda path, query: (404, b"not found", "text/plain") if path == "/metrics" else read(path, query)
        result = self.run_acsctl("bundle", self.folder / "b2", "--http-url", self.mock.url)
        self.assertEqual(result.returncode, 6)
        self.assertIn("is it the address of http.listen?", result.stdout)
        self.mock.raw = (200, b"<html>login</html>", "text/html")
        self.check(6, "bundle", self.folder / "b3")
        self.assertFalse((self.folder / "b3").exists())
        for url in (self.mock.url + "/?token=SECRET", self.mock.url + "/#SECRET"):
            self.assertNotIn("SECRET", self.check(2, "bundle", self.folder / "b4", "--url", url))
            self.assertNotIn("SECRET", self.check(2, "bundle", self.folder / "b4", "--http-url", url))

    def test_tls_verifies_the_certificate_and_presents_one(self):
        def make(name, *options):
            certificate, key = self.folder / f"{name}.pem", self.folder / f"{name}.key"
            subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                            "-keyout", key, "-out", certificate, "-days", "2", "-subj", f"/CN={name}", *map(str, options)],
                           check=True, capture_output=True)
            return certificate, key

        ca, ca_key = make("ca")
        server = make("acsd", "-CA", ca, "-CAkey", ca_key, "-addext", "subjectAltName=IP:127.0.0.1")
        client, client_key = make("kim", "-CA", ca, "-CAkey", ca_key)
        other_ca, _ = make("other")
        context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH, cafile=ca)
        context.load_cert_chain(*server)
        context.verify_mode = ssl.CERT_REQUIRED
        with OperatorMock(context) as mock:
            identity = ("--certificate", client, "--key", client_key)
            self.environment["ACSCTL_URL"] = mock.url
            self.check(0, "links", "--ca", ca, *identity)
            self.assertIn("the certificate is not valid", self.check(3, "links", "--ca", other_ca, *identity))
            self.assertIn("the certificate is not valid", self.check(3, "links", *identity))
            self.check(3, "links", "--ca", ca)
            self.environment["ACSCTL_URL"] = mock.url.replace("127.0.0.1", "localhost")
            self.assertIn("the certificate is not valid", self.check(3, "links", "--ca", ca, *identity))
            self.check(2, "links", "--ca", self.folder / "none.pem", *identity)
            self.check(2, "links", "--ca", ca, "--certificate", client, "--key", ca_key)
            client_key.chmod(0o644)
            self.assertIn("chmod", self.check(2, "links", "--ca", ca, *identity))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    arguments, rest = parser.parse_known_args()
    AcsctlCase.bin_dir = arguments.bin.resolve()
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)


if __name__ == "__main__":
    main()
