#!/usr/bin/env python3
"""Vehicles of several makes and with several ports: each gets its jobs with its own names of actions, places and ports."""

import json
import shutil
import subprocess
import time
import urllib.request

from scenario_case import FINISH_SECONDS, PLANS, STATUS_SECONDS, TIME_SCALE, ScenarioCase, main

# A make whose actions, parameters and load positions have names of their own. It knows no stationType.
OTHER_MAKE = ("LR02,type=LR,node=N001,ports=2,load=CP01:1,load=CP02:2,pick=loadCassette,drop=unloadCassette,"
              "stationName=rack,lhd=fork:INTEGER,stationType=")
ROBOT = """
[robots.LR02]
type = "LR"
manufacturer = "ACS"
serial = "LR02"
vehicle_type = "lr-base"
start_node = "N001"
ports = ["CP01-02"]
load_positions = { CP01 = "1", CP02 = "2" }
"""
OTHER_ROBOT = ROBOT + """
[robots.LR02.actions.CassetteLoad]
vehicle_action = "loadCassette"
parameters = { rack = "{place}", fork = "{robot_port}", loadType = "cassette", loadId = "{carrier}" }

[robots.LR02.actions.CassetteUnload]
vehicle_action = "unloadCassette"
parameters = { rack = "{place}", fork = "{robot_port}", loadId = "{carrier}" }
"""


def make_plan(plan_id, robot, jobs):
    """Cassettes (carrier, from, port, to): all of them onto the robot, then all of them off it."""
    def make_step(number, action, place, carrier, start, end):
        return {"stepNo": number, "action": action, "position": place, "carrierIds": [carrier],
                "jobs": [{"jobId": f"{plan_id}-{number}", "from": start, "to": end}]}
    loads = [make_step(number, "CassetteLoad", start, carrier, start, f"{robot}.{port}")
             for number, (carrier, start, port, _) in enumerate(jobs, 1)]
    unloads = [make_step(number, "CassetteUnload", end, carrier, f"{robot}.{port}", end)
               for number, (carrier, _, port, end) in enumerate(jobs, len(jobs) + 1)]
    return {"planId": plan_id, "lotId": "LOT", "priority": 1, "steps": loads + unloads}


