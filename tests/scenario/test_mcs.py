#!/usr/bin/env python3
"""mcs-sim as a tool: every ready scenario passes against acsd, a scenario that must fail fails, and the trace is complete."""

import dataclasses
import fcntl
import json
import os
import signal
import subprocess
import unittest

from scenario_case import FINISH_SECONDS, PLANS, REPOSITORY, SITE, TIME_SCALE, Line, ScenarioCase, main
import operator_api  # which scenario_case makes known
from wire_rules import WireRules, read_trace

SCENARIOS = REPOSITORY / "examples" / "scenarios"
# Ten lines play at the same time. mcs-sim itself ends a scenario that takes longer than its "within"; this limit is for
# an mcs-sim that hangs.
PLAY_SECONDS = 600


@dataclasses.dataclass
class Batch:
    """Scenarios that one mcs-sim plays over a line of its own, and what that line is like."""

    names: list
    arm: tuple = ()
    acsd: tuple = ()
    mcs: tuple = ()
    vehicles: tuple = ("LR01,type=LR", "CR01,type=CR")
    vda: tuple = ()


# All are played at the same time. Scenarios that change the state of the ACS come last. Those that pause a robot during a
# job have jobs that last long enough on a busy machine.
BATCHES = [
    Batch(["lr-plan", "robot-status", "abort-while-driving", "cancel-before-arrival", "cancel-after-arrival",
           "cancel-waiting", "abort-waiting", "control-finished-plan", "pinned-robot", "priority", "location-spelling"]),
    Batch(["plan-list", "plan-history", "plan-history-ended", "repeated-request", "duplicate-plan", "connection-drop",
           "replay-after-drop", "connect", "close-1008", "local-time", "job-failure-lr"], acsd=("site.timezone=+09:00",)),
    Batch(["error-list", "cr-plan", "cr-carriers", "set-cover", "deep-position", "control-unknown-plan",
           "unknown-location", "unknown-robot", "mixed-robots", "bad-messages", "each-command", "undefined-payload",
           "null-result-request", "old-name", "sync-config", "robot-positions", "registration-refused",
           "registration-unanswered", "queue-full"]),
    Batch(["abort-running-job"], arm=("--program", "11=40s")),
    Batch(["lost-ack", "late-acks", "wrong-ack-id", "loose-acks", "job-failure", "abort-failing-job"],
          arm=("--program", "12=20s,fail")),
    Batch(["pause-resume", "pause-refused", "pause-driving", "pause-waiting", "pause-repeated", "cancel-paused",
           "controls-race", "abort-paused"], vda=("--action-time", "pick=40s")),
    Batch(["pause-cr", "abort-paused-cr", "abort-second-of-five", "abort-last-job"],
          arm=("--program", "11=40s", "--program", "12=20s")),
    Batch(["pinned-robots"], vehicles=("LR01,type=LR", "CR01,type=CR", "RBT01,type=LR,node=D-A02.CP06"),
          acsd=("robots.RBT01.type=LR", "robots.RBT01.manufacturer=ACS", "robots.RBT01.serial=RBT01",
                "robots.RBT01.vehicle_type=lr-base", "robots.RBT01.start_node=D-A02.CP06",
                "robots.RBT01.home=A02.CP06", 'robots.RBT01.ports=["CP01"]')),
    Batch(["lr-plan", "plan-history", "null-result-request"], mcs=("--profile", "nexus")),
]
# These the ACS of the examples plays too, and its operator types what it is asked for.
SMALL_ACS = ["pause-resume", "pause-refused", "abort-paused", "cancel-paused", "tsc-paused"]
TYPED = {"pause the TSC": b"pause\n", "resume the TSC": b"auto\n"}
# These need an action from outside: a test each.
ATTENDED = ["comm-loss", "error-set-cleared", "tsc-paused"]


def get_paths(names):
    return [SCENARIOS / f"{name}.json" for name in names]


