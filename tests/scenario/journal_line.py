"""A line whose MCS is e20_mcs_journal and whose acsd writes a message trace: for tests that no report is lost or doubled."""

import json
import resource
import subprocess
import time

from scenario_case import FINISH_SECONDS, ScenarioCase
from kill_case import make_expected

FULL = "the journal cannot be used: File too large"
MOST_OPEN = 2  # plans of each kind
FINAL = ("Completed", "Failed", "Aborted", "Cancelled")
# Robot, actions, position, carrier, its two places, the port of the robot.
KINDS = {"LR": ("LR01", "Cassette", ("A01.CP01", "A02.CP03"), "CASSETTE_01", ("A01.CP01", "A02.CP03"), "CP01"),
         "CR": ("CR01", "Tray", ("A01.CP02", "A01.CP02"), "TRAY_01", ("A01.CP02.TP01", "A01.CP02.TP03"), "TP01")}


def make_plan(kind, number):
    """Carries the carrier of this kind to its other place."""
    _, action, positions, carrier, places, port = KINDS[kind]
    turn = -1 if number % 2 else 1
    (load_at, unload_at), (start, end) = positions[::turn], places[::turn]
    plan_id = f"{kind}-{number:04}"
    return {"planId": plan_id, "lotId": "LOT", "priority": 10, "steps": [
        {"stepNo": 1, "action": f"{action}Load", "position": load_at, "carrierIds": [carrier],
         "jobs": [{"jobId": f"{plan_id}-1", "from": start, "to": f"AMR.{port}"}]},
        {"stepNo": 2, "action": f"{action}Unload", "position": unload_at, "carrierIds": [carrier],
         "jobs": [{"jobId": f"{plan_id}-2", "from": f"AMR.{port}", "to": end}]}]}


def list_moves(kind, plans):
    """What the robot has to move for these plans."""
    robot = KINDS[kind][0]
    return [(job["from"].replace("AMR", robot), job["to"].replace("AMR", robot))
            for plan in plans for step in plan["steps"] for job in step["jobs"]]


def is_report(message):
    return message["command"].endswith("Report")


def get_key(message):
    return message["command"], message["transactionId"]


class Journal:
    """The whole lines of the journal, read while it grows."""

    def __init__(self, path):
        self._path = path
        self._offset = 0
        self.plans = {"LR": [], "CR": []}
        self.reports = []

    def update(self):
        if not self._path.exists():
            return
        with open(self._path, "rb") as file:
            file.seek(self._offset)
            lines = file.read().splitlines(keepends=True)
        for line in lines:
            if not line.endswith(b"\n"):
                break
            self._offset += len(line)
            message = json.loads(line)
            if message["command"] == "ExecutionPlan":
                plan = message["payload"]
                self.plans[plan["planId"][:2]].append(plan)
            elif is_report(message):
                self.reports.append(message)

    def get_reports(self, plan_id):
        return [(message["command"], *[payload[name] for name in ("stepNo", "jobId", "status") if name in payload])
                for message in self.reports if (payload := message["payload"]).get("planId") == plan_id]

    def count_open(self, kind):
        ended = {message["payload"]["planId"] for message in self.reports
                 if message["command"] == "PlanReport" and message["payload"]["status"] in FINAL}
        return sum(plan["planId"] not in ended for plan in self.plans[kind])


