#!/usr/bin/env python3
"""A vehicle or acsd is killed and started again at each phase of a plan: the plan completes, and nothing is done twice."""

import time

from scenario_case import FINISH_SECONDS, main
from traced_line import TIME_SCALE, TracedLineCase

MAP_DEVIATION = 0.5
DOCK = "D-A01.CP01"
PICKED = [("A01.CP01", "LR01.CP01")]


class VehicleRestarts(TracedLineCase):
    def hold(self, *faults):
        self.start_line(*faults, overrides=("robot.load_timeout=1s",))

    def restart_vehicle(self, start):
        self.kill(self.vehicle)
        self.line.start_vehicles(TIME_SCALE, (f"LR01,type=LR,{start}",)).wait_ready()
        self.finish()
        return self.read_drives()

    def test_before_the_drive(self):
        self.hold("LR01 stuck error=held level=WARNING")
        self.wait_for(lambda: self.has_error("held") and self.find_last_state()["orderId"], "an order is accepted")
        drives = self.restart_vehicle("node=D-CHG01")
        self.assert_begins(drives[0], "D-CHG01", "N045")
        self.assert_begins(drives[1], "D-CHG01", "N045")

    def test_on_a_node_of_the_drive(self):
        self.hold("LR01 stuck node=N047 error=held level=WARNING")
        self.wait_for_error("held")
        self.assert_begins(self.restart_vehicle("node=N047")[1], "N047", "N050")

    def test_between_two_nodes_of_the_drive(self):
        self.hold("LR01 stuck node=N046 at=200ms error=held level=WARNING")
        self.wait_for_error("held")
        state = self.find_last_state()
        self.assertEqual(state["lastNodeId"], "N046")
        at = state["agvPosition"]
        drives = self.restart_vehicle(f"node=N046,position={at['x']}:{at['y']}")
        self.assert_begins(drives[1], "N046", "N047")
        self.assertGreater(drives[1][0]["nodePosition"]["allowedDeviationXY"], MAP_DEVIATION)

    def test_at_the_dock_before_the_job(self):
        self.hold(f"LR01 loss topic=order direction=in node={DOCK}",
                  f"LR01 stuck node={DOCK} error=held level=WARNING")
        self.wait_for_error("held")
        self.wait_for(lambda: "pick" in self.read_actions(), "the job is commanded")
        self.assertEqual(self.read_moves(), [])
        drives = self.restart_vehicle(f"node={DOCK}")
        self.assert_begins(drives[1], DOCK, "N052")

    def test_during_the_action(self):
        self.hold(f"LR01 estop node={DOCK} at=400ms")
        self.wait_for_error("emergencyStop")
        self.assertEqual([action["actionStatus"] for action in self.find_last_state()["actionStates"]], ["RUNNING"])
        self.restart_vehicle(f"node={DOCK}")
        self.assertEqual(self.read_actions(), ["pick", "pick", "drop"])

    def test_after_an_action_whose_end_was_not_reported(self):
        self.hold(f"LR01 silence topic=state node={DOCK} at=100ms")
        self.wait_for(lambda: self.read_moves() == PICKED, "the carrier is picked")
        self.restart_vehicle(f"node={DOCK}")
        self.assertEqual(self.read_actions()[-1], "drop")

    def test_after_an_action_that_was_never_reported(self):
        """The state that accepts the job comes 50 ms after the state of the arrival; it is lost, as all that follow."""
        self.hold(f"LR01 silence topic=state node={DOCK} at=30ms")
        self.wait_for(lambda: self.read_moves() == PICKED, "the carrier is picked")
        self.assertNotIn("pick", [action["actionType"] for action in self.find_last_state()["actionStates"]])
        self.restart_vehicle(f"node={DOCK}")
        self.assertEqual(self.read_actions()[-1], "drop")

    def test_with_the_load_on_board(self):
        self.hold("LR01 stuck node=N060 error=held level=WARNING")
        self.wait_for_error("held")
        drives = self.restart_vehicle("node=N060")
        self.assert_begins(drives[2], "N060", "N061")
        self.assertEqual(self.read_actions(), ["pick", "drop"])


class AcsdRestarts(TracedLineCase):
    def restart_acsd(self):
        self.kill(self.acsd)
        self.start_acsd()
        self.finish()

    def test_between_two_nodes_of_the_drive(self):
        self.start_line("LR01 stuck node=N046 at=200ms for=2s error=held level=WARNING")
        self.wait_for_error("held")
        self.restart_acsd()

    def test_during_the_action(self):
        self.start_line(f"LR01 estop node={DOCK} at=400ms for=2s")
        self.wait_for_error("emergencyStop")
        self.restart_acsd()
        self.assertEqual(self.read_actions(), ["pick", "drop"])

    def test_the_action_ends_meanwhile(self):
        self.start_line(f"LR01 estop node={DOCK} at=400ms for=2s")
        self.wait_for_error("emergencyStop")
        self.kill(self.acsd)
        deadline = time.monotonic() + FINISH_SECONDS
        while self.read_moves() != PICKED:
            self.assertLess(time.monotonic(), deadline, "the carrier is picked")
            time.sleep(0.02)
        self.start_acsd()
        self.finish()
        self.assertEqual(self.read_actions(), ["pick", "drop"])


if __name__ == "__main__":
    main()
