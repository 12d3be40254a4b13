#!/usr/bin/env python3
"""The metrics of a line that works: as documented, as promtool wants them, and with Prometheus that evaluates every alert rule
and every panel of the dashboard on them."""

import json
import pathlib
import re
import subprocess
import sys
import time
import urllib.parse
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenario"))
from monitoring_files import (RULES, find_program, list_dashboard_queries, read_documented_metrics,  # noqa: E402
                              read_rules, run_promtool)
from scenario_case import ScenarioCase, main  # noqa: E402
from mcs_stub import McsStub  # noqa: E402
from plan_samples import make_carrying_plan  # noqa: E402
from production_line import find_free_port  # noqa: E402

WAIT_SECONDS = 60
TIMEOUT = 10


class LiveMetrics(ScenarioCase):
    maxDiff = None

    def setUp(self):
        """After a plan, with a trace, an implausible report and a foreign command: every metric but one of alarms has a series."""
        super().setUp()
        stub = McsStub()
        self.addCleanup(stub.close)
        robots = self.start_robots()
        self.publish("-r", "-t", "uagv/v2/ACS/LR01/instantActions", "-m", "{}")
        acsd = self.line.start_acsd(stub.address, robots, arguments=("--trace", self.line.folder / "trace"))
        self.address = acsd.wait_ready()["http"]
        stub.wait_for("RobotStatusUpdate", lambda message: message.payload["robotStatus"] == "Idle"
                      and message.payload["robotId"] == "LR01")
        self.assertEqual(stub.ask("ExecutionPlan", make_carrying_plan("P1"))["result"], "Success")
        stub.wait_for("PlanReport", lambda message: message.payload["status"] == "Completed")
        self.publish("-t", "uagv/v2/ACS/LR01/state", "-m", "no JSON")

    def publish(self, *options):
        subprocess.run([find_program("mosquitto_pub"), "-p", str(self.line.broker_port), *options], check=True)

    def disconnect_vehicles(self):
        self.vehicles.process.kill()
        self.wait_for(lambda: 'acsd_alarms_by_code{code="ACS-1002",level="heavy",robot="LR01"} 1' in self.read_metrics(),
                      "no alarm of LR01")

    def wait_for(self, is_reached, failure):
        deadline = time.monotonic() + WAIT_SECONDS
        while not is_reached():
            self.assertLess(time.monotonic(), deadline, failure)
            time.sleep(0.1)

    def read_metrics(self):
        with urllib.request.urlopen(f"http://{self.address}/metrics", timeout=TIMEOUT) as response:
            return response.read().decode()

    def read_types(self):
        return dict(re.findall(r"^# TYPE (\S+) (\S+)$", self.read_metrics(), re.MULTILINE))

    def test_the_metrics_are_those_of_the_reference_and_follow_the_conventions_of_prometheus(self):
        documented = read_documented_metrics()
        self.wait_for(lambda: {"acsd_store_log_bytes", "acsd_robot_oddities_total"} <= self.read_types().keys(),
                      "the store was not checked, or the report was not counted")
        connected = self.read_types()
        self.assertIn("acsd_robot_battery", connected)  # of connected robots only
        self.disconnect_vehicles()
        self.assertEqual(connected | self.read_types(), documented)
        text = self.read_metrics()
        code, output = run_promtool("check", "metrics", text=text)
        self.assertEqual((code, output), (0, ""))
        # Nothing that cannot occur.
        for series in ('requests_sent_total{command="ExecutionPlan"}', 'requests_received_total{command="PlanReport"}',
                       'requests_refused_total{command="JobReport"}', 'nacks_total{command="RobotPositionUpdate"}',
                       'state{robot="LR01",state="Error"}', 'status="Error"', 'acsd_arm_up{robot="LR01"}'):
            self.assertNotIn(series, text)
        # What an alert needs before the first event.
        for series in ('acsd_job_failures_total{action="CassetteLoad"} 0', 'acsd_mcs_nacks_total{command="JobReport"} 0',
                       'acsd_plan_changes_total{status="Failed"} 0', "acsd_loop_stall_seconds_count "):
            self.assertIn(series, text)

    def start_prometheus(self):
        port = find_free_port()
        config = self.line.folder / "prometheus.yml"
        # JSON is YAML too.
        config.write_text(json.dumps({
            "global": {"scrape_interval": "1s", "evaluation_interval": "1s"}, "rule_files": [str(RULES)],
            "scrape_configs": [{"job_name": "acsd", "static_configs": [{"targets": [self.address]}]}]}))
        self.line.start("prometheus", f"--config.file={config}", f"--storage.tsdb.path={self.line.folder / 'prometheus'}",
                        f"--web.listen-address=127.0.0.1:{port}", binary=find_program("prometheus"))
        self.prometheus = f"http://127.0.0.1:{port}/api/v1"
        self.wait_for(lambda: self.is_answering(), "prometheus does not answer")

    def is_answering(self):
        try:
            return bool(self.query("acsd_build_info"))
        except OSError:
            return False

    def request(self, path, **parameters):
        query = urllib.parse.urlencode(parameters)
        with urllib.request.urlopen(f"{self.prometheus}/{path}?{query}", timeout=TIMEOUT) as response:
            return json.load(response)["data"]

    def query(self, expression):
        return self.request("query", query=expression)["result"]

    def list_rules(self):
        return [rule for group in self.request("rules")["groups"] for rule in group["rules"]]

    def test_prometheus_evaluates_every_rule_and_every_panel_has_data(self):
        self.start_prometheus()
        self.disconnect_vehicles()
        missing = dict.fromkeys(list_dashboard_queries())

        def has_all():
            for panel in [panel for panel in missing if self.query(panel[1])]:
                del missing[panel]
            return not missing

        self.wait_for(has_all, missing)
        self.wait_for(lambda: all(rule["health"] == "ok" for rule in self.list_rules()), "a rule fails")
        rules = {rule["name"]: rule for rule in self.list_rules()}
        self.assertEqual(rules.keys(), read_rules().keys())
        self.wait_for(lambda: {rule["name"]: rule for rule in self.list_rules()}["AcsdRobotDisconnected"]["state"]
                      == "pending", "the alarm is no alert")
        self.assertEqual(rules["AcsdDown"]["state"], "inactive")


if __name__ == "__main__":
    main()
