#!/usr/bin/env python3
"""A vehicle that is switched to manual mode has lost its order: its plan waits, and continues when the vehicle is back."""

from scenario_case import main
from traced_line import TracedLineCase

MAP_DEVIATION = 0.5


class Modes(TracedLineCase):
    def run_with_fault(self, fault):
        self.start_line(fault, overrides=("robot.load_timeout=1s",))
        self.finish()
        return self.read_drives()

    def test_manual_mode_before_the_drive(self):
        drives = self.run_with_fault("LR01 mode for=3s")
        self.assert_begins(drives[0], "D-CHG01", "N045")
        self.assert_begins(drives[1], "D-A01.CP01", "N052")

    def test_manual_mode_on_a_node_of_the_drive(self):
        drives = self.run_with_fault("LR01 mode node=N046 for=2s")
        self.assert_begins(drives[0], "D-CHG01", "N045")
        self.assert_begins(drives[1], "N046", "N047")
        self.assert_begins(drives[2], "D-A01.CP01", "N052")

    def test_manual_mode_between_two_nodes_of_the_drive(self):
        drives = self.run_with_fault("LR01 mode node=N046 at=200ms for=2s")
        self.assert_begins(drives[1], "N046", "N047")
        self.assertGreater(drives[1][0]["nodePosition"]["allowedDeviationXY"], MAP_DEVIATION)
        self.assertEqual(drives[1][1]["nodePosition"]["allowedDeviationXY"], MAP_DEVIATION)

    def test_manual_mode_with_a_load_on_board(self):
        drives = self.run_with_fault("LR01 mode node=N060 for=2s")
        self.assert_begins(drives[1], "D-A01.CP01", "N052")
        self.assert_begins(drives[2], "N060", "N061")

    def test_manual_mode_at_the_dock_before_the_job(self):
        drives = self.run_with_fault("LR01 mode node=D-A01.CP01 for=2s")
        self.assert_begins(drives[1], "D-A01.CP01", "N052")

    def test_manual_mode_during_the_action(self):
        self.run_with_fault("LR01 mode node=D-A01.CP01 at=400ms for=2s")
        actions = self.read_actions()
        self.assertEqual(actions, ["pick", "pick", "drop"])

    def test_manual_mode_after_the_action(self):
        self.run_with_fault("LR01 mode node=N052 at=3s for=2s")
        self.assertEqual(self.read_actions(), ["pick", "drop"])


if __name__ == "__main__":
    main()
