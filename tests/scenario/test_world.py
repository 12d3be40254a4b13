#!/usr/bin/env python3
"""The right carrier at the right place: compares the moves of the simulated robots with the plans and the reports of acsd."""

import json
import re
import unittest

from scenario_case import FINISH_SECONDS, PLANS, SITE, ScenarioCase, main

CR_PLAN = json.loads(PLANS[1].read_text())
RELAYS = "/project/plc/set_relay_value"


class World(ScenarioCase):
    def run_plans(self, plans, *options, config=None, programs=None):
        """Plans through a whole line on one floor; returns mcs-sim after it has ended."""
        self.line.share_world()
        arm = self.start_robots(programs=programs)
        mcs = self.line.start_mcs(plans, *options)
        self.trace = self.line.folder / "trace"
        self.line.start_acsd(mcs.wait_ready()["ws"], arm, config=config, arguments=("--trace", self.trace)).wait_ready()
        self.exit_code = mcs.wait(FINISH_SECONDS)
        return mcs

    def read_events(self, *kinds):
        """What is in the journal, but for what was placed by hand and where robots are docked."""
        lines = (self.line.folder / "world.json.journal").read_text().splitlines()
        return [event for event in map(json.loads, lines) if event["event"] in kinds]

    def read_moves(self):
        return [(event["event"], event.get("carrier"), event["from"], event["to"])
                for event in self.read_events("CarrierMoved", "MemoryMoved")]

    def write_plan(self, name, change):
        """A copy of the CR example plan, its steps changed by the function."""
        plan = json.loads(json.dumps(CR_PLAN))
        change(plan["steps"])
        path = self.line.folder / name
        path.write_text(json.dumps(plan))
        return path

    def read_config(self):
        return (SITE / "acsd.toml").read_text().replace('map = "site.lif.json"', f'map = "{SITE / "site.lif.json"}"')

    def write_file(self, name, text):
        path = self.line.folder / name
        path.write_text(text)
        return path

    def write_config_with_swapped_inputs(self, action, first, second):
        """The site's configuration, but each of the two relay words gets what the other one should."""
        text = self.read_config()
        section = re.search(rf"^\[actions\.{action}\]$.*?(?=^\[|\Z)", text, re.MULTILINE | re.DOTALL)
        values = dict(re.findall(r'(ml\d+) = ("[^"]*")', section[0]))
        swapped = {first: values[second], second: values[first]}
        self.assertNotEqual(values[first], values[second])
        changed = re.sub(r'(ml\d+) = ("[^"]*")', lambda match: f"{match[1]} = {swapped.get(match[1], match[2])}", section[0])
        return self.write_file("acsd.toml", text.replace(section[0], changed))

    def read_inputs(self):
        """The relay words of each job, in the order in which acsd had them written."""
        texts = [json.loads(line) for file in sorted(self.trace.iterdir()) for line in file.read_text().splitlines()]
        return [entry["text"] for entry in texts
                if entry["link"] == "arm" and entry["direction"] == "out" and RELAYS in entry["text"]]

    def assert_summary(self, mcs, deliveries, plans):
        self.assertEqual(mcs.tail(2), [deliveries, plans])

    def test_every_tray_and_memory_ends_where_the_plan_demands_it(self):
        mcs = self.run_plans(PLANS[1:])
        self.assert_summary(mcs, "2 carriers delivered, 0 misplaced", "1 plans completed, 0 failed")
        self.assertEqual(self.exit_code, 0)
        self.assertEqual(self.read_moves(), [
            ("CarrierMoved", "TRAY_01", "A01.CP02.TP01", "CR01.TP01"),
            ("CarrierMoved", "TRAY_02", "A01.CP02.TP02", "CR01.TP02"),
            ("MemoryMoved", None, "CR01.TP01.MP01", "A01.SET01.MP01"),
            ("MemoryMoved", None, "CR01.TP02.MP01", "A01.SET01.MP02"),
            ("CarrierMoved", "TRAY_01", "CR01.TP01", "A01.CP02.TP03"),
            ("CarrierMoved", "TRAY_02", "CR01.TP02", "A01.CP02.TP04")])

    def test_inputs_in_two_ranges_of_relays(self):
        """The robot's port is far from the other words: it is read back by a MONITOR of its own."""
        port = "ml109 = \"{robot_port}\""
        config = self.read_config()
        programs = (SITE / "programs.toml").read_text()
        self.assertEqual((config.count(port), programs.count("{robot}.TP{ml109}")), (2, 2))
        mcs = self.run_plans(
            PLANS[1:],
            config=self.write_file("acsd.toml", config.replace(port, port.replace("ml109", "ml900"))),
            programs=self.write_file("programs.toml", programs.replace("{robot}.TP{ml109}", "{robot}.TP{ml900}")))
        self.assert_summary(mcs, "2 carriers delivered, 0 misplaced", "1 plans completed, 0 failed")
        self.assertEqual(self.exit_code, 0)

    def test_the_inputs_of_two_jobs_differ_as_their_places_do(self):
        self.run_plans(PLANS[1:])
        self.assertEqual(self.exit_code, 0)
        inputs = {}
        for number, text in enumerate(self.read_inputs()):
            for relay, value in re.findall(r'"(ml\d+)","value":(-?\d+)', self.flatten(text)):
                inputs.setdefault(relay, []).append((number, int(value)))
        # TrayLoad and TrayUnload have five words each, MemoryPickAndPlace has nine.
        self.assertEqual([value for _, value in inputs["ml108"]], [1, 2, 1, 2, 3, 4])
        self.assertEqual([value for _, value in inputs["ml107"]][:2], [2, 2])
        self.assertEqual([value for _, value in inputs["ml109"]][:2], [1, 2])
        numbers = [value for _, value in inputs["ml105"]]
        self.assertEqual(len(set(numbers)), len(numbers))
        self.assertEqual(len(numbers), 6)

    @staticmethod
    def flatten(text):
        return re.sub(r"\s", "", text)

    def test_swapped_inputs_of_an_unload_fail_the_plan(self):
        """The arm would unload the port with the number of the tray's place: it is empty."""
        mcs = self.run_plans(PLANS[1:], config=self.write_config_with_swapped_inputs("TrayUnload", "ml108", "ml109"))
        self.assertEqual(self.exit_code, 1)
        self.assert_summary(mcs, "0 carriers delivered, 0 misplaced", "0 plans completed, 1 failed")
        self.assertEqual([move[2:] for move in self.read_moves() if move[2].startswith("CR01.TP0") and move[1]], [])

    def test_swapped_inputs_that_the_arm_can_execute_are_found_by_the_mcs(self):
        """The arm loads the other tray into another port of the robot: it and acsd notice nothing."""
        def load_crosswise(steps):
            steps[1:] = []
            steps[0]["carrierIds"] = ["TRAY_01"]
            steps[0]["jobs"] = [steps[0]["jobs"][0] | {"to": "AMR.TP02"}]

        mcs = self.run_plans([self.write_plan("crosswise.json", load_crosswise)],
                             config=self.write_config_with_swapped_inputs("TrayLoad", "ml108", "ml109"))
        self.assertEqual(self.exit_code, 1)
        self.assert_summary(mcs, "0 carriers delivered, 1 misplaced", "1 plans completed, 0 failed")
        plan_id = CR_PLAN["planId"]
        violations = [line.removeprefix(" violation: ") for line in mcs.log.read_text().splitlines()
                      if line.startswith(" violation: ")]
        self.assertEqual(violations, [
            f"{plan_id} JobReport step 1 Completed, but not moved: CR01: TRAY_01 from A01.CP02.TP01 to CR01.TP02",
            f"{plan_id} TRAY_01 is at A01.CP02.TP01, not at CR01.TP02",
            "done without a report: CR01: TRAY_02 from A01.CP02.TP02 to CR01.TP01"])

    def test_repeated_plans_find_the_floor_that_they_need(self):
        mcs = self.run_plans(PLANS, "--repeat", "2")
        self.assert_summary(mcs, "6 carriers delivered, 0 misplaced", "4 plans completed, 0 failed")
        self.assertEqual(self.exit_code, 0)

    def test_without_restocking_the_plans_move_the_carriers_of_the_world_file(self):
        mcs = self.run_plans(PLANS, "--fresh-ids", "--no-restock")
        self.assert_summary(mcs, "3 carriers delivered, 0 misplaced", "2 plans completed, 0 failed")
        self.assertEqual(self.exit_code, 0)
        self.assertEqual(self.read_events("CarrierPlaced", "MemoryPlaced"), [])
        self.assertIn(("CarrierMoved", "CASSETTE_01", "LR01.CP01", "A02.CP03"), self.read_moves())


if __name__ == "__main__":
    main()
