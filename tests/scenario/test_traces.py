#!/usr/bin/env python3
"""The traces of acsd, mcs-sim, vda-sim and openstream-sim: they agree on every message, give one time line, have no secrets, are bounded,
and can be read after a kill."""

import collections
import functools
import json
import os
import signal
import socket
import subprocess
import urllib.request

from scenario_case import FINISH_SECONDS, PLANS, STATUS_SECONDS, TIME_SCALE, ScenarioCase, main

SECRETS = {"acsd": "password-of-acsd", "vda-sim": "password-of-vda-sim", "header": "token-of-the-mcs-link"}
COMMANDS, STATES = ("order", "instantActions"), ("state",)


class ArmClient:
    """A client of the Open Stream with a MONITOR of 500 samples per second."""

    def __init__(self, address):
        host, port = address.rsplit(":", 1)
        self._socket = socket.create_connection((host, int(port)), timeout=STATUS_SECONDS)
        self._lines = self._socket.makefile("rb")
        self.received = []
        self._send(cmd="HANDSHAKE", payload={"major": 1})
        self._send(cmd="MONITOR", payload={"period_ms": 2, "method": "GET", "url": "/project/robot/joints/joint_states"})

    def _send(self, **message):
        self._socket.sendall((json.dumps(message) + "\n").encode())

    def read(self, count):
        self.received += [self._lines.readline().decode().rstrip("\r\n") for _ in range(count)]

    def close(self):
        self._lines.close()
        self._socket.close()


