#!/usr/bin/env python3
"""A vehicle that rejects its orders: its plans are executed by others or wait, and an operator lets it work again."""

import json
import shutil
import subprocess

from scenario_case import FINISH_SECONDS, PLANS, main
from traced_line import VEHICLES, TracedLineCase

# Cassettes of the fleet's plans and their targets.
TRANSPORTS = {"C1": ("A01.CP01", "A02.CP03"), "C2": ("A01.CP03", "A02.CP01"), "C3": ("A01.CP05", "A02.CP05"),
              "C4": ("A01.CP06", "A02.CP06"), "C5": ("A01.CP04", "A02.CP04")}
PINNED = "C5"
OTHER_NODES = {"LR02": "N060", "LR03": "N070", "LR04": "N015", "LR05": "N030"}


def make_table(name):
    return f"""
[robots.{name}]
type = "LR"
manufacturer = "ACS"
serial = "{name}"
vehicle_type = "lr-base"
start_node = "{OTHER_NODES[name]}"
ports = ["CP01"]
"""


def make_vehicles(*names):
    return (VEHICLES[0], *[f"{name},type=LR,node={OTHER_NODES[name]}" for name in names], *VEHICLES[1:])


class Refusals(TracedLineCase):
    def find_refusal_alarms(self):
        return [alarm for alarm in self.read_status(self.operator)["alarms"] if alarm["errorCode"] == "ACS-1012"]

    def wait_for_refusal_alarm(self):
        self.wait_for_status(self.operator, lambda status: [
            (alarm["robotId"], alarm["level"]) for alarm in status["alarms"] if alarm["errorCode"] == "ACS-1012"
        ] == [("LR01", "heavy")])

    def command_vehicles(self, line):
        binary = shutil.which("mosquitto_pub")
        self.assertIsNotNone(binary, "mosquitto_pub is missing; run scripts/setup")
        subprocess.run([binary, "-p", str(self.line.broker_port), "-q", "1", "-t", "vda-sim/control", "-m", line],
                       check=True, timeout=10)

    def make_plan(self, carrier):
        """The example plan for this carrier; one is pinned to LR01 and comes last."""
        plan = json.loads(PLANS[0].read_text())
        robot = "LR01" if carrier == PINNED else "AMR"
        plan.update(planId=f"PLAN-{carrier}", priority=1 if carrier == PINNED else 10)
        for step, place, ends in zip(plan["steps"], TRANSPORTS[carrier], ("from", "to")):
            step.update(position=place, carrierIds=[carrier])
            other = "to" if ends == "from" else "from"
            step["jobs"][0].update({"jobId": f"{carrier}-{ends}", ends: place, other: f"{robot}.CP01"})
        path = self.line.folder / f"{carrier}.json"
        path.write_text(json.dumps(plan))
        return path

    def test_a_vehicle_that_rejects_its_orders_is_unavailable_until_the_alarm_is_cleared(self):
        self.start_line("LR01 refuse count=3")
        self.wait_for_refusal_alarm()
        (plan,) = self.read_status(self.operator)["plans"]
        self.assertEqual(plan["status"], "Pending")
        (robot,) = plan["waits"]["robots"]
        self.assertIn("rejects its commands: the vehicle rejected the order", robot["reason"])
        self.post("/v1/alarms/clear", {"robotId": "LR01", "errorCode": "ACS-1012"})
        self.finish()
        self.assertEqual(len([nodes for nodes in self.read_drives() if nodes[0]["nodeId"] == "D-CHG01"]), 4)

    def test_a_change_of_the_operating_mode_lets_a_vehicle_that_rejected_its_orders_work_again(self):
        self.start_line("LR01 refuse count=3")
        self.wait_for_refusal_alarm()
        self.command_vehicles("LR01 mode mode=MANUAL")
        self.wait_for(lambda: self.find_last_state()["operatingMode"] == "MANUAL", "MANUAL")
        self.assertEqual(len(self.find_refusal_alarms()), 1)
        self.command_vehicles("LR01 end mode")
        self.wait_for_status(self.operator, lambda status: all(
            alarm["errorCode"] != "ACS-1012" for alarm in status["alarms"]))
        self.finish()

    def test_the_plan_of_a_vehicle_that_rejects_every_order_is_completed_by_another(self):
        self.start_line("LR01 refuse for=10m", vehicles=make_vehicles("LR02"), tables=make_table("LR02"),
                        overrides=("tsc.initial=paused",))
        self.resume_with_all_vehicles()
        self.finish("LR02")
        self.assertEqual(len(self.read_drives()), 1)

    def test_a_fleet_of_five_works_without_the_vehicle_that_rejects_every_order(self):
        self.start_line("LR01 refuse for=10m error=routeError", vehicles=make_vehicles(*OTHER_NODES),
                        tables="".join(map(make_table, OTHER_NODES)), overrides=("tsc.initial=paused",),
                        world={"version": 1, "carriers": {carrier: ends[0] for carrier, ends in TRANSPORTS.items()}},
                        plans=[self.make_plan(carrier) for carrier in TRANSPORTS])
        self.wait_for_status(self.operator, lambda status: len(status["plans"]) == len(TRANSPORTS))
        self.resume_with_all_vehicles()
        self.wait_for_status(self.operator, lambda status: [plan["planId"] for plan in status["plans"]] == ["PLAN-C5"],
                             FINISH_SECONDS)
        pinned = self.read_status(self.operator)["plans"][0]
        self.assertEqual(pinned["status"], "Pending")
        (robot,) = pinned["waits"]["robots"]
        self.assertEqual(robot["robotId"], "LR01")
        self.assertIn("rejects its commands: the vehicle rejected the order", robot["reason"])
        (alarm,) = self.find_refusal_alarms()
        self.assertEqual((alarm["robotId"], alarm["level"]), ("LR01", "heavy"))
        self.assertIn("routeError", alarm["message"])
        carriers = [carrier for carrier in TRANSPORTS if carrier != PINNED]
        moves = self.read_moves()
        self.assertEqual({end for move in moves for end in move if end.startswith("LR01")}, set())
        self.assertEqual(sorted(end for move in moves for end in move if not end.startswith("LR")),
                         sorted(end for carrier in carriers for end in TRANSPORTS[carrier]))
        self.assertEqual(len(self.read_drives()), 3)
        self.command_vehicles("LR01 end refuse")
        self.post("/v1/alarms/clear", {"robotId": "LR01", "errorCode": "ACS-1012"})
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        self.assertEqual(self.mcs.tail(2), ["5 carriers delivered, 0 misplaced", "5 plans completed, 0 failed"])
        start, target = TRANSPORTS[PINNED]
        self.assertEqual(self.read_moves()[-2:], [(start, "LR01.CP01"), ("LR01.CP01", target)])


if __name__ == "__main__":
    main()
