"""What the tests share that kill programs under permanent work: the plans of the MCS, and the judgement of what was reported
and what was done.

--kills N   number of kills in each test (5)
--seed N    seed of the moments; printed on failure
--long      more of them
"""

import argparse
import json
import random
import shutil
import signal
import subprocess
import sys
import threading
import time
import unittest
import urllib.request

from link_proxy import LinkProxy
from scenario_case import PLANS, ScenarioCase
from scenario_case import main as run_tests

MOST_OPEN = 4
FINISH_SECONDS = 180
SETTINGS = argparse.Namespace(kills=5, seed=1, long=False)


def make_expected(plan):
    """The reports of a completed plan, in order."""
    reports = [("PlanReport", "InProgress")]
    for step in plan["steps"]:
        number = step["stepNo"]
        reports += [("StepReport", number, "Dispatched"), ("StepReport", number, "InProgress")]
        for job in step.get("jobs", ()):
            reports += [("JobReport", number, job["jobId"], status)
                        for status in ("Instructed", "InProgress", "Completed")]
        reports.append(("StepReport", number, "Completed"))
    return [*reports, ("PlanReport", "Completed")]


class Trace:
    """The trace of mcs-sim, read while it grows."""

    def __init__(self, path):
        self._path = path
        self._offset = 0
        self._rest = ""
        self.plans = {}  # by planId, as they were sent
        self.acked = set()
        self.refused = {}
        self.reports = {}  # by planId: (transactionId, key), each transactionId once, by its first coming
        self.contents = {}  # by transactionId
        self.alarms = []
        self.faults = []

    def update(self):
        if not self._path.exists():
            return
        with open(self._path, encoding="utf-8") as file:
            file.seek(self._offset)
            text = self._rest + file.read()
            self._offset = file.tell()
        *lines, self._rest = text.split("\n")
        for line in lines:
            entry = json.loads(line)
            self._take(entry["direction"], json.loads(entry["text"]))

    def _take(self, direction, message):
        command, payload = message["command"], message.get("payload")
        if direction == "out":
            if command == "ExecutionPlan":
                self.plans[payload["planId"]] = payload
            return
        if command == "ExecutionPlanAck":
            if message["result"] == "Success":
                self.acked.add(payload["planId"])
            else:
                self.refused[payload["planId"]] = message["message"]
        elif command.endswith("Report"):
            self._take_report(command, message, payload)

    def _take_report(self, command, message, payload):
        content = json.dumps([command, message["timestamp"], payload], sort_keys=True)
        if self.contents.setdefault(message["transactionId"], content) != content:
            self.faults.append(f"sent again, but otherwise: {message}")
        if command == "ErrorReport":
            self.alarms.append(payload)
            return
        members = [payload[name] for name in ("stepNo", "jobId", "status") if name in payload]
        reports = self.reports.setdefault(payload["planId"], {})
        reports.setdefault(message["transactionId"], (command, *members))

    def get_reports(self, plan_id):
        return list(self.reports.get(plan_id, {}).values())

    def get_final(self, plan_id):
        final = ("Completed", "Failed", "Aborted", "Cancelled")
        return [report[1] for report in self.get_reports(plan_id) if report[0] == "PlanReport" and report[1] in final]

    def count_open(self):
        return sum(not self.get_final(plan_id) for plan_id in self.plans)


