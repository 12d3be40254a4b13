#!/usr/bin/env python3
"""Behaviour on missing or wrong input: one clear line, the right exit code, nothing left running."""

import os
import socket
import subprocess
import time
import unittest

from scenario_case import FINISH_SECONDS, PLANS, SITE, ScenarioCase, main, write_plan


class BadInput(ScenarioCase):
    def run_program(self, name, *arguments):
        return subprocess.run([self.bin_dir / name, *map(str, arguments)], capture_output=True, text=True, timeout=20,
                              stdin=subprocess.DEVNULL, check=False)

    def assert_refused(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        lines = result.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def test_every_program_rejects_an_unknown_option(self):
        needed = {
            "acsd": ["--config", SITE / "acsd.toml"],
            "vda-sim": ["--broker", "mqtt://127.0.0.1:1", "--site", SITE / "site.lif.json", "--vehicle", "LR01"],
            "openstream-sim": [],
            "mcs-sim": ["--plan", PLANS[0]],
        }
        for name, arguments in needed.items():
            with self.subTest(name):
                self.assert_refused(self.run_program(name, *arguments, "--frobnicate"), 2, "--frobnicate")

    def test_help_and_version_work_in_every_program(self):
        for name in ("acsd", "vda-sim", "openstream-sim", "mcs-sim"):
            with self.subTest(name):
                usage = self.run_program(name, "--help")
                self.assertEqual(usage.returncode, 0)
                self.assertNotRegex(usage.stdout, "(?m)^ *--[a-z-]+ .*[A-Z] \\.\\.\\.")  # each value needs its own option
                version = self.run_program(name, "--version")
                self.assertEqual(version.returncode, 0)
                self.assertTrue(version.stdout.startswith(name + " "), version.stdout)

    def test_a_port_in_use_is_named(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            address = f"127.0.0.1:{taken.getsockname()[1]}"
            plan = write_plan(self.line.folder, "plan.json", lambda plan: None)
            store = self.line.folder / "store"
            rows = {
                "mcs-sim": ["--listen", address, "--plan", plan],
                "openstream-sim": ["--listen", address, "--http", "127.0.0.1:0"],
                "acsd": ["--config", SITE / "acsd.toml", "--set", f"http.listen={address}",
                         "--set", f"store.directory={store}"],
            }
            rows = [*rows.items(), ("acsd", [*rows["acsd"], "--set", "http.listen=127.0.0.1:0", "--set",
                                             f"operator.listen={address}"])]
            for name, arguments in rows:
                with self.subTest(name, arguments=arguments):
                    result = self.run_program(name, *arguments)
                    self.assertNotEqual(result.returncode, 0)
                    self.assertIn(address, result.stderr)

    def test_a_site_file_that_is_not_a_lif_is_rejected(self):
        site = self.line.folder / "wrong.lif.json"
        site.write_text('{"layouts": 3}')
        result = self.run_program("vda-sim", "--broker", "mqtt://127.0.0.1:1", "--site", site, "--vehicle", "LR01")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("wrong.lif.json", result.stderr)
        result = self.run_program("acsd", "--config", SITE / "acsd.toml", "--set", f"site.map={site}", "--check-config")
        self.assertEqual(result.returncode, 2)
        self.assertIn("wrong.lif.json", result.stderr)

    def test_every_error_of_a_configuration_is_reported_at_once(self):
        config = self.line.folder / "acsd.toml"
        text = (SITE / "acsd.toml").read_text()
        text = text.replace('url = "ws://127.0.0.1:9001/acs/"', 'url = "http://127.0.0.1:9001/"')
        text = text.replace("max_plans = 100", "max_plants = 100").replace('type = "LR"', 'type = "XR"')
        text = text.replace('map = "site.lif.json"', f'map = "{SITE / "site.lif.json"}"')
        config.write_text(text)
        result = self.run_program("acsd", "--config", config, "--check-config")
        self.assertEqual(result.returncode, 2)
        for key in ("mcs.url", "queue.max_plants", "robots.LR01.type"):
            lines = [line for line in result.stderr.splitlines() if key in line]
            self.assertEqual(len(lines), 1, result.stderr)
            self.assertRegex(lines[0], r"acsd\.toml:\d+: ")

    def check_config(self, *overrides):
        sets = [part for override in overrides for part in ("--set", override)]
        return self.run_program("acsd", "--config", SITE / "acsd.toml", "--check-config", *sets)

    def test_a_check_of_the_configuration_fails_if_its_result_is_not_written(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([self.line.bin_dir / "acsd", "--config", SITE / "acsd.toml", "--check-config",
                                   "--set", f"store.directory={self.line.folder / 'store'}"],
                                  stdout=full, stderr=subprocess.PIPE, text=True, timeout=FINISH_SECONDS, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("acsd: the output could not be written\n", done.stderr)

    def test_a_folder_a_device_a_pipe_and_an_endless_file_are_rejected(self):
        broker = ["--broker", "mqtt://127.0.0.1:1", "--vehicle", "LR01"]
        pipe, endless = self.line.folder / "pipe", self.line.folder / "endless"
        os.mkfifo(pipe)  # never gets a writer
        with endless.open("wb") as file:
            file.truncate(1 << 40)
        for path, reason in ((self.line.folder, "Is a directory"), ("/dev/zero", "it is a device"),
                             (pipe, "it is a pipe"), (endless, "longer than")):
            with self.subTest(path):
                self.assert_refused(self.check_config(f"site.map={path}"), 2, "site.map", str(path), reason)
                self.assert_refused(self.run_program("acsd", "--config", path), 2, str(path), reason)
                self.assert_refused(self.run_program("vda-sim", "--site", path, *broker), 2, str(path), reason)
                self.assert_refused(self.run_program("mcs-sim", "--plan", path), 2, str(path), reason)

    def test_one_vehicle_cannot_be_two_robots(self):
        self.assert_refused(self.check_config("robots.CR01.serial=LR01"), 2, "robots.", "serial", "LR01")
        self.assert_refused(self.check_config("store.directory="), 2, "store.directory", "empty")
        self.assert_refused(self.check_config("store.path=acsd.db"), 2, "store.path", "renamed to store.directory")

    def test_a_store_is_locked_by_one_acsd(self):
        arguments = ["--config", SITE / "acsd.toml", "--set", "mcs.url=ws://127.0.0.1:1/acs/", "--set",
                     "mqtt.url=mqtt://127.0.0.1:1", "--set", "http.listen=127.0.0.1:0", "--set",
                     "operator.listen=127.0.0.1:0", "--set", f"store.directory={self.line.folder / 'store'}"]
        first = self.line.start("acsd", *arguments)
        first.wait_ready()
        self.assert_refused(self.run_program("acsd", *arguments), 1, str(self.line.folder / "store"), "another program")
        self.line.forget(first)
        self.assertEqual(first.stop(), 0)
        second = self.line.start("acsd", *arguments)
        self.assertIn("operator", second.wait_ready())

    def test_the_example_configuration_is_valid(self):
        result = self.run_program("acsd", "--config", SITE / "acsd.toml", "--check-config")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("note: site.map: members without effect on driving: ", result.stderr)
        self.assertNotIn("warning: ", result.stderr)

    def test_acsd_is_ready_without_broker_and_mcs_and_ends_cleanly(self):
        acsd = self.line.start("acsd", "--config", SITE / "acsd.toml", "--set", "mcs.url=ws://127.0.0.1:1/acs/",
                               "--set", "mqtt.url=mqtt://127.0.0.1:1", "--set", "http.listen=127.0.0.1:0",
                               "--set", "operator.listen=127.0.0.1:0", "--set", "robots.CR01.arm.url=tcp://127.0.0.1:1",
                               "--set", f"store.directory={self.line.folder / 'store'}")
        self.assertIn("http", acsd.wait_ready())
        missing = ("cannot reach the MCS", "cannot reach the MQTT broker", "no Open Stream session")
        self.wait_for_log(acsd, *missing)
        self.line.forget(acsd)
        self.assertEqual(acsd.stop(), 0)
        warnings = [line for line in acsd.tail(1000) if " warning " in line]
        self.assertEqual(len(warnings), len(missing), "an outage is logged once, not at every attempt")

    def wait_for_log(self, program, *sentences):
        deadline = time.monotonic() + FINISH_SECONDS
        while not all(sentence in program.log.read_text() for sentence in sentences):
            self.assertLess(time.monotonic(), deadline, program.log.read_text())
            with self.assertRaises(subprocess.TimeoutExpired, msg="it ended"):
                program.process.wait(0.05)

    def test_a_plan_for_an_unknown_location_is_rejected_with_a_reason(self):
        def change(plan):
            plan["steps"][0]["position"] = "A09.CP01"
            plan["steps"][0]["jobs"][0]["from"] = "A09.CP01"

        arm = self.start_robots()
        mcs = self.line.start_mcs([write_plan(self.line.folder, "plan.json", change)], "--fresh-ids")
        self.line.start_acsd(mcs.wait_ready()["ws"], arm).wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 1)
        output = mcs.log.read_text()
        self.assertIn("A09.CP01", output)
        self.assert_last_line(mcs, "0 plans completed, 1 failed")


if __name__ == "__main__":
    main()
