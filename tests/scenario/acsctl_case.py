"""Tests that operate a real line with acsctl."""

import json
import os
import subprocess

from scenario_case import FINISH_SECONDS, ScenarioCase


class AcsctlCase(ScenarioCase):
    def use_acsd(self, operator):
        """acsctl operates the acsd of this address."""
        self.environment = {"PATH": os.environ["PATH"], "HOME": str(self.line.folder), "ACSCTL_URL": f"http://{operator}"}

    def run_acsctl(self, *arguments):
        return subprocess.run([self.line.bin_dir / "acsctl", *map(str, arguments)], capture_output=True, text=True,
                              env=self.environment, timeout=FINISH_SECONDS, stdin=subprocess.DEVNULL)

    def check(self, code, *arguments):
        """Standard output, or standard error of a failure."""
        result = self.run_acsctl(*arguments)
        self.assertEqual(result.returncode, code, (arguments, result.stdout, result.stderr))
        return result.stdout if code in (0, 5) else result.stderr

    def read(self, *arguments):
        return json.loads(self.check(0, *arguments, "--json"))

    def wait_for_robot(self, robot_id, status):
        self.wait_until(lambda: self.read("robot", robot_id)["status"] == status, f"{robot_id} is {status}")
