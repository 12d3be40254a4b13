#!/usr/bin/env python3
"""The broker of the example site (examples/site/mosquitto.conf): accounts, topics by account, length of messages."""

import re
import shutil
import subprocess
import time
import urllib.request

from scenario_case import FINISH_SECONDS, PLANS, TIME_SCALE, ScenarioCase, main

CLIENT_SECONDS = 20
ACSD_BYTES = 4 << 20  # of the longest VDA5050 message that acsd reads
ACCOUNTS = ("acsd", "LR01", "CR01")


class Broker(ScenarioCase):
    def setUp(self):
        super().setUp()
        folder = self.line.folder / "mosquitto"
        (folder / "certs").mkdir(parents=True)
        self.certificate = folder / "certs" / "broker.pem"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-keyout", folder / "certs" / "broker.key", "-out", self.certificate, "-days", "2",
                        "-subj", "/CN=broker", "-addext", "subjectAltName=IP:127.0.0.1"], check=True, capture_output=True)
        shutil.copy(self.line.site_dir / "mosquitto.acl", folder / "acs.acl")
        passwords = folder / "acs.passwords"
        passwords.touch(mode=0o600)
        for name in ACCOUNTS:
            subprocess.run(["mosquitto_passwd", "-b", passwords, name, f"password of {name}"], check=True)
            file = self.line.folder / name
            file.touch(mode=0o600)
            file.write_text(f"password of {name}\n")
        lines = (self.line.site_dir / "mosquitto.conf").read_text().replace("/etc/mosquitto", str(folder)).splitlines()
        lines.remove("listener 8883")  # the test has a free port
        self.line.start_broker(access=lines)

    def start_acsd(self, mcs_address, arm):
        return self.line.start_acsd(
            mcs_address, arm, f"mqtt.url=mqtts://127.0.0.1:{self.line.broker_port}", f"mqtt.ca_file={self.certificate}",
            "mqtt.username=acsd", f"mqtt.password_file={self.line.folder / 'acsd'}")

    def run_client(self, program, account, *arguments):
        binary = shutil.which(program)
        self.assertIsNotNone(binary, f"{program} is missing; run scripts/setup")
        login = () if account is None else ("-u", account, "-P", f"password of {account}")
        return subprocess.run([binary, "-h", "127.0.0.1", "-p", str(self.line.broker_port), "--cafile", self.certificate,
                               "-q", "1", *login, *map(str, arguments)], capture_output=True, text=True,
                              timeout=CLIENT_SECONDS, check=False)

    def publish(self, account, topic, size):
        payload = self.line.folder / "payload"
        payload.write_bytes(b"x" * size)
        run = self.run_client("mosquitto_pub", account, "-t", topic, "-f", payload)
        self.assertEqual(run.returncode, 0, run.stderr)

    def read_first(self, account, topic, messages):
        """Topic and length of the first of these messages (account, topic, length) that the account receives. The broker
        keeps them for it."""
        session = ("-c", "-i", "reader", "-t", topic)
        subscribed = self.run_client("mosquitto_sub", account, *session, "-E")
        self.assertEqual(subscribed.returncode, 0, subscribed.stderr)
        for message in messages:
            self.publish(*message)
        received = self.run_client("mosquitto_sub", account, *session, "-F", "%t %l", "-C", "1")
        self.assertEqual(received.returncode, 0, received.stderr)
        return received.stdout.strip()

    def test_plans_are_completed_with_an_account_for_each_vehicle(self):
        for name, start in (("LR01", "type=LR,node=D-CHG01"), ("CR01", "type=CR,node=D-CHG02")):
            self.line.start("vda-sim", "--broker", f"mqtts://127.0.0.1:{self.line.broker_port}", "--tls-ca", self.certificate,
                            "--user", name, "--password-file", self.line.folder / name, "--no-control", "--site",
                            self.line.site_dir / "site.lif.json", "--time-scale", TIME_SCALE, "--vehicle",
                            f"{name},{start}").wait_ready()
        mcs = self.line.start_mcs(PLANS, "--fresh-ids")
        self.start_acsd(mcs.wait_ready()["ws"], self.line.start_arm(TIME_SCALE).wait_ready()).wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assert_last_line(mcs, "2 plans completed, 0 failed")

    def test_a_client_has_the_topics_of_its_account_only(self):
        self.assertNotEqual(self.run_client("mosquitto_pub", None, "-t", "uagv/v2/ACS/LR01/order", "-m", "x").returncode, 0)
        order, state = "uagv/v2/ACS/CR01/order", "uagv/v2/ACS/CR01/state"
        self.assertEqual(self.read_first("CR01", order, [("LR01", order, 1), ("CR01", order, 2), ("acsd", order, 3)]),
                         f"{order} 3")
        self.assertEqual(self.read_first("acsd", "#", [("LR01", state, 1), ("acsd", state, 2), ("CR01", state, 3)]),
                         f"{state} 3")
        own = "uagv/v2/ACS/LR01/order"
        self.assertEqual(self.read_first("LR01", "#", [("acsd", order, 1), ("CR01", state, 2), ("acsd", own, 3)]), f"{own} 3")

    def read_unreadable(self, address):
        with urllib.request.urlopen(f"http://{address}/metrics", timeout=CLIENT_SECONDS) as response:
            text = response.read().decode()
        found = re.search(r'^acsd_robot_oddities_total\{kind="unreadable_message",robot="LR01"\} (\d+)', text, re.MULTILINE)
        return int(found.group(1)) if found else 0

    def test_19_7_the_longest_message_of_the_broker_is_the_longest_of_acsd(self):
        topic = "uagv/v2/ACS/LR01/state"
        messages = [("LR01", topic, ACSD_BYTES + 1), ("LR01", topic, ACSD_BYTES)]
        self.assertEqual(self.read_first("acsd", topic, messages), f"{topic} {ACSD_BYTES}")
        acsd = self.start_acsd("127.0.0.1:1", {"stream": "127.0.0.1:1"})
        addresses = acsd.wait_ready()
        self.wait_for_status(addresses["operator"], lambda status: status["links"]["mqtt"])
        for message in messages:
            self.publish(*message)
        deadline = time.monotonic() + CLIENT_SECONDS
        while self.read_unreadable(addresses["http"]) == 0:
            self.assertLess(time.monotonic(), deadline, acsd.log.read_text())
            time.sleep(0.02)
        self.assertEqual(self.read_unreadable(addresses["http"]), 1)
        self.assertNotIn("too long", acsd.log.read_text())


if __name__ == "__main__":
    main()