class JournalCase(ScenarioCase):
    def setUp(self):
        super().setUp()
        self.journal_file = self.line.folder / "mcs.journal"
        self.journal = Journal(self.journal_file)
        self.trace = self.line.folder / "trace"
        self.port = 0

    def start_line(self, find_port=None):
        """acsd connects to the port that find_port returns, without it to the MCS."""
        self.line.share_world()
        self.arm = self.start_robots()
        self.start_mcs()
        self.start_acsd(port=find_port and find_port())

    def start_acsd(self, *overrides, port=None):
        self.acsd = self.line.start_acsd(f"127.0.0.1:{port or self.port}", self.arm, *overrides,
                                         arguments=("--trace", self.trace))
        self.operator = self.acsd.wait_ready()["operator"]

    def start_mcs(self, *options, **others):
        self.mcs = self.line.start("e20_mcs_journal", self.port, self.journal_file, *options, stdin=subprocess.PIPE, bufsize=0,
                                   **others)
        self.addCleanup(self.mcs.process.stdin.close)
        self.port = int(self.mcs.wait_ready()["ws"].rsplit(":", 1)[1])
        self.written = None  # the plan that the MCS has not put into its journal yet

    def end_mcs(self):
        self.line.forget(self.mcs)
        return self.mcs.stop()

    def limit_journal(self, room):
        """The file does not grow by more bytes than that, as on a full disk. Returns the former limit."""
        limit = (self.journal_file.stat().st_size + room, resource.RLIM_INFINITY)
        return resource.prlimit(self.mcs.process.pid, resource.RLIMIT_FSIZE, limit)

    def write_plan(self, kind):
        plan = make_plan(kind, len(self.journal.plans[kind]))
        self.written = (kind, plan)
        try:
            self.mcs.process.stdin.write(json.dumps(plan).encode() + b"\n")
        except BrokenPipeError:
            pass  # it was killed meanwhile, and is started again

    def supply(self):
        """Keeps both robots in work. A plan that is lost with the killed process is written again."""
        self.journal.update()
        if self.written is not None and self.written[1] not in self.journal.plans[self.written[0]]:
            return
        for kind in KINDS:
            if self.journal.count_open(kind) < MOST_OPEN:
                self.write_plan(kind)
                return

    def wait_until(self, is_reached, otherwise, seconds=FINISH_SECONDS):
        end = time.monotonic() + seconds
        while not is_reached():
            self.assertLess(time.monotonic(), end, otherwise)
            self.assertTrue(self.acsd.is_running(), "acsd has ended by itself")
            time.sleep(0.02)
            self.journal.update()

    def wait_for_the_end_of_all_plans(self):
        self.wait_until(lambda: not any(self.journal.count_open(kind) for kind in KINDS), "every plan ends")
        self.wait_until(lambda: self.read_status(self.operator)["outbox"]["reports"] == 0, "every report has its Ack")

    def read_trace(self):
        """(direction, message) of each message between acsd, which has ended, and the MCS."""
        self.line.forget(self.acsd)
        self.assertEqual(self.acsd.stop(), 0)
        entries = [json.loads(line) for file in sorted(self.trace.iterdir()) for line in file.read_text().splitlines()]
        self.assertEqual([entry for entry in entries if entry["link"] == "trace"], [], "the trace is complete")
        return [(entry["direction"], json.loads(entry["text"])) for entry in entries if entry["link"] == "mcs"]

    def read_moves(self, kind):
        robot = KINDS[kind][0]
        events = map(json.loads, (self.line.folder / "world.json.journal").read_text().splitlines())
        return [(event["from"], event["to"]) for event in events
                if event["event"] == "CarrierMoved" and robot in event["from"] + event["to"]]

    def judge(self):
        trace = self.read_trace()
        sent = {get_key(message): message["payload"] for direction, message in trace
                if direction == "out" and is_report(message)}
        self.assertEqual(len(self.journal.reports), len(set(map(get_key, self.journal.reports))), "no report is there twice")
        self.assertEqual({get_key(message): message["payload"] for message in self.journal.reports}, sent,
                         "the journal has each report as acsd has sent it")
        self.assertEqual(sorted({message["payload"]["planId"] for direction, message in trace
                                 if direction == "in" and message["command"] == "ExecutionPlan"}),
                         sorted(plan["planId"] for plans in self.journal.plans.values() for plan in plans))
        for kind, plans in self.journal.plans.items():
            self.assertEqual(self.read_moves(kind), list_moves(kind, plans), "each job is done once")
            for plan in plans:
                self.assertEqual(self.journal.get_reports(plan["planId"]), make_expected(plan))
