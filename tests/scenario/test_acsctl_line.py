#!/usr/bin/env python3
"""acsctl operates a real line: what each command prints and returns when acsd answers."""

import json
import pathlib
import signal
import subprocess
import tarfile

from acsctl_case import AcsctlCase
from scenario_case import FINISH_SECONDS, PLANS, TIME_SCALE, main
from production_line import find_free_port  # which scenario_case makes known


class OperatedLine(AcsctlCase):
    def setUp(self):
        super().setUp()
        self.line.start_broker()
        robots = self.line.start_vehicles(TIME_SCALE, ("LR01,type=LR", "CR01,type=CR"))
        arm = self.line.start_arm(TIME_SCALE).wait_ready()
        robots.wait_ready()
        self.mcs_port = find_free_port()
        self.acsd = self.line.start_acsd(f"127.0.0.1:{self.mcs_port}", arm, arguments=("--trace", str(self.line.folder / "trace")))
        addresses = self.acsd.wait_ready()
        self.http = f"http://{addresses['http']}"
        self.use_acsd(addresses["operator"])

    def test_a_plan_is_found_blocked_freed_and_completed(self):
        self.wait_for_robot("CR01", "Idle")
        self.wait_for_robot("LR01", "Idle")
        self.check(5, "status", "--check")
        self.assertIn("The link mcs is down", " ".join(self.check(5, "why").split()))
        for command in (("status",), ("plans",), ("robots",), ("robot", "CR01"), ("alarms",), ("links",), ("queue",), ("site",),
                        ("events",), ("trace",), ("trace", "--robot", "LR01", "--limit", "5"), ("audit",)):
            self.environment["COLUMNS"] = "80"
            lines = self.check(0, *command).splitlines()
            self.assertLessEqual(max(map(len, lines), default=0), 80, command)
            del self.environment["COLUMNS"]
        self.assertIn("CR09", self.check(1, "robot", "CR09"))
        self.check(1, "plan", "P/9")
        self.check(1, "why", "P9")
        self.check(1, "clear", "CR01", "ACS-1004", "--yes")
        self.check(1, "cancel", "P9", "--yes")
        self.check(1, "maintenance", "CR09", "on")
        self.check(1, "carriers", "CR01", "A", "B", "--yes")

        self.assertIn("CR01 is taken out of service", self.check(0, "maintenance", "CR01", "on"))
        self.check(0, "carriers", "CR01", "TRAY_99", "--", "-", "--yes")
        mcs = self.line.start_mcs(PLANS[1:], "--fresh-ids", port=self.mcs_port)
        mcs.wait_ready()
        self.wait_until(lambda: self.read("plans", "--state", "waiting")["plans"], "a plan that waits")
        (plan,) = self.read("plans")["plans"]
        plan_id = plan["planId"]
        self.assertIn("acsctl maintenance CR01 off", " ".join(self.check(5, "why", plan_id).split()))
        self.check(5, "why", "CR01")
        self.check(0, "plan", plan_id)
        self.assertEqual([entry["planId"] for entry in self.read("queue")["plans"]], [plan_id])
        self.assertIn(plan_id, self.run_acsctl("__complete", "why", "").stdout.split())
        self.check(0, "priority", plan_id, "7")
        self.wait_until(lambda: self.read("plan", plan_id)["priority"] == 7, "the new priority")
        self.check(0, "pause", plan_id, "--reason", "a test")
        self.wait_until(lambda: self.read("plan", plan_id)["status"] == "Paused", "the pause")
        self.assertIn(f"acsctl resume {plan_id}", " ".join(self.check(5, "why", plan_id).split()))
        self.assertIn("needs --yes", self.check(2, "resume", plan_id))
        self.check(0, "resume", plan_id, "--yes")
        self.wait_until(lambda: self.read("plan", plan_id)["status"] == "Pending", "the end of the pause")
        (station, *_) = (found["stationId"] for found in self.read("site")["stations"])
        self.check(0, "block", "station", station, "--reason", "wet floor")
        self.wait_until(lambda: self.read("site")["blocked"], "the block")
        self.assertIn("wet floor", self.check(0, "site"))
        self.assertIn(f"acsctl unblock station {station}", " ".join(self.check(5, "why").split()))
        self.check(0, "unblock", "station", station, "--yes")
        self.wait_until(lambda: not self.read("site")["blocked"], "the end of the block")
        self.check(1, "block", "node", "NOWHERE")
        self.check(0, "tsc", "pause")
        self.wait_until(lambda: self.read("status")["tsc"] == "Paused", "the pause of the TSC")
        self.assertIn("acsctl tsc resume", " ".join(self.check(5, "why").split()))
        self.check(0, "tsc", "resume", "--yes")
        self.check(1, "skip", plan_id, "9", "--yes")
        self.check(1, "resolve", plan_id, "J9", "done", "--yes")

        self.check(0, "maintenance", "CR01", "off", "--yes")
        self.wait_until(lambda: "TRAY_99" in " ".join(self.run_acsctl("why", plan_id).stdout.split()), "the wrong tray")
        self.check(0, "carriers", "CR01", "-", "-", "-", "--yes")
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.wait_until(lambda: self.read("plan", plan_id)["status"] == "Completed", "the end of the plan")
        self.assertIn("has ended: Completed", " ".join(self.check(0, "why", plan_id).split()))
        self.assertEqual([found["planId"] for found in self.read("plans", "--state", "finished")["plans"]], [plan_id])
        self.check(1, "abort", plan_id, "--yes")
        self.assertIn(plan_id, self.check(0, "events"))
        self.assertIn("ExecutionPlan", self.check(0, "trace", "--plan", plan_id, "--limit", "1000"))

        bundle = self.line.folder / "bundle.tar.gz"
        self.check(0, "bundle", bundle, "--http-url", self.http)
        with tarfile.open(bundle) as archive:
            contents = {pathlib.PurePath(member.name).name: archive.extractfile(member).read() for member in archive}
        self.assertIn(b"acsd_", contents["metrics.txt"])
        self.assertEqual([entry for entry in json.loads(contents["manifest.json"])["files"] if entry["error"]], [])

    def test_events_are_followed(self):
        self.wait_for_robot("LR01", "Idle")
        process = subprocess.Popen([self.line.bin_dir / "acsctl", "events", "--follow", "--limit", "1"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, env=self.environment)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertNotEqual(process.stdout.readline(), "", "there is no earlier event")  # now it follows
        self.check(0, "tsc", "pause")
        while "tsc" not in (line := process.stdout.readline()).lower():
            self.assertNotEqual(line, "", "the stream has ended")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(FINISH_SECONDS), 0)


if __name__ == "__main__":
    main()
