#!/usr/bin/env python3
"""examples/python/mcs.py, an MCS on the C interface, in front of acsd and simulated robots: the plan is completed, and the robots have
moved what it demands. Bad clients beside acsd disturb neither."""

import argparse
import base64
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import time

from scenario_case import FINISH_SECONDS, PLANS, REPOSITORY, ScenarioCase
from scenario_case import main as run_tests

SETTINGS = argparse.Namespace(library="")
PROGRAM = REPOSITORY / "examples" / "python" / "mcs.py"
UPGRADE = ("GET /acs/ HTTP/1.1\r\nHost: mcs\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
           f"Sec-WebSocket-Key: {base64.b64encode(bytes(16)).decode()}\r\n\r\n").encode()
MASK = bytes(4)  # leaves the payload as it is
FLOOD_BYTES, READ_BYTES = 64 * 1024 * 1024, 64 * 1024
FINAL_TEXT, FIRST_FRAGMENT, LAST_FRAGMENT, PING = 0x81, 0x01, 0x80, 0x89


def make_frame(first, payload):
    assert len(payload) < 126
    return bytes([first, 0x80 | len(payload)]) + MASK + payload


class PythonMcs(ScenarioCase):
    def start_mcs(self, plan=PLANS[0], **options):
        self.mcs = self.line.start("mcs", "-B", PROGRAM, "--library", SETTINGS.library, "--listen", "127.0.0.1:0", plan,
                                   binary=sys.executable, **options)
        return self.mcs.wait_ready()["ws"]

    def wait_for_line(self, begin):
        end = time.monotonic() + FINISH_SECONDS
        while not any(line.startswith(begin) for line in self.mcs.tail(10_000)):
            self.assertLess(time.monotonic(), end, f"no line {begin}")
            time.sleep(0.02)

    def read_moves(self):
        lines = (self.line.folder / "world.json.journal").read_text().splitlines()
        return [(event["carrier"], event["from"], event["to"]) for event in map(json.loads, lines)
                if event["event"] == "CarrierMoved"]

    def connect(self, address, data):
        host, port = address.rsplit(":", 1)
        client = socket.create_connection((host, int(port)), FINISH_SECONDS)
        self.addCleanup(client.close)
        client.sendall(data)
        return client

    def read_to_the_end(self, client):
        data = b""
        try:
            while part := client.recv(4096):
                data += part
        except ConnectionResetError:
            pass
        return data

    def test_a_plan_is_completed(self):
        self.line.share_world()
        arm = self.start_robots()
        self.line.start_acsd(self.start_mcs(), arm).wait_ready()
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)

        self.assertEqual(self.read_moves(), [("CASSETTE_01", "A01.CP01", "LR01.CP01"), ("CASSETTE_01", "LR01.CP01", "A02.CP03")])
        lines = self.mcs.tail(10_000)
        plan = json.loads(PLANS[0].read_text())["planId"]
        self.assertIn("the ACS is registered", lines)
        self.assertTrue(any(line.startswith(f"plan {plan}: accepted") for line in lines), lines)
        reports = [line for line in lines if line.startswith("PlanReport ")]
        self.assertIn("status=InProgress", reports[0])
        self.assertIn("status=Completed", reports[-1])
        self.assertEqual(sum(line.startswith("JobReport ") and "status=Completed" in line for line in lines), 2)

    def test_a_report_with_characters_that_the_locale_lacks_is_printed(self):
        plan = self.line.folder / "plan.json"
        plan.write_text(json.dumps(json.loads(PLANS[0].read_text()) | {"planId": "계획"}))
        address = self.start_mcs(plan, environment=os.environ | {"PYTHONIOENCODING": "ascii"})
        self.line.start_acsd(address, self.start_robots()).wait_ready()
        self.wait_for_line(r"PlanReport planId=\uacc4\ud68d")

    def test_an_interrupt_ends_it_without_a_traceback(self):
        self.start_mcs()
        self.mcs.send_signal(signal.SIGINT)
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 130)
        self.assertFalse([line for line in self.mcs.tail(10_000) if "Traceback" in line])
        self.line.forget(self.mcs)

    def test_acsd_is_killed_and_continues(self):
        self.line.share_world()
        arm = self.start_robots()
        address = self.start_mcs()
        acsd = self.line.start_acsd(address, arm)
        acsd.wait_ready()
        self.wait_for_line("JobReport ")
        acsd.send_signal(signal.SIGKILL)
        acsd.wait(FINISH_SECONDS)
        self.line.forget(acsd)
        acsd.stop()
        self.line.start_acsd(address, arm).wait_ready()
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        self.assertEqual(self.read_moves(), [("CASSETTE_01", "A01.CP01", "LR01.CP01"), ("CASSETTE_01", "LR01.CP01", "A02.CP03")])
        self.assertEqual(self.mcs.tail(10_000).count("the ACS is registered"), 2)

    def test_bad_clients_are_refused(self):
        address = self.start_mcs()
        self.assertTrue(self.read_to_the_end(self.connect(address, b"GET / HTTP/1.1\r\n\r\n")).startswith(b"HTTP/1.1 400 "))
        self.assertEqual(self.read_to_the_end(self.connect(address, b"x" * 20_000)), b"")
        for frame, code in ((b"\x81\x01x", 1002),  # not masked
                            (b"\xf1\x80" + MASK, 1002),  # reserved bits
                            (make_frame(LAST_FRAGMENT, b"x"), 1002),  # no first fragment
                            (b"\x81\xff" + (1 << 40).to_bytes(8, "big") + MASK, 1009)):  # 1 TiB
            answer = self.read_to_the_end(self.connect(address, UPGRADE + frame))
            self.assertTrue(answer.startswith(b"HTTP/1.1 101 "))
            self.assertEqual(answer.split(b"\r\n\r\n", 1)[1][2:4], code.to_bytes(2, "big"), frame)
        # Fragments with a ping between them are one message.
        registration = b'{"command":"Registration","transactionId":"t","payload":{}}'
        client = self.connect(address, UPGRADE + make_frame(FIRST_FRAGMENT, registration[:9]) + make_frame(PING, b"ping")
                              + make_frame(LAST_FRAGMENT, registration[9:]))
        data = self.read_until(client, b'"RegistrationAck"', b"\r\n\r\n")
        self.assertIn(b"\x8a\x04ping", data)
        self.assertIn(b'"result":"Success"', data)

    def read_until(self, client, *parts):
        data = b""
        while not all(part in data for part in parts):
            part = client.recv(4096)
            self.assertTrue(part, data)
            data += part
        return data

    def test_clients_are_numbered_in_the_order_of_their_upgrades(self):
        address = self.start_mcs()
        early = self.connect(address, b"")
        late = self.connect(address, UPGRADE + make_frame(PING, b"late"))
        self.read_until(late, b"\x8a\x04late")
        early.sendall(UPGRADE + make_frame(PING, b"early"))
        self.read_until(early, b"\x8a\x05early")
        self.assertTrue(self.mcs.is_running())

    def test_a_client_that_reads_no_pongs_is_closed(self):
        client = self.connect(self.start_mcs(), UPGRADE)
        client.settimeout(FINISH_SECONDS)
        pings = make_frame(PING, bytes(125)) * 1000
        with self.assertRaises(ConnectionError):
            for _ in range(1000):  # 131 MB, of which the buffers of both sockets take some
                client.sendall(pings)
        self.assertTrue(self.mcs.is_running())

    def test_what_follows_a_violation_needs_no_memory(self):
        address = self.start_mcs()
        too_big = b"\x81\xff" + (1 << 40).to_bytes(8, "big") + MASK
        for violation in (b"\x81\x01x",  # not masked
                          too_big, make_frame(FIRST_FRAGMENT, b"x") + too_big):
            before = self.read_peak_memory()
            client = self.connect(address, UPGRADE + violation)
            client.settimeout(FINISH_SECONDS)
            try:
                for _ in range(FLOOD_BYTES // READ_BYTES):
                    client.sendall(bytes(READ_BYTES))
            except ConnectionError:
                pass  # closed in the meantime
            self.assertLess(self.read_peak_memory() - before, FLOOD_BYTES // 4)
        self.assertTrue(self.mcs.is_running())

    def read_peak_memory(self):
        status = pathlib.Path(f"/proc/{self.mcs.process.pid}/status").read_text()
        return int(re.search(r"^VmHWM:\s+(\d+) kB$", status, re.MULTILINE).group(1)) * 1024

    def test_an_invalid_address_is_a_usage_error(self):
        for address in ("127.0.0.1:99999", "127.0.0.1:-1", "127.0.0.1:", "127.0.0.1:http"):
            ended = subprocess.run([sys.executable, "-B", PROGRAM, "--library", SETTINGS.library, "--listen", address, PLANS[0]],
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=FINISH_SECONDS, check=False)
            self.assertEqual(ended.returncode, 2, ended.stdout)
            self.assertIn(f"argument --listen: '{address}' is not HOST:PORT with a port of 0 to 65535", ended.stdout)

    def test_an_invalid_plan_is_refused_at_the_start(self):
        plan = self.line.folder / "plan.json"
        plan.write_text(json.dumps({"planId": "P", "steps": [{"stepNo": "one"}]}))
        ended = subprocess.run([sys.executable, "-B", PROGRAM, "--library", SETTINGS.library, plan], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, timeout=FINISH_SECONDS, check=False)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("payload.", ended.stdout)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--library", required=True, type=os.path.abspath)
    SETTINGS, rest = parser.parse_known_args()
    sys.argv[1:] = rest
    run_tests()