class Vehicles(ScenarioCase):
    def start_plans(self, plans, vehicles, *overrides, tables=""):
        """A whole line on one floor, and mcs-sim with the plans."""
        self.line.share_world()
        self.line.start_broker()
        self.line.start_vehicles(TIME_SCALE, vehicles).wait_ready()
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        files = []
        for plan in plans:
            files.append(self.line.folder / f"{plan['planId']}.json")
            files[-1].write_text(json.dumps(plan))
        mcs = self.line.start_mcs(files)
        site = self.line.site_dir
        config = self.line.folder / "acsd.toml"
        config.write_text((site / "acsd.toml").read_text().replace('"site.lif.json"', f'"{site / "site.lif.json"}"')
                          + tables)
        self.trace = self.line.folder / "trace"
        self.acsd = self.line.start_acsd(mcs.wait_ready()["ws"], arm, *overrides, config=config,
                                         arguments=("--trace", self.trace))
        self.operator = self.acsd.wait_ready()["operator"]
        return mcs

    @staticmethod
    def read_metrics(http):
        with urllib.request.urlopen(f"http://{http}/metrics", timeout=STATUS_SECONDS) as response:
            return response.read().decode()

    def stop_acsd(self):
        """Else the last line of the trace may be half written."""
        self.line.forget(self.acsd)
        self.acsd.stop()

    def run_plans(self, plans, vehicles, *overrides, tables=""):
        """Returns mcs-sim after it has ended."""
        mcs = self.start_plans(plans, vehicles, *overrides, tables=tables)
        self.exit_code = mcs.wait(FINISH_SECONDS)
        self.stop_acsd()
        return mcs

    def wait_for_reason(self, plan_id, reason):
        """Until only this plan is left, and waits with this reason."""
        message = f"No robot can execute the plan: {reason}."
        self.wait_for_status(self.operator, lambda status: [
            (plan["planId"], (plan["waits"] or {}).get("message")) for plan in status["plans"]] == [(plan_id, message)],
            FINISH_SECONDS)

    def read_moves(self, robot):
        """(carrier, from, to) of everything that the robot has moved."""
        lines = (self.line.folder / "world.json.journal").read_text().splitlines()
        events = [event for event in map(json.loads, lines) if event["event"] == "CarrierMoved"]
        return [(event["carrier"], event["from"], event["to"]) for event in events
                if f"{robot}." in event["from"] + event["to"]]

    def read_actions(self, robot):
        """(actionType, parameters) of each job that the robot was sent, in that order."""
        texts = [json.loads(line) for file in sorted(self.trace.iterdir()) for line in file.read_text().splitlines()]
        actions = {}
        for entry in texts:
            if entry["link"] == "mqtt" and entry["direction"] == "out" and entry["topic"].endswith(f"/{robot}/order"):
                for node in json.loads(entry["text"])["nodes"]:
                    for action in node["actions"]:
                        actions[action["actionId"]] = (action["actionType"], {
                            parameter["key"]: parameter["value"] for parameter in action["actionParameters"]})
        return list(actions.values())

    def test_four_ports_are_loaded_and_unloaded_as_the_plan_names_them(self):
        jobs = [("C1", "A01.CP01", "CP03", "A02.CP01"), ("C2", "A01.CP03", "CP01", "A02.CP02"),
                ("C3", "A01.CP04", "CP04", "A02.CP03"), ("C4", "A01.CP05", "CP02", "A02.CP04")]
        mcs = self.run_plans([make_plan("FOUR", "AMR", jobs)], ("LR01,type=LR", "CR01,type=CR"),
                             'robots.LR01.ports=["CP01-04"]')
        self.assertEqual(mcs.tail(2), ["4 carriers delivered, 0 misplaced", "1 plans completed, 0 failed"])
        self.assertEqual(self.exit_code, 0)
        self.assertEqual(self.read_moves("LR01"),
                         [(carrier, start, f"LR01.{port}") for carrier, start, port, _ in jobs]
                         + [(carrier, f"LR01.{port}", end) for carrier, _, port, end in jobs])
        self.assertEqual(self.read_actions("LR01")[0], ("pick", {
            "stationType": "rack", "stationName": "A01.CP01", "loadType": "cassette", "loadId": "C1", "lhd": "CP03",
            "height": 0.8}))

    def run_mosquitto(self, name, *arguments):
        binary = shutil.which(name)
        self.assertIsNotNone(binary, f"{name} is missing; run scripts/setup")
        return subprocess.run([binary, "-p", str(self.line.broker_port), "-q", "1", *arguments], capture_output=True,
                              text=True, timeout=10, check=False)

    def test_commands_that_others_have_left_on_the_broker_are_removed(self):
        topics = [f"uagv/v2/ACS/LR01/{topic}" for topic in ("order", "instantActions")]
        foreign = "uagv/v2/ACS/OTHER/order"
        self.line.start_broker()
        for topic in (*topics, foreign):
            self.assertEqual(self.run_mosquitto("mosquitto_pub", "-r", "-t", topic, "-m", '{"orderId": "left"}').returncode, 0)
        self.line.share_world()
        mcs = self.line.start_mcs([PLANS[0]])
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        acsd = self.line.start_acsd(mcs.wait_ready()["ws"], arm)
        http = acsd.wait_ready()["http"]
        deadline = time.monotonic() + FINISH_SECONDS
        metric = 'acsd_retained_commands_removed_total{robot="LR01"} 2'
        while metric not in self.read_metrics(http):
            self.assertLess(time.monotonic(), deadline, acsd.log.read_text())
            time.sleep(0.05)
        # A vehicle that subscribes now receives what is left: here the message that is not for one of acsd's vehicles.
        left = self.run_mosquitto("mosquitto_sub", "-F", "%t", "-W", "1", *[part for topic in (*topics, foreign)
                                                                            for part in ("-t", topic)])
        self.assertEqual(left.stdout.split(), [foreign])
        for topic in topics:
            self.assertRegex(acsd.log.read_text(), f"warning.*retained.*{topic}")
        self.line.start_vehicles(TIME_SCALE).wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assertIn(metric, self.read_metrics(http))

    def test_two_makes_each_complete_a_plan_on_one_site(self):
        plans = [make_plan("OURS", "LR01", [("C1", "A01.CP01", "CP01", "A02.CP01")]),
                 make_plan("THEIRS", "LR02", [("C2", "A01.CP03", "CP02", "A02.CP02"),
                                              ("C3", "A01.CP04", "CP01", "A02.CP03")])]
        mcs = self.run_plans(plans, ("LR01,type=LR", "CR01,type=CR", OTHER_MAKE), tables=OTHER_ROBOT)
        self.assertEqual(mcs.tail(2), ["3 carriers delivered, 0 misplaced", "2 plans completed, 0 failed"])
        self.assertEqual(self.exit_code, 0)
        self.assertEqual([kind for kind, _ in self.read_actions("LR01")], ["pick", "drop"])
        self.assertEqual(self.read_actions("LR02"), [
            ("loadCassette", {"rack": "A01.CP03", "fork": 2, "loadType": "cassette", "loadId": "C2"}),
            ("loadCassette", {"rack": "A01.CP04", "fork": 1, "loadType": "cassette", "loadId": "C3"}),
            ("unloadCassette", {"rack": "A02.CP02", "fork": 2, "loadId": "C2"}),
            ("unloadCassette", {"rack": "A02.CP03", "fork": 1, "loadId": "C3"})])

    def test_a_plan_with_a_mandatory_parameter_that_has_no_value_waits_with_the_reason(self):
        plans = [make_plan("NONE", "LR01", [("C1", "A01.CP02", "CP01", "A02.CP01")])]
        self.start_plans(plans, ("LR01,type=LR", "CR01,type=CR"),
                         'actions.CassetteLoad.parameters={stationType="{station.height}", loadType="cassette"}')
        self.wait_for_reason("NONE", "LR01: the parameter stationType of pick cannot be given: "
                                     "the job has no {station.height}")
        self.stop_acsd()
        self.assertEqual(self.read_actions("LR01"), [])
        self.assertEqual(self.read_moves("LR01"), [])

    def test_a_vehicle_that_demands_an_unknown_parameter_gets_no_plan_and_another_one_does_the_work(self):
        plans = [make_plan("OPEN", "AMR", [("C1", "A01.CP01", "CP01", "A02.CP01")]),
                 make_plan("PINNED", "LR02", [("C2", "A01.CP03", "CP02", "A02.CP02")])]
        demanding = "LR02,type=LR,node=N001,ports=2,load=CP01:1,load=CP02:2,stationType=kind"
        names = 'parameters = { stationName = "{place}", loadType = "cassette", loadId = "{carrier}" }'
        self.start_plans(plans, ("LR01,type=LR", "CR01,type=CR", demanding),
                         tables=f"{ROBOT}[robots.LR02.actions.CassetteLoad]\n{names}\n")
        self.wait_for_reason("PINNED", "LR02: the parameter kind of pick is mandatory and not configured")
        self.stop_acsd()
        self.assertEqual([kind for kind, _ in self.read_actions("LR01")], ["pick", "drop"])
        self.assertEqual(self.read_actions("LR02"), [])
        self.assertEqual(self.read_moves("LR02"), [])


if __name__ == "__main__":
    main()
