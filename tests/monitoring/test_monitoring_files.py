#!/usr/bin/env python3
"""The alert rules and the dashboard of monitoring/: valid for Prometheus, tested, and about metrics that exist."""

import itertools
import json
import pathlib
import re
import runpy
import sys
import tempfile
import unittest

from monitoring_files import (DASHBOARD, GENERATOR, REPOSITORY, RULE_TESTS, RULES, SCRAPING, find_metrics,
                              list_dashboard_queries, read_dashboard, read_documented_metrics, read_rules, run_promtool)

SEVERITIES = ("critical", "warning")
PANEL_TYPES = ("row", "stat", "table", "timeseries", "state-timeline")
COLUMNS = 24


def make_anchor(heading):
    """As a Markdown renderer makes it."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


class Rules(unittest.TestCase):
    def setUp(self):
        self.rules = read_rules()

    def check_promtool(self, *arguments):
        code, output = run_promtool(*arguments)
        self.assertEqual(code, 0, output)
        return output

    def test_the_rules_and_the_example_configuration_are_valid(self):
        output = self.check_promtool("check", "rules", RULES)
        self.assertIn(f"{len(self.rules)} rules found", output)
        self.check_promtool("check", "config", SCRAPING)

    def test_each_alert_fires_and_stays_quiet_when_it_should(self):
        self.check_promtool("test", "rules", RULE_TESTS)
        text = RULE_TESTS.read_text()
        cases = dict(re.findall(r"^  - name: (\w+)\n(.*?)(?=^  - name: |\Z)", text, re.MULTILINE | re.DOTALL))
        self.assertEqual(cases.keys(), self.rules.keys())
        for alert, case in cases.items():
            expected = re.findall(r"exp_(?:samples|alerts):( \[\])?", case)
            self.assertIn(" [] and firing", " and ".join(sorted(part or "firing" for part in expected)), alert)
            self.assertEqual(set(re.findall(r'alertname[=:] ?"?(\w+)', case)), {alert})

    def test_each_alert_has_a_severity_texts_and_a_page(self):
        for alert, rule in self.rules.items():
            with self.subTest(alert):
                self.assertIn(rule["severity"], SEVERITIES)
                self.assertNotIn(". ", rule["summary"])
                self.assertGreater(len(rule["description"]), 40)
                self.assertTrue(rule["description"].endswith("."))
                for page in re.findall(r"docs/[^\s'{}]+", rule["runbook_url"]):
                    self.check_page(page)

    def check_page(self, page):
        path, _, anchor = page.partition("#")
        file = REPOSITORY / path
        if path == "docs/runbook/en/":  # the code follows
            codes = re.findall(r"^\| `((?:ACS|ARM)-\w+)`", (REPOSITORY / "docs/reference/alarms.md").read_text(), re.MULTILINE)
            for code in codes:
                self.assertTrue((file / f"{code}.md").exists(), code)
            return
        self.assertTrue(file.exists(), page)
        if anchor:
            headings = re.findall(r"^#+ (.*)$", file.read_text(), re.MULTILINE)
            self.assertIn(anchor, [make_anchor(heading) for heading in headings], page)

    def test_each_metric_of_a_rule_is_documented(self):
        documented = read_documented_metrics()
        for alert, rule in self.rules.items():
            self.assertLessEqual(find_metrics(rule["expr"], documented), documented.keys(), alert)

    def test_the_guide_names_each_alert_that_selects_the_job(self):
        text = (REPOSITORY / "docs/guide/monitor.md").read_text()
        sentence = re.search(r"The job must be named `acsd`:[^.]*\.", text).group()
        selecting = [alert for alert, rule in self.rules.items() if 'job="acsd"' in rule["expr"]]
        self.assertEqual(re.findall(r"`(Acsd\w+)`", sentence), selecting)


class Dashboard(unittest.TestCase):
    def test_the_file_is_what_its_generator_writes(self):
        self.assertEqual(DASHBOARD.read_text(), runpy.run_path(str(GENERATOR))["render"]())

    def test_each_query_is_valid_and_its_metrics_are_documented(self):
        documented = read_documented_metrics()
        rules = ["groups:", "  - name: dashboard", "    rules:"]
        for number, (title, expression) in enumerate(list_dashboard_queries()):
            self.assertNotIn("$", expression, title)
            self.assertLessEqual(find_metrics(expression, documented), documented.keys(), title)
            # JSON is YAML too.
            rules += [f"      - record: panel:query:{number}", f"        expr: {json.dumps(expression)}"]
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "panels.yml"
            file.write_text("\n".join(rules) + "\n")
            code, output = run_promtool("check", "rules", file)
        self.assertEqual(code, 0, output)
        self.assertIn(f"{number + 1} rules found", output)

    def test_the_utilisation_of_robots_of_one_name_at_two_sites_is_at_most_1(self):
        expression = next(expression for title, expression in list_dashboard_queries() if title.startswith("Utilisation"))
        series = [{"series": f'acsd_robot_status_seconds_total{{job="acsd",instance="{instance}",robot="LR01",status="Moving"}}',
                   "values": "0+10x40"} for instance in ("a:8080", "b:8080")]
        samples = [{"labels": '{status="Moving"}', "value": 1}]
        case = {"interval": "10s", "input_series": series, "promql_expr_test": [
            {"expr": expression.replace("[10s]", "[1m]"), "eval_time": "5m", "exp_samples": samples}]}
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "utilisation.yml"
            file.write_text(json.dumps({"tests": [case]}))
            code, output = run_promtool("test", "rules", file)
        self.assertEqual(code, 0, output)

    def test_the_panels_fill_the_grid_without_overlap(self):
        dashboard = read_dashboard()
        self.assertGreaterEqual(dashboard["schemaVersion"], 36)  # Grafana 9
        panels = dashboard["panels"]
        self.assertEqual(len({panel["id"] for panel in panels}), len(panels))
        taken = set()
        for panel in panels:
            self.assertIn(panel["type"], PANEL_TYPES)
            place = panel["gridPos"]
            self.assertLessEqual(place["x"] + place["w"], COLUMNS, panel["title"])
            cells = set(itertools.product(range(place["x"], place["x"] + place["w"]),
                                          range(place["y"], place["y"] + place["h"])))
            self.assertFalse(cells & taken, panel["title"])
            taken |= cells
        self.assertEqual([panel["title"] for panel in panels if panel["type"] == "row"],
                         ["Overview", "Plans", "Robots", "MCS link", "Store and process"])

    def test_the_data_source_is_a_variable(self):
        dashboard = read_dashboard()
        variables = {variable["name"]: variable for variable in dashboard["templating"]["list"]}
        self.assertEqual(variables["datasource"]["type"], "datasource")
        for panel in dashboard["panels"]:
            for target in panel.get("targets", ()):
                self.assertEqual(target["datasource"]["uid"], "${datasource}")
                self.assertLessEqual(set(re.findall(r"\$(\w+)", target["expr"])), {*variables, "__rate_interval"})


if __name__ == "__main__":
    sys.exit(unittest.main(verbosity=2))
