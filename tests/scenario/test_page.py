#!/usr/bin/env python3
"""The live page of a real acsd with real robots, in Chromium: tests/page/test_page.py against its address."""

import pathlib
import subprocess
import sys

from scenario_case import FINISH_SECONDS, PLANS, REPOSITORY, ScenarioCase, main

TEST = REPOSITORY / "tests" / "page" / "test_page.py"
SYSTEM_PYTHON = pathlib.Path("/usr/bin/python3")  # which python3-selenium belongs to
SKIPPED = 77


class Page(ScenarioCase):
    def test_page(self):
        arm = self.start_robots()
        mcs = self.line.start_mcs(PLANS, "--repeat", 50, "--fresh-ids", "--keep")
        acsd = self.line.start_acsd(mcs.wait_ready()["ws"], arm)
        acsd.wait_ready()
        python = SYSTEM_PYTHON if SYSTEM_PYTHON.exists() else sys.executable
        done = subprocess.run([python, "-B", TEST, "--url", f"http://{acsd.addresses['operator']}/"], timeout=2 * FINISH_SECONDS,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode == SKIPPED:
            self.skipTest(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    main()
