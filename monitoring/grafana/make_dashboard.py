#!/usr/bin/env python3
"""Writes acsd.json, the Grafana dashboard of acsd, next to this file. Change the panels here, then run it without arguments."""

import json
import pathlib

TARGET = pathlib.Path(__file__).with_name("acsd.json")
COLUMNS = 24
SELECTOR = 'job=~"$job",instance=~"$instance"'
ROBOT = SELECTOR + ',robot=~"$robot"'
RATE = "[$__rate_interval]"
DATASOURCE = {"type": "prometheus", "uid": "${datasource}"}
UP_DOWN = [{"type": "value", "options": {"0": {"text": "down", "color": "red", "index": 0},
                                         "1": {"text": "up", "color": "green", "index": 1}}}]
YES_NO = [{"type": "value", "options": {"0": {"text": "no", "color": "red", "index": 0},
                                        "1": {"text": "yes", "color": "green", "index": 1}}}]
STATUS_COLORS = {
    "Idle": "blue", "Moving": "green", "Working": "dark-green", "Docking": "light-green", "UnDocking": "light-green",
    "Arrival": "super-light-green", "Charging": "purple", "Manual": "yellow", "Stopped": "orange", "Error": "red",
    "Disconnected": "dark-red", "Init": "text"}


def quantile(share, metric, labels="", selector=SELECTOR):
    by = ", ".join(["le", *labels.split(",")] if labels else ["le"])
    return f"histogram_quantile({share}, sum by ({by}) (rate({metric}_bucket{{{selector}}}{RATE})))"


def increase(metric, by, selector=SELECTOR):
    return f"sum by ({by}) (increase({metric}{{{selector}}}{RATE}))"


def red_above(value):
    return [{"color": "green", "value": None}, {"color": "red", "value": value}]


def make_targets(queries, bInstant=False, kind="time_series"):
    """queries: (expression, legend)"""
    return [{"refId": chr(ord("A") + number), "datasource": DATASOURCE, "expr": expression, "legendFormat": legend,
             "instant": bInstant, "range": not bInstant, "format": kind} for number, (expression, legend) in enumerate(queries)]


def make_panel(kind, title, queries, description="", unit="short", bInstant=False, table="time_series", thresholds=None,
               mappings=(), custom=None, options=None, overrides=(), lowest=None, highest=None):
    defaults = {"unit": unit, "mappings": list(mappings), "custom": custom or {},
                "thresholds": {"mode": "absolute", "steps": thresholds or [{"color": "green", "value": None}]}}
    if lowest is not None:
        defaults["min"] = lowest
    if highest is not None:
        defaults["max"] = highest
    return {"type": kind, "title": title, "description": description, "datasource": DATASOURCE,
            "targets": make_targets(queries, bInstant, table), "options": options or {},
            "fieldConfig": {"defaults": defaults, "overrides": list(overrides)}}


def stat(title, expression, description="", **options):
    return make_panel("stat", title, [(expression, "{{instance}}")], description, bInstant=True, options={
        "colorMode": "background", "graphMode": "none", "justifyMode": "auto", "textMode": "auto", "orientation": "auto",
        "reduceOptions": {"calcs": ["lastNotNull"], "fields": "", "values": False}}, **options)


def graph(title, queries, description="", unit="short", bStacked=False, **options):
    custom = {"drawStyle": "line", "lineWidth": 1, "fillOpacity": 40 if bStacked else 10, "showPoints": "never",
              "stacking": {"mode": "normal" if bStacked else "none", "group": "A"}}
    return make_panel("timeseries", title, queries, description, unit, custom=custom, lowest=0, options={
        "legend": {"displayMode": "list", "placement": "bottom", "showLegend": True},
        "tooltip": {"mode": "multi", "sort": "desc"}}, **options)


def color_by_name(colors):
    return [{"matcher": {"id": "byName", "options": name},
             "properties": [{"id": "color", "value": {"mode": "fixed", "fixedColor": color}}]} for name, color in colors.items()]


