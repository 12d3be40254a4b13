#!/usr/bin/env python3
"""make_config.py SITE_FOLDER OUTPUT_FOLDER: writes /etc/acsd of the package acsd from the example site: its map, and its
configuration with the paths of the package, tokens, and a new store that starts paused."""

import pathlib
import shutil
import sys

CHANGES = (
    ('directory = "store"', 'directory = "/var/lib/acsd/store"'),
    ('# tokens_file = "tokens"', 'tokens_file = "tokens"'),
    ('new_store = "auto"', 'new_store = "paused"'),
    ("# acsd's configuration for the example site. docs/reference/configuration.md has a table of all keys.\n#\n",
     "# Configuration of acsd. It is that of an example site: replace URLs, map, ports, robots, stations and actions by those of yours.\n"
     "# /usr/share/doc/acs/docs (package acs-doc) has reference/configuration.md, a table of all keys, and\n"
     "# guide/commission-a-site.md. Afterwards:\n"
     "#   runuser -u acsd -- acsd --config /etc/acsd/acsd.toml --check-config\n"
     "#   systemctl restart acsd\n"
     "#   acsctl --token-file /etc/acsd/operator.token tsc resume\n#\n"),
)


def make_config(text):
    for old, new in CHANGES:
        if text.count(old) != 1:
            sys.exit(f"make_config: examples/site/acsd.toml has {text.count(old)} times '{old}' instead of once")
        text = text.replace(old, new)
    return text


def make_config_folder(site, output):
    output.mkdir(parents=True, exist_ok=True)
    text = make_config((site / "acsd.toml").read_text(encoding="utf-8"))
    (output / "acsd.toml").write_text(text, encoding="utf-8")
    shutil.copyfile(site / "site.lif.json", output / "site.lif.json")


def main():
    make_config_folder(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))


if __name__ == "__main__":
    main()
