"""An acsd that only has the operator API /v1: fixed state, recorded commands, and the errors that a client must survive."""

import http.server
import json
import socket
import struct
import threading
import urllib.parse

NOW = "2026-11-27T23:10:00.000Z"
WAITS = {"message": "No suitable robot is free.", "since": "2026-11-27T23:05:00.000Z", "queuePosition": 1,
         "robots": [{"robotId": "LR01", "reason": "busy with plan PLAN_1"},
                    {"robotId": "LR02", "reason": "in maintenance"}]}
STEPS = [{"stepNo": 1, "action": "LOAD", "position": "A01", "status": "Completed"},
         {"stepNo": 2, "action": "UNLOAD", "position": "B02", "status": "InProgress"}]


def make_plan(plan_id, status, robot_id=None, waits=None, **members):
    return {"planId": plan_id, "lotId": "LOT_7", "priority": 5, "status": status, "robotId": robot_id, "stepNo": 2,
            "jobId": None, "currentAction": None, "acceptedAt": "2026-11-27T23:00:00.000Z", "startedAt": None,
            "endedAt": None, "message": "", "waits": waits, "steps": STEPS, **members}


def make_robot(robot_id, status, **members):
    return {"robotId": robot_id, "type": "LR", "driver": "vda5050", "status": status, "position": "A01", "node": "N1",
            "nextNode": None, "pose": {"x": 1.0, "y": 2.5, "theta": 0.0}, "battery": 80, "planId": None, "stepNo": None,
            "jobId": None, "route": [], "reservedNodes": ["N1"], "carrierIds": ["C_01"], "ports": [f"{robot_id}.CP01"],
            "maintenance": False, "reason": None, "armUp": None, "topic": "uagv/v2/ACME/0001", "protocolVersion": "2.0.0",
            "mode": "AUTOMATIC", "errors": [], "warnings": [], "lastMessageAt": NOW, **members}


PLANS = [make_plan("PLAN_1", "InProgress", "LR01"), make_plan("PLAN_2", "Pending", waits=WAITS)]
ROBOTS = [make_robot("LR01", "Moving", planId="PLAN_1", nextNode="N2", route=[{"nodeId": "N2", "reserved": True},
                                                                             {"nodeId": "N3", "reserved": False}]),
          make_robot("LR02", "Stopped", maintenance=True, reason="In maintenance.")]
ALARMS = [{"robotId": "LR02", "errorCode": "ACS-1002", "level": "heavy", "message": "no state for 10 s",
           "since": "2026-11-27T23:09:00.000Z", "title": "Robot disconnected", "cause": "The network is down.",
           "remedy": "Check the robot.", "planId": None, "stepNo": None, "jobId": None}]
LINKS = [{"name": "mcs", "up": True, "reason": None, "since": "2026-11-27T20:10:00.000Z", "broker": None},
         {"name": "mqtt", "up": False, "reason": "connection refused", "since": "2026-11-27T23:09:57.000Z",
          "broker": None}]
STATUS = {"version": "0.1.0", "startedAt": "2026-11-27T20:00:00.000Z", "uptimeSeconds": 11400, "ready": False,
          "notReadyReasons": ["The MQTT broker is not connected."], "isConnected": False, "links": LINKS, "tsc": "Paused",
          "tscReason": "Paused by kim.", "outbox": {"reports": 3, "oldest": "2026-11-27T23:09:50.000Z"},
          "refusedReports": {"count": 1, "last": {"command": "PlanReport", "planId": "PLAN_1", "message": "unknown plan",
                                                  "retried": False}},
          "plans": {"active": 1, "waiting": 1}, "robots": {"total": 2, "byStatus": {"Moving": 1, "Stopped": 1}},
          "alarms": {"heavy": 1, "light": 0}, "siteRevision": 1}
SITE = {"nodes": [{"nodeId": "N1", "x": 0, "y": 0, "mapId": "M"}, {"nodeId": "N2", "x": 1, "y": 0, "mapId": "M"}],
        "edges": [{"edgeId": "E1", "startNodeId": "N1", "endNodeId": "N2", "trajectory": None}],
        "stations": [{"stationId": "B02", "nodeIds": ["N2"]}],
        "blocked": [{"kind": "edge", "id": "E1", "reason": "wet floor", "since": NOW}]}