OVERVIEW = (
    (3, stat("Ready", f"acsd_ready{{{SELECTOR}}}", "Whether /readyz answers 200.", mappings=YES_NO)),
    (3, stat("MCS", f"acsd_mcs_registered{{{SELECTOR}}}", "Registered with the MCS.", mappings=UP_DOWN)),
    (3, stat("Broker", f'acsd_link_up{{{SELECTOR},link="mqtt"}}', "Absent if no robot needs the broker.", mappings=UP_DOWN)),
    (3, stat("Heavy alarms", f'acsd_alarms_active{{{SELECTOR},level="heavy"}}', thresholds=red_above(1))),
    (4, stat("Plans in progress", f'acsd_plans{{{SELECTOR},status="InProgress"}}')),
    (4, stat("Oldest plan not started", f"acsd_queue_oldest_seconds{{{SELECTOR}}}", unit="s", thresholds=red_above(1800))),
    (4, stat("Time since the start", f"time() - process_start_time_seconds{{{SELECTOR}}}", unit="s")),
    (12, make_panel("table", "Active alarms", [(f"acsd_alarms_by_code{{{SELECTOR}}} > 0", "")], bInstant=True, table="table",
                    description="docs/runbook has a page for each code.", options={"showHeader": True},
                    overrides=({"matcher": {"id": "byRegexp", "options": "Time|__name__|job"},
                                "properties": [{"id": "custom.hidden", "value": True}]},))),
    (8, graph("Alarms", [(f"acsd_alarms_active{{{SELECTOR}}}", "{{level}}")],
              overrides=color_by_name({"heavy": "red", "light": "yellow"}))),
    (4, make_panel("table", "Version", [(f"acsd_build_info{{{SELECTOR}}}", "")], bInstant=True, table="table",
                   options={"showHeader": True},
                   overrides=({"matcher": {"id": "byRegexp", "options": "Time|__name__|job|Value"},
                               "properties": [{"id": "custom.hidden", "value": True}]},))))

PLANS = (
    (8, graph("Unfinished plans", [(f"acsd_plans{{{SELECTOR}}}", "{{status}}")], bStacked=True)),
    (8, graph("Plans that wait, by cause", [(f"acsd_plans_waiting{{{SELECTOR}}}", "{{cause}}")], bStacked=True,
              description="docs/reference/metrics.md lists the causes.")),
    (8, graph("Plans that ended", [(increase("acsd_plan_changes_total", "status",
                                             SELECTOR + ',status=~"Completed|Failed|Cancelled|Aborted"'), "{{status}}")],
              bStacked=True, overrides=color_by_name({"Completed": "green", "Failed": "red", "Cancelled": "yellow",
                                                      "Aborted": "orange"}))),
    (8, graph("Wait until the start", [(quantile(0.5, "acsd_plan_wait_seconds"), "50 %"),
                                       (quantile(0.95, "acsd_plan_wait_seconds"), "95 %")], unit="s")),
    (8, graph("Duration of plans, 95 %", [(quantile(0.95, "acsd_plan_duration_seconds", "status"), "{{status}}")], unit="s")),
    (8, graph("Longest time without progress", [
        (f"acsd_queue_oldest_seconds{{{SELECTOR}}}", "oldest plan not started"),
        (f"acsd_plan_unchanged_seconds{{{SELECTOR}}}", "plan in progress without a change")], unit="s")),
    (8, graph("Duration of steps, 95 %", [(quantile(0.95, "acsd_step_duration_seconds", "action"), "{{action}}")], unit="s",
              description="From the assignment of the step to its end, with its drive.")),
    (8, graph("Duration of jobs, 95 %", [(quantile(0.95, "acsd_job_duration_seconds", "action"), "{{action}}")], unit="s")),
    (8, graph("Failed jobs", [(increase("acsd_job_failures_total", "action"), "{{action}}")], bStacked=True)))

