"""A floor with moving robots and plans, as acsd shows them, for the tests of the live page. No real robot behaves like these: they
only have to move, wait, work and finish plans."""

import heapq
import itertools
import json
import math
import pathlib
import random
from datetime import datetime, timedelta, timezone

SITE = pathlib.Path(__file__).resolve().parent.parent.parent / "examples" / "site" / "site.lif.json"

SPEED = 1.2  # m/s
SPUR_SPEED = 0.5
WORK_SECONDS = 6.0
AHEAD = 3  # reserved nodes
WAIT_SECONDS = 6.0  # for a node; then the robot passes anyway, because the mock has no traffic control
QUEUE_LENGTH = 6
KEPT_FINISHED = 200
ACTIONS = {"LR": (("CassetteLoad", "CP"), ("CassetteUnload", "CP")), "CR": (("TrayLoad", "CP"), ("MemoryPickAndPlace", "SET"))}
OFFERED_ACTIONS = [
    {"actionType": "initPosition", "description": "Sets the position of the vehicle.", "parameters": [
        {"key": "x", "valueType": "NUMBER", "required": True}, {"key": "count", "valueType": "INTEGER", "required": False},
        {"key": "lastNodeId", "valueType": "STRING", "required": True}, {"key": "exact", "valueType": "BOOL", "required": False}]},
    {"actionType": "stateRequest", "description": "", "parameters": []},
    {"actionType": "tune", "description": "", "parameters": [
        {"key": "__proto__", "valueType": "NUMBER", "required": True},
        {"key": "a \"b\"", "valueType": "OBJECT", "required": False}]},
]


def format_time(time):
    return time.strftime("%Y-%m-%dT%H:%M:%S.") + f"{time.microsecond // 1000:03}Z"


def get_now():
    return datetime.now(timezone.utc)


class Floor:
    """Nodes, edges and stations of a layout."""

    def __init__(self):
        self.map_ids = {}
        self.places = {}  # nodeId -> (x, y)
        self.edges = []  # (edgeId, startNodeId, endNodeId)
        self.trajectories = {}  # edgeId -> [(x, y)]
        self.stations = {}  # stationId -> nodeId
        self.neighbours = {}
        self.blocks = {}  # (kind, id) -> block

    def add_node(self, node_id, x, y, map_id="floor-1"):
        self.places[node_id] = (x, y)
        self.map_ids[node_id] = map_id
        self.neighbours.setdefault(node_id, [])

    def add_edge(self, edge_id, start, end):
        self.edges.append((edge_id, start, end))
        self.neighbours[start].append((end, math.dist(self.places[start], self.places[end]), edge_id))

    @staticmethod
    def read_example():
        floor = Floor()
        layout = json.loads(SITE.read_text(encoding="utf-8"))["layouts"][0]
        for node in layout["nodes"]:
            floor.add_node(node["nodeId"], node["nodePosition"]["x"], node["nodePosition"]["y"], node["mapId"])
        for edge in layout["edges"]:
            floor.add_edge(edge["edgeId"], edge["startNodeId"], edge["endNodeId"])
        for station in layout["stations"]:
            floor.stations[station["stationId"]] = station["interactionNodeIds"][0]
        return floor

    @staticmethod
    def make_grid(count):
        """About `count` nodes: lanes 3 m apart in both directions, a station beside every fourth crossing."""
        floor = Floor()
        columns = max(2, round(math.sqrt(count * 0.8 * 1.6)))
        rows = max(2, round(count * 0.8 / columns))
        for row, column in itertools.product(range(rows), range(columns)):
            floor.add_node(f"G{row:02}{column:03}", column * 3.0, row * 3.0)
        for row, column in itertools.product(range(rows), range(columns)):
            here = f"G{row:02}{column:03}"
            for there in ((row, column + 1), (row + 1, column)):
                other = f"G{there[0]:02}{there[1]:03}"
                if other in floor.places:
                    floor.add_edge(f"{here}-{other}", here, other)
                    floor.add_edge(f"{other}-{here}", other, here)
            if (row + column) % 4 == 0:
                kind = "SET" if row % 2 else "CP"
                station = f"B{row // 5}{column // 8}.{kind}{row:02}{column:03}"
                floor.add_node(f"D-{station}", column * 3.0 + 1.1, row * 3.0 + 1.1)
                floor.add_edge(f"{here}-D-{station}", here, f"D-{station}")
                floor.add_edge(f"D-{station}-{here}", f"D-{station}", here)
                floor.stations[station] = f"D-{station}"
        return floor

    def find_route(self, start, goal):
        """The shortest one over open edges; empty if there is none."""
        best = {start: 0.0}
        before = {}
        heap = [(0.0, start)]
        while heap:
            cost, node = heapq.heappop(heap)
            if node == goal:
                route = [node]
                while node in before:
                    node = before[node]
                    route.append(node)
                return route[::-1]
            for other, length, edge_id in self.neighbours[node]:
                if (("node", other) in self.blocks or ("edge", edge_id) in self.blocks
                        or cost + length >= best.get(other, math.inf)):
                    continue
                best[other] = cost + length
                before[other] = node
                heapq.heappush(heap, (cost + length, other))
        return []

    def describe(self):
        return {
            "nodes": [{"nodeId": node_id, "x": x, "y": y, "mapId": self.map_ids[node_id]}
                      for node_id, (x, y) in self.places.items()],
            "edges": [{"edgeId": edge_id, "startNodeId": start, "endNodeId": end, "trajectory": self.trajectories.get(edge_id)}
                      for edge_id, start, end in self.edges],
            "stations": [{"stationId": station, "nodeIds": [node]} for station, node in self.stations.items()],
            "blocked": list(self.blocks.values())}


