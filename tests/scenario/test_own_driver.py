#!/usr/bin/env python3
"""The lesson examples/own-driver with real processes: acsd with a driver of its own, the cart, and mcs-sim. Whatever is killed, the
cart's journal has each job once."""

import argparse
import itertools
import json
import pathlib
import resource
import signal
import socket
import subprocess
import sys
import time
import urllib.request

from scenario_case import FINISH_SECONDS, PLANS, REPOSITORY, ScenarioCase, main

LESSON = REPOSITORY / "examples" / "own-driver"
MAXIMUM_LINES = 250
SECONDS = 0.2  # of the cart, for an edge and for a job
LONG_SECONDS = 2  # for a job during which a program is killed
MOVES = [["pick", "A01.CP01", "LR01.CP01"], ["drop", "LR01.CP01", "A02.CP03"]]  # of the plan


class OwnDriver(ScenarioCase):
    job_seconds = SECONDS
    lesson = LESSON
    program = None  # cart_acsd, if it is not among the programs of --bin

    def start_cart(self, port=0):
        cart = self.line.start("cart_sim", self.lesson / "cart_sim.py", port, self.line.folder / "journal", self.node,
                               SECONDS, self.job_seconds, binary=sys.executable)
        self.cart_address = cart.wait_ready()["cart"]
        return cart

    def start_line(self, plans=PLANS[:1]):
        self.node = "D-CHG01"
        self.cart = self.start_cart()
        self.trace = self.line.folder / "mcs.ndjson"
        self.mcs = self.line.start_mcs(plans, "--trace", self.trace)
        self.mcs_address = self.mcs.wait_ready()["ws"]
        self.names = itertools.count()
        self.start_acsd()

    def start_acsd(self):
        settings = {
            "mcs.url": f"ws://{self.mcs_address}/acs/",
            "store.directory": self.line.folder / "store",
            "http.listen": "127.0.0.1:0",
            "operator.listen": "127.0.0.1:0",
            "robots.LR01.options.url": f"tcp://{self.cart_address}",
        }
        sets = [part for key, value in settings.items() for part in ("--set", f"{key}={value}")]
        self.acsd_trace = self.line.folder / f"trace{next(self.names)}"
        self.acsd = self.line.start("cart_acsd", "--config", self.lesson / "acsd.toml", *sets, "--trace", self.acsd_trace,
                                    binary=self.program)
        self.addresses = self.acsd.wait_ready()

    def kill(self, program):
        self.line.forget(program)
        program.send_signal(signal.SIGKILL)
        program.stop()

    def restart_acsd(self):
        self.kill(self.acsd)
        self.start_acsd()

    def read_journal(self):
        """(commandId, what) of each executed job."""
        path = self.line.folder / "journal"
        lines = path.read_text().splitlines() if path.exists() else []
        return [(line.split()[0], line.split()[1:]) for line in lines if line]

    def read_lines(self, direction):
        """The lines between this acsd and the cart."""
        lines = []
        for path in sorted(self.acsd_trace.glob("*")):
            for text in path.read_text(errors="replace").splitlines():
                try:
                    entry = json.loads(text)
                except ValueError:
                    continue  # being written
                if entry.get("link") == "cart" and entry["direction"] == direction:
                    lines.append(entry["text"])
        return lines

    def wait_for(self, condition, what):
        deadline = time.monotonic() + FINISH_SECONDS
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            self.assertTrue(self.acsd.is_running(), "acsd has ended by itself")
            time.sleep(0.01)

    def wait_for_line(self, direction, begin):
        self.wait_for(lambda: any(line.startswith(begin) for line in self.read_lines(direction)), begin)

    def judge(self):
        """The plan is completed, and each of its jobs was executed once."""
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        journal = self.read_journal()
        self.assertEqual([what for _, what in journal], MOVES)
        self.assertEqual(len({job for job, _ in journal}), len(MOVES))

    def test_a_plan_is_completed(self):
        self.start_line()
        self.judge()
        self.assertTrue(any(line.startswith("go ") for line in self.read_lines("out")))
        with urllib.request.urlopen(f"http://{self.addresses['http']}/metrics", timeout=10) as response:
            metrics = response.read().decode()
        self.assertIn('acsd_driver_cart_connected{robot="LR01"} 1', metrics)
        self.assertEqual(list(self.read_status(self.addresses["operator"])["links"]), ["mcs"])  # and no broker

    def test_acsd_is_killed_during_a_job(self):
        self.job_seconds = LONG_SECONDS
        self.start_line()
        for done in range(len(MOVES)):
            self.wait_for_line("out", "job ")
            self.assertEqual(len(self.read_journal()), done)
            self.restart_acsd()
            self.wait_for_line("out", "ask ")
            self.wait_for(lambda count=done + 1: len(self.read_journal()) == count, "the job is executed")
        self.judge()

    def test_acsd_is_killed_when_the_job_is_done(self):
        """It learns after its restart that the job was done meanwhile."""
        self.job_seconds = LONG_SECONDS
        self.start_line()
        self.wait_for_line("in", "job ")
        self.kill(self.acsd)
        deadline = time.monotonic() + FINISH_SECONDS
        while not self.read_journal():
            self.assertLess(time.monotonic(), deadline, "the cart finishes the job")
            time.sleep(0.01)
        self.start_acsd()
        self.wait_for_line("in", f"job {self.read_journal()[0][0]} done")
        self.judge()

    def test_acsd_is_killed_after_a_job(self):
        self.start_line()
        self.wait_for(lambda: len(self.read_journal()) == 1, "the first job is executed")
        self.restart_acsd()
        self.judge()

    def test_acsd_is_killed_during_a_drive(self):
        self.start_line()
        for _ in range(3):
            self.wait_for_line("out", "go ")
            self.restart_acsd()
        self.judge()

    def test_acsd_is_killed_again_and_again(self):
        self.start_line()
        for _ in range(8):
            count = len(self.read_lines("in"))
            self.wait_for(lambda known=count: len(self.read_lines("in")) > known + 4 or not self.mcs.is_running(),
                          "the cart reports")
            self.restart_acsd()
        self.judge()

    def test_the_cart_is_restarted(self):
        """During a job, which it has not executed then and is commanded again, and while it is stationary."""
        self.job_seconds = LONG_SECONDS
        self.start_line()
        self.wait_for_line("in", "job ")
        position = [line.split()[1] for line in self.read_lines("in") if line.startswith("state ")][-1]
        command = [line.split()[1] for line in self.read_lines("in") if line.startswith("job ")][-1]
        self.kill(self.cart)
        self.assertEqual(self.read_journal(), [])
        self.node = position
        self.cart = self.start_cart(self.cart_address.rsplit(":", 1)[1])
        self.wait_for_line("in", f"job {command} unknown")
        self.judge()

    def test_a_torn_line_of_the_journal_is_no_job(self):
        (self.line.folder / "journal").write_text("\nhalf")  # the disk was full, or the power was lost
        self.start_line()
        self.judge()
        commanded = [line.split()[1] for line in self.read_lines("out") if line.startswith("job ")]
        self.assertEqual([job for job, _ in self.read_journal()], commanded)

        self.kill(self.cart)
        self.cart = self.start_cart()
        host, port = self.cart_address.split("//")[-1].split(":")
        with socket.create_connection((host, int(port)), timeout=FINISH_SECONDS) as connection, connection.makefile("rw") as lines:
            for job in commanded:
                print("job", job, *MOVES[0], file=lines, flush=True)
                self.assertEqual(next(line for line in lines if not line.startswith("state ")), f"refused {job} known\n")

    def test_a_job_that_the_disk_of_the_cart_does_not_take_is_commanded_again(self):
        self.start_line()
        before = resource.prlimit(self.cart.process.pid, resource.RLIMIT_FSIZE, (5, resource.RLIM_INFINITY))
        self.wait_for(lambda: any(line.startswith("job ") and line.endswith(" unknown") for line in self.read_lines("in")),
                      "the cart has not executed the job")
        resource.prlimit(self.cart.process.pid, resource.RLIMIT_FSIZE, before)
        self.judge()

    def test_the_project_is_small(self):
        """Every line of its C++ files counts: comments, blank lines and lone braces too. cart_sim.py is the robot, not the project."""
        lines = {path.name: len(path.read_text().splitlines()) for path in self.lesson.glob("**/*.[ch]pp")}
        self.assertEqual(sorted(lines), ["CartAdapter.hpp", "main.cpp"])
        self.assertLessEqual(sum(lines.values()), MAXIMUM_LINES, lines)

    def test_errors_of_the_configuration_have_lines(self):
        lines = (self.lesson / "acsd.toml").read_text().splitlines()
        number = {key: 1 + next(i for i, line in enumerate(lines) if line.startswith(key))
                  for key in ("driver", "options.url", "CassetteLoad")}

        def check(change):
            changed = list(lines)
            change(changed)
            path = self.line.folder / "acsd.toml"
            path.write_text("\n".join(changed).replace("../site", str(self.lesson.parent / "site")) + "\n")
            run = subprocess.run([self.program or self.line.bin_dir / "cart_acsd", "--config", path, "--check-config"],
                                 capture_output=True, text=True, timeout=60, check=False)
            text = run.stderr.replace(str(path), "FILE")
            return run.returncode, [line for line in text.splitlines() if not line.startswith("note: site.map: ")]

        self.assertEqual(check(lambda text: None), (0, []))

        def replace(key, value):
            return lambda text: text.__setitem__(number[key] - 1, value)

        self.assertEqual(
            check(replace("driver", 'driver = "card"')),
            (2, [f"FILE:{number['driver']}: robots.LR01.driver: this acsd has no driver \"card\"; it has vda5050, "
                 "vda5050_openstream, cart"]))
        code, errors = check(replace("options.url", 'options.url = "tcp://127.0.0.1:99999"'))
        self.assertEqual((code, len(errors)), (2, 1), errors)
        self.assertTrue(errors[0].startswith(f"FILE:{number['options.url']}: robots.LR01.options.url: "), errors)
        self.assertEqual(
            check(replace("CassetteLoad", 'CassetteLoad = { robot = "LR", options.command = "throw" }')),
            (2, [f"FILE:{number['CassetteLoad']}: actions.CassetteLoad.options.command: expected 'pick' or 'drop', "
                 "found the string 'throw'"]))
        code, errors = check(lambda text: text.insert(number["options.url"], 'options.uri = "x"'))
        self.assertEqual((code, len(errors)), (2, 1), errors)
        self.assertTrue(errors[0].startswith(f"FILE:{number['options.url'] + 1}: robots.LR01.options.uri: unknown key"),
                        errors)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--lesson", type=pathlib.Path, default=LESSON, help="the folder of the lesson")
    parser.add_argument("--program", type=pathlib.Path, help="cart_acsd, built elsewhere")
    arguments, sys.argv[1:] = parser.parse_known_args()
    OwnDriver.lesson, OwnDriver.program = arguments.lesson, arguments.program
    main()
