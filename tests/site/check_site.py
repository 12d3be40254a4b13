#!/usr/bin/env python3
"""Checks the example site, its configuration and the example plans; exit code 1 and a line per error.

    check_site.py            everything but the schema
    check_site.py --schema   the layout against the official LIF schema of $ACS_SPEC_DIR; exit code 77 (skipped) where
                             that folder or python3-jsonschema is missing
"""

import importlib.util
import os
import pathlib
import subprocess
import sys

import site_checks as checks

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SITE = ROOT / "examples/site"
PLANS = ROOT / "examples/plans"
KEYS = ROOT / "docs/reference/configuration.md"
SKIPPED = 77


def find_schema_or_none():
    folder = os.environ.get("ACS_SPEC_DIR")
    path = pathlib.Path(folder) / "lif/lif-schema.json" if folder else None
    return path if path is not None and path.is_file() else None


def check_schema_only(lif):
    schema = find_schema_or_none()
    if schema is None:
        print("skipped: ACS_SPEC_DIR does not name a folder with lif/lif-schema.json")
        return SKIPPED, []
    if importlib.util.find_spec("jsonschema") is None:
        print("skipped: python3-jsonschema is not installed")
        return SKIPPED, []
    return 0, checks.check_schema(lif, checks.read_json(schema))


def check_all_else(lif):
    errors = [error for check in checks.LAYOUT_CHECKS for error in check(lif)]
    config = checks.read_toml(SITE / "acsd.toml")
    errors += checks.check_config(config, lif)
    errors += checks.check_key_table(config, (SITE / "acsd.toml").read_text(encoding="utf-8"),
                                       KEYS.read_text(encoding="utf-8"))
    plans = sorted(PLANS.glob("*.json"))
    if not plans:
        errors.append("there are no example plans")
    for path in plans:
        errors += [f"{path.name}: {error}" for error in checks.check_plan(checks.read_json(path), config)]
    if subprocess.run([sys.executable, ROOT / "scripts/make_site.py", "--check"], check=False).returncode != 0:
        errors.append("the layout or its picture is not what scripts/make_site.py writes")
    return errors


def main():
    lif = checks.read_json(SITE / "site.lif.json")
    code, errors = check_schema_only(lif) if sys.argv[1:] == ["--schema"] else (0, check_all_else(lif))
    for error in errors:
        print(error, file=sys.stderr)
    return 1 if errors else code


if __name__ == "__main__":
    sys.exit(main())
