#!/usr/bin/env python3
"""docs/reference/openapi.json against acsd: every path, every answer and every member."""

import json
import shutil
import signal
import subprocess
import time
import urllib.request

from api_client import REQUEST_SECONDS, ApiClient, EventReader
from api_description import load_description
from mcs_stub import McsStub
from plan_samples import make_carrying_plan, make_tray_memory_plan
from scenario_case import FINISH_SECONDS, ScenarioCase, main
from production_line import find_free_port  # which scenario_case makes known

POLL_PERIOD = 0.02
TIME_SCALE = 10
TOO_LONG = 1024 * 1024 + 1  # bytes of a body
LONG_HEADER = {"X-Long": "x" * 17_000}
MOST_STREAMS = 16  # of one client address
CURVE = {"degree": 1, "knotVector": [0.0, 0.0, 1.0, 1.0]}
SESSIONS = ("/v1/login", "/v1/logout")

# What this line does not show, with the reason.
UNSEEN = {
    ("AuditLine/1.time", "value"): "a disk that is full",
    ("AuditLine/1.lost", "value"): "a disk that is full",
    ("TraceLine/1.time", "value"): "a disk that is full",
    ("TraceLine/1.mono_us", "value"): "a disk that is full",
    ("TraceLine/1.link", "value"): "a disk that is full",
    ("TraceLine/1.lost", "value"): "a disk that is full",
    ("Status.tscReason", "value"): "a store that was restored: test_store.py",
    ("StatusChange.tscReason", "value"): "a store that was restored: test_store.py",
    ("Robot.topic", "null"): "a robot without MQTT: test_own_driver.py",
    ("Robot.warnings[]", "value"): "a vehicle that contradicts its factsheet",
    ("Unavailable: Retry-After", "value"): "1,000 commands that wait for the store: test_operations.py",
}


def make_tray_plan(plan_id):
    """CR: a tray from one place to another, in two steps; the first job is PLAN-1."""
    return {"planId": plan_id, "lotId": "LOT", "steps": [
        {"stepNo": 1, "action": "TrayLoad", "position": "A01.CP01", "carrierIds": ["T-" + plan_id],
         "jobs": [{"jobId": plan_id + "-1", "from": "A01.CP01.TP01", "to": "AMR.TP01"}]},
        {"stepNo": 2, "action": "TrayUnload", "position": "A01.CP02", "carrierIds": ["T-" + plan_id],
         "jobs": [{"jobId": plan_id + "-2", "from": "AMR.TP01", "to": "A01.CP02.TP01"}]}]}


def make_cover_plan(plan_id):
    """CR: opens a cover; its job has no places."""
    return {"planId": plan_id, "lotId": "LOT", "steps": [
        {"stepNo": 1, "action": "OpenSetCover", "position": "A01.SET01", "jobs": [{"jobId": plan_id + "-1"}]}]}


def find_robot(snapshot, robot_id):
    return next(robot for robot in snapshot["robots"] if robot["robotId"] == robot_id)


def has_alarm(snapshot, code):
    return any(alarm["errorCode"] == code for alarm in snapshot["alarms"])


