"""Shared code of the tests with real processes."""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "scripts"))
import operator_api  # noqa: E402
from production_line import Line  # noqa: E402

SITE = REPOSITORY / "examples" / "site"
PLANS = [REPOSITORY / "examples" / "plans" / name for name in ("lr-cassette.json", "cr-tray.json")]
TIME_SCALE = 20
FINISH_SECONDS = 120
STATUS_SECONDS = 20


class ScenarioCase(unittest.TestCase):
    """A test on a line of its own; on a failure the ends of all logs are printed."""

    bin_dir = None

    def setUp(self):
        self.line = Line(self.bin_dir, SITE)
        self.line.__enter__()
        self.addCleanup(self.line.stop)

    def tearDown(self):
        if self.has_failed():
            for program in self.line.programs:
                print(f"--- {program.name} ---", *program.tail(40), sep="\n", file=sys.stderr)

    def has_failed(self):
        """For tearDown: whether the test has a failure or an error, also in a subtest."""
        result = self._outcome.result
        return any(self in (test, getattr(test, "test_case", None)) for test, _ in [*result.failures, *result.errors])

    def wait_for_log(self, program, part):
        deadline = time.monotonic() + STATUS_SECONDS
        while part not in program.log.read_text(errors="replace"):
            self.assertLess(time.monotonic(), deadline, f"{part!r} was not logged")
            time.sleep(0.02)

    def start_robots(self, make_vehicle_port=lambda broker_port: broker_port, **arm_options):
        self.line.start_broker()
        vehicles = self.line.start_vehicles(TIME_SCALE, port=make_vehicle_port(self.line.broker_port))
        self.vehicles = vehicles
        arm = self.line.start_arm(TIME_SCALE, **arm_options)
        vehicles.wait_ready()
        return arm.wait_ready()

    def make_token(self, role, name=None):
        """The token, named as its role by default; its line is added to the file `tokens` in the folder of the line."""
        result = subprocess.run([self.line.bin_dir / "acsd", "token", role, name or role], check=True, capture_output=True,
                                text=True)
        tokens = self.line.folder / "tokens"
        tokens.touch(0o600)
        with open(tokens, "a", encoding="ascii") as file:
            file.write(result.stdout)
        return result.stderr.split()[-1]

    def write_cluster_config(self):
        """A copy of the site's configuration without mqtt.url, for tests that set mqtt.urls."""
        folder = self.line.folder / "site"
        shutil.copytree(self.line.site_dir, folder)
        config = folder / "acsd.toml"
        lines = config.read_text(encoding="utf-8").splitlines()
        lines.remove(next(line for line in lines if line.startswith('url = "mqtt://')))
        config.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return config

    def read_status(self, address):
        return operator_api.read_state(address, STATUS_SECONDS)

    def wait_for_status(self, address, is_reached, seconds=STATUS_SECONDS):
        self.wait_until(lambda: is_reached(self.read_status(address)), "the status was not reached", seconds)

    def wait_until(self, is_reached, otherwise, seconds=FINISH_SECONDS):
        deadline = time.monotonic() + seconds
        while not is_reached():
            self.assertLess(time.monotonic(), deadline, otherwise)
            time.sleep(0.02)

    def assert_last_line(self, program, expected):
        self.assertEqual(program.tail(1), [expected])


def write_plan(folder, name, change):
    """A copy of the LR example plan, changed by the function."""
    plan = json.loads(PLANS[0].read_text())
    change(plan)
    path = pathlib.Path(folder) / name
    path.write_text(json.dumps(plan))
    return path


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True, type=pathlib.Path)
    arguments, rest = parser.parse_known_args()
    ScenarioCase.bin_dir = arguments.bin
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2, module="__main__")