class Scenarios(ScenarioCase):
    def start_play(self, line, *arguments, batch=Batch([])):
        """mcs-sim, and a whole line for it."""
        line.start_broker()
        vehicles = line.start_vehicles(TIME_SCALE, batch.vehicles, options=batch.vda)
        arm = line.start_arm(TIME_SCALE, *batch.arm)
        vehicles.wait_ready()
        mcs = line.start("mcs-sim", "--listen", "127.0.0.1:0", *batch.mcs, *arguments)
        line.start_acsd(mcs.wait_ready()["ws"], arm.wait_ready(), *batch.acsd).wait_ready()
        return mcs

    def play(self, *arguments):
        """Runs mcs-sim against a whole line; returns it after it has ended, with its exit code."""
        mcs = self.start_play(self.line, *arguments)
        return mcs, mcs.wait(FINISH_SECONDS)

    def start_play_with_small_acs(self, line, paths, typed):
        acs = []
        mcs = line.start("mcs-sim", "--listen", "127.0.0.1:0", "--scenario", *paths, on_output=self.answer({
            text: (lambda typing=typing: acs[0].process.stdin.write(typing)) for text, typing in typed.items()}))
        acs.append(line.start("e09_small_acs", f"ws://{mcs.wait_ready()['ws']}/acs/", stdin=subprocess.PIPE, bufsize=0))
        self.addCleanup(acs[0].process.stdin.close)
        return mcs

    def start_line(self):
        line = Line(self.bin_dir, SITE)
        line.__enter__()
        self.addCleanup(line.stop)
        return line

    def test_each_ready_scenario_is_played(self):
        played = {name for batch in BATCHES for name in batch.names} | set(ATTENDED)
        self.assertEqual(sorted(played), sorted(path.stem for path in SCENARIOS.glob("*.json")))

    def test_each_ready_scenario_has_its_row_for_the_reader(self):
        rows = [line.split("]")[0][3:] for line in (SCENARIOS / "README.md").read_text().splitlines()
                if line.startswith("| [")]
        self.assertEqual(rows, sorted(path.stem for path in SCENARIOS.glob("*.json")))

    def test_the_ready_scenarios_pass(self):
        """Every message of every scenario also keeps the rules of the document (wire_rules.py)."""
        plays = []
        for batch in BATCHES:
            line = self.start_line()
            trace = line.folder / "trace.ndjson"
            mcs = self.start_play(line, "--trace", trace, "--scenario", *get_paths(batch.names), batch=batch)
            plays.append((batch.names, mcs, trace, "+09:00" if "local-time" in batch.names else None))
        small = self.start_play_with_small_acs(self.start_line(), get_paths(SMALL_ACS), TYPED)
        plays.append((SMALL_ACS, small, None, None))
        for names, mcs, trace, offset in plays:
            with self.subTest(batch=names):
                try:
                    code = mcs.wait(PLAY_SECONDS)
                except subprocess.TimeoutExpired:
                    code = None
                output = mcs.log.read_text()
                self.assertEqual(code, 0, output)
                self.assertEqual([name for name in names if f" scenario {name}: passed\n" not in output], [])
                if trace is not None:
                    self.assertEqual(WireRules(offset).judge(read_trace(trace)), [])

    @staticmethod
    def answer(answers):
        """For on_output: calls each answer once what it is the answer to has been asked for."""
        seen = bytearray()
        pending = dict(answers)

        def watch(chunk):
            seen.extend(chunk)
            for text in [text for text in pending if f"asked for: {text}".encode() in seen]:
                pending.pop(text)()

        return watch

    def stop_program(self, program):
        self.line.forget(program)
        program.stop()

    def kill_program(self, program):
        program.send_signal(signal.SIGKILL)
        self.stop_program(program)

    def test_scenario_comm_loss(self):
        mcs = self.line.start("mcs-sim", "--listen", "127.0.0.1:0", "--scenario", SCENARIOS / "comm-loss.json",
                              on_output=self.answer({
                                  "make the ACS unable to work":
                                      lambda: self.stop_program(self.line.broker),
                                  "make the ACS able to work again":
                                      lambda: self.line.start_broker(self.line.broker_port)}))
        arm_addresses = self.start_robots()
        self.line.start_acsd(mcs.wait_ready()["ws"], arm_addresses).wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0, mcs.log.read_text())

    def test_scenario_error_set_cleared(self):
        """The base of LR01 dies and comes back; the will of its connection makes it an error at once."""
        self.line.start_broker()
        arm = self.line.start_arm(TIME_SCALE)
        # Each program alone would put its vehicle on the first charger.
        logistics, control = (self.line.start_vehicles(TIME_SCALE, (vehicle,))
                              for vehicle in ("LR01,type=LR", "CR01,type=CR,node=D-CHG02"))
        for vehicle in (logistics, control):
            vehicle.wait_ready()
        mcs = self.line.start("mcs-sim", "--listen", "127.0.0.1:0", "--scenario", SCENARIOS / "error-set-cleared.json",
                              on_output=self.answer({
                                  "raise an error": lambda: self.kill_program(logistics),
                                  "clear the error": lambda: self.line.start_vehicles(TIME_SCALE, ("LR01,type=LR",))}))
        self.line.start_acsd(mcs.wait_ready()["ws"], arm.wait_ready()).wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0, mcs.log.read_text())

    def test_a_program_is_reset_by_the_path_that_the_controller_serves(self):
        """From 60.30 on r_code, before it the task's own path: acsd tries the one and then the other."""
        for version, urls in (("70.04-00", {"r_code"}), ("60.20-00", {"r_code", "tasks[0]/reset"})):
            with self.subTest(version), Line(self.line.bin_dir, self.line.site_dir) as line:
                line.start_broker()
                vehicles = line.start_vehicles(TIME_SCALE)
                arm = line.start_arm(TIME_SCALE, "--program", "11=40s", "--controller-version", version)
                vehicles.wait_ready()
                mcs = line.start("mcs-sim", "--listen", "127.0.0.1:0", "--scenario", *get_paths(["abort-paused-cr"]))
                trace = line.folder / "trace"
                line.start_acsd(mcs.wait_ready()["ws"], arm.wait_ready(), arguments=("--trace", trace)).wait_ready()
                self.assertEqual(mcs.wait(FINISH_SECONDS), 0, mcs.log.read_text())
                text = "".join(file.read_text() for file in trace.iterdir())
                self.assertEqual({url for url in ("r_code", "tasks[0]/reset") if url in text}, urls)

    def test_scenario_tsc_paused(self):
        """The operator of acsd asks for it over HTTP."""
        acsd = []

        def post(path):
            self.assertEqual(operator_api.post(acsd[0].addresses["operator"], path)[0], 202)

        mcs = self.line.start("mcs-sim", "--listen", "127.0.0.1:0", "--scenario", SCENARIOS / "tsc-paused.json",
                              on_output=self.answer({"pause the TSC": lambda: post("/v1/tsc/pause"),
                                                     "resume the TSC": lambda: post("/v1/tsc/resume")}))
        arm_addresses = self.start_robots()
        acsd.append(self.line.start_acsd(mcs.wait_ready()["ws"], arm_addresses))
        acsd[0].wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0, mcs.log.read_text())

    def test_the_small_acs_replays_its_reports_after_a_kill(self):
        """The file holds what the MCS has not acknowledged, with the same transactionId and timestamp."""
        small = []

        def start_small_acs():
            small.append(self.line.start("e09_small_acs", f"ws://{mcs.addresses['ws']}/acs/", self.line.folder / "outbox"))

        def restart():
            self.kill_program(small[0])
            start_small_acs()

        job = {"planId": "{A}", "jobId": "{A.1.1}"}
        scenario = self.write_scenario(
            {"send": "ExecutionPlan", "file": str(PLANS[0]), "as": "A"},
            {"expect": "StepReport", "payload": {"planId": "{A}", "stepNo": 1, "status": "InProgress"}},
            {"withholdAcks": "JobReport", "for": "1m"},
            {"expect": "JobReport", "payload": {**job, "status": "Instructed"}, "as": "first"},
            {"expect": "JobReport", "payload": {**job, "status": "InProgress"}, "as": "second"},
            {"ask": "kill the ACS and start it again"},
            {"expect": "Registration", "payload": {}},
            *({"expectNext": "JobReport", "repeated": True, "transactionId": f"{{{name}.transactionId}}",
               "timestamp": f"{{{name}.timestamp}}", "payload": {**job, "status": status}}
              for name, status in (("first", "Instructed"), ("second", "InProgress"))))
        mcs = self.line.start("mcs-sim", "--listen", "127.0.0.1:0", "--scenario", scenario,
                              on_output=self.answer({"kill the ACS and start it again": restart}))
        mcs.wait_ready()
        start_small_acs()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0, mcs.log.read_text())

    def test_the_small_acs_reports_a_result_for_each_abort(self):
        result = {"expectNext": "AbortResultReport", "payload": {"planId": "{A}", "result": "Success"}, "besides": "*Update"}
        scenario = self.write_scenario(
            {"send": "ExecutionPlan", "file": str(PLANS[0]), "as": "A"},
            {"expect": "JobReport", "payload": {"planId": "{A}", "jobId": "{A.1.1}", "status": "InProgress"}},
            {"abort": "A"}, {"abort": "A"},
            {"expect": "JobReport", "payload": {"planId": "{A}", "jobId": "{A.1.1}", "status": "Completed"}},
            {"expectNext": "PlanReport", "payload": {"planId": "{A}", "status": "Aborted"}, "besides": "*Update"},
            result, result,
            {"expectNothing": "*Report", "payload": {"planId": "{A}"}, "for": "1s"})
        mcs = self.start_play_with_small_acs(self.line, [scenario], {})
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0, mcs.log.read_text())

    def write_scenario(self, *steps):
        path = self.line.folder / "scenario.json"
        path.write_text(json.dumps({"name": "test", "steps": steps}))
        return path

    def test_an_unmet_expectation_fails_the_run_and_is_reported(self):
        path = self.write_scenario(
            {"send": "ExecutionPlan", "file": str(PLANS[0]), "as": "A"},
            {"expect": "ExecutionPlanAck", "result": "Success"},
            {"expect": "ExecutionPlanAck", "result": "Fail", "within": "1s"},
            {"waitFor": "A", "status": "Completed"})
        mcs, code = self.play("--scenario", path)
        self.assertEqual(code, 1)
        output = mcs.log.read_text()
        self.assertIn("FAILED      expect ExecutionPlanAck result=Fail", output)
        self.assertIn("no ExecutionPlanAck came within 1s", output)
        self.assertIn("not reached wait until A is Completed", output)
        self.assert_last_line(mcs, "0 of 1 scenarios passed, 1 of 3 expectations held, 0 violations")

    def test_the_trace_has_every_message_of_both_directions(self):
        trace = self.line.folder / "trace.ndjson"
        _, code = self.play("--scenario", SCENARIOS / "sync-config.json", "--trace", trace)
        self.assertEqual(code, 0)
        lines = read_trace(trace)
        self.assertEqual([(line["direction"], line["message"]["command"]) for line in lines[:2]],
                         [("in", "Registration"), ("out", "RegistrationAck")])
        ids = {name: [line["message"]["transactionId"] for line in lines if line["message"]["command"] == name]
               for name in ("SyncConfig", "SyncConfigAck")}
        self.assertEqual(len(ids["SyncConfig"]), 1)
        self.assertEqual(ids["SyncConfig"], ids["SyncConfigAck"])
        self.assertEqual(sorted(line["time"] for line in lines), [line["time"] for line in lines])

    def make_certificate(self, name):
        certificate, key = self.line.folder / f"{name}.pem", self.line.folder / f"{name}.key"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-subj", "/CN=localhost", "-keyout", key, "-out", certificate], check=True, capture_output=True)
        return certificate, key

    def test_an_invalid_tls_file_is_rejected_with_its_option(self):
        certificate, key = self.make_certificate("one")
        _, foreign = self.make_certificate("two")
        junk = self.line.folder / "junk.pem"
        junk.write_text("junk")
        rows = {
            "--tls-certificate": [("--tls-certificate", "nowhere.pem", "--tls-key", key),
                                  ("--tls-certificate", junk, "--tls-key", key)],
            "--tls-key": [("--tls-certificate", certificate, "--tls-key", "nowhere.key"),
                          ("--tls-certificate", certificate, "--tls-key", junk),
                          ("--tls-certificate", certificate, "--tls-key", foreign)],
            "--tls-client-ca": [("--tls-certificate", certificate, "--tls-key", key, "--tls-client-ca", junk)],
        }
        for option, lines in rows.items():
            for arguments in lines:
                with self.subTest(arguments=arguments):
                    result = subprocess.run(
                        [self.bin_dir / "mcs-sim", "--listen", "127.0.0.1:0", "--plan", PLANS[0], *arguments],
                        capture_output=True, text=True, timeout=20, check=False)
                    self.assertEqual(result.returncode, 2, result.stderr)
                    self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                    self.assertIn(f"{option}: expected ", result.stderr)

    def test_the_ready_line_states_whether_it_is_wss(self):
        certificate, key = self.make_certificate("one")
        mcs = self.line.start("mcs-sim", "--listen", "127.0.0.1:0", "--plan", PLANS[0], "--tls-certificate", certificate,
                              "--tls-key", key)
        self.assertEqual(list(mcs.wait_ready()), ["wss"])

    def assert_terminal_unchanged(self, *command, answer):
        """The program answers `help` on a terminal with a text that has this part, and `quit` ends it."""
        terminal, of_program = os.openpty()
        self.addCleanup(os.close, terminal)
        self.addCleanup(os.close, of_program)
        process = subprocess.Popen([self.bin_dir / command[0], *command[1:]], stdin=of_program, stdout=of_program, stderr=of_program)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        os.write(terminal, b"help\n")
        shown = b""
        while answer not in shown:  # which is not in what was typed
            shown += os.read(terminal, 65536)
        self.assertEqual(fcntl.fcntl(of_program, fcntl.F_GETFL) & os.O_NONBLOCK, 0)
        os.write(terminal, b"quit\n")
        self.assertEqual(process.wait(FINISH_SECONDS), 0)

    def test_the_console_leaves_the_terminal_as_it_is_for_other_programs(self):
        self.assert_terminal_unchanged("mcs-sim", "--listen", "127.0.0.1:0", "--console", answer=b"abort")

    def test_the_console_reads_on_after_a_line_that_is_too_long(self):
        for size in (4095, 4096, 5000, 3 * 4096, 100_000):
            with self.subTest(size=size):
                result = subprocess.run([self.bin_dir / "mcs-sim", "--listen", "127.0.0.1:0", "--console"],
                                        input="x" * size + "\nlist\nquit\n", capture_output=True, text=True,
                                        timeout=FINISH_SECONDS, check=False)
                self.assertIn(" no plans\n", result.stdout)
                self.assertEqual(" a line has at most 4095 bytes\n" in result.stdout, size > 4095)

    def test_the_small_acs_leaves_the_terminal_as_it_is_for_other_programs(self):
        self.assert_terminal_unchanged("e09_small_acs", "ws://127.0.0.1:1/acs/", answer=b"does nothing now")

    def test_a_trace_that_cannot_be_written_fails_the_run(self):
        _, code = self.play("--scenario", SCENARIOS / "sync-config.json", "--trace", "/dev/full")
        self.assertEqual(code, 1)

    def test_an_invalid_scenario_is_rejected_with_its_place(self):
        path = self.write_scenario({"wait": "1s"}, {"cancel": "A"})
        result = subprocess.run([self.bin_dir / "mcs-sim", "--scenario", path], capture_output=True, text=True,
                                timeout=20, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn(f"{path}: steps[1].cancel: expected the name", result.stderr)


if __name__ == "__main__":
    main()
