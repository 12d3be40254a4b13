#!/usr/bin/env python3
"""The search of the built documentation site, in Chromium, from files and without a server."""

import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "page"))
from missing_packages import SKIPPED, find_missing  # noqa: E402

# What is searched for, and a page that must be found.
SEARCHES = (
    ("corridor", "docs/reference/configuration.html"),
    ("ACS-1008", "docs/runbook/en/ACS-1008.html"),
    ("알람", "docs/reference/ko/alarms.html"),
    # With a particle; inside a compound that the page writes without a space; two words; one syllable.
    ("저장소를", "docs/runbook/ko/ACS-1005.html"),
    ("경알람", "docs/runbook/ko/ACS-1009.html"),
    ("충전 스테이션", "docs/reference/ko/configuration.html"),
    ("암", "docs/runbook/ko/ARM-motorOff.html"),
)
UNKNOWN = ("zzyzx", "뷁뷁뷁")


def search(browser, site, words):
    from page_case import wait_until  # needs selenium

    driver = browser.driver
    driver.get(f"{site.as_uri()}/search.html?q={words}")
    ended = "return /found|did not match/.test(document.querySelector('#search-results p')?.innerText)"
    wait_until(lambda: driver.execute_script(ended), f"the search for {words} has ended")
    links = driver.execute_script("return [...document.querySelectorAll('#search-results li > a')].map((link) => link.href)")
    return [link.split("?")[0].split("#")[0].removeprefix(f"{site.as_uri()}/") for link in links]


def main():
    parser = argparse.ArgumentParser(description="Tests the search of the documentation site.")
    parser.add_argument("site", type=pathlib.Path, help="folder of index.html")
    site = parser.parse_args().site.resolve()
    if missing := find_missing():
        print(f"skipped: {', '.join(missing)} not installed (scripts/setup --for test)")
        return SKIPPED
    from browser import Browser

    faults = []
    with Browser() as browser:
        for words, page in SEARCHES:
            found = search(browser, site, words)
            if page not in found:
                faults.append(f"'{words}' does not find {page}, only {found}")
        for words in UNKNOWN:
            found = search(browser, site, words)
            if found:
                faults.append(f"'{words}' finds {found}")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