ROBOTS = (
    (12, make_panel("state-timeline", "Status", [(f"acsd_robot_state{{{ROBOT}}} == 1", "{{robot}} {{state}}")],
                    description="A bar while the robot has the status.",
                    custom={"fillOpacity": 80, "lineWidth": 0},
                    mappings=[{"type": "value", "options": {"1": {"text": "yes", "color": "green", "index": 0}}}],
                    options={"mergeValues": True, "showValue": "never", "rowHeight": 0.8,
                             "legend": {"showLegend": False, "displayMode": "list", "placement": "bottom"}})),
    (12, graph("Utilisation: share of time by status", [
        (f"sum by (status) (rate(acsd_robot_status_seconds_total{{{ROBOT}}}{RATE}))"
         f" / scalar(count(sum by (job, instance, robot) (acsd_robot_status_seconds_total{{{ROBOT}}})))", "{{status}}")],
        unit="percentunit", bStacked=True, overrides=color_by_name(STATUS_COLORS), highest=1)),
    (8, graph("Battery", [(f"acsd_robot_battery{{{ROBOT}}}", "{{robot}}")], unit="percent", highest=100)),
    (8, graph("Waiting for the route: share of time", [(f"rate(acsd_robot_route_wait_seconds_total{{{ROBOT}}}{RATE})",
                                                       "{{robot}}")], unit="percentunit",
              description="Other robots have reserved the next nodes or block the route.")),
    (8, graph("Time since the last message", [(f"acsd_robot_last_seen_seconds{{{ROBOT}}}", "{{robot}}")], unit="s")),
    (8, graph("States received per second", [(f"rate(acsd_robot_states_received_total{{{ROBOT}}}{RATE})", "{{robot}}")])),
    (8, graph("Implausible reports", [(increase("acsd_robot_oddities_total", "robot, kind", ROBOT), "{{robot}} {{kind}}")],
              bStacked=True)),
    (8, graph("Orders sent again, sessions of arms, missing samples", [
        (increase("acsd_robot_orders_resent_total", "robot", ROBOT), "{{robot}} orders"),
        (increase("acsd_arm_connects_total", "robot", ROBOT), "{{robot}} sessions"),
        (increase("acsd_arm_samples_missing_total", "robot", ROBOT), "{{robot}} samples")])))

MCS = (
    (8, graph("Link", [(f"acsd_mcs_connected{{{SELECTOR}}}", "connected"), (f"acsd_mcs_registered{{{SELECTOR}}}", "registered"),
                       (f"acsd_is_connected{{{SELECTOR}}}", "isConnected")], highest=1)),
    (8, graph("Time to the Ack", [(quantile(0.5, "acsd_mcs_ack_wait_seconds"), "50 %"),
                                  (quantile(0.95, "acsd_mcs_ack_wait_seconds"), "95 %")], unit="s")),
    (8, graph("Outbox", [(f"acsd_outbox_depth{{{SELECTOR}}}", "reports without an Ack"),
                         (f"acsd_outbox_oldest_seconds{{{SELECTOR}}}", "age of the oldest one, in seconds")])),
    (8, graph("Requests sent", [(increase("acsd_mcs_requests_sent_total", "command",
                                          SELECTOR + ',command!="RobotPositionUpdate"'), "{{command}}")], bStacked=True)),
    (8, graph("Requests received", [(increase("acsd_mcs_requests_received_total", "command"), "{{command}}"),
                                    (increase("acsd_mcs_requests_refused_total", "command"), "{{command}} refused")])),
    (8, graph("Reports refused, without an Ack, and deviations", [
        (increase("acsd_mcs_nacks_total", "command"), "{{command}} refused"),
        (increase("acsd_mcs_ack_timeouts_total", "instance"), "without an Ack"),
        (increase("acsd_mcs_notes_total", "what"), "{{what}}")], bStacked=True)))