class OpenApi(ScenarioCase):
    """One acsd with everything that an answer can have, and one with tokens."""

    def setUp(self):
        super().setUp()
        self.description = load_description()
        self.examples = set()  # paths whose request of the description was accepted

    # The state.

    def read_everything(self):
        """Reads every path without a parameter, and every plan and robot."""
        for method, path, _ in self.description.list_operations():
            if method == "GET" and "{" not in path and path != "/v1/events":
                self.api.ask("GET", path, 200)
        plans = [plan["planId"] for state in ("unfinished", "finished")
                 for plan in self.api.get(f"/v1/plans?state={state}")["plans"]]
        for target in [f"/v1/plans/{plan}" for plan in plans] + ["/v1/robots/LR01", "/v1/robots/CR01"]:
            self.api.get(target)

    def get_snapshot(self):
        """The plan that a robot has names this robot, and has no position in the queue; any other plan has one."""
        snapshot = self.api.get("/v1/snapshot")
        robots = {robot["planId"]: robot["robotId"] for robot in snapshot["robots"] if robot["planId"]}
        plans = [(plan["planId"], plan["robotId"]) for plan in snapshot["plans"]]
        self.assertEqual({plan: robot for plan, robot in plans if robot}, robots)
        self.assertEqual([robot is None for _, robot in plans], sorted(robot is None for _, robot in plans))
        for plan in snapshot["plans"]:
            if plan["waits"] and plan["status"] != "Paused":
                self.assertEqual(plan["waits"]["queuePosition"] is None, plan["robotId"] is not None, plan)
        return snapshot

    def wait_for(self, is_reached, what, *targets):
        """Reads the state until the function of the snapshot is true. Reads also the targets each time."""
        deadline = time.monotonic() + FINISH_SECONDS
        while not is_reached(snapshot := self.get_snapshot()):
            self.assertLess(time.monotonic(), deadline, f"{what}; the last: {snapshot}")
            for target in targets:
                self.api.get(target)
            time.sleep(POLL_PERIOD)

    def wait_for_robots(self, status, *robot_ids):
        self.wait_for(lambda snapshot: all(robot["status"] == status for robot in snapshot["robots"]
                                           if robot["robotId"] in robot_ids), f"{robot_ids} are {status}")

    def wait_for_plan(self, plan_id, status):
        target = f"/v1/plans/{plan_id}"
        self.wait_for(lambda _: self.api.get(target)["status"] == status, f"{plan_id} is {status}", "/v1/queue")

    # The programs.

    def start(self):
        self.line.start_broker()
        self.stub = McsStub()
        self.addCleanup(self.stub.close)
        self.stub.refuse_upgrades(10**6)
        self.arm_address = f"127.0.0.1:{find_free_port()}"
        self.start_arm()
        self.api = self.start_acsd(self.stub.address, f"site.map={self.make_curved_site()}",
                                   arguments=("--trace", self.line.folder / "trace"))
        self.events = EventReader(self.api.address)

    def start_acsd(self, mcs_address, *overrides, **options):
        """Its API."""
        acsd = self.line.start_acsd(mcs_address, {"stream": self.arm_address}, *overrides, **options)
        return ApiClient(self.description, acsd.wait_ready()["operator"])

    def start_arm(self):
        """Always at the same address."""
        self.arm = self.line.start("openstream-sim", "--listen", self.arm_address, "--http", "127.0.0.1:0", "--control",
                                   "127.0.0.1:0", "--programs", self.line.site_dir / "programs.toml", "--robot", "1=CR01",
                                   "--time-scale", TIME_SCALE)
        self.arm.wait_ready()

    def start_robot(self, vehicle, *options):
        """In a process of its own."""
        program = self.line.start_vehicles(TIME_SCALE, (vehicle,), options=options)
        program.wait_ready()
        return program

    def end(self, program):
        """As by a power failure."""
        self.line.forget(program)
        program.send_signal(signal.SIGKILL)
        program.stop()

    def make_curved_site(self):
        """The example site with a trajectory on the first edge."""
        site = json.loads((self.line.site_dir / "site.lif.json").read_text())
        layout = site["layouts"][0]
        edge = layout["edges"][0]
        places = {node["nodeId"]: node["nodePosition"] for node in layout["nodes"]}
        points = [{name: places[edge[node]][name] for name in ("x", "y")} for node in ("startNodeId", "endNodeId")]
        edge["vehicleTypeEdgeProperties"][0]["trajectory"] = CURVE | {"controlPoints": points}
        path = self.line.folder / "site.lif.json"
        path.write_text(json.dumps(site))
        return path

    def publish(self, topic, *message):
        binary = shutil.which("mosquitto_pub")
        self.assertIsNotNone(binary, "mosquitto_pub is missing; run scripts/setup")
        subprocess.run([binary, "-p", str(self.line.broker_port), "-q", "1", "-t", topic, *message], check=True,
                       timeout=REQUEST_SECONDS)

    def command_vehicles(self, line):
        self.publish("vda-sim/control", "-m", line)

    def submit(self, plan):
        answer = self.stub.ask("ExecutionPlan", plan)
        self.assertEqual(answer["result"], "Success", answer)

    # Requests.

    def list_requests(self):
        """(METHOD, path, operation, target, body) of each operation: the request that the description gives as an example."""
        for method, path, operation in self.description.list_operations():
            body = None
            if method == "POST":
                body = json.dumps(self.description.make_value(self.description.get_body_schema(operation))).encode()
            yield method, path, operation, self.description.fill_path(path, operation), body

    def post_example(self, path, expected=202, **values):
        """The request that the description gives as an example is accepted."""
        operation = self.description.document["paths"][path]["post"]
        self.examples.add(path)
        self.api.post(self.description.fill_path(path, operation, **values), self.description.make_value(
            self.description.get_body_schema(operation)), expected)

    def check_invalid_bodies(self, target, operation, headers=None):
        schema = self.description.resolve(self.description.get_body_schema(operation))
        body = self.description.make_value(schema)
        texts = [json.dumps(body | {"ghost": 1}), "{", "[]", '{"ghost": 1, "ghost": 2}', "\xff"]
        texts += [json.dumps(body | {name: {}}) for name in body]
        texts += [json.dumps({key: value for key, value in body.items() if key != name}) for name in schema["required"]]
        for text in texts:
            self.api.ask("POST", target, 400, text.encode("latin-1"), headers)
        self.api.ask("POST", target + "?ghost=1", 400, body, headers)

    def check_unknown(self, method, path, operation, body):
        """Each parameter of the path that names nothing."""
        for parameter in map(self.description.resolve, operation.get("parameters", [])):
            if parameter["in"] == "path" and parameter["schema"]["type"] == "string":
                target = self.description.fill_path(path, operation, **{parameter["name"]: "GHOST"})
                self.api.ask(method, target, 404, body)

    # The phases of the test of the answers.

    def check_routes(self):
        served = {(method, path) for method, path in self.api.list_routes() if path.startswith("/v1/")}  # the page is not described
        self.assertEqual(self.description.find_route_errors(served), [])
        self.assertEqual(self.api.get("/v1/openapi.json"), self.description.document)
        *_, headers = self.api.request("GET", "/v1/openapi.json")
        self.api.ask("GET", "/v1/openapi.json", 304, headers={"If-None-Match": headers["ETag"]})

    def check_links_that_are_down(self):
        self.wait_for(lambda snapshot: any(link["reason"] for link in snapshot["status"]["links"]), "a link is down")
        self.read_everything()

    def check_idle_robots(self):
        self.stub.refuse_upgrades(0)
        self.carrier = self.start_robot("LR01,type=LR", "--action-time", "pick=1h", "--action-time", "logReport=1h")
        self.start_robot("CR01,type=CR,node=D-CHG02")
        self.wait_for_robots("Idle", "LR01", "CR01")
        self.wait_for(lambda snapshot: snapshot["status"]["ready"], "acsd is ready")
        self.read_everything()

    def check_invalid_requests(self):
        for method, path, operation, target, body in self.list_requests():
            self.check_unknown(method, path, operation, body)
            self.api.ask(method, target, 431, headers=LONG_HEADER)
            if method == "POST":
                self.api.ask("POST", target, 413, b" " * TOO_LONG)
                if path not in SESSIONS:
                    self.check_invalid_bodies(target, operation)
                continue
            self.api.ask("GET", target + "?ghost=1", 400)
            for parameter in map(self.description.resolve, operation.get("parameters", [])):
                if parameter["in"] == "query" and parameter["schema"]["type"] == "integer":
                    for value in ("-1", "x", ""):
                        self.api.ask("GET", f"{target}?{parameter['name']}={value}", 400)
        self.api.ask("POST", "/v1/alarms/clear", 404, {"robotId": "LR01", "errorCode": "GHOST"})

    def check_idempotency_keys(self):
        key = {"Idempotency-Key": "reused"}
        for _ in range(2):
            self.api.ask("POST", "/v1/tsc/resume", 202, headers=key)
        for method, path, _, target, body in self.list_requests():
            if method == "POST" and path not in SESSIONS:
                self.api.ask("POST", target, 409, body, key)
        self.api.ask("POST", "/v1/tsc/resume", 400, headers={"Idempotency-Key": "not one"})

    def check_commands_to_robots(self):
        self.post_example("/v1/robots/{robotId}/carriers")
        self.wait_for(lambda snapshot: "T_01" in find_robot(snapshot, "CR01")["carrierIds"], "the record is corrected")
        self.api.post("/v1/robots/CR01/carriers", {"carrierIds": [None, None, None]})
        self.post_example("/v1/robots/{robotId}/maintenance")
        self.wait_for_robots("Stopped", "CR01")
        self.api.post("/v1/robots/CR01/maintenance", {"on": False})
        self.wait_for_robots("Idle", "CR01")

    def check_instant_actions(self):
        """The logReport of LR01 does not end; later its vehicle is switched off."""
        log = {"actionType": "logReport", "parameters": {"reason": "test"}, "reason": "a fault"}
        self.api.ask("POST", "/v1/robots/LR01/actions", 202, log)
        self.post_example("/v1/robots/{robotId}/actions")
        for _ in range(2):
            self.api.ask("POST", "/v1/robots/CR01/actions", 202, {"actionType": "stateRequest"}, {"Idempotency-Key": "state"})
        self.api.ask("POST", "/v1/robots/CR01/actions", 400, {"actionType": "cancelOrder"})

        def list_statuses(robot_id):
            return [action["status"] for action in self.api.get(f"/v1/robots/{robot_id}/actions")["actions"]]

        self.wait_for(lambda _: list_statuses("LR01") == ["Running"] and list_statuses("CR01") == ["Finished"] * 2,
                      "the actions are performed")

    def check_blocked_places(self):
        self.post_example("/v1/site/block")
        self.wait_for(lambda snapshot: snapshot["status"]["siteRevision"] == 1, "a place is blocked")
        self.read_everything()
        self.post_example("/v1/site/block", 409)
        self.post_example("/v1/site/unblock")
        self.wait_for(lambda snapshot: snapshot["status"]["siteRevision"] == 2, "the place is open")
        self.post_example("/v1/site/unblock", 409)
        for command in ("block", "unblock"):
            self.api.post(f"/v1/site/{command}", {"kind": "node", "id": "GHOST"}, 404)

    def check_waiting_plans(self):
        self.post_example("/v1/tsc/pause")
        self.wait_for(lambda snapshot: snapshot["status"]["tsc"] == "Paused", "the TSC is Paused")
        for plan in (make_carrying_plan("P2"), make_carrying_plan("P3") | {"lotId": "", "priority": None},
                     make_tray_memory_plan("P4", 2), make_cover_plan("P5"), make_carrying_plan("P6")):
            self.submit(plan)
        self.wait_for(lambda snapshot: len([plan for plan in snapshot["plans"] if plan["waits"]]) == 5, "the plans wait")
        self.read_everything()
        self.post_example("/v1/plans/{planId}/priority", planId="P6")
        self.wait_for(lambda _: self.api.get("/v1/plans/P6")["priority"] == 5, "the priority has changed")
        self.post_example("/v1/plans/{planId}/pause", planId="P6")
        self.wait_for_plan("P6", "Paused")
        self.post_example("/v1/plans/{planId}/resume", planId="P6")
        self.wait_for_plan("P6", "Pending")
        self.post_example("/v1/plans/{planId}/cancel", planId="P6")
        self.wait_for_plan("P6", "Cancelled")
        for command, body in (("cancel", {}), ("priority", {"priority": 1})):
            self.api.post(f"/v1/plans/P6/{command}", body, 409)
        self.post_example("/v1/tsc/resume")

    def check_running_plans(self):
        """P2 loads without an end, and P3 waits for its robot."""
        self.stub.unacknowledged = ("JobReport",)
        self.command_vehicles("LR01 blocked for=1s")
        self.wait_for(lambda snapshot: find_robot(snapshot, "LR01")["errors"], "the vehicle reports an error")
        self.wait_for(lambda snapshot: find_robot(snapshot, "LR01")["status"] == "Working", "the robot works", "/v1/plans/P2",
                      "/v1/queue")
        self.wait_for(lambda snapshot: snapshot["status"]["outbox"]["reports"], "a report waits for its Ack")
        self.read_everything()
        self.stub.unacknowledged = ()
        self.api.post("/v1/plans/P2/steps/1/skip", expected=409)
        self.command_vehicles("LR01 mode mode=SERVICE")
        self.wait_for_robots("Manual", "LR01")
        self.read_everything()
        self.command_vehicles("LR01 end mode")

    def check_disconnected_robot(self):
        """The vehicle of P2 is switched off, and fails to load when it is back. P3 follows."""
        self.end(self.carrier)
        self.wait_for_robots("Disconnected", "LR01")
        self.read_everything()
        self.api.post("/v1/plans/P2/jobs/P2-1/resolve", {"outcome": "again"}, 409)
        self.post_example("/v1/alarms/clear")
        self.stub.refused = ("PlanReport",)
        self.carrier = self.start_robot("LR01,type=LR,node=D-A01.CP01", "--fault",
                                        "LR01 action-fails type=pick when=start error=gripperError level=WARNING")
        self.wait_for_plan("P2", "Failed")
        self.wait_for(lambda snapshot: snapshot["status"]["refusedReports"]["last"], "the MCS refuses the report")
        self.read_everything()
        self.stub.refused = ()
        for plan in ("P3", "P4", "P5"):
            self.wait_for_plan(plan, "Completed")
        self.read_everything()

    def check_unresolved_job(self):
        """The controller of the arm is switched off while it executes the first job of P1: its counters begin with 0 again."""
        self.api.post("/v1/robots/CR01/carriers", {"carrierIds": [None, None, None]})
        request = urllib.request.Request(f"http://{self.arm.addresses['control']}/faults", b"1 estop program=11\n")
        with urllib.request.urlopen(request, timeout=REQUEST_SECONDS):
            pass
        self.submit(make_tray_plan("P1"))
        self.wait_for_robots("Error", "CR01")
        self.read_everything()
        self.end(self.arm)
        self.start_arm()
        self.wait_for(lambda snapshot: has_alarm(snapshot, "ACS-1008"), "the job is unresolved")
        self.read_everything()
        self.post_example("/v1/plans/{planId}/steps/{stepNo}/skip")
        self.post_example("/v1/plans/{planId}/jobs/{jobId}/resolve")
        self.wait_for_plan("P1", "Completed")
        self.read_everything()

    def check_abort(self):
        self.submit(make_carrying_plan("P7"))
        self.wait_for_plan("P7", "InProgress")
        self.post_example("/v1/plans/{planId}/abort", planId="P7")
        self.wait_for_plan("P7", "Aborted")

    def check_alarm_without_plan(self):
        self.stub.refused = ("ErrorReport",)
        self.command_vehicles("CR01 stuck for=1s error=testError level=WARNING")
        self.wait_for(lambda snapshot: snapshot["status"]["refusedReports"]["last"]["command"] == "ErrorReport",
                      "the MCS refuses the report")
        self.read_everything()

    def check_invalid_message(self):
        """The trace has its bytes escaped."""
        file = self.line.folder / "message"
        file.write_bytes(b"\xff")
        self.publish("uagv/v2/ACS/LR01/state", "-f", file)
        deadline = time.monotonic() + FINISH_SECONDS
        while '"escaped":true' not in self.api.ask("GET", "/v1/trace?limit=1000", 200):
            self.assertLess(time.monotonic(), deadline, "the message is not in the trace")
            time.sleep(POLL_PERIOD)
        for query in ("plan=P1", "robot=LR01", "plan=P1&robot=CR01&limit=5"):
            self.assertTrue(self.api.ask("GET", f"/v1/trace?{query}", 200), query)
        self.assertEqual(self.api.ask("GET", "/v1/trace?plan=GHOST", 200), "")

    def check_failing_store(self):
        database, away = self.line.folder / "store" / "acsd.db", self.line.folder / "away.db"
        database.rename(away)
        self.wait_for(lambda snapshot: has_alarm(snapshot, "ACS-1005"), "the store fails")
        self.read_everything()
        self.api.post("/v1/tsc/resume", expected=503)
        away.rename(database)
        self.wait_for(lambda snapshot: not snapshot["status"]["notReadyReasons"], "the store works again")

    def check_events(self):
        events = self.events.close()
        numbers = [number for _, number, _ in events]
        self.assertEqual(numbers, list(range(numbers[0], numbers[0] + len(numbers))))
        lost = EventReader(self.api.address, 0)
        lost.wait_for(lambda event: event[0] == "reset", REQUEST_SECONDS)
        for event, _, data in events + lost.close():
            self.assertEqual(self.description.find_event_errors("/v1/events", event, data), [])
        streams = [EventReader(self.api.address) for _ in range(MOST_STREAMS)]
        self.assertEqual({(stream.status, stream.content_type) for stream in streams}, {(200, "text/event-stream")})
        self.description.statuses["GET", "/v1/events"].add("200")
        self.api.ask("GET", "/v1/events", 503)
        for stream in streams:
            stream.close()

    def check_clients(self):
        """Tokens, roles, sessions and host names, at an acsd of its own without a trace."""
        viewer, operator = self.make_token("viewer"), self.make_token("operator")
        self.post_example("/v1/login", 204)  # without tokens
        self.api = self.start_acsd("127.0.0.1:1", f"operator.tokens_file={self.line.folder / 'tokens'}",
                                   f"store.directory={self.line.folder / 'store-2'}")
        reader, writer = ({"Authorization": f"Bearer {token}"} for token in (viewer, operator))
        for method, path, operation, target, body in self.list_requests():
            self.api.ask(method, target, 403, body, {"Host": "evil.example"})
            if path not in SESSIONS:
                self.api.ask(method, target, 401, body)
                if method == "POST":
                    self.api.ask(method, target, 403, body, reader)
        self.api.ask("POST", "/v1/login", 401, {"token": "guess"})
        self.api.ask("GET", "/v1/trace", 404, headers=reader)
        self.check_invalid_bodies("/v1/login", self.description.document["paths"]["/v1/login"]["post"])

        status, _, headers = self.api.request("POST", "/v1/login", json.dumps({"token": operator}))
        self.assertEqual(status, 204)
        session = {"Cookie": headers["Set-Cookie"].split(";")[0]}
        own = session | {"Origin": f"http://{self.api.address}"}
        self.api.ask("GET", "/v1/status", 200, headers=session)
        self.api.ask("POST", "/v1/tsc/pause", 403, headers=session)
        self.api.ask("POST", "/v1/tsc/pause", 202, headers=own)
        self.api.ask("POST", "/v1/logout", 403, headers=session)
        self.check_invalid_bodies("/v1/logout", self.description.document["paths"]["/v1/logout"]["post"], own)
        self.api.ask("POST", "/v1/logout", 204, headers=own)
        self.api.ask("GET", "/v1/status", 401, headers=session)
        self.examples.add("/v1/logout")
        key = {"Idempotency-Key": "1"}
        for _ in range(2):
            self.api.ask("POST", "/v1/tsc/resume", 202, headers=writer | key)
        self.api.ask("GET", "/v1/audit", 200, headers=reader)

    def test_answers_are_as_described(self):
        self.start()
        for check in (self.check_routes, self.check_links_that_are_down, self.check_idle_robots, self.check_invalid_requests,
                      self.check_idempotency_keys, self.check_commands_to_robots, self.check_instant_actions,
                      self.check_blocked_places,
                      self.check_waiting_plans, self.check_running_plans, self.check_disconnected_robot,
                      self.check_unresolved_job, self.check_abort, self.check_alarm_without_plan, self.check_invalid_message,
                      self.check_failing_store, self.check_events, self.check_clients):
            check()
        self.assertEqual(self.examples, {path for method, path, _ in self.description.list_operations() if method == "POST"})
        self.assertEqual(self.description.list_missing_answers(), [])
        self.assertEqual(set(self.description.list_unseen()), set(UNSEEN))


if __name__ == "__main__":
    main()
