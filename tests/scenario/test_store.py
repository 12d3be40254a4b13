#!/usr/bin/env python3
"""The store of acsd as in docs/guide/operate.md: one program at a time, and no other user prevents a start."""

import json
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
import urllib.request

from mcs_stub import McsStub
from plan_samples import make_carrying_plan, make_tray_memory_plan
from scenario_case import FINISH_SECONDS, ScenarioCase, main
import operator_api  # which scenario_case makes known

END_SECONDS = 20
FOREIGN_USER = 65534
LARGE_LOG = 8 << 20  # acsd merges a larger log itself
MOST_PLANS = 3000
TRAY_JOBS = 75
# Locks what it can open, reports how many, and ends with its standard input.
HOLDER = """
import fcntl, os, sys
os.setgid({user}); os.setuid({user})
held = []
for path in sys.argv[1:]:
    try:
        held.append(os.open(path, os.O_RDONLY))
        fcntl.flock(held[-1], fcntl.LOCK_EX)
    except OSError:
        pass
print(len(held), flush=True)
sys.stdin.read()
"""


class Store(ScenarioCase):
    def setUp(self):
        super().setUp()
        self.stub = McsStub()
        self.addCleanup(self.stub.close)
        self.directory = self.line.folder / "store"

    def start_acsd(self, *overrides, **options):
        acsd = self.line.start_acsd(self.stub.address, self.robots, *overrides, **options)
        return acsd, acsd.wait_ready()["operator"]

    def end_acsd(self, acsd):
        self.assertEqual(acsd.stop(), 0)
        self.line.forget(acsd)

    def wait_for_end(self, program):
        program.wait(END_SECONDS)
        self.line.forget(program)
        return program.stop()

    def assert_refused(self, *parts, overrides=()):
        """A start ends with exit code 1 and these parts in its part of the log, which all acsd of a test share."""
        begin = (self.line.folder / "acsd.log").stat().st_size
        acsd = self.line.start_acsd(self.stub.address, self.robots, *overrides)
        self.assertEqual(self.wait_for_end(acsd), 1, acsd.tail())
        for part in parts:
            self.assertIn(part, acsd.log.read_text()[begin:])

    def wait_for_lock(self):
        """An attempt to lock it would be one of another program."""
        number = self.directory.stat().st_ino
        deadline = time.monotonic() + END_SECONDS
        while f":{number} " not in pathlib.Path("/proc/locks").read_text():
            self.assertLess(time.monotonic(), deadline, "the directory was not locked")
            time.sleep(0.02)

    def submit(self, plan_id):
        return self.stub.ask("ExecutionPlan", make_carrying_plan(plan_id))