TRACE = [{"time": NOW, "mono_us": 1, "link": "mcs", "direction": "in",
          "text": json.dumps({"command": "ExecutionPlan", "transactionId": "T", "payload": {"planId": "PLAN_1"}})},
         {"time": NOW, "mono_us": 2, "link": "mqtt", "direction": "out", "robot": "LR01", "topic": "uagv/v2/ACME/1/order",
          "text": json.dumps({"orderId": "O1", "orderUpdateId": 0})},
         {"time": NOW, "mono_us": 3, "link": "trace", "lost": 4}]
AUDIT = [{"time": NOW, "peer": "127.0.0.1:5", "proof": "token", "name": "kim", "role": "operator", "method": "POST",
          "request": "/v1/tsc/pause", "status": 202, "answer": {"message": "The TSC is paused."}}]
ENTRIES = [{"time": NOW, "kind": "plan", "robotId": "LR01", "planId": "PLAN_1", "stepNo": None, "jobId": None,
            "text": "plan PLAN_1: Pending -> InProgress on LR01"},
           {"time": NOW, "kind": "alarm", "robotId": "LR02", "planId": None, "stepNo": None, "jobId": None,
            "text": "alarm ACS-1002 of LR02 is set"}]


OFFERED = [{"actionType": "initPosition", "description": "sets the pose", "parameters": [
               {"key": "x", "valueType": "NUMBER", "required": True}, {"key": "mapId", "valueType": "STRING", "required": True},
               {"key": "note", "valueType": "OBJECT", "required": False}]},
           {"actionType": "stateRequest", "description": "", "parameters": []}]


def make_lines(objects):
    return "".join(json.dumps(line) + "\n" for line in objects).encode()


class _Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def answer(self, status, body, content_type="application/json", headers=()):
        if not isinstance(body, bytes):
            body = json.dumps(body).encode()
        for _ in range(self.server.mock.interim):
            self.send_response_only(100)
            self.end_headers()
        self.send_response(status)
        self.send_header("Content-Type", content_type)
        self.send_header("Content-Length", str(len(body)))
        for name, value in headers:
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def lose_connection(self):
        """A reset instead of an answer."""
        self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.close_connection = True
        self.connection.close()

    def handle_one_request(self):
        try:
            super().handle_one_request()
        except (OSError, ValueError):
            self.close_connection = True

    def do_GET(self):
        self.respond("")

    def do_POST(self):
        self.respond(self.rfile.read(int(self.headers.get("Content-Length", 0))).decode())

    def respond(self, body):
        mock = self.server.mock
        url = urllib.parse.urlsplit(self.path)
        request = {"method": self.command, "path": url.path, "query": dict(urllib.parse.parse_qsl(url.query)), "body": body,
                   "key": self.headers.get("Idempotency-Key"), "type": self.headers.get("Content-Type"),
                   "authorization": self.headers.get("Authorization")}
        with mock.lock:
            mock.requests.append(request)
            lost, mock.losses = mock.losses > 0, max(0, mock.losses - 1)
            stream_refusal = mock.stream_refusal
        if lost:
            self.lose_connection()
        elif mock.token is not None and request["authorization"] != f"Bearer {mock.token}":
            self.answer(401, {"error": "The token is not valid."})
        elif mock.raw is not None:
            self.answer(*mock.raw)
        elif mock.raw_post is not None and self.command == "POST":
            self.answer(*mock.raw_post)
        elif stream_refusal is not None and url.path == "/v1/events":
            self.answer(*stream_refusal)
        elif url.path == "/v1/events":
            self.send_events(request)
        elif self.command == "GET":
            self.answer(*mock.read(url.path, request["query"]))
        elif mock.refusal is not None:
            self.answer(mock.refusal[0], {"error": mock.refusal[1]}, headers=mock.refusal[2:])
        elif url.path.endswith("/actions"):
            self.answer(202, {"message": f"Accepted: {url.path}", "actionId": mock.add_action(json.loads(body))})
        else:
            self.answer(202, {"message": f"Accepted: {url.path}"})

    def send_events(self, request):
        for _ in range(self.server.mock.interim):
            self.send_response_only(100)
            self.end_headers()
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Transfer-Encoding", "chunked")
        self.end_headers()
        after = int(request["query"].get("after", 0))
        for part in self.server.mock.make_events(after):
            self.wfile.write(f"{len(part):x}\r\n".encode() + part + b"\r\n")
            self.wfile.flush()
        if self.server.mock.events_end:
            self.wfile.write(b"0\r\n\r\n")
        else:
            self.server.mock.stream_loss.wait()
            if self.server.mock.stream_reset:
                self.lose_connection()
        self.close_connection = True


