#!/usr/bin/env python3
"""Serves the live page from its source folder and a simulated /v1 with moving robots, plans, alarms and events: for work on the
page, for its tests (which call the methods of MockAcsd), and as the load of its performance test."""

import argparse
import contextlib
import http.server
import json
import queue
import socketserver
import threading
import urllib.parse
from collections import deque

from mock_files import CONTENT_TYPES, POLICY, find_page_file
from mock_floor import OFFERED_ACTIONS, Floor, Simulation, format_time, get_now

TICK_SECONDS = 0.2
KEEP_ALIVE_SECONDS = 15.0
KEPT_EVENTS = 4096
BROKER = "mqtt://broker-1.example:1883"
COOKIE = "acsd_session"


class Refusal(Exception):
    def __init__(self, status, sentence):
        super().__init__(sentence)
        self.status = status


class MockAcsd:
    """One mock on a free port (or `port`), with threads of its own. `lock` protects all of it."""

    def __init__(self, floor=None, robots=8, port=0, token=None, is_traced=True, seed=1, has_traffic=True):
        self.lock = threading.RLock()
        self.simulation = Simulation(floor or Floor.read_example(), robots, seed, has_traffic)
        self.posts = []  # (path, body, idempotencyKey)
        self.token = token  # with one, every request needs it
        self.role = "operator"
        self.is_traced = is_traced
        self.is_silent = False  # neither events nor keep-alives, and no answer to a request for them
        self.is_down = False  # closes every connection
        self.answer_post = None  # of mock_answers; sends it in place of each answer to a command
        self.standby = None  # why it does not lead; all but the page is then answered with it
        self.tsc = "Auto"
        self.links = [{"name": name, "up": True, "reason": None, "since": format_time(get_now()), "broker": broker}
                      for name, broker in (("mcs", None), ("mqtt", BROKER))]
        self.not_ready = []
        self.refused = {"count": 0, "last": None}
        self.outbox = {"reports": 0, "oldest": None}
        self.site_revision = 1
        self.started_at = get_now()
        self._event_id = 0
        self._events = deque(maxlen=KEPT_EVENTS)
        self._clients = []
        self._answers = {}
        self._stopped = threading.Event()
        self._is_frozen = False
        self._sent_status = None
        self._server = Server(("127.0.0.1", port), self)
        self.address = f"127.0.0.1:{self._server.server_address[1]}"
        self._threads = [threading.Thread(target=self._server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True),
                         threading.Thread(target=self._run, daemon=True)]

    def make_links(self):
        return [{**link, "broker": link["broker"] if link["up"] else None} for link in self.links]

    def __enter__(self):
        for thread in self._threads:
            thread.start()
        return self

    def __exit__(self, *_):
        self._stopped.set()
        self._server.shutdown()
        self._server.server_close()
        self.drop_clients()

    def _run(self):
        while not self._stopped.wait(TICK_SECONDS):
            with self.lock:
                if not self._is_frozen:
                    self.simulation.advance(TICK_SECONDS)
                self.publish()

    def is_stopped(self, seconds):
        """Within this time."""
        return self._stopped.wait(seconds)

    def freeze(self):
        """Robots and plans change no more by themselves."""
        with self.lock:
            self._is_frozen = True

    def publish(self):
        """Sends what has changed as events."""
        with self.lock:
            simulation = self.simulation
            data = {}
            status = self.describe_status()
            del status["uptimeSeconds"]
            if status != self._sent_status:
                data["status"] = self._sent_status = status
            plans = [simulation.plans[plan_id].describe() for plan_id in sorted(simulation.changed_plans)
                     if plan_id in simulation.plans]
            if plans:
                data["plans"] = plans
            if simulation.ended_plans:
                data["ended"] = [plan.describe() for plan in simulation.ended_plans]
            if simulation.changed_robots:
                data["robots"] = [simulation.robots[robot_id].describe() for robot_id in sorted(simulation.changed_robots)]
            if simulation.has_changed_alarms:
                data["alarms"] = simulation.alarms
            if data:
                self._send("changes", data)
            for kind, robot_id, plan_id, step_no, job_id, text in simulation.entries:
                self._send("entry", {"time": format_time(get_now()), "kind": kind, "robotId": robot_id, "planId": plan_id,
                                     "stepNo": step_no, "jobId": job_id, "text": text})
            simulation.changed_plans.clear()
            simulation.changed_robots.clear()
            simulation.ended_plans.clear()
            simulation.entries.clear()
            simulation.has_changed_alarms = False

    def _send(self, kind, data):
        self._event_id += 1
        event = (self._event_id, f"event: {kind}\nid: {self._event_id}\ndata: {json.dumps(data)}\n\n".encode())
        self._events.append(event)
        if not self.is_silent:
            for client in self._clients:
                client.put(event[1])

    def send_reset(self):
        with self.lock:
            for client in self._clients:
                client.put(b"event: reset\ndata: {}\n\n")

    def drop_clients(self):
        """Closes the event streams."""
        with self.lock:
            for client in self._clients:
                client.put(None)

    def attach(self, after):
        """A queue of the events after this one."""
        with self.lock:
            client = queue.Queue()
            oldest = self._events[0][0] if self._events else 1
            if after is not None and (after > self._event_id or after + 1 < oldest):
                client.put(b"event: reset\ndata: {}\n\n")
            elif after is not None:
                for event_id, text in self._events:
                    if event_id > after:
                        client.put(text)
            self._clients.append(client)
            return client

    def detach(self, client):
        with self.lock, contextlib.suppress(ValueError):
            self._clients.remove(client)

    def describe_status(self):
        simulation = self.simulation
        by_status = {}
        for robot in simulation.robots.values():
            by_status[robot.status] = by_status.get(robot.status, 0) + 1
        heavy = sum(alarm["level"] == "heavy" for alarm in simulation.alarms)
        reasons = self.not_ready + [f"link {link['name']} is down: {link['reason']}" for link in self.links if not link["up"]]
        return {
            "version": "0.1.0", "startedAt": format_time(self.started_at),
            "uptimeSeconds": round((get_now() - self.started_at).total_seconds()), "ready": not reasons,
            "notReadyReasons": reasons, "isConnected": self.links[1]["up"], "links": self.make_links(),
            "tsc": self.tsc, "tscReason": None, "outbox": dict(self.outbox), "refusedReports": dict(self.refused),
            "plans": {"active": sum(plan.robot_id is not None for plan in simulation.plans.values()),
                      "waiting": sum(plan.robot_id is None for plan in simulation.plans.values())},
            "robots": {"total": len(simulation.robots), "byStatus": by_status},
            "alarms": {"heavy": heavy, "light": len(simulation.alarms) - heavy}, "siteRevision": self.site_revision}

    # GET

    def get(self, path, query):
        with self.lock:
            simulation = self.simulation
            parts = path.split("/")[2:]
            if parts == ["status"]:
                return self.describe_status()
            if parts == ["snapshot"]:
                return {"eventId": self._event_id, "status": self.describe_status(),
                        "plans": [plan.describe() for plan in simulation.plans.values()],
                        "robots": [robot.describe() for robot in simulation.robots.values()], "alarms": simulation.alarms}
            if parts == ["plans"]:
                plans = simulation.finished if query.get("state") == "finished" else simulation.plans.values()
                return {"plans": [plan.describe() for plan in list(plans)[:int(query.get("limit", 100))]]}
            if parts[0] == "plans" and len(parts) == 2:
                return self.find_plan(parts[1]).describe(is_detailed=True)
            if parts == ["robots"]:
                return {"robots": [robot.describe() for robot in simulation.robots.values()]}
            if parts[0] == "robots" and parts[2:] == ["actions"]:
                return {"actions": self.find_robot(parts[1]).actions, "offered": OFFERED_ACTIONS}
            if parts == ["alarms"]:
                return {"alarms": simulation.alarms}
            if parts == ["links"]:
                return {"links": self.make_links()}
            if parts == ["site"]:
                return simulation.floor.describe()
            if parts == ["trace"]:
                return self.make_trace(query)
            raise Refusal(404, f"Unknown path {path}.")

    def find_plan(self, plan_id):
        plan = self.simulation.plans.get(plan_id) or next(
            (plan for plan in self.simulation.finished if plan.plan_id == plan_id), None)
        if plan is None:
            raise Refusal(404, f"Unknown plan {plan_id}.")
        return plan

    def find_robot(self, robot_id):
        robot = self.simulation.robots.get(robot_id)
        if robot is None:
            raise Refusal(404, f"Unknown robot {robot_id}.")
        return robot

    def make_trace(self, query):
        if not self.is_traced:
            raise Refusal(404, "acsd runs without --trace.")
        lines = []
        robot_id, plan_id = query.get("robot"), query.get("plan")
        if plan_id:
            for direction, command in (("in", "PlanCommand"), ("out", "PlanCommandAck"), ("out", "PlanReport"),
                                       ("in", "PlanReportAck")):
                text = json.dumps({"command": command, "transactionId": "7f3c", "payload": {"planId": plan_id}})
                lines.append({"link": "mcs", "direction": direction, "text": text})
        if robot_id:
            robot = self.simulation.robots[robot_id]
            for direction, topic in (("out", "order"), ("in", "state"), ("in", "visualization"), ("in", "state")):
                text = json.dumps({"headerId": 812, "version": "2.0.0", "manufacturer": "ACME", "serialNumber": robot_id,
                                   "lastNodeId": robot.node, "driving": robot.status == "Moving"})
                lines.append({"link": "mqtt", "direction": direction, "robot": robot_id, "text": text,
                              "topic": f"uagv/v2/ACME/{robot_id}/{topic}"})
        return "".join(json.dumps({"time": format_time(get_now()), "mono_us": i, **line}) + "\n" for i, line in enumerate(lines))

    # POST

    def post(self, path, body, key):
        """(answer, whether it is that to an earlier request with the key)"""
        with self.lock:
            if self.role != "operator":
                raise Refusal(403, "The role viewer may only read.")
            self.posts.append((path, body, key))
            if key in self._answers:
                return self._answers[key], True
            answer = self.execute(path.split("/")[2:], body or {})
            answer = {"message": answer} if isinstance(answer, str) else answer
            if key is not None:
                self._answers[key] = answer
            self.publish()
            return answer, False

    def execute(self, parts, body):
        simulation = self.simulation
        if parts[0] == "plans":
            return self.control_plan(self.find_plan(parts[1]), parts[2:], body)
        if parts[0] == "robots" and parts[2] == "actions":
            return self.request_action(self.find_robot(parts[1]), body)
        if parts[0] == "robots" and parts[2] == "maintenance":
            robot = self.find_robot(parts[1])
            robot.is_in_maintenance = body["on"]
            simulation.changed_robots.add(robot.robot_id)
            return f"Maintenance of {robot.robot_id} is {'on' if body['on'] else 'off'}."
        if parts[0] == "robots" and parts[2] == "carriers":
            robot = self.find_robot(parts[1])
            robot.carrier_ids = body["carrierIds"]
            simulation.changed_robots.add(robot.robot_id)
            return f"The ports of {robot.robot_id} are corrected."
        if parts == ["alarms", "clear"]:
            if not simulation.clear_alarms(body["robotId"], body["errorCode"]):
                raise Refusal(404, f"{body['robotId']} has no alarm {body['errorCode']}.")
            return f"Alarm {body['errorCode']} of {body['robotId']} is cleared."
        if parts[0] == "tsc":
            self.tsc = "Paused" if parts[1] == "pause" else "Auto"
            return f"The TSC is {self.tsc}."
        if parts[0] == "site":
            place = (body["kind"], body["id"])
            if parts[1] == "block":
                simulation.floor.blocks[place] = {"kind": body["kind"], "id": body["id"], "reason": body.get("reason", ""),
                                                  "since": format_time(get_now())}
            else:
                simulation.floor.blocks.pop(place, None)
            self.site_revision += 1
            return f"The {body['kind']} {body['id']} is {'blocked' if parts[1] == 'block' else 'open'}."
        raise Refusal(404, "Unknown path.")

    def request_action(self, robot, body):
        action_type = body["actionType"]
        if all(offer["actionType"] != action_type for offer in OFFERED_ACTIONS):
            raise Refusal(400, f"{robot.robot_id} does not offer {action_type}.")
        action_id = f"acs-{action_type}-{len(robot.actions) + 1}"
        robot.actions.append({
            "actionId": action_id, "actionType": action_type, "parameters": body.get("parameters", {}),
            "reason": body.get("reason", ""), "requestedAt": format_time(get_now()), "status": "Waiting", "resultDescription": "",
            "endedAt": None})
        self.simulation.note("action", f"{action_type} requested", robot)
        return {"message": f"{action_type} is sent to {robot.robot_id}.", "actionId": action_id}

    def end_action(self, robot_id, status, result):
        """The last action of the robot."""
        with self.lock:
            robot = self.simulation.robots[robot_id]
            robot.actions[-1].update(status=status, resultDescription=result, endedAt=format_time(get_now()))
            self.simulation.note("action", f"{robot.actions[-1]['actionType']} {status}", robot)
            self.publish()

    def control_plan(self, plan, parts, body):
        simulation = self.simulation
        if plan.ended_at is not None:
            raise Refusal(409, f"Plan {plan.plan_id} is {plan.status}.")
        if parts[0] in ("pause", "resume"):
            is_pause = parts[0] == "pause"
            plan.status = "Paused" if is_pause else "InProgress" if plan.robot_id else "Pending"
            plan.waits = simulation.make_wait("The plan is paused.") if is_pause else None
        elif parts[0] in ("cancel", "abort"):
            simulation.end_plan(plan, "Cancelled" if parts[0] == "cancel" else "Aborted", body.get("reason", ""))
        elif parts[0] == "priority":
            if plan.robot_id is not None:
                raise Refusal(409, f"Plan {plan.plan_id} does not wait.")
            plan.priority = body["priority"]
        elif parts[0] == "jobs":
            simulation.clear_alarms(plan.robot_id, "ACS-1008")
            plan.job_status[plan.step_no - 1], plan.waits = "InProgress", None
            simulation.robots[plan.robot_id].is_fixed = False
        elif parts[0] == "steps":
            plan.steps[int(parts[1]) - 1]["status"] = "Skipped"
        simulation.changed_plans.add(plan.plan_id)
        return f"{parts[0].capitalize()} of plan {plan.plan_id} accepted."


class Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
    daemon_threads = True
    request_queue_size = 64

    def __init__(self, address, mock):
        self.mock = mock
        super().__init__(address, Handler)

    def handle_error(self, request, client_address):
        """A browser that closes a connection is no error."""


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        """Nothing."""

    def do_GET(self):
        mock, url = self.server.mock, urllib.parse.urlsplit(self.path)
        if mock.is_down:
            self.close_connection = True
            return
        if not url.path.startswith("/v1/"):
            self.send_page(url.path)
            return
        query = dict(urllib.parse.parse_qsl(url.query))
        try:
            if mock.standby is not None:
                raise Refusal(503, mock.standby)
            self.check_access()
            if url.path == "/v1/events":
                self.send_events(query)
                return
            answer = mock.get(urllib.parse.unquote(url.path), query)
        except Refusal as refusal:
            self.send_json(refusal.status, {"error": str(refusal)})
            return
        if isinstance(answer, str):
            self.send_bytes(200, "application/x-ndjson", answer.encode())
        else:
            self.send_json(200, answer)

    def do_POST(self):
        mock = self.server.mock
        length = int(self.headers.get("Content-Length") or 0)
        body = json.loads(self.rfile.read(length)) if length else None
        try:
            if self.path == "/v1/login":
                if body["token"] != mock.token:
                    raise Refusal(401, "Unknown token.")
                self.send_bytes(204, None, b"", {"Set-Cookie": f"{COOKIE}={mock.token}; HttpOnly; SameSite=Strict; Path=/"})
                return
            if self.path == "/v1/logout":
                self.send_bytes(204, None, b"", {"Set-Cookie": f"{COOKIE}=; Max-Age=0; Path=/"})
                return
            self.check_access()
            answer, is_replay = mock.post(urllib.parse.unquote(self.path), body, self.headers.get("Idempotency-Key"))
        except Refusal as refusal:
            self.send_json(refusal.status, {"error": str(refusal)})
            return
        if mock.answer_post is not None:
            mock.answer_post(self)
            return
        self.send_json(202, answer, {"Idempotent-Replay": "true"} if is_replay else {})

    def check_access(self):
        token = self.server.mock.token
        if token is not None and f"{COOKIE}={token}" not in (self.headers.get("Cookie") or ""):
            raise Refusal(401, "A token is required.")

    def send_page(self, path):
        name = "index.html" if path == "/" else path.removeprefix("/page/")
        file = find_page_file(name)
        if file is None or not (path == "/" or path.startswith("/page/")):
            self.send_json(404, {"error": f"Unknown path {path}."})
            return
        self.send_bytes(200, CONTENT_TYPES[file.suffix if file.suffix else ".txt"], file.read_bytes(),
                        {"Content-Security-Policy": POLICY, "Cache-Control": "no-cache", "X-Content-Type-Options": "nosniff"})

    def send_json(self, status, value, headers=None):
        self.send_bytes(status, "application/json", json.dumps(value).encode(), headers)

    def send_bytes(self, status, content_type, body, headers=None):
        self.send_response(status)
        if content_type is not None:
            self.send_header("Content-Type", content_type)
        if status != 204:
            self.send_header("Content-Length", str(len(body)))
        for name, value in (headers or {}).items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def send_events(self, query):
        mock = self.server.mock
        while mock.is_silent and not mock.is_stopped(0.1):
            pass
        after = query.get("after", self.headers.get("Last-Event-ID"))
        client = mock.attach(None if after is None else int(after))
        try:
            self.send_response(200)
            self.send_header("Content-Type", "text/event-stream")
            self.send_header("Cache-Control", "no-store")
            self.send_header("Connection", "close")
            self.end_headers()
            self.close_connection = True
            self.write_events(client)
        except OSError:
            pass
        finally:
            mock.detach(client)

    def write_events(self, client):
        while True:
            try:
                text = client.get(timeout=KEEP_ALIVE_SECONDS)
            except queue.Empty:
                text = b"" if self.server.mock.is_silent else b": keep-alive\n\n"
            if text is None:
                return
            self.wfile.write(text)
            self.wfile.flush()


def main():
    parser = argparse.ArgumentParser(description="Serves the live page of acsd with simulated data.")
    parser.add_argument("--port", type=int, default=8081, help="port (default 8081; 0 selects a free one)")
    parser.add_argument("--robots", type=int, default=8, metavar="N", help="number of robots (default 8)")
    parser.add_argument("--nodes", type=int, metavar="N", help="a grid of about N nodes (default: the example site)")
    parser.add_argument("--token", help="demand this token")
    parser.add_argument("--role", choices=("operator", "viewer"), default="operator", help="role of every client")
    parser.add_argument("--troubles", action="store_true", help="with alarms, an unresolved job, blocks and a lost link")
    arguments = parser.parse_args()
    with MockAcsd(Floor.make_grid(arguments.nodes) if arguments.nodes else None, arguments.robots, arguments.port,
                  arguments.token, has_traffic=not arguments.nodes) as mock:
        mock.role = arguments.role
        if arguments.troubles:
            from mock_troubles import add_troubles
            add_troubles(mock)
        print(f"http://{mock.address}/", flush=True)
        with contextlib.suppress(KeyboardInterrupt):
            threading.Event().wait()


if __name__ == "__main__":
    main()