class Traces(ScenarioCase):
    def setUp(self):
        super().setUp()
        self.traces = self.line.folder / "traces"

    def read_files(self, program):
        """The lines of a program; a file ends with a complete line."""
        text = ""
        for file in sorted(self.traces.glob(f"{program}-*.ndjson")):
            text += file.read_text()
            self.assertTrue(text.endswith("\n"), file)
        return [json.loads(line) for line in text.splitlines()]

    def write_secret(self, name):
        file = self.line.folder / f"{name}.secret"
        file.touch(mode=0o600)
        file.write_text(SECRETS[name] + "\n")
        return file

    def start_broker_with_passwords(self):
        passwords = self.line.folder / "passwords"
        passwords.touch(mode=0o600)
        for name in ("acsd", "vda-sim"):
            subprocess.run(["mosquitto_passwd", "-b", passwords, name, SECRETS[name]], check=True)
        self.line.start_broker(access=("allow_anonymous false", f"password_file {passwords}"))

    def stop(self, program):
        self.line.forget(program)
        self.assertEqual(program.stop(), 0)

    def run_line(self):
        """Executes a plan of LR01 and one of CR01. acsd sees all messages of the vehicles, and all programs end in order."""
        self.start_broker_with_passwords()
        self.traces.mkdir()
        mcs = self.line.start_mcs(PLANS, "--fresh-ids", "--trace", self.traces / "mcs-sim-000001.ndjson")
        arm = self.line.start_arm(TIME_SCALE, "--trace", self.traces)
        arm_addresses = arm.wait_ready()
        headers = self.line.folder / "headers"
        headers.touch(mode=0o600)
        headers.write_text(f"Authorization: Bearer {SECRETS['header']}\n")
        acsd = self.line.start_acsd(
            mcs.wait_ready()["ws"], arm_addresses, "mqtt.username=acsd", f"mqtt.password_file={self.write_secret('acsd')}",
            f"mcs.headers_file={headers}", arguments=("--trace", self.traces))
        operator = acsd.wait_ready()["operator"]
        self.wait_for_status(operator, lambda status: status["links"]["mqtt"])
        vehicles = self.line.start_vehicles(
            TIME_SCALE, options=("--trace", self.traces, "--user", "vda-sim", "--password-file", self.write_secret("vda-sim")))
        vehicles.wait_ready()
        request = urllib.request.Request(f"http://{arm_addresses['http']}/project/robot/motor_on_state",
                                         headers={"Authorization": f"Bearer {SECRETS['header']}"})
        with urllib.request.urlopen(request, timeout=STATUS_SECONDS) as response:
            self.motor = response.read().decode()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assert_last_line(mcs, "2 plans completed, 0 failed")
        self.stop(arm)
        self.stop(vehicles)
        self.wait_for_status(operator, lambda status: all(robot["status"] == "Disconnected" for robot in status["robots"]))
        self.stop(acsd)

    def check_vehicles(self, acsd, vda):
        def collect(lines, direction, topics):
            found = collections.defaultdict(list)
            for line in lines:
                if line["link"] == "mqtt" and line["direction"] == direction:
                    topic = line["topic"].rsplit("/", 1)[1]
                    if topic in topics:
                        found[line["robot"], topic].append(line["text"])
            return found

        sent, shown = collect(acsd, "out", COMMANDS), collect(acsd, "in", STATES)
        received = collect(vda, "in", COMMANDS)
        self.assertEqual(set(sent), set(received))
        for key, texts in received.items():  # vda-sim ends first, perhaps while a vehicle drives to its parking position
            self.assertEqual(sent[key][:len(texts)], texts, key)
        self.assertEqual(shown, collect(vda, "out", STATES))
        for robot in ("LR01", "CR01"):
            self.assertGreater(len(sent[robot, "order"]), 1)
            self.assertGreater(len(sent[robot, "instantActions"]), 0)
            self.assertGreater(len(shown[robot, "state"]), 10)

    def check_arm(self, acsd, arm):
        def collect(lines, direction):
            return [line["text"] for line in lines if line["link"] == "arm" and line["direction"] == direction
                    and line["robot"] == "CR01"]

        self.assertEqual(collect(acsd, "out"), collect(arm, "in"))
        self.assertEqual(collect(acsd, "in"), collect(arm, "out"))
        self.assertTrue(any("CONTROL" in text for text in collect(arm, "in")))
        self.assertGreater(len(collect(arm, "out")), 10)
        calls = [(line["direction"], line["text"]) for line in arm if line["link"] == "http"]
        self.assertEqual(calls, [("in", "GET /project/robot/motor_on_state"), ("out", f"200 {self.motor}")])
        self.assertEqual({line["controller"] for line in arm}, {1})

    def check_mcs(self, acsd, mcs):
        def collect(lines, direction):
            return [line["text"] for line in lines if line["link"] == "mcs" and line["direction"] == direction]

        self.assertGreater(len(mcs), 10)
        for here, there in (("in", "out"), ("out", "in")):  # mcs-sim ends first: acsd may have sent more
            received = collect(mcs, here)
            self.assertEqual(collect(acsd, there)[:len(received)], received)

    def merge(self, *arguments):
        run = subprocess.run([self.bin_dir / "acsctl", "trace", "--json", "--limit", "1000000", "--file", self.traces,
                              *arguments], capture_output=True, text=True, timeout=FINISH_SECONDS, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout.splitlines()

    def check_order(self, merged):
        """Each message is sent before it is received."""
        sent, received = collections.Counter(), collections.Counter()
        for line in merged:
            if line["link"] in ("mqtt", "arm", "mcs") and "kind" not in line:
                key = (line["link"], line.get("robot"), line.get("topic"), line["text"])
                if line["direction"] == "out":
                    sent[key] += 1
                elif line.get("topic", "").endswith(("/connection", "/control")):
                    continue  # the broker publishes a last will, and a retained message again
                else:
                    receiver = (line.get("program"), *key)  # acsd also receives its own commands
                    received[receiver] += 1
                    self.assertLessEqual(received[receiver], sent[key], line)
        self.assertGreater(sum(received.values()), 100)

    def check_secrets(self):
        for file in self.traces.iterdir():
            text = file.read_text()
            for secret in SECRETS.values():
                self.assertNotIn(secret, text, file)
            self.assertNotIn("secret", text.lower(), file)

    def test_the_traces_of_a_line_agree_and_give_one_time_line(self):
        self.run_line()
        acsd, vda, arm, mcs = (self.read_files(name) for name in ("acsd", "vda-sim", "openstream-sim", "mcs-sim"))
        self.assertEqual([line for line in acsd + vda + arm + mcs if line["link"] == "trace"], [], "no line is lost")
        for program, lines in (("vda-sim", vda), ("openstream-sim", arm), ("mcs-sim", mcs)):
            self.assertEqual({line["program"] for line in lines}, {program})
        self.check_vehicles(acsd, vda)
        self.check_arm(acsd, arm)
        self.check_mcs(acsd, mcs)
        self.check_secrets()

        merged = self.merge()
        self.check_order([json.loads(line) for line in merged])
        in_order = subprocess.run(["sort", "-m", "-s", "-t,", "-k1,1", "-k2.11,2n", *sorted(self.traces.iterdir())], check=True,
                                  capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"}).stdout.splitlines()
        self.assertEqual(merged, [line for line in in_order if json.loads(line)["link"] != "core"])

        sent = [line for line in acsd if line.get("topic", "").endswith("/LR01/order") and line["direction"] == "out"]
        plan, = {line["plan"] for line in sent if "plan" in line}
        self.assertEqual(sent[0].get("plan"), plan)
        about_plan = [json.loads(line) for line in self.merge("--plan", plan)]
        self.assertEqual({line.get("program", "acsd") for line in about_plan}, {"acsd", "vda-sim", "mcs-sim"})
        received = [line["text"] for line in about_plan
                    if line.get("program") == "vda-sim" and line["topic"].endswith("/order")]
        self.assertEqual(received, [line["text"] for line in sent if line.get("plan") == plan])

        replayed = subprocess.run([self.bin_dir / "acsd", "replay", self.traces], capture_output=True, text=True,
                                  timeout=FINISH_SECONDS, check=False)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)

    def test_a_trace_can_be_read_after_a_kill(self):
        self.line.start_broker()
        vehicles = self.line.start_vehicles(TIME_SCALE, options=("--count", "30", "--prefix", "V", "--trace", self.traces))
        arm = self.line.start_arm(TIME_SCALE, "--trace", self.traces)
        client = ArmClient(arm.wait_ready()["stream"])
        self.addCleanup(client.close)
        client.read(500)
        vehicles.wait_ready()
        for program in (vehicles, arm):
            self.line.forget(program)
            program.send_signal(signal.SIGKILL)
            program.stop()
        for name in ("vda-sim", "openstream-sim"):
            text, = (file.read_text() for file in self.traces.glob(f"{name}-*.ndjson"))
            lines = [json.loads(line) for line in text.splitlines(keepends=True) if line.endswith("\n")]
            self.assertLessEqual(len(text.splitlines()) - len(lines), 1)
            self.assertGreater(len(lines), 30)
            if name == "openstream-sim":
                sent = [line["text"] for line in lines if line["direction"] == "out"]
                both = min(len(sent), len(client.received))
                self.assertEqual(sent[:both], client.received[:both])
        self.assertGreater(len(self.merge()), 60)

    def test_a_fast_stream_fills_no_more_than_the_limits(self):
        limits = ("--trace-max-file-bytes", "16384", "--trace-max-files", "3")
        arm = self.line.start_arm(TIME_SCALE, "--trace", self.traces, "--control", "127.0.0.1:0", *limits)
        addresses = arm.wait_ready()
        client = ArmClient(addresses["stream"])
        client.read(1000)
        faults = urllib.request.Request(f"http://{addresses['control']}/faults", data=b"1 estop for=5s")
        with urllib.request.urlopen(faults, timeout=STATUS_SECONDS) as response:
            answer = response.read().decode()
        client.read(1)
        client.close()
        self.stop(arm)
        files = sorted(self.traces.iterdir())
        self.assertEqual(len(files), 3)
        self.assertGreater(int(files[0].name[-13:-7]), 5, "older files were deleted")
        for file in files:
            self.assertLessEqual(file.stat().st_size, 16384)
        lines = self.read_files("openstream-sim")
        self.assertIn(client.received[-1], [line["text"] for line in lines if line["link"] == "arm"])
        self.assertEqual([(line["direction"], line["text"]) for line in lines if line["link"] == "control"],
                         [("in", "POST /faults 1 estop for=5s"), ("out", f"200 {answer}")])

    def test_a_folder_that_cannot_be_used_is_refused_with_what_to_do(self):
        file = self.line.folder / "file"
        file.touch()
        site = self.line.site_dir / "site.lif.json"
        rows = (("vda-sim", "--broker", "mqtt://127.0.0.1:1", "--site", site, "--vehicle", "LR01"), ("openstream-sim",))
        for program, *arguments in rows:
            for folder, expected in ((file, "Not a directory"), (file / "x", "Not a directory"), ("", "expected a folder")):
                run = subprocess.run([self.bin_dir / program, *map(str, arguments), "--trace", folder], capture_output=True,
                                     text=True, timeout=STATUS_SECONDS, check=False)
                self.assertEqual(run.returncode, 2, run)
                self.assertEqual(run.stdout, "")
                line, = run.stderr.splitlines()
                self.assertIn("--trace", line)
                self.assertIn(expected, line)
                self.assertIn("created if necessary", line)

    def test_starts_that_fail_keep_the_files_of_earlier_runs(self):
        def list_numbers():
            return [int(file.stem[-6:]) for file in sorted(self.traces.iterdir())]

        self.line.start_broker()
        self.traces.mkdir()
        for number in (1, 2, 3):
            (self.traces / f"acsd-{number:06}.ndjson").write_text("{}\n")
        start = functools.partial(self.line.start_acsd, "127.0.0.1:1", {"stream": "127.0.0.1:1"}, "trace.max_files=3",
                                  arguments=("--trace", self.traces))
        with socket.create_server(("127.0.0.1", 0)) as taken:
            for _ in range(4):
                acsd = start(f"operator.listen=127.0.0.1:{taken.getsockname()[1]}")
                self.assertEqual(acsd.wait(STATUS_SECONDS), 1)
                self.assertEqual(list_numbers(), [1, 2, 3])
        start().wait_ready()
        self.assertEqual(list_numbers(), [2, 3, 4])

    def test_a_folder_of_another_process_is_refused(self):
        arm = self.line.start_arm(TIME_SCALE, "--trace", self.traces)
        arm.wait_ready()
        run = subprocess.run([self.bin_dir / "openstream-sim", "--listen", "127.0.0.1:0", "--http", "127.0.0.1:0", "--trace",
                              self.traces], capture_output=True, text=True, timeout=STATUS_SECONDS, check=False)
        self.assertEqual(run.returncode, 2, run)
        self.assertIn("give each process a folder of its own", run.stderr)
        self.line.forget(arm)
        arm.send_signal(signal.SIGKILL)
        arm.stop()
        self.line.start_arm(TIME_SCALE, "--trace", self.traces).wait_ready()


if __name__ == "__main__":
    main()
