#!/usr/bin/env python3
"""The mock of the live page answers as the description of the operator API states: what its tests show is then what acsd sends."""

import json
import pathlib
import sys
import unittest
import urllib.error
import urllib.request

from mock_acsd import MockAcsd
from mock_troubles import add_troubles

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenario"))
from api_description import load_description  # noqa: E402

TIME_LIMIT = 30  # seconds


class Mock(unittest.TestCase):
    def setUp(self):
        self.description = load_description()
        self.mock = self.enterContext(MockAcsd())
        add_troubles(self.mock)
        self.mock.freeze()

    def ask(self, path, body=None):
        """The answer, which must be as described."""
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(f"http://{self.mock.address}{path}", data, {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=TIME_LIMIT) as response:
                status, headers, text = response.status, response.headers, response.read().decode()
        except urllib.error.HTTPError as error:
            status, headers, text = error.code, error.headers, error.read().decode()
        method = "GET" if body is None else "POST"
        self.assertEqual(self.description.find_answer_errors(method, path, status, headers, text), [])
        return status, text

    def read(self, path):
        status, text = self.ask(path)
        self.assertEqual(status, 200, path)
        return json.loads(text)

    def test_answers(self):
        snapshot = self.read("/v1/snapshot")
        self.assertEqual({alarm["level"] for alarm in snapshot["alarms"]}, {"heavy", "light"})
        for path in ("/v1/status", "/v1/robots", "/v1/alarms", "/v1/links", "/v1/site", "/v1/plans", "/v1/plans?state=finished",
                     "/v1/robots/LR01/actions",
                     *(f"/v1/plans/{plan['planId']}" for plan in snapshot["plans"])):
            self.read(path)

    def test_messages(self):
        for query in ("robot=LR01", "plan=P1"):
            self.assertEqual(self.ask(f"/v1/trace?{query}")[0], 200)
        self.mock.is_traced = False
        self.assertEqual(self.ask("/v1/trace?robot=LR01")[0], 404)

    def test_a_completed_plan(self):
        with self.mock.lock:
            plan = next(plan for plan in self.mock.simulation.plans.values() if plan.robot_id is not None)
            self.mock.simulation.end_plan(plan, "Completed")
        answer = self.read(f"/v1/plans/{plan.plan_id}")
        self.assertEqual((answer["stepNo"], answer["jobId"], answer["currentAction"]), (0, None, None))

    def test_events(self):
        with urllib.request.urlopen(f"http://{self.mock.address}/v1/events?after=0", timeout=TIME_LIMIT) as feed:
            with self.mock.lock:
                self.mock.tsc = "Paused"
                self.mock.simulation.note("note", "the last event")
                self.mock.publish()
            event, kinds = None, set()
            for line in feed:
                if line.startswith(b"event: "):
                    event = line[7:].strip().decode()
                elif line.startswith(b"data: "):
                    data = json.loads(line[6:])
                    self.assertEqual(self.description.find_event_errors("/v1/events", event, data), [])
                    kinds.add(event)
                    if data.get("text") == "the last event":
                        break
        self.assertEqual(kinds, {"changes", "entry"})

    def test_commands(self):
        plan = next(iter(self.mock.simulation.plans))
        for path, body in ((f"/v1/plans/{plan}/pause", {}), ("/v1/robots/LR01/maintenance", {"on": True}),
                           ("/v1/robots/LR01/actions", {"actionType": "stateRequest"}), ("/v1/site/block", {"kind": "node", "id": "N020"}), ("/v1/tsc/pause", {})):
            self.assertEqual(self.ask(path, body)[0], 202, path)
        self.assertEqual(self.ask("/v1/plans/none/pause", {})[0], 404)


if __name__ == "__main__":
    unittest.main()