class Plan:
    def __init__(self, number, robot_type, positions, now):
        self.plan_id = f"PLAN-{now:%Y%m%d}-{number:03}"
        self.robot_type = robot_type
        self.lot_id = f"LOT_{4000 + number}"
        self.priority = (5, 5, 5, 8, 5, 3)[number % 6]
        self.status = "Pending"
        self.robot_id = None
        self.step_no = 1
        self.accepted_at = now
        self.started_at = self.ended_at = None
        self.message = ""
        self.waits = None
        self.steps = [{"stepNo": i + 1, "action": action, "position": position, "status": "Pending"}
                      for i, ((action, _), position) in enumerate(zip(ACTIONS[robot_type], positions))]
        self.carrier_ids = [f"C_{number:03}"]
        self.job_status = ["Pending"] * len(self.steps)

    def get_step(self):
        return self.steps[self.step_no - 1]

    def get_job_id(self, step_no=None):
        return f"{self.plan_id}-J{step_no or self.step_no}"

    def describe(self, is_detailed=False):
        is_busy = self.status in ("InProgress", "Paused") and self.robot_id is not None
        is_working = is_busy and self.get_step()["status"] == "InProgress"
        steps = [dict(step) for step in self.steps]
        if is_detailed:
            for i, step in enumerate(steps):
                places = [f"{step['position']}.TP01", f"{self.robot_id or 'AMR'}.CP01"]
                step["carrierIds"] = self.carrier_ids
                step["jobs"] = [{"jobId": self.get_job_id(i + 1), "from": places[i % 2], "to": places[1 - i % 2],
                                 "status": self.job_status[i]}]
        return {
            "planId": self.plan_id, "lotId": self.lot_id, "priority": self.priority, "status": self.status,
            "robotId": self.robot_id, "stepNo": self.step_no if is_busy or self.ended_at and self.status != "Completed" else 0,
            "jobId": self.get_job_id() if is_working else None, "currentAction": self.get_step()["action"] if is_working else None,
            "acceptedAt": format_time(self.accepted_at), "startedAt": self.started_at and format_time(self.started_at),
            "endedAt": self.ended_at and format_time(self.ended_at), "message": self.message, "waits": self.waits,
            "steps": steps}


