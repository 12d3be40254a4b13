#!/usr/bin/env python3
"""What an operator does over HTTP, and what the operator API answers, with real processes."""

import http.client
import itertools
import json
import signal
import socket
import ssl
import subprocess
import threading
import time
import urllib.error
import urllib.request

from scenario_case import FINISH_SECONDS, PLANS, TIME_SCALE, ScenarioCase, main
import operator_api  # which scenario_case makes known
from production_line import find_free_port


class Operator(ScenarioCase):
    def start_line(self, *overrides, vehicles=("LR01,type=LR", "CR01,type=CR")):
        """Everything but the MCS, which has a port already."""
        self.line.start_broker()
        robots = self.line.start_vehicles(TIME_SCALE, vehicles)
        self.arm = self.line.start_arm(TIME_SCALE).wait_ready()
        robots.wait_ready()
        self.mcs_port = find_free_port()
        self.overrides = overrides
        self.start_acsd()

    def start_acsd(self):
        self.acsd = self.line.start_acsd(f"127.0.0.1:{self.mcs_port}", self.arm, *self.overrides)
        self.acsd.wait_ready()

    def command(self, path, body=None):
        return operator_api.post(self.acsd.addresses["operator"], path, body)

    def set_carriers(self, *carriers):
        return self.command("/v1/robots/CR01/carriers", {"carrierIds": carriers})

    def wait_for(self, get, what):
        """The first answer of get that is not None."""
        never, end = threading.Event(), time.monotonic() + FINISH_SECONDS
        while (found := get(self.read_status(self.acsd.addresses["operator"]))) is None:
            self.assertLess(time.monotonic(), end, what)
            never.wait(0.05)
        return found

    def wait_for_robot(self, robot_id, status):
        def get(answer):
            robot = next(robot for robot in answer["robots"] if robot["robotId"] == robot_id)
            return robot if robot["status"] == status else None

        return self.wait_for(get, f"{robot_id} is {status}")

    def wait_for_reason(self, start):
        def get(answer):
            waits = [plan["waits"] for plan in answer["plans"] if plan["waits"] is not None]
            robots = waits[0]["robots"] if waits else []
            return waits[0] if robots and robots[0]["reason"].startswith(start) else None

        return self.wait_for(get, f"a plan that waits as {start}")

    def test_monitoring_and_operators_have_an_address_each(self):
        self.line.start_broker()
        self.mcs_port = find_free_port()
        self.arm, self.overrides = {"stream": "127.0.0.1:1"}, ()
        self.start_acsd()
        self.assertEqual([self.read_code(name, path) for name in ("http", "operator") for path in (
            "/livez", "/metrics", "/v1/status")], [200, 200, 404, 404, 404, 200])
        self.assertEqual([self.read_code("http", path, "POST") for path in ("/v1/tsc/pause", "/livez")], [404, 405])
        self.assertEqual(self.read_code("operator", "/v1/tsc/pause", "POST"), 202)
        for name in ("http", "operator"):  # a page that has its own name resolved to this address (DNS rebinding)
            self.assertEqual([self.read_code(name, path, host="evil.example") for path in ("/livez", "/metrics", "/v1/status")],
                             [403, 403, 403])

    def test_no_other_origin_may_read_an_answer(self):
        """A browser shows a page the answer of another origin only if a header permits it."""
        self.line.start_broker()
        self.mcs_port = find_free_port()
        self.arm, self.overrides = {"stream": "127.0.0.1:1"}, ()
        self.start_acsd()
        rows = ({"Sec-Fetch-Site": "cross-site"}, 403), ({"Sec-Fetch-Site": "same-site"}, 200), ({}, 200)
        for name, path in (("http", "/livez"), ("http", "/metrics"), ("operator", "/v1/status"), ("operator", "/v1/audit")):
            for method, (header, expected) in itertools.product(("GET", "OPTIONS"), rows):  # OPTIONS asks for the permission
                connection = http.client.HTTPConnection(self.acsd.addresses[name], timeout=20)
                connection.request(method, path, headers={
                    "Origin": "http://evil.example", "Access-Control-Request-Method": "GET", **header})
                response = connection.getresponse()
                self.assertEqual(response.status, expected if method == "GET" else 403, (path, header))
                self.assertEqual([key for key in response.headers if key.lower().startswith("access-control-")], [])
                connection.close()

    def test_a_token_gives_its_role_until_it_is_withdrawn(self):
        self.line.start_broker()
        self.mcs_port = find_free_port()
        viewer, operator = self.make_token("viewer", "grafana"), self.make_token("operator", "kim")
        tokens = self.line.folder / "tokens"
        self.assertNotIn(operator, tokens.read_text())
        self.arm, self.overrides = {"stream": "127.0.0.1:1"}, (f"operator.tokens_file={tokens}",)
        self.start_acsd()
        rows = ((None, 401, 401), ("guess", 401, 401), (tokens.read_text().split()[-1], 401, 401),
                (viewer, 200, 403), (operator, 200, 202))
        for token, read, changed in rows:
            self.assertEqual(self.read_code("operator", "/v1/status", token=token), read)
            self.assertEqual(self.read_code("operator", "/v1/tsc/pause", "POST", token=token), changed)
        self.assertEqual(self.read_code("http", "/livez"), 200)
        self.assert_audited(operator, [("grafana", "viewer", 403), ("kim", "operator", 202)])

        tokens.write_text("".join(line for line in tokens.read_text().splitlines(True) if "kim" not in line))
        self.acsd.send_signal(signal.SIGHUP)
        deadline = time.monotonic() + FINISH_SECONDS
        while self.read_code("operator", "/v1/tsc/resume", "POST", token=operator) != 401:
            self.assertLess(time.monotonic(), deadline, "the token is still valid")
        self.assertEqual(self.read_code("operator", "/v1/status", token=viewer), 200)

        self.line.forget(self.acsd)
        self.assertEqual(self.acsd.stop(), 0)
        self.start_acsd()
        self.assert_audited(viewer, [("grafana", "viewer", 403), ("kim", "operator", 202)])

    def assert_audited(self, token, commands):
        """These commands to pause the TSC are in /v1/audit."""
        request = urllib.request.Request(f"http://{self.acsd.addresses['operator']}/v1/audit?limit=1000",
                                         headers={"Authorization": f"Bearer {token}"})
        with urllib.request.urlopen(request, timeout=20) as response:
            entries = [json.loads(line) for line in response.read().splitlines()]
        entries = [entry for entry in entries if entry["request"] == "/v1/tsc/pause"]
        self.assertEqual([(entry["name"], entry["role"], entry["status"]) for entry in entries], commands)
        for entry in entries:
            self.assertEqual((entry["method"], entry["proof"]), ("POST", "token"))
            self.assertEqual(list(entry["answer"]), ["message" if entry["status"] == 202 else "error"])
            self.assertRegex(entry["peer"], r"127\.0\.0\.1:\d+")
        (file,) = (self.line.folder / "store" / "audit").iterdir()
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)

    def test_an_invalid_request_for_a_token_is_refused(self):
        for arguments in ((), ("operator",), ("root", "kim"), ("viewer", "a b"), ("viewer", ""), ("viewer", "kim", "lee")):
            result = subprocess.run([self.line.bin_dir / "acsd", "token", *arguments], capture_output=True, text=True)
            self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (2, "", 1), arguments)

    def make_certificate(self, name, *options):
        """(certificate, key); of the CA "ca" if there is one."""
        certificate, key = self.line.folder / f"{name}.pem", self.line.folder / f"{name}.key"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-keyout", key, "-out", certificate, "-days", "2", "-subj", f"/CN={name}", *map(str, options)],
                       check=True, capture_output=True)
        return certificate, key

    def test_a_token_whose_line_is_not_written_is_not_shown(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([self.bin_dir / "acsd", "token", "operator", "kim"], stdout=full, stderr=subprocess.PIPE, text=True,
                                  timeout=FINISH_SECONDS, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "acsd token: the line cannot be written to standard output: No space left on device. No token is made\n")

    def test_other_machines_need_tls_and_a_token_or_a_certificate(self):
        def check(*overrides):
            sets = [part for override in overrides for part in ("--set", override)]
            return subprocess.run([self.line.bin_dir / "acsd", "--config", self.line.site_dir / "acsd.toml", "--check-config",
                                   *sets], capture_output=True, text=True)

        ca, ca_key = self.make_certificate("ca")
        of_ca = ("-CA", ca, "-CAkey", ca_key)
        certificate, key = self.make_certificate("acsd", *of_ca, "-addext", "subjectAltName=IP:127.0.0.1")
        operator, tokens = self.make_token("operator", "kim"), self.line.folder / "tokens"
        tls = (f"operator.tls.certificate={certificate}", f"operator.tls.key={key}")
        needs_tls = 'tls = { certificate = "acsd.pem", key = "acsd.key" }'
        needs_tokens = 'tokens_file = "tokens"'
        for overrides, missing in (((), f"{needs_tls} and {needs_tokens}"), (tls, needs_tokens),
                                   ((f"operator.tokens_file={tokens}",), needs_tls)):
            result = check("operator.listen=0.0.0.0:0", *overrides)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(result.stderr, "--set: operator.listen: 0.0.0.0:0 can be reached from other machines; "
                                            f"add to [operator]: {missing}\n")

        self.line.start_broker()
        self.mcs_port = find_free_port()
        self.arm, self.overrides = {"stream": "127.0.0.1:1"}, (
            *tls, "operator.listen=0.0.0.0:0", f"operator.tokens_file={tokens}", f"operator.tls.client_ca={ca}",
            'operator.certificates={ "lee" = "viewer", "kim" = "operator" }')
        self.start_acsd()
        port = self.acsd.addresses["operator"].split(":")[1]
        rows = [(None, None, 401, 401), (None, "guess", 401, 401), (None, operator, 200, 202)]
        for name, read, changed in (("lee", 200, 403), ("kim", 200, 202), ("stranger", 403, 403)):
            rows.append((self.make_certificate(name, *of_ca), None, read, changed))
        for identity, token, read, changed in rows:
            context = ssl.create_default_context(cafile=ca)
            if identity is not None:
                context.load_cert_chain(*identity)
            headers = {} if token is None else {"Authorization": f"Bearer {token}"}
            for method, path, expected in (("GET", "/v1/status", read), ("POST", "/v1/tsc/pause", changed)):
                connection = http.client.HTTPSConnection("127.0.0.1", port, timeout=20, context=context)
                connection.request(method, path, headers=headers)
                self.assertEqual(connection.getresponse().status, expected, (identity, token, method))
                connection.close()
        with self.assertRaises(OSError):
            urllib.request.urlopen(f"http://127.0.0.1:{port}/v1/status", timeout=20)

    def test_a_certificate_is_renewed_without_a_restart(self):
        def read_certificate():
            with socket.create_connection(("127.0.0.1", port), timeout=20) as plain:
                with context.wrap_socket(plain, server_hostname="127.0.0.1") as stream:
                    return ssl.DER_cert_to_PEM_cert(stream.getpeercert(binary_form=True))

        def make(name):
            return self.make_certificate(name, "-CA", ca, "-CAkey", ca_key, "-addext", "subjectAltName=IP:127.0.0.1")

        ca, ca_key = self.make_certificate("ca")
        certificate, key = make("acsd")
        context = ssl.create_default_context(cafile=ca)
        self.line.start_broker()
        self.mcs_port = find_free_port()
        self.arm = {"stream": "127.0.0.1:1"}
        self.overrides = (f"operator.tls.certificate={certificate}", f"operator.tls.key={key}")
        self.start_acsd()
        port = int(self.acsd.addresses["operator"].split(":")[1])
        self.assertEqual(read_certificate(), certificate.read_text())

        renewed, renewed_key = make("renewed")
        key.chmod(0o644)
        self.acsd.send_signal(signal.SIGHUP)
        refusal = f"every user of this machine can read {key}; run chmod o-rwx {key}"
        deadline = time.monotonic() + FINISH_SECONDS
        while refusal not in self.acsd.log.read_text():
            self.assertLess(time.monotonic(), deadline, "the key is not refused")
            time.sleep(0.05)
        self.assertEqual(read_certificate(), certificate.read_text())
        renewed.replace(certificate)
        renewed_key.replace(key)
        self.acsd.send_signal(signal.SIGHUP)
        deadline = time.monotonic() + FINISH_SECONDS
        while read_certificate() != certificate.read_text():
            self.assertLess(time.monotonic(), deadline, "the former certificate is still used")

    def read_code(self, name, path, method="GET", host=None, token=None):
        request = urllib.request.Request(f"http://{self.acsd.addresses[name]}{path}", method=method)
        if host is not None:
            request.add_header("Host", host)
        if token is not None:
            request.add_header("Authorization", f"Bearer {token}")
        try:
            with urllib.request.urlopen(request, timeout=20) as response:
                return response.status
        except urllib.error.HTTPError as error:
            with error:
                return error.code

    def test_maintenance_and_ports_block_a_plan_over_a_restart_until_cleared(self):
        self.start_line()
        self.wait_for_robot("CR01", "Idle")
        self.assertEqual(self.command("/v1/robots/CR01/maintenance", {"on": True}),
                         (202, {"message": "CR01 is taken out of service."}))
        self.assertTrue(self.wait_for_robot("CR01", "Stopped")["maintenance"])
        self.assertEqual(self.command("/v1/robots/CR09/maintenance", {"on": True})[0], 404)
        self.assertEqual(self.command("/v1/alarms/clear", {"robotId": "CR01", "errorCode": "ACS-1004"})[0], 404)
        mcs = self.line.start_mcs(PLANS[1:], "--fresh-ids", port=self.mcs_port)
        mcs.wait_ready()
        self.assertEqual(self.wait_for_reason("in maintenance")["queuePosition"], 1)

        self.line.forget(self.acsd)
        self.assertEqual(self.acsd.stop(), 0)
        self.start_acsd()
        self.wait_for_reason("in maintenance")

        self.assertEqual(self.set_carriers("TRAY_99", None, None)[0], 202)
        self.assertEqual(self.set_carriers("A", "B")[0], 400)
        self.assertEqual(self.command("/v1/robots/CR01/maintenance", {"on": False})[0], 202)
        self.wait_for_reason("CR01.TP01 is taken by TRAY_99")
        self.assertEqual(self.set_carriers(None, None, None)[0], 202)
        self.wait_for(lambda _: "it was (TRAY_99, empty, empty), it is (empty, empty, empty)" in self.acsd.log.read_text(errors="replace") or None,
                      "a line about the corrected port")
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assert_last_line(mcs, "1 plans completed, 0 failed")

    def test_a_vehicle_with_a_low_battery_charges_before_it_works(self):
        self.start_line("robots.LR01.charge=CHG01", "robot.battery_resume=40",
                        vehicles=("LR01,type=LR,battery=10", "CR01,type=CR"))
        self.wait_for_robot("LR01", "Charging")
        mcs = self.line.start_mcs(PLANS[:1], "--fresh-ids", port=self.mcs_port)
        mcs.wait_ready()
        self.assertEqual(mcs.wait(FINISH_SECONDS), 0)
        self.assert_last_line(mcs, "1 plans completed, 0 failed")
        robot = next(robot for robot in self.read_status(self.acsd.addresses["operator"])["robots"] if robot["robotId"] == "LR01")
        self.assertGreater(robot["battery"], 30)


if __name__ == "__main__":
    main()
