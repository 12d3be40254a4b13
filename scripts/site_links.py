#!/usr/bin/env python3
"""Checks the links of built HTML pages without the network: files and anchors inside the site exist, addresses of other sites are
well-formed. Prints each violation, one per line."""

import argparse
import html.parser
import os
import re
import sys
from urllib.parse import unquote, urlsplit

HOST = re.compile(r"(?:[A-Za-z0-9](?:[A-Za-z0-9-]*[A-Za-z0-9])?\.)+[A-Za-z]{2,}")
# Attributes that name another file.
LINKS = {"a": "href", "link": "href", "img": "src", "script": "src", "source": "src", "iframe": "src", "object": "data"}
# Pages that Sphinx makes; they are no documents.
GENERATED = ("genindex.html", "search.html")


class Page(html.parser.HTMLParser):
    """The anchors of a page, and its links with their lines."""

    def __init__(self, path):
        super().__init__()
        self.anchors = set()
        self.links = []
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.anchors.update(value for value in (values.get("id"), values.get("name") if tag == "a" else None) if value)
        target = values.get(LINKS.get(tag, ""))
        if target is not None:
            self.links.append((self.getpos()[0], target, tag))


def list_pages(folder):
    for place, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html"):
                yield os.path.relpath(os.path.join(place, name), folder)


def check_foreign(target, tag):
    """Why the address of another site is refused, or None."""
    if tag != "a" and tag != "link":
        return "is loaded from another site: the site must work without a network"
    if any(sign in target for sign in " <>\"{}|\\^`"):
        return "has a character that an address cannot have"
    try:
        address = urlsplit(target)
        bRight = address.scheme == "mailto" or (address.scheme in ("http", "https") and address.port != 0
                                                and HOST.fullmatch(address.hostname or ""))
    except ValueError:
        bRight = False
    return None if bRight else "is not a well-formed address"


def check_site(folder):
    """(page, line, target, reason)"""
    pages = {path: Page(os.path.join(folder, path)) for path in list_pages(folder)}
    for path, page in sorted(pages.items()):
        for line, target, tag in page.links:
            if re.match(r"[a-zA-Z][a-zA-Z0-9+.-]*:|//", target):
                reason = check_foreign(target, tag)
                if reason:
                    yield path, line, target, reason
                continue
            file, _, anchor = target.partition("#")
            file = unquote(file.split("?")[0])
            place = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
            if file.startswith("/") or place.startswith(".."):
                yield path, line, target, "leads out of the site"
            elif not os.path.isfile(os.path.join(folder, place)):
                yield path, line, target, f"{place} does not exist"
            elif anchor and place in pages and unquote(anchor) not in pages[place].anchors and place not in GENERATED:
                yield path, line, target, f"{place} has no anchor #{unquote(anchor)}"


def main():
    parser = argparse.ArgumentParser(description="Checks the links of built HTML pages; silent when all is well.")
    parser.add_argument("folder", help="the folder of index.html")
    folder = parser.parse_args().folder
    faults = list(check_site(folder))
    if not any(list_pages(folder)):
        print(f"{folder}: no pages")
        return 1
    for path, line, target, reason in faults:
        print(f"{path}:{line}: link '{target}': {reason}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