class Robot:
    def __init__(self, robot_id, robot_type, node, place):
        self.robot_id = robot_id
        self.type = robot_type
        self.status = "Idle"
        self.node = node
        self.x, self.y = place
        self.theta = 0.0
        self.battery = 80.0
        self.route = []  # nodes ahead
        self.reserved = 0  # of them
        self.progress = 0.0  # metres from `node`
        self.waited = self.work_left = 0.0
        self.plan = None
        self.position = ""
        self.carrier_ids = [None]
        self.ports = [f"{robot_id}.CP01"]
        self.is_fixed = False  # does not move
        self.is_in_maintenance = False
        self.actions = []  # instant actions, the oldest first
        self.reason = None
        self.errors = []
        self.warnings = []
        self.last_message_at = get_now()

    def describe(self):
        plan = self.plan
        return {
            "robotId": self.robot_id, "type": self.type, "driver": "vda5050", "status": self.status, "position": self.position,
            "node": self.node, "nextNode": self.route[0] if self.progress > 0 and self.route else None,
            "pose": {"x": round(self.x, 3), "y": round(self.y, 3), "theta": round(self.theta, 4)},
            "battery": round(self.battery), "planId": plan and plan.plan_id, "stepNo": plan and plan.step_no,
            "jobId": plan and plan.describe()["jobId"],
            "route": [{"nodeId": node, "reserved": i < self.reserved} for i, node in enumerate(self.route)],
            "reservedNodes": [self.node, *self.route[:self.reserved]], "carrierIds": self.carrier_ids,
            "ports": self.ports, "maintenance": self.is_in_maintenance, "reason": self.reason,
            "armUp": self.status != "Error" if self.type == "CR" else None, "topic": f"uagv/v2/ACME/{self.robot_id}",
            "protocolVersion": "2.0.0", "mode": "AUTOMATIC", "errors": self.errors, "warnings": self.warnings,
            "lastMessageAt": format_time(self.last_message_at)}


