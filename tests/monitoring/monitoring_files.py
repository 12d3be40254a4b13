"""Reads what describes the metrics of acsd: the reference document, the alert rules and the dashboard."""

import json
import pathlib
import re
import shutil
import subprocess

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
FOLDER = REPOSITORY / "monitoring"
RULES = FOLDER / "prometheus" / "acsd.rules.yml"
RULE_TESTS = FOLDER / "prometheus" / "acsd.rules.test.yml"
SCRAPING = FOLDER / "prometheus" / "prometheus.yml"
DASHBOARD = FOLDER / "grafana" / "acsd.json"
GENERATOR = FOLDER / "grafana" / "make_dashboard.py"
REFERENCE = REPOSITORY / "docs" / "reference" / "metrics.md"

METRIC = re.compile(r"\b((?:acsd|process)_[a-z_]+)")
HISTOGRAM_SUFFIXES = ("_bucket", "_sum", "_count")
# Variables of the dashboard.
VARIABLES = {"$__rate_interval": "10s", "$job": ".*", "$instance": ".*", "$robot": ".*"}


def find_program(name):
    found = shutil.which(name)
    if found is None:
        raise FileNotFoundError(f"{name} is not installed; run scripts/setup --for test")
    return found


def run_promtool(*arguments, text=None):
    """(exit code, output)"""
    result = subprocess.run([find_program("promtool"), *map(str, arguments)], input=text, text=True, check=False,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return result.returncode, result.stdout


def read_documented_metrics():
    """{name: type} of the tables of the reference."""
    metrics = {}
    for line in REFERENCE.read_text().splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) > 3 and cells[2] in ("gauge", "counter", "histogram"):
            metrics.update(dict.fromkeys(METRIC.findall(cells[1]), cells[2]))
    return metrics


def find_metrics(expression, documented):
    """The names in an expression, of a histogram without the suffix."""
    names = set()
    for name in METRIC.findall(expression):
        base = next((name.removesuffix(suffix) for suffix in HISTOGRAM_SUFFIXES if name.endswith(suffix)), name)
        names.add(base if documented.get(base) == "histogram" else name)
    return names


def read_rules():
    """{alert: {"expr": …, "severity": …, "summary": …, …}}; the file has each value on one line."""
    rules, rule = {}, None
    for line in RULES.read_text().splitlines():
        found = re.match(r"\s+(- )?(alert|expr|for|severity|summary|description|runbook_url): (.*)$", line)
        if found is None:
            continue
        value = found.group(3)
        if value.startswith("'"):
            value = value[1:-1].replace("''", "'")
        if found.group(2) == "alert":
            rule = rules.setdefault(value, {})
        rule[found.group(2)] = value
    return rules


def read_dashboard():
    return json.loads(DASHBOARD.read_text())


def list_dashboard_queries():
    """(title of the panel, expression) with the variables replaced."""
    queries = []
    for panel in read_dashboard()["panels"]:
        for target in panel.get("targets", ()):
            expression = target["expr"]
            for variable, value in VARIABLES.items():
                expression = expression.replace(variable, value)
            queries.append((panel["title"], expression))
    return queries