class KillCase(ScenarioCase):
    plan_files = PLANS

    def setUp(self):
        super().setUp()
        self.random = random.Random(f"{SETTINGS.seed} {self.id()}")
        self.stopped = threading.Event()
        self.addCleanup(self.stopped.set)

    def tearDown(self):
        super().tearDown()
        if self.has_failed():
            print(f"--seed {SETTINGS.seed} --kills {SETTINGS.kills}", file=sys.stderr)

    def make_proxy(self, port):
        proxy = LinkProxy(port)
        self.addCleanup(proxy.close)
        return proxy

    def start_line(self, make_vehicle_port=lambda port: port, make_mcs_port=lambda port: port,
                   make_arm_port=lambda port: port):
        self.arm = dict(self.start_robots(make_vehicle_port))
        self.arm["stream"] = f"127.0.0.1:{make_arm_port(int(self.arm['stream'].rsplit(':', 1)[1]))}"
        for relay in ("ml100", "ml101"):  # counters that are all 0 prove nothing
            self.post(f"http://{self.arm['http']}/project/plc/set_relay_value", {"name": relay, "value": 1})
        self.start_spy()
        self.trace_file = self.line.folder / "trace.ndjson"
        self.trace = Trace(self.trace_file)
        self.mcs = self.line.start_mcs((), "--console", "--trace", self.trace_file, stdin=subprocess.PIPE, bufsize=0)
        self.addCleanup(self.mcs.process.stdin.close)
        self.mcs_address = f"127.0.0.1:{make_mcs_port(int(self.mcs.wait_ready()['ws'].rsplit(':', 1)[1]))}"
        self.start_acsd()

    def start_spy(self):
        """Records the done actions from the vehicles' states."""
        binary = shutil.which("mosquitto_sub")
        self.assertIsNotNone(binary, "mosquitto_sub is missing; run scripts/setup")
        self.done_actions = {}
        pending = [b""]

        def read(chunk):
            *lines, pending[0] = (pending[0] + chunk).split(b"\n")
            for line in lines:
                for action in json.loads(line).get("actionStates", ()):
                    if action["actionStatus"] == "FINISHED" and action["actionType"] in ("pick", "drop"):
                        self.done_actions[action["actionId"]] = action["actionType"]

        self.line.start("mosquitto_sub", "-p", self.line.broker_port, "-t", "uagv/v2/ACS/LR01/state", binary=binary,
                        on_output=read)

    def start_acsd(self):
        # A killed vehicle loses its load, and no operator reports that to acsd.
        self.acsd = self.line.start_acsd(self.mcs_address, self.arm, "robot.taken_port=load")
        self.acsd.wait_ready()

    @staticmethod
    def post(url, body=None):
        request = urllib.request.Request(url, json.dumps(body or {}).encode(), method="POST")
        with urllib.request.urlopen(request, timeout=10) as response:
            return response.status

    def kill_acsd(self):
        self.line.forget(self.acsd)
        self.acsd.send_signal(signal.SIGKILL)
        self.acsd.stop()
        self.start_acsd()

    def supply(self):
        """Keeps both robots in work: never fewer than MOST_OPEN plans that are not finished."""
        self.trace.update()
        sent = len(self.trace.plans)
        if sent == getattr(self, "asked", 0) and self.trace.count_open() < MOST_OPEN:
            self.asked = sent + 1
            self.mcs.process.stdin.write(f"plan {self.plan_files[sent % len(self.plan_files)]}\n".encode())

    def supply_for(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.supply()
            self.stopped.wait(min(0.05, max(0.0, end - time.monotonic())))

    def wait_until(self, is_reached, otherwise, seconds=FINISH_SECONDS):
        end = time.monotonic() + seconds
        while not is_reached():
            self.assertLess(time.monotonic(), end, otherwise)
            self.assertTrue(self.is_running(), "acsd has ended by itself")
            self.stopped.wait(0.05)
            self.trace.update()

    def is_running(self):
        return self.acsd.is_running()

    def play(self, strike, kills):
        """Strikes `kills` times under permanent work, then waits until every plan has ended."""
        self.supply_for(2.0)
        for _ in range(kills):
            self.supply_for(self.random.uniform(0.05, 2.5))
            strike()
        self.supply_for(1.0)
        self.wait_until(lambda: len(self.trace.plans) == self.asked and self.trace.count_open() == 0,
                        "every plan ends after the last kill")
        self.mcs.process.stdin.write(b"quit\n")
        self.exit_code = self.mcs.wait(FINISH_SECONDS)
        self.trace.update()

    def judge(self, all_completed=True):
        trace = self.trace
        self.assertEqual(trace.faults, [])
        self.assertEqual(trace.refused, {})
        self.assertEqual(set(trace.plans), trace.acked)
        self.assertEqual({plan_id: trace.get_final(plan_id) for plan_id in trace.plans
                          if len(trace.get_final(plan_id)) != 1}, {}, "exactly one final report per plan")
        done = {"LR": 0, "CR": 0}
        begun = {"LR": 0, "CR": 0}
        for plan_id, plan in trace.plans.items():
            expected, reports = make_expected(plan), trace.get_reports(plan_id)
            if trace.get_final(plan_id) == ["Completed"]:
                self.assertEqual(reports, expected, plan_id)
            self.assertEqual([report for report in reports if reports.count(report) > 1], [], plan_id)
            kind = "LR" if plan["steps"][0]["action"].startswith("Cassette") else "CR"
            done[kind] += sum(report[0] == "JobReport" and report[-1] == "Completed" for report in reports)
            begun[kind] += sum(report[0] == "JobReport" and report[-1] == "Instructed" for report in reports)
        self.assertGreaterEqual(len(self.done_actions), done["LR"], "no job is reported that was not done")
        self.assertLessEqual(len(self.done_actions), begun["LR"], "no job is done twice")
        self.assertGreaterEqual(self.read_counter("ml101") - 1, done["CR"], "no job is reported that was not done")
        self.assertLessEqual(self.read_counter("ml100") - 1, begun["CR"], "no job is begun twice")
        print(f"{len(trace.plans)} plans, {begun['LR']} jobs of the vehicle, {begun['CR']} of the arm ...", end=" ",
              file=sys.stderr)
        if all_completed:
            self.assertEqual({trace.get_final(plan_id)[0] for plan_id in trace.plans}, {"Completed"})
            self.assertEqual([alarm for alarm in trace.alarms if alarm["errorCode"] == "ACS-1008"], [],
                             "the robots report the outcome of each job")
            self.assertEqual(self.exit_code, 0)

    def read_counter(self, name):
        first = {"ml100": 400, "ml101": 404}[name]
        url = f"http://{self.arm['http']}/project/plc/m/val_s32?st={first}&len=1"
        with urllib.request.urlopen(url, timeout=10) as response:
            return json.loads(response.read())[0]

    def play_long(self, strike):
        self.play(strike, max(1, SETTINGS.kills // 10))

    @staticmethod
    def skip_unless_long():
        if not SETTINGS.long:
            raise unittest.SkipTest("with --long")


def run_kill_tests():
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--kills", type=int, default=SETTINGS.kills)
    parser.add_argument("--seed", type=int, default=SETTINGS.seed)
    parser.add_argument("--long", action="store_true")
    parser.parse_known_args(namespace=SETTINGS)
    _, rest = parser.parse_known_args()
    sys.argv[1:] = rest
    run_tests()