class OneProgram(Store):
    def test_no_second_acsd_starts_whichever_file_of_the_store_is_removed(self):
        self.robots = self.start_robots()
        self.start_acsd()
        for name in ("generation", "acsd.db-shm", "acsd.db-wal", "acsd.db", "acsd.db.rescued"):
            with self.subTest(removed=name):
                (self.directory / name).unlink(missing_ok=True)
                self.assert_refused(f"{self.directory}: expected a store that only this program uses", "a lock of another program")

    def test_acsd_keeps_the_path_of_a_directory_that_was_moved_away(self):
        self.robots = self.start_robots()
        acsd, address = self.start_acsd()
        away = self.line.folder / "away"
        self.directory.rename(away)
        self.directory.mkdir(mode=0o700)
        self.wait_for_status(address, lambda status: any("store" in reason for reason in status["notReadyReasons"]))
        self.wait_for_lock()
        self.assert_refused(f"{self.directory}: expected a store that only this program uses")
        self.assert_refused(f"{away}: expected a store that only this program uses", overrides=(f"store.directory={away}",))
        self.assertTrue(acsd.is_running())

    def test_acsd_ends_when_another_one_has_taken_its_path(self):
        self.robots = self.start_robots()
        first, address = self.start_acsd("tsc.initial=paused")
        self.stub.wait_for("RobotStatusUpdate")
        self.assertEqual(self.submit("P1")["result"], "Success")
        away = self.line.folder / "away"
        first.process.send_signal(signal.SIGSTOP)  # it checks its directory every 2 s
        self.directory.rename(away)
        second, _ = self.start_acsd()
        first.process.send_signal(signal.SIGCONT)
        self.assertEqual(self.wait_for_end(first), 1)
        self.assertIn("ends now", first.log.read_text())
        self.assertTrue(second.is_running())
        # What it had is still there.
        self.end_acsd(second)
        shutil.rmtree(self.directory)
        away.rename(self.directory)
        _, address = self.start_acsd("tsc.initial=paused")
        self.assertEqual([plan["planId"] for plan in self.read_status(address)["plans"]], ["P1"])

    def test_a_user_without_permission_cannot_prevent_a_start_by_a_lock(self):
        if os.geteuid() != 0:
            self.skipTest("needs a process of another user: runs as root only")
        self.robots = self.start_robots()
        acsd, _ = self.start_acsd()
        self.end_acsd(acsd)
        self.line.folder.chmod(0o755)
        readable = self.line.folder / "readable"
        readable.touch(mode=0o644)
        paths = [self.line.folder, readable, self.directory, *self.directory.iterdir()]
        holder = subprocess.Popen([sys.executable, "-c", HOLDER.format(user=FOREIGN_USER), *map(str, paths)], text=True,
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(holder.communicate)
        self.assertEqual(holder.stdout.readline(), "2\n")  # the folder and the file, nothing of the store
        self.start_acsd()
        self.assertEqual(holder.poll(), None)


class Log(Store):
    """The write-ahead log grows while another program reads an older state of the database."""

    def read_log_size(self, address):
        with urllib.request.urlopen(f"http://{address}/metrics", timeout=END_SECONDS) as response:
            text = response.read().decode()
        return int(float(re.search(r"^acsd_store_log_bytes (\S+)", text, re.MULTILINE).group(1)))

    def find_alarms(self, address):
        return [alarm["errorCode"] for alarm in self.read_status(address)["alarms"] if alarm["errorCode"] == "ACS-1021"]

    def wait_for_report(self, is_set, start=0):
        return self.stub.wait_for("ErrorReport", lambda message: message.payload["errorCode"] == "ACS-1021"
                                  and message.payload["state"] == is_set, start)

    def test_a_log_that_a_reader_keeps_from_being_merged_raises_an_alarm_until_the_reader_has_ended(self):
        self.robots = self.start_robots()
        acsd = self.line.start_acsd(self.stub.address, self.robots, "tsc.initial=paused", "queue.max_plans=5000",
                                    "outbox.max=1000000", f"store.max_log_bytes={LARGE_LOG}")
        addresses = acsd.wait_ready()
        self.stub.wait_for("RobotStatusUpdate")
        database = self.directory / "acsd.db"
        log = self.directory / "acsd.db-wal"
        reader = sqlite3.connect(database, isolation_level=None)
        self.addCleanup(reader.close)
        reader.execute("BEGIN")
        reader.execute("SELECT count(*) FROM plans").fetchone()
        number = 0
        while log.stat().st_size <= LARGE_LOG:
            number += 1
            self.assertLess(number, MOST_PLANS, "the log does not grow")
            plan = make_tray_memory_plan(f"P{number}", TRAY_JOBS)
            self.assertEqual(self.stub.ask("ExecutionPlan", plan)["result"], "Success")
        index, report = self.wait_for_report(True)
        self.assertEqual(self.find_alarms(addresses["operator"]), ["ACS-1021"])
        self.assertIn(f"{database} has 8 MiB and cannot be merged", report.payload["message"])
        self.assertIn(f"fuser -v {database}", report.payload["message"])
        self.assertGreater(self.read_log_size(addresses["http"]), LARGE_LOG)
        self.assertEqual(self.submit("LAST")["result"], "Success")  # a light alarm refuses nothing

        reader.close()
        self.wait_for_report(False, index)
        self.assertIn(f"The log of the store {database} has 8 MiB", acsd.log.read_text())
        self.assertEqual(self.find_alarms(addresses["operator"]), [])
        self.assertEqual(self.submit("AFTER")["result"], "Success")
        self.assertLessEqual(log.stat().st_size, LARGE_LOG)


class Restored(Store):
    def run_store(self, command, *arguments, code=0):
        """Standard output, or standard error if the command is to fail."""
        run = subprocess.run([str(self.line.bin_dir / "acsd"), "store", command, *map(str, arguments)], capture_output=True,
                             text=True, timeout=END_SECONDS)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout if code == 0 else run.stderr

    def read_commands(self, folder):
        """Topics of the orders and instant actions that were sent to vehicles."""
        entries = [json.loads(line) for path in folder.glob("*.ndjson") for line in path.read_text().splitlines()]
        return [entry["text"] for entry in entries if entry["direction"] == "out" and entry.get("topic", "").endswith("/order")]

    def test_a_restored_backup_moves_no_robot_until_it_is_accepted_and_the_tsc_is_resumed(self):
        self.robots = self.start_robots()
        acsd, address = self.start_acsd()
        self.stub.wait_for("RobotStatusUpdate")
        self.assertEqual(self.submit("P1")["result"], "Success")
        self.wait_for_status(address, lambda status: status["plans"] and status["plans"][0]["status"] == "InProgress")

        # A backup while acsd runs and a plan is in progress: its vehicle is stopped meanwhile. A restore is refused.
        self.vehicles.send_signal(signal.SIGSTOP)
        self.addCleanup(self.vehicles.send_signal, signal.SIGCONT)
        backup = self.line.folder / "backup.db"
        self.assertIn(f"copied to {backup}", self.run_store("backup", self.directory, backup))
        self.assertEqual(backup.stat().st_mode & 0o777, 0o600)
        database = sqlite3.connect(f"file:{backup}?mode=ro", uri=True)
        self.assertEqual(database.execute("PRAGMA integrity_check").fetchone(), ("ok",))
        self.assertEqual(database.execute("SELECT plan_id, state FROM plans").fetchall(), [("P1", "InProgress")])
        database.close()
        self.assertIn("1 open plan resumed", self.run_store("check", self.directory))
        self.assertIn("a lock of another program", self.run_store("restore", self.directory, backup, code=1))
        self.assertIn("nothing to accept", self.run_store("accept", self.directory))
        empty = self.line.folder / "empty"
        empty.mkdir(mode=0o700)
        for wrong in (empty, self.line.folder / "absent"):
            self.assertIn("a database to accept", self.run_store("accept", wrong, code=1))
        self.vehicles.send_signal(signal.SIGCONT)
        self.wait_for_status(address, lambda status: not status["plans"], FINISH_SECONDS)
        self.end_acsd(acsd)

        self.run_store("restore", self.directory, backup)
        sentence = f"run acsd store accept {self.directory}: the TSC is then paused"
        self.assertIn(sentence, self.run_store("check", self.directory, code=1))
        self.assert_refused(sentence)
        self.run_store("accept", self.directory)

        trace = self.line.folder / "trace"
        acsd, address = self.start_acsd(arguments=("--trace", trace))
        self.wait_for_status(address, lambda status: all(robot["node"] for robot in status["robots"]))
        for _ in range(2):  # also after another start
            status = self.read_status(address)
            self.assertEqual(status["tsc"], "Paused")
            self.assertRegex(status["tscReason"], "The store was restored, copied or incomplete, and was accepted at .* resume the TSC")
            self.assertEqual([plan["planId"] for plan in status["plans"]], ["P1"])
            self.assertIn(status["tscReason"], acsd.log.read_text())
            self.end_acsd(acsd)
            acsd, address = self.start_acsd(arguments=("--trace", trace))
            self.wait_for_status(address, lambda status: all(robot["node"] for robot in status["robots"]))
        self.assertEqual(self.read_commands(trace), [])
        self.assertEqual(operator_api.post(address, "/v1/tsc/resume")[0], 202)
        self.wait_for_status(address, lambda status: status["tsc"] == "Auto" and status["tscReason"] is None)

    def test_a_copied_store_does_not_start(self):
        self.robots = self.start_robots()
        acsd, _ = self.start_acsd()
        self.end_acsd(acsd)
        copy = self.line.folder / "copy"
        shutil.copytree(self.directory, copy)
        self.assert_refused(f"run acsd store accept {copy}", "a copy of the database that was used last",
                            overrides=(f"store.directory={copy}",))
        acsd, _ = self.start_acsd()


if __name__ == "__main__":
    main()
