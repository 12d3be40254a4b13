#!/usr/bin/env python3
"""Clients of the operator API that do not behave: streams that no client reads, pages of other origins, tokens, ids and keys that are
wrong. Each has a clear answer, and acsd continues."""

import http.client
import itertools
import json
import pathlib
import re
import socket

from api_client import EventReader
from line_faults import FaultCase
from plan_samples import make_carrying_plan
from scenario_case import STATUS_SECONDS, ScenarioCase, main
import operator_api  # which scenario_case makes known

STREAMS = 100
MOST_STREAMS = 16  # of one client address
SMALLEST_BUFFER = 2048
KEPT_BYTES = 8 << 20  # of events
WAITING_PLANS = 60
QUEUE_PRIORITY = 2
MOST_GROWTH = 64 << 20  # bytes: the kept events (8 MiB) and what serving anything else needs
NODES = ("N001", "N002")
FOREIGN = "http://evil.example"


class UnreadStreams(FaultCase):
    def open_stream(self):
        """A socket that never reads: the head of the answer is left in its buffer."""
        host, port = self.address.rsplit(":", 1)
        stream = socket.socket()
        self.addCleanup(stream.close)
        stream.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, SMALLEST_BUFFER)
        stream.settimeout(STATUS_SECONDS)
        stream.connect((host, int(port)))
        stream.sendall(f"GET /v1/events HTTP/1.1\r\nHost: {self.address}\r\n\r\n".encode())
        size, head = 1, b""
        while b"\r\n\r\n" not in head:
            head = stream.recv(size, socket.MSG_PEEK | socket.MSG_WAITALL)
            self.assertEqual(len(head), size, head)
            size += 1
        return stream, int(head.split()[1]), re.search(rb"Retry-After: (\d+)", head)

    def read_memory(self):
        """Bytes of acsd that are resident."""
        status = pathlib.Path(f"/proc/{self.acsd.process.pid}/status").read_text()
        return 1024 * int(re.search(r"VmRSS:\s+(\d+) kB", status)[1])

    def change_the_queue(self):
        """The last plan of the queue becomes the second, and the last again, so that all of them change, until more was changed
        than acsd keeps. A plan that is started meanwhile is left to the robot."""
        produced, numbers = 0, list(range(1, WAITING_PLANS + 1))
        for priority in itertools.cycle((QUEUE_PRIORITY + 1, QUEUE_PRIORITY)):
            plan_id = f"Q{numbers[-1]}"
            status, answer = operator_api.post(self.address, f"/v1/plans/{plan_id}/priority", {"priority": priority})
            if status == 409:
                numbers.pop()
                continue
            self.assertEqual(status, 202, answer)
            plans = []
            while not any(plan["planId"] == plan_id and plan["priority"] == priority for plan in plans):
                plans = self.read_json("/v1/snapshot")["plans"]
            produced += len(json.dumps([plan for plan in plans if plan["planId"].startswith("Q")]))
            if produced > 2 * KEPT_BYTES:
                return

    def test_a_hundred_event_streams_that_do_not_read(self):
        self.start_line()
        first_event = self.read_json("/v1/snapshot")["eventId"]
        self.submit(make_carrying_plan("P1"))
        memory = self.read_memory()
        streams = [self.open_stream() for _ in range(STREAMS)]
        statuses = [status for _, status, _ in streams]
        self.assertEqual(statuses, [200] * MOST_STREAMS + [503] * (STREAMS - MOST_STREAMS))
        for _, status, retry in streams:
            self.assertEqual(retry is not None, status == 503)

        for plan_id in ("P2", *(f"Q{number + 1}" for number in range(WAITING_PLANS))):
            priority = QUEUE_PRIORITY + (2 if plan_id == "P2" else 0)
            self.submit(make_carrying_plan(plan_id) | {"priority": priority})
        self.change_the_queue()
        for path in ("/v1/status", "/v1/snapshot", "/v1/site", "/v1/plans"):
            self.read_json(path)
        for plan in ("P1", "P2"):
            self.wait_for_plan(plan, "Completed")
        if (self.line.bin_dir / "libscenario_held_disk.so").exists():  # a sanitizer, which has no such library, keeps freed memory
            self.assertLess(self.read_memory() - memory, MOST_GROWTH)

        # The events from before are dropped, also for those who read. A stream that has ended makes room for another.
        streams[0][0].close()
        self.wait_until(lambda: self.has_reset(first_event), "no stream is accepted")

    def has_reset(self, first_event):
        """False: there is no room for a stream."""
        reader = EventReader(self.address, first_event)
        if reader.status == 200:
            reader.wait_for(lambda event: event[0] == "reset", STATUS_SECONDS)
        reader.close()
        return reader.status == 200


