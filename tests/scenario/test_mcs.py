#!/usr/bin/env python3
"""mcs-sim as a tool: every ready scenario passes against acsd, a scenario that must fail does, and the trace has it all."""

import json
import subprocess
import unittest

from scenario_case import FINISH_SECONDS, PLANS, REPOSITORY, TIME_SCALE, ScenarioCase, main

SCENARIOS = REPOSITORY / "examples" / "scenarios"
# What the arm must be like for a scenario.
ARM_OPTIONS = {"job-failure": ["--program", "12=500ms,fail"]}


class Scenarios(ScenarioCase):
    def play(self, *arguments, arm_options=()):
        """Runs mcs-sim against a whole line; returns it after it has ended, with its exit code."""
        self.line.start_broker()
        vehicles = self.line.start_vehicles(TIME_SCALE)
        arm = self.line.start("openstream-sim", "--listen", "127.0.0.1:0", "--http", "127.0.0.1:0", "--time-scale",
                              TIME_SCALE, *arm_options)
        vehicles.wait_ready()
        mcs = self.line.start("mcs-sim", "--listen", "127.0.0.1:0", *arguments)
        self.line.start_acsd(mcs.wait_ready()["ws"], arm.wait_ready()).wait_ready()
        return mcs, mcs.wait(FINISH_SECONDS)

    def write_scenario(self, *steps):
        path = self.line.folder / "scenario.json"
        path.write_text(json.dumps({"name": "test", "steps": steps}))
        return path

    def test_an_expectation_that_does_not_hold_makes_the_run_fail_and_is_told(self):
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
        lines = [json.loads(line) for line in trace.read_text().splitlines()]
        self.assertEqual([(line["direction"], line["message"]["command"]) for line in lines[:2]],
                         [("in", "Registration"), ("out", "RegistrationAck")])
        ids = {name: [line["message"]["transactionId"] for line in lines if line["message"]["command"] == name]
               for name in ("SyncConfig", "SyncConfigAck")}
        self.assertEqual(len(ids["SyncConfig"]), 1)
        self.assertEqual(ids["SyncConfig"], ids["SyncConfigAck"])
        self.assertEqual(sorted(line["time"] for line in lines), [line["time"] for line in lines])

    def test_a_scenario_that_is_none_is_refused_with_its_place(self):
        path = self.write_scenario({"wait": "1s"}, {"cancel": "A"})
        result = subprocess.run([self.bin_dir / "mcs-sim", "--scenario", path], capture_output=True, text=True,
                                timeout=20, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn(f"{path}: steps[1].cancel: expected the name", result.stderr)


def make_test(path):
    def test(self):
        mcs, code = self.play("--scenario", path, arm_options=ARM_OPTIONS.get(path.stem, ()))
        self.assertEqual(code, 0, mcs.log.read_text())

    return test


for scenario in sorted(SCENARIOS.glob("*.json")):
    setattr(Scenarios, "test_scenario_" + scenario.stem.replace("-", "_"), make_test(scenario))

if __name__ == "__main__":
    main()
