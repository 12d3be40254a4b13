#!/usr/bin/env python3
"""e20_mcs_journal in front of acsd and simulated robots: it is killed after it has written a report and before it answers it.
At the end its journal has each report that acsd has sent, once, and they match what the robots have moved. What it cannot
write reaches acsd's log and status as Fail with the reason. An acsd without its token gets HTTP 401.

--kills N   number of kills (5)
--seed N    seed of the moments; printed on failure
"""

import argparse
import os
import random
import resource
import signal
import subprocess
import sys
import time

from journal_line import FULL, JournalCase, get_key, is_report
from scenario_case import FINISH_SECONDS, ScenarioCase
from scenario_case import main as run_tests
from kill_case import make_expected

SETTINGS = argparse.Namespace(kills=5, seed=1)
MOST_REPORTS = 6  # between two kills
UNPRIVILEGED = 65534
HALF_A_LINE = b'{"command":"PlanReport","transactionId":"'


class McsJournal(JournalCase):
    def setUp(self):
        super().setUp()
        self.random = random.Random(f"{SETTINGS.seed} {self.id()}")

    def tearDown(self):
        super().tearDown()
        if self.has_failed():
            print(f"--seed {SETTINGS.seed} --kills {SETTINGS.kills}", file=sys.stderr)

    def test_the_mcs_is_killed_between_its_journal_and_its_ack(self):
        self.start_line()
        self.end_mcs()
        for _ in range(SETTINGS.kills):
            self.start_mcs("--die-after", self.random.randint(1, MOST_REPORTS))
            self.wait_until(lambda: self.supply() or not self.mcs.is_running(), "the MCS is killed")
            self.assertEqual(self.end_mcs(), -signal.SIGKILL)
            if self.random.randrange(2):  # as if it had been killed while it wrote
                with open(self.journal_file, "ab") as file:
                    file.write(HALF_A_LINE[:self.random.randint(1, len(HALF_A_LINE))])
        self.start_mcs()
        self.wait_for_the_end_of_all_plans()
        again = sum("Written before." in line for line in self.mcs.tail(1_000_000))
        self.judge()
        self.assertGreaterEqual(again, SETTINGS.kills, "a report comes again after each kill")
        print(f"{len(self.journal.reports)} reports, {again} of them again ...", end=" ", file=sys.stderr)

    def test_a_full_disk_is_answered_with_fail_and_the_reason(self):
        self.start_line()
        self.write_plan("LR")
        self.wait_until(lambda: self.journal.reports, "a first report is written")
        before = self.limit_journal(len(HALF_A_LINE))
        self.wait_for_status(self.operator, lambda status: status["refusedReports"]["count"] > 0)
        last = self.read_status(self.operator)["refusedReports"]["last"]
        self.assertEqual((last["planId"], last["message"]), ("LR-0000", FULL))
        self.assertIn(f'reason="{FULL}"', "".join(line for line in self.acsd.tail(1000) if "the MCS refuses a report" in line))
        self.wait_for_status(self.operator, lambda status: not status["plans"] and not status["outbox"]["reports"],
                             FINISH_SECONDS)

        resource.prlimit(self.mcs.process.pid, resource.RLIMIT_FSIZE, before)
        self.write_plan("LR")
        self.wait_until(lambda: len(self.journal.plans["LR"]) == 2, "the next plan is written")
        self.wait_until(lambda: self.journal.count_open("LR") == 1, "the next plan ends")
        self.assertEqual(self.end_mcs(), 0)
        self.start_mcs()  # on a journal without half lines
        refused = {tuple(line.split(": ")[0].split()) for line in self.mcs.tail(1000) if f"Fail {FULL}" in line}
        sent = {get_key(message) for direction, message in self.read_trace() if direction == "out" and is_report(message)}
        self.assertEqual(set(map(get_key, self.journal.reports)), sent - refused)
        self.assertEqual(self.journal.get_reports("LR-0001"), make_expected(self.journal.plans["LR"][1]))

    def test_a_plan_whose_ack_cannot_be_written_is_not_sent_again(self):
        self.line.share_world()
        self.arm = self.start_robots()
        self.start_mcs()
        self.write_plan("LR")
        ScenarioCase.wait_until(self, lambda: self.journal.update() or self.journal.plans["LR"], "the plan is written")
        self.limit_journal(0)
        self.start_acsd()
        unwritten = f"after a restart the plan is sent again: {FULL}"
        self.wait_until(lambda: unwritten in self.mcs.tail(1000), "the plan has its Ack")
        count = self.count_positions()
        self.wait_until(lambda: self.count_positions() > count + 5, "further positions reach the MCS")
        plans = [message for direction, message in self.read_trace() if direction == "in" and message["command"] == "ExecutionPlan"]
        self.assertEqual(len(plans), 1)

    def count_positions(self):
        return sum(file.read_text(errors="replace").count("RobotPositionUpdate") for file in self.trace.glob("*"))

    def test_an_acs_without_the_token_gets_401(self):
        self.arm = self.start_robots()
        self.start_mcs(environment=os.environ | {"MCS_TOKEN": "right"})
        for header in (None, "Authorization: Bearer wrong", "Authorization: Bearer right"):
            headers = self.line.folder / "headers"
            headers.write_text("" if header is None else header + "\n")
            headers.chmod(0o600)
            self.start_acsd(f"mcs.headers_file={headers}")
            if header is not None and header.endswith("right"):
                self.wait_for_status(self.operator, lambda status: status["links"]["mcs"])
                self.assertNotIn("HTTP 401", self.acsd.log.read_text())
                break
            self.wait_until(lambda: "the server refused the connection with HTTP 401" in self.acsd.log.read_text(), "401")
            self.assertFalse(self.read_status(self.operator)["links"]["mcs"])
            self.line.forget(self.acsd)
            self.acsd.stop()
            self.acsd.log.unlink()
        self.assertIn("refused: 127.0.0.1 has not the token", self.mcs.tail(1000))
        self.assertEqual([line for line in self.mcs.tail(1000) if "right" in line or "wrong" in line], [])

    def test_a_second_program_and_a_foreign_file_are_refused(self):
        self.start_mcs()
        foreign = self.line.folder / "foreign"
        foreign.write_text("no message\nand no newline")
        for file, reason in ((self.journal_file, "Resource temporarily unavailable"), (foreign, "Bad message"),
                             (self.line.folder, "Is a directory")):
            ended = subprocess.run([self.bin_dir / "e20_mcs_journal", "0", file], stdout=subprocess.PIPE, text=True,
                                   timeout=FINISH_SECONDS, check=False)
            self.assertEqual((ended.returncode, ended.stdout), (2, f"{file}: the journal cannot be used: {reason}\n"))
        self.assertEqual(foreign.read_text(), "no message\nand no newline")

    def test_a_journal_that_cannot_be_read_is_left_as_it_is(self):
        self.line.folder.chmod(0o711)
        line = b'{"command":"PlanReportAck","transactionId":"1","result":"Success","message":""}\n'
        self.journal_file.write_bytes(line)
        self.journal_file.chmod(0o200)
        options = {}
        if os.geteuid() == 0:  # which may read each file
            os.chown(self.journal_file, UNPRIVILEGED, UNPRIVILEGED)
            options = {"user": UNPRIVILEGED, "group": UNPRIVILEGED, "extra_groups": []}
        try:
            ended = subprocess.run([self.bin_dir / "e20_mcs_journal", "0", self.journal_file], stdout=subprocess.PIPE, text=True,
                                   timeout=FINISH_SECONDS, check=False, **options)
        except PermissionError:
            self.skipTest("another user cannot run the program")
        self.journal_file.chmod(0o600)
        self.assertEqual(self.journal_file.read_bytes(), line)
        self.assertEqual((ended.returncode, ended.stdout),
                         (2, f"{self.journal_file}: the journal cannot be used: Permission denied\n"))

    def test_an_invalid_plan_is_neither_written_nor_sent(self):
        self.start_mcs()
        lines = (b"hello", b'{"planId":"P"}', b'{},"command":"CancelPlan"')
        self.mcs.process.stdin.write(b"".join(line + b"\n" for line in lines))
        end = time.monotonic() + FINISH_SECONDS
        while len(refused := [line for line in self.mcs.tail() if line.startswith("not a plan: ")]) < len(lines):
            self.assertLess(time.monotonic(), end, refused)
            time.sleep(0.02)
        self.assertIn("payload.", refused[1])
        self.assertEqual(self.journal_file.read_bytes(), b"")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--kills", type=int, default=SETTINGS.kills)
    parser.add_argument("--seed", type=int, default=SETTINGS.seed)
    SETTINGS, rest = parser.parse_known_args()
    sys.argv[1:] = rest
    run_tests()