class Simulation:
    """Robots drive from station to station with plans. advance() is one step in time; the changes since are in `changed_…`."""

    def __init__(self, floor, robot_count, seed=1, has_traffic=True):
        self.floor = floor
        self.has_traffic = has_traffic  # without it, no robot waits for another one
        self.random = random.Random(seed)
        self.robots = {}
        self.plans = {}
        self.finished = []
        self.alarms = []
        self.changed_robots = set()
        self.changed_plans = set()
        self.ended_plans = []
        self.has_changed_alarms = False
        self.entries = []  # (kind, robotId, planId, stepNo, jobId, text)
        self._number = 0
        self._owner = {}  # node -> robot
        self._make_robots(robot_count)
        for _ in range(QUEUE_LENGTH):
            self.add_plan()

    def _make_robots(self, count):
        docks = list(self.floor.stations.items())
        self.random.shuffle(docks)
        for i in range(count):
            robot_type = "CR" if i % 3 == 2 else "LR"
            number = sum(robot.type == robot_type for robot in self.robots.values()) + 1
            station, node = docks[i % len(docks)]
            robot = Robot(f"{robot_type}{number:02}", robot_type, node, self.floor.places[node])
            robot.position = station
            robot.battery = 45 + (i * 37) % 55
            robot.theta = math.pi / 2
            self._owner[node] = robot
            self.robots[robot.robot_id] = robot

    def add_plan(self, robot_type=None):
        self._number += 1
        robot_type = robot_type or ("CR" if self._number % 3 == 0 else "LR")
        positions = []
        for _, kind in ACTIONS[robot_type]:
            fitting = [station for station in self.floor.stations if f".{kind}" in station and station not in positions]
            positions.append(self.random.choice(fitting or list(self.floor.stations)))
        plan = Plan(self._number, robot_type, positions, get_now())
        self.plans[plan.plan_id] = plan
        self.changed_plans.add(plan.plan_id)
        self.note("plan", f"plan {plan.plan_id}: accepted", plan=plan)
        return plan

    def note(self, kind, text, robot=None, plan=None, step_no=None):
        self.entries.append((kind, robot and robot.robot_id, plan and plan.plan_id, step_no, None, text))

    def advance(self, seconds):
        for robot in self.robots.values():
            robot.last_message_at = get_now()
            if robot.is_fixed or (robot.plan is not None and robot.plan.status == "Paused"):
                continue
            if robot.plan is None:
                self._assign(robot)
            elif robot.work_left > 0:
                self._work(robot, seconds)
            elif robot.route:
                self._drive(robot, seconds)
            else:
                self._begin_work(robot)
        self._explain_waits()

    def _assign(self, robot):
        plan = next((plan for plan in sorted(self.plans.values(), key=lambda plan: (-plan.priority, plan.accepted_at))
                     if plan.status == "Pending" and plan.robot_type == robot.type), None)
        if plan is None or robot.is_in_maintenance:
            return
        robot.plan = plan
        plan.robot_id, plan.status, plan.started_at, plan.waits = robot.robot_id, "InProgress", get_now(), None
        self.note("plan", f"plan {plan.plan_id}: Pending -> InProgress on {robot.robot_id}", robot, plan)
        self._begin_step(robot)
        if sum(plan.robot_id is None for plan in self.plans.values()) < QUEUE_LENGTH:
            self.add_plan()

    def _begin_step(self, robot):
        step = robot.plan.get_step()
        step["status"] = "Dispatched"
        robot.route = self.floor.find_route(robot.node, self.floor.stations[step["position"]])[1:]
        robot.reserved = 0
        robot.status = "UnDocking" if robot.route else "Working"
        self._mark(robot)

    def _mark(self, robot):
        self.changed_robots.add(robot.robot_id)
        if robot.plan is not None:
            self.changed_plans.add(robot.plan.plan_id)

    def _reserve(self, robot):
        while robot.reserved < min(AHEAD, len(robot.route)):
            node = robot.route[robot.reserved]
            owner = self._owner.get(node) if self.has_traffic else None
            if owner not in (None, robot):
                return owner
            self._owner[node] = robot
            robot.reserved += 1
        return None

    def _drive(self, robot, seconds):
        blocker = self._reserve(robot)
        if robot.reserved == 0:
            robot.waited += seconds
            if robot.waited < WAIT_SECONDS:
                if robot.plan.waits is None and blocker is not None:
                    robot.plan.waits = self.make_wait(f"{robot.robot_id} waits on its route: {robot.route[0]} is reserved by "
                                                       f"{blocker.robot_id}.")
                    self._mark(robot)
                return
            robot.reserved = 1
        if robot.waited > 0:
            robot.waited, robot.plan.waits = 0.0, None
            self._mark(robot)
        start, end = self.floor.places[robot.node], self.floor.places[robot.route[0]]
        length = math.dist(start, end) or 0.001
        is_spur = robot.route[0].startswith("D-") or robot.node.startswith("D-")
        robot.progress += seconds * (SPUR_SPEED if is_spur else SPEED)
        target = math.atan2(end[1] - start[1], end[0] - start[0])
        if is_spur and robot.node.startswith("D-"):
            target = robot.theta  # backwards out of the dock
        turn = math.remainder(target - robot.theta, math.tau)
        robot.theta = math.remainder(robot.theta + max(-0.6, min(0.6, turn)), math.tau)
        share = min(1.0, robot.progress / length)
        robot.x, robot.y = start[0] + (end[0] - start[0]) * share, start[1] + (end[1] - start[1]) * share
        robot.battery = max(15, robot.battery - seconds * 0.01)
        status = "UnDocking" if robot.node.startswith("D-") else "Docking" if robot.route[0].startswith("D-") else "Moving"
        if status != robot.status:
            robot.status = status
        self.changed_robots.add(robot.robot_id)
        if share >= 1.0:
            if self._owner.get(robot.node) is robot:
                del self._owner[robot.node]
            robot.node = robot.route.pop(0)
            robot.reserved = max(0, robot.reserved - 1)
            robot.progress = 0.0
            self._owner[robot.node] = robot

    def _begin_work(self, robot):
        plan = robot.plan
        step = plan.get_step()
        step["status"] = "InProgress"
        plan.job_status[plan.step_no - 1] = "InProgress"
        robot.position, robot.status, robot.work_left = step["position"], "Working", WORK_SECONDS
        robot.theta = math.copysign(math.pi / 2, robot.theta)
        self.note("step", f"step {plan.step_no} of {plan.plan_id}: Dispatched -> InProgress", robot, plan, plan.step_no)
        self._mark(robot)

    def _work(self, robot, seconds):
        robot.work_left -= seconds
        if robot.work_left > 0:
            return
        plan = robot.plan
        plan.get_step()["status"] = plan.job_status[plan.step_no - 1] = "Completed"
        robot.carrier_ids = [plan.carrier_ids[0] if plan.step_no == 1 else None]
        if plan.step_no < len(plan.steps):
            plan.step_no += 1
            self._begin_step(robot)
        else:
            self.end_plan(plan, "Completed")

    def end_plan(self, plan, status, message=""):
        robot = self.robots.get(plan.robot_id)
        plan.status, plan.message, plan.ended_at, plan.waits = status, message, get_now(), None
        self.note("plan", f"plan {plan.plan_id}: {status}", robot, plan)
        self.plans.pop(plan.plan_id, None)
        self.changed_plans.discard(plan.plan_id)
        self.finished.insert(0, plan)
        del self.finished[KEPT_FINISHED:]
        self.ended_plans.append(plan)
        if robot is not None:
            robot.plan, robot.work_left = None, 0.0
            del robot.route[1 if robot.progress > 0 else 0:]
            robot.status = "Idle"
            self.changed_robots.add(robot.robot_id)
        if sum(plan.robot_id is None for plan in self.plans.values()) < QUEUE_LENGTH:
            self.add_plan()

    def make_wait(self, message, position=None, robots=()):
        return {"message": message, "since": format_time(get_now()), "queuePosition": position,
                "robots": [{"robotId": robot_id, "reason": reason} for robot_id, reason in robots]}

    def _explain_waits(self):
        """Of the plans in the queue."""
        queue = sorted((plan for plan in self.plans.values() if plan.status == "Pending"),
                       key=lambda plan: (-plan.priority, plan.accepted_at))
        for position, plan in enumerate(queue, 1):
            robots = [(robot.robot_id, robot.reason or (f"busy with plan {robot.plan.plan_id}" if robot.plan else "unavailable"))
                      for robot in self.robots.values() if robot.type == plan.robot_type][:4]
            wait = self.make_wait("No suitable robot is free.", position, robots)
            if plan.waits is None or (plan.waits["queuePosition"], plan.waits["robots"]) != (position, wait["robots"]):
                wait["since"] = plan.waits["since"] if plan.waits else format_time(plan.accepted_at)
                plan.waits = wait
                self.changed_plans.add(plan.plan_id)

    # What the tests and pictures set.

    def set_alarm(self, robot_id, code, level, message, title, cause, remedy, plan=None, minutes=0):
        alarm = {"robotId": robot_id, "errorCode": code, "level": level, "message": message,
                 "since": format_time(get_now() - timedelta(minutes=minutes)), "title": title, "cause": cause, "remedy": remedy,
                 "planId": plan and plan.plan_id, "stepNo": plan and plan.step_no, "jobId": plan and plan.get_job_id()}
        self.alarms.append(alarm)
        self.has_changed_alarms = True
        self.entries.append(("alarm", robot_id, alarm["planId"], alarm["stepNo"], alarm["jobId"], f"{code} set: {message}"))
        return alarm

    def clear_alarms(self, robot_id, code):
        kept = [alarm for alarm in self.alarms if (alarm["robotId"], alarm["errorCode"]) != (robot_id, code)]
        is_found = len(kept) < len(self.alarms)
        if is_found:
            self.alarms = kept
            self.has_changed_alarms = True
            self.entries.append(("alarm", robot_id, None, None, None, f"{code} cleared"))
        return is_found

    def fix(self, robot_id, status, reason=None):
        """The robot stays where it is, with this status."""
        robot = self.robots[robot_id]
        robot.is_fixed, robot.status, robot.reason = True, status, reason
        self._mark(robot)
        return robot
