#!/usr/bin/env python3
"""e18_tls: both sides accept the right certificate and refuse every other one; a client of Python confirms it."""

import signal
import socket
import ssl
import subprocess
import unittest

from scenario_case import FINISH_SECONDS, STATUS_SECONDS, ScenarioCase, main

REGISTERED, NOT_CONNECTED, UNUSABLE = 0, 1, 2


class MutualTLS(ScenarioCase):
    def setUp(self):
        super().setUp()
        self.make("ca", "basicConstraints=critical,CA:TRUE")
        self.make("other-ca", "basicConstraints=critical,CA:TRUE")
        self.make("mcs", "subjectAltName=DNS:localhost", "ca")
        self.make("acs", "subjectAltName=DNS:acs", "ca")

    def make(self, name, extension, issuer=None):
        """A certificate NAME.pem with its key NAME.key; without an issuer it is a CA."""
        signed = ["-CA", self.path(f"{issuer}.pem"), "-CAkey", self.path(f"{issuer}.key"),
                  "-addext", "basicConstraints=critical,CA:FALSE"] if issuer else []
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                        "-keyout", self.path(f"{name}.key"), "-out", self.path(f"{name}.pem"), "-days", "1",
                        "-subj", f"/CN={name}", "-addext", extension, *signed], check=True, capture_output=True)

    def path(self, name):
        return self.line.folder / name

    def start_mcs(self, name="mcs"):
        self.mcs = self.line.start("e18_tls", "mcs", *self.files("ca", name))
        self.port = int(self.mcs.wait_ready()["wss"].split(":")[1])

    def files(self, ca, name):
        return [self.path(f"{ca}.pem"), *([self.path(f"{name}.pem"), self.path(f"{name}.key")] if name else ["", ""])]

    def run_acs(self, ca="ca", name="acs", scheme="wss"):
        url = f"{scheme}://localhost:{self.port}/acs/"
        acs = subprocess.run([self.bin_dir / "e18_tls", "acs", url, *self.files(ca, name)], stdout=subprocess.PIPE, text=True,
                             timeout=FINISH_SECONDS, check=False)
        return acs.returncode, acs.stdout

    def stop_mcs(self):
        self.mcs.send_signal(signal.SIGTERM)
        self.assertEqual(self.mcs.wait(FINISH_SECONDS), 0)
        return self.mcs.log.read_text()

    def ask(self, name):
        """The answer of the MCS to an HTTP request of a client of another make."""
        context = ssl.create_default_context(cafile=self.path("ca.pem"))
        if name:
            context.load_cert_chain(self.path(f"{name}.pem"), self.path(f"{name}.key"))
        with socket.create_connection(("localhost", self.port), timeout=STATUS_SECONDS) as plain:
            with context.wrap_socket(plain, server_hostname="localhost") as connection:
                connection.sendall(b"GET /nowhere HTTP/1.1\r\nHost: localhost\r\n\r\n")
                return connection.recv(1024)

    def test_the_right_certificates(self):
        self.start_mcs()
        self.assertEqual(self.run_acs(), (REGISTERED, "acs: registered\n"))
        self.assertTrue(self.ask("acs").startswith(b"HTTP/1.1 4"))
        self.assertIn("mcs: registered\n", self.stop_mcs())

    def assert_refused(self, part, log="", **client):
        code, text = self.run_acs(**client)
        self.assertEqual(code, NOT_CONNECTED, text)
        self.assertIn("acs: not connected: ", text)
        self.assertIn(part, text)
        shown = self.stop_mcs()
        self.assertIn(log, shown)
        self.assertNotIn("registered", shown)

    def test_a_client_without_a_certificate(self):
        self.start_mcs()
        with self.assertRaisesRegex(ssl.SSLError, "certificate required"):
            self.ask(None)
        self.assert_refused("certificate", "mcs: a connection did not become a WebSocket", name=None)

    def test_a_client_certificate_of_another_ca(self):
        self.make("stranger", "subjectAltName=DNS:acs", "other-ca")
        self.start_mcs()
        with self.assertRaisesRegex(ssl.SSLError, "unknown ca"):
            self.ask("stranger")
        self.assert_refused("", "mcs: a connection did not become a WebSocket", name="stranger")

    def test_a_server_certificate_of_another_ca(self):
        self.start_mcs()
        self.assert_refused("the server's certificate", ca="other-ca")

    def test_a_server_certificate_for_another_host(self):
        self.make("elsewhere", "subjectAltName=DNS:elsewhere", "ca")
        self.start_mcs("elsewhere")
        self.assert_refused("the server's certificate", name="acs")

    def test_certificates_do_not_make_ws_safe(self):
        self.start_mcs()
        code, text = self.run_acs(scheme="ws")
        self.assertEqual(code, UNUSABLE, text)
        self.assertIn("expected wss://", text)


if __name__ == "__main__":
    main()