class Clients(ScenarioCase):
    """Of an acsd with tokens and without robots."""

    def setUp(self):
        super().setUp()
        self.line.start_broker()
        self.kim, self.lee, self.viewer = (self.make_token(role, name) for role, name in (
            ("operator", "kim"), ("operator", "lee"), ("viewer", "grafana")))
        self.start_acsd()

    def start_acsd(self):
        self.acsd = self.line.start_acsd("127.0.0.1:1", {"stream": "127.0.0.1:1"},
                                         f"operator.tokens_file={self.line.folder / 'tokens'}")
        self.address = self.acsd.wait_ready()["operator"]

    def request(self, method, path, headers, body=None):
        """(status, headers, text). The text of a stream is not read."""
        connection = http.client.HTTPConnection(self.address, timeout=STATUS_SECONDS)
        connection.request(method, path, None if body is None else json.dumps(body), headers)
        response = connection.getresponse()
        is_stream = response.getheader("Content-Type") == "text/event-stream"
        text = "" if is_stream else response.read().decode()
        connection.close()
        return response.status, response.headers, text

    @staticmethod
    def show(token, **headers):
        return {"Authorization": f"Bearer {token}"} | {name.replace("_", "-"): value for name, value in headers.items()}

    def read(self, path):
        status, _, text = self.request("GET", path, self.show(self.viewer))
        self.assertEqual(status, 200, text)
        return json.loads(text)

    def list_blocked(self):
        return [block["id"] for block in self.read("/v1/site")["blocked"]]

    def wait_for_blocked(self, *nodes):
        """A command has its effect when the store has it."""
        self.wait_until(lambda: self.list_blocked() == list(nodes), f"{nodes} are not blocked")

    def test_a_page_of_a_foreign_origin_changes_nothing_and_reads_nothing(self):
        status, headers, _ = self.request("POST", "/v1/login", {}, {"token": self.kim})
        self.assertEqual(status, 204)
        session = {"Cookie": headers["Set-Cookie"].split(";")[0]}
        own = f"http://{self.address}"
        host, port = self.address.rsplit(":", 1)
        others = ({}, {"Origin": FOREIGN}, {"Origin": "null"}, {"Origin": ""}, {"Origin": f"http://{host}:{int(port) - 1}"},
                  {"Origin": f"{own}.evil.example"}, {"Origin": own, "Sec-Fetch-Site": "cross-site"})
        for other in others:
            for path in ("/v1/tsc/pause", "/v1/logout"):
                self.assertEqual(self.request("POST", path, session | other)[0], 403, (path, other))
        for other in ({"Origin": FOREIGN}, {"Origin": "null"}):  # no foreign page logs its visitor in
            self.assertEqual(self.request("POST", "/v1/login", other, {"token": self.kim})[0], 403, other)

        foreign = session | {"Origin": FOREIGN}
        asked = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "content-type, authorization"}
        for method, path, expected in (("OPTIONS", "/v1/tsc/pause", 403), ("OPTIONS", "/v1/login", 403), ("GET", "/v1/status", 200),
                                       ("GET", "/v1/snapshot", 200), ("GET", "/v1/site", 200), ("GET", "/v1/audit", 200),
                                       ("GET", "/v1/events", 200)):
            for site, answered in (("same-site", expected), ("cross-site", 403)):
                status, headers, _ = self.request(method, path, foreign | (asked if method == "OPTIONS" else {})
                                                  | {"Sec-Fetch-Site": site})
                self.assertEqual(status, answered, (path, site))
                self.assertEqual([name for name in headers if name.lower().startswith("access-control-")], [], path)

        self.assertEqual(self.read("/v1/status")["tsc"], "Auto")
        self.assertEqual(self.request("POST", "/v1/tsc/pause", session | {"Origin": own})[0], 202)

    def test_a_proof_that_is_none(self):
        cookie = f"acs_session_{self.address.rsplit(':', 1)[1]}"
        rows = (("Authorization", ""), ("Authorization", "Bearer"), ("Authorization", "Bearer "), ("Authorization", self.kim),
                ("Authorization", f"Basic {self.kim}"), ("Authorization", f"Bearer {self.kim}x"),
                ("Authorization", f"Bearer {self.kim[:-1]}"), ("Authorization", f"Bearer {self.kim.swapcase()}"),
                ("Authorization", "Bearer " + "x" * 4000), ("Cookie", f"{cookie}={self.kim}"), ("Cookie", f"{cookie}="))
        for name, value in rows:
            with self.subTest(name, value=value):
                for method, path in (("GET", "/v1/status"), ("GET", "/v1/events"), ("POST", "/v1/tsc/pause")):
                    own = {"Origin": f"http://{self.address}"} if method == "POST" else {}
                    status, headers, text = self.request(method, path, {name: value} | own)
                    self.assertEqual(status, 401, text)
                    self.assertNotIn("Set-Cookie", headers)
        for method, path, body in (("POST", "/v1/tsc/pause", None), ("POST", "/v1/site/block", {"kind": "node", "id": NODES[0]})):
            status, _, text = self.request(method, path, self.show(self.viewer), body)
            self.assertEqual(status, 403, text)
            self.assertIn("may not send commands", text)
        self.assertEqual(self.read("/v1/status")["tsc"], "Auto")
        self.assertEqual(self.list_blocked(), [])

    def test_an_id_that_is_none(self):
        ids = ("GHOST", "%00", "%ff", "..", "%2e%2e%2f%2e%2e", "a%2fb", "%25", "%F0%9F%A4%96", "x" * 2000, "%3Cscript%3E", "P1%0aP2")
        paths = ("/v1/plans/{}", "/v1/robots/{}"), ("/v1/plans/{}/cancel", "/v1/plans/{}/steps/1/skip", "/v1/plans/P1/jobs/{}/resolve",
                                                   "/v1/robots/{}/maintenance")
        bodies = {"resolve": {"outcome": "done"}, "maintenance": {"on": True}}
        for name in ids:
            for method, group in zip(("GET", "POST"), paths):
                for path in group:
                    with self.subTest(path, id=name):
                        status, _, text = self.request(method, path.format(name), self.show(self.kim),
                                                       bodies.get(path.rsplit("/", 1)[1]))
                        self.assertIn(status, (400, 404), text)
                        self.assertTrue(text)
        for body in ({"kind": "node", "id": "GHOST"}, {"kind": "node", "id": ""}, {"kind": "ghost", "id": NODES[0]}):
            self.assertIn(self.request("POST", "/v1/site/block", self.show(self.kim), body)[0], (400, 404), body)
        self.assertEqual(self.list_blocked(), [])

    def test_a_repeated_idempotency_key(self):
        def block(token, node, key="7f3a-1"):
            status, headers, text = self.request("POST", "/v1/site/block", self.show(token, Idempotency_Key=key),
                                                 {"kind": "node", "id": node})
            return status, headers["Idempotent-Replay"], text

        # The same request is answered as before: executed again it would be refused, because the node is blocked.
        first = block(self.kim, NODES[0])
        self.assertEqual(first[:2], (202, None))
        self.wait_for_blocked(NODES[0])
        self.assertEqual(block(self.kim, NODES[0]), (202, "true", first[2]))
        self.assertEqual(block(self.kim, NODES[0], "7f3a-2")[:2], (409, None))

        # Another body is not executed. Another operator has keys of his own, and an unknown one has no answer of them.
        self.assertEqual(block(self.kim, NODES[1])[:2], (409, None))
        self.assertEqual(block(self.viewer, NODES[0])[:2], (403, None))
        self.assertEqual(block("guess", NODES[0])[:2], (401, None))
        self.assertEqual(self.list_blocked(), [NODES[0]])
        self.assertEqual(block(self.lee, NODES[1])[:2], (202, None))
        self.wait_for_blocked(*NODES)

        self.line.forget(self.acsd)
        self.assertEqual(self.acsd.stop(), 0)
        self.start_acsd()
        self.assertEqual(block(self.kim, NODES[0]), (202, "true", first[2]))
        self.assertEqual(block(self.kim, NODES[1])[:2], (409, None))
        audited = [line for line in self.request("GET", "/v1/audit", self.show(self.viewer))[2].splitlines()
                   if json.loads(line).get("replay")]
        self.assertEqual(len(audited), 2)


if __name__ == "__main__":
    main()