class _Server(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, *_):
        pass


class OperatorMock:
    """`with OperatorMock() as mock:`; mock.url is its address."""

    def __init__(self, ssl_context=None):
        self.lock = threading.Lock()
        self.requests = []
        self.losses = 0  # requests whose connection is lost
        self.token = None
        self.raw = None  # (status, body, content type): the answer to everything
        self.raw_post = None  # to every command
        self.stream_refusal = None  # to every request for events
        self.interim = 0  # answers "100 Continue" before each answer
        self.refusal = None  # (status, sentence, headers...): the answer to every command
        self.events = None
        self.newest_event = len(ENTRIES)
        self.oldest_event = 1
        self.events_end = True
        self.stream_loss = threading.Event()  # a stream that does not end is lost
        self.stream_reset = False  # by a reset; otherwise by an end within its chunks
        self.actions = []
        self.outcomes = [("Running", ""), ("Finished", "done")]  # of an action, one for each read
        self.plans, self.robots, self.alarms, self.status, self.site = PLANS, ROBOTS, ALARMS, STATUS, SITE
        self._server = _Server(("127.0.0.1", 0), _Handler)
        self._server.mock = self
        if ssl_context is not None:
            self._server.socket = ssl_context.wrap_socket(self._server.socket, server_side=True)
        self.url = f"http{'s' if ssl_context else ''}://127.0.0.1:{self._server.server_port}"

    def __enter__(self):
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.stream_loss.set()
        self._server.shutdown()
        self._server.server_close()

    def read(self, path, query):
        """(status, body[, content type])"""
        fixed = {"/v1/status": self.status, "/v1/robots": {"robots": self.robots}, "/v1/alarms": {"alarms": self.alarms},
                 "/v1/links": {"links": self.status["links"]}, "/v1/site": self.site,
                 "/v1/snapshot": {"eventId": self.newest_event, "status": self.status, "plans": self.plans, "robots": self.robots,
                                  "alarms": self.alarms},
                 "/v1/queue": {"plans": [{"position": 1, "planId": "PLAN_2", "priority": 5, "acceptedAt": NOW, "waits": WAITS}],
                               "outbox": self.status["outbox"]},
                 "/v1/openapi.json": {"openapi": "3.1.0"}}
        if path == "/v1/plans":
            kept = [plan for plan in self.plans if query.get("robot") in (None, plan["robotId"])]
            return 200, {"plans": kept[:int(query.get("limit", 100))]}
        if path == "/v1/robots/LR01/actions":
            return 200, self.read_actions()
        if path in ("/v1/trace", "/v1/audit"):
            return 200, make_lines(TRACE if path == "/v1/trace" else AUDIT), "application/x-ndjson"
        if path == "/metrics":
            return 200, b"acsd_up 1\n", "text/plain"
        if path in fixed:
            return 200, fixed[path]
        name = urllib.parse.unquote(path.rsplit("/", 1)[1])
        found = [item for item in self.plans + self.robots if name in (item["planId"], item.get("robotId"))]
        found = [item for item in found if item in (self.robots if path.startswith("/v1/robots/") else self.plans)]
        return (200, found[0]) if found else (404, {"error": f"There is no {name}."})

    def add_action(self, request):
        self.actions.append({"actionId": f"A{len(self.actions)}", "actionType": request["actionType"], "status": "Waiting",
                             "parameters": request.get("parameters", {}), "reason": request.get("reason", ""),
                             "requestedAt": NOW, "resultDescription": "", "endedAt": None})
        return self.actions[-1]["actionId"]

    def read_actions(self):
        """The newest action takes its next status."""
        if self.actions and self.outcomes and self.actions[-1]["endedAt"] is None:
            status, result = self.outcomes.pop(0)
            ended = NOW if status in ("Finished", "Failed", "Unknown") else None
            self.actions[-1].update(status=status, resultDescription=result, endedAt=ended)
        return {"actions": self.actions, "offered": OFFERED}

    def make_events(self, after):
        if self.events is not None:
            return self.events
        if 0 < after < self.oldest_event - 1:
            return [b"event: reset\ndata: {}\n\n"]
        parts = [b": keep-alive\n\n"]
        for number in range(max(after + 1, self.oldest_event), self.newest_event + 1):
            entry = ENTRIES[(number - 1) % len(ENTRIES)]
            parts.append(f"event: entry\nid: {number}\ndata: {json.dumps(entry)}\n\n".encode())
        return parts
