#!/usr/bin/env python3
"""acs-sim finds nothing in front of mcs-sim, e20_mcs_journal and a correct MCS, whatever it does itself, and names the rule that
each defect of an MCS violates."""

import json
import signal
import socket
import subprocess
import tempfile
import unittest

from faulty_mcs import DEFECTS, FaultyMcs
from scenario_case import FINISH_SECONDS, PLANS
from scenario_case import ScenarioCase as _ScenarioCase
from scenario_case import main
from production_line import Program

FAULTS = ("late-report", "duplicate-report", "out-of-order", "unknown-report", "unknown-command", "bad-payload", "malformed",
          "unknown-ack", "late-ack", "refuse-plan", "fail-job", "not-connected", "reconnect")
QUICK = ("--time-scale", "50")


class AcsSim(unittest.TestCase):
    def start(self, address, *arguments):
        """acs-sim with its output as lines."""
        process = subprocess.Popen(
            [_ScenarioCase.bin_dir.resolve() / "acs-sim", "--url", f"ws://{address}/acs/", *QUICK, *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        return process

    def run_to_end(self, address, *arguments):
        process = self.start(address, "--for", f"{FINISH_SECONDS}s", *arguments)
        lines = process.stdout.read().splitlines()
        return process.wait(), lines

    def start_program(self, name, *arguments, **options):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        program = Program(name, [_ScenarioCase.bin_dir.resolve() / name, *map(str, arguments)], folder.name, **options)
        self.addCleanup(program.stop)
        return program, program.wait_ready()["ws"]

    def assert_nothing_found(self, code, lines, plans):
        self.assertEqual([line for line in lines if "VIOLATION" in line], [], "\n".join(lines))
        self.assertEqual(code, 0, "\n".join(lines))
        self.assertTrue(lines[-1].endswith(f" of {plans} plans have ended"), lines[-1])

    def test_mcs_sim_has_no_defect(self):
        mcs, address = self.start_program("mcs-sim", "--listen", "127.0.0.1:0", "--repeat", 2, "--plan", *PLANS)
        self.assert_nothing_found(*self.run_to_end(address, "--plans", "4"), 4)
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0, "mcs-sim has judged acs-sim")

    def test_mcs_sim_copes_with_each_fault(self):
        for fault in FAULTS:
            with self.subTest(fault=fault):
                # Two more plans than must end: one may be refused.
                _, address = self.start_program("mcs-sim", "--listen", "127.0.0.1:0", "--repeat", 2, "--keep", "--plan", *PLANS)
                self.assert_nothing_found(*self.run_to_end(address, "--plans", "2", "--fault", fault), 2)

    def test_the_journal_of_e20_has_no_defect(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        mcs, address = self.start_program("e20_mcs_journal", 0, f"{folder.name}/journal", stdin=subprocess.PIPE, bufsize=0)
        self.addCleanup(mcs.process.stdin.close)
        for number in range(4):
            plan = json.loads(PLANS[number % 2].read_text()) | {"planId": f"PLAN-{number}"}
            mcs.process.stdin.write(json.dumps(plan).encode() + b"\n")
        faults = [part for fault in FAULTS if fault != "refuse-plan" for part in ("--fault", fault)]
        self.assert_nothing_found(*self.run_to_end(address, "--plans", "4", *faults), 4)

    def test_a_correct_mcs_has_no_defect(self):
        mcs = FaultyMcs()
        self.addCleanup(mcs.close)
        faults = [part for fault in FAULTS for part in ("--fault", fault)]
        code, lines = self.run_to_end(mcs.address, "--plans", "20", *faults)
        self.assert_nothing_found(code, lines, 20)
        self.assertEqual({line for line in lines if line.startswith("fault")}, {f"fault: {fault}" for fault in FAULTS})
        # Whether a slow MCS acknowledges isConnected=false before it is true again is a matter of time.
        self.assertLessEqual({line.split()[0] for line in lines if "not seen" in line}, {"plan-withheld"})

    def test_each_defect_is_named_by_its_rule(self):
        for defect, (rule, faults) in DEFECTS.items():
            with self.subTest(defect=defect):
                mcs = FaultyMcs(defect)
                self.addCleanup(mcs.close)
                process = self.start(mcs.address, "--ack-timeout", "1s", "--for", f"{FINISH_SECONDS}s",
                                     *[part for fault in faults for part in ("--fault", fault)])
                lines = []
                for line in process.stdout:
                    lines.append(line.rstrip())
                    if line.startswith(f"VIOLATION {rule} ("):
                        process.send_signal(signal.SIGINT)
                        break
                lines += process.stdout.read().splitlines()
                rows = [line for line in lines if line.startswith(rule + " ") and "VIOLATED" in line]
                self.assertEqual(len(rows), 1, "\n".join(lines))
                self.assertEqual(process.wait(FINISH_SECONDS), 1)

    def test_an_interruption_prints_the_table(self):
        mcs = FaultyMcs()
        self.addCleanup(mcs.close)
        process = self.start(mcs.address)
        self.assertTrue(any(line == "registered\n" for line in iter(process.stdout.readline, "")))
        process.send_signal(signal.SIGINT)
        lines = process.stdout.read().splitlines()
        self.assertIn("plans have ended", lines[-1])
        self.assertEqual(process.wait(FINISH_SECONDS), 0)

    def test_without_an_mcs_the_exit_code_is_1(self):
        with socket.socket() as closed:  # bound, not listening
            closed.bind(("127.0.0.1", 0))
            process = self.start(f"127.0.0.1:{closed.getsockname()[1]}", "--for", "100ms")
            process.wait(FINISH_SECONDS)
        lines = process.stdout.read().splitlines()
        self.assertEqual((process.wait(FINISH_SECONDS), lines[-1]), (1, "the MCS has not accepted a registration"))


if __name__ == "__main__":
    main()