STORE = (
    (8, graph("Time of a commit", [(quantile(0.5, "acsd_store_commit_seconds"), "50 %"),
                                   (quantile(0.95, "acsd_store_commit_seconds"), "95 %")], unit="s")),
    (8, graph("Commits per second", [(f"rate(acsd_store_commit_seconds_count{{{SELECTOR}}}{RATE})", "{{instance}}")])),
    (8, graph("Size of the log of the store, free space", [(f"acsd_store_log_bytes{{{SELECTOR}}}", "log"),
                                                          (f"acsd_store_free_bytes{{{SELECTOR}}}", "free")], unit="bytes")),
    (8, graph("Event loop blocked", [(increase("acsd_loop_stall_seconds_count", "instance"), "stalls"),
                                     (increase("acsd_position_ticks_missed_total", "instance"), "missed positions")])),
    (8, graph("CPU and memory", [(f"rate(process_cpu_seconds_total{{{SELECTOR}}}{RATE})", "CPU, in cores"),
                                 (f"process_resident_memory_bytes{{{SELECTOR}}}", "memory")],
              overrides=({"matcher": {"id": "byName", "options": "memory"}, "properties": [
                  {"id": "unit", "value": "bytes"}, {"id": "custom.axisPlacement", "value": "right"}]},))),
    (8, graph("Lost log lines, trace messages and audit entries", [
        (increase("acsd_log_lines_dropped_total", "instance"), "log"), (increase("acsd_trace_lost_total", "instance"), "trace"),
        (increase("acsd_audit_lost_total", "instance"), "audit log")])))

ROWS = (("Overview", OVERVIEW), ("Plans", PLANS), ("Robots", ROBOTS), ("MCS link", MCS), ("Store and process", STORE))


def make_query_variable(name, query):
    return {"name": name, "label": name, "type": "query", "datasource": DATASOURCE, "query": {"query": query, "refId": name},
            "definition": query, "refresh": 2, "sort": 1, "multi": True, "includeAll": True, "allValue": ".*", "hide": 0,
            "current": {"text": "All", "value": "$__all"}, "options": [], "regex": ""}


def place_panels():
    """Numbers the panels and fills rows of the grid from left to right; stats are flat."""
    panels, y = [], 0
    for title, row in ROWS:
        panels.append({"type": "row", "title": title, "collapsed": False, "panels": [],
                       "gridPos": {"h": 1, "w": COLUMNS, "x": 0, "y": y}})
        y, x, height = y + 1, 0, 0
        for width, panel in row:
            if x + width > COLUMNS:
                x, y = 0, y + height
            height = 4 if panel["type"] == "stat" else 8
            panels.append(panel | {"gridPos": {"h": height, "w": width, "x": x, "y": y}})
            x += width
        y += height
    return [panel | {"id": number} for number, panel in enumerate(panels, 1)]


def make_dashboard():
    variables = [{"name": "datasource", "label": "data source", "type": "datasource", "query": "prometheus", "hide": 0,
                  "refresh": 1, "regex": "", "options": [], "current": {}, "multi": False, "includeAll": False},
                 make_query_variable("job", "label_values(acsd_build_info, job)"),
                 make_query_variable("instance", 'label_values(acsd_build_info{job=~"$job"}, instance)'),
                 make_query_variable("robot", f"label_values(acsd_robot_state{{{SELECTOR}}}, robot)")]
    return {"uid": "acsd", "title": "acsd", "tags": ["acsd"], "schemaVersion": 37, "version": 1, "editable": True,
            "timezone": "", "refresh": "10s", "time": {"from": "now-1h", "to": "now"}, "timepicker": {}, "graphTooltip": 1,
            "annotations": {"list": []}, "links": [], "templating": {"list": variables}, "panels": place_panels()}


def render():
    return json.dumps(make_dashboard(), indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    TARGET.write_text(render())
