#!/usr/bin/env python3
"""The live page in headless Chromium, against the mock or (what applies) a real acsd.

    test_page.py               a sample
    test_page.py --long        all of it, with the measurement of the CPU time
    test_page.py --url URL     what holds for every acsd, against the one at URL, such as http://127.0.0.1:8081/

Exit code 77 if chromium, chromedriver or python3-selenium is missing."""

import argparse
import sys
import unittest

from missing_packages import SKIPPED, find_missing

SAMPLE = ("AnyAcsd", "Floor.test_a_robot_moves", "Alarms.test_an_alarm_appears_and_clears", "Plans.test_pause_and_resume",
          "Safety.test_ids_are_text", "Connection.test_reset")


def main():
    parser = argparse.ArgumentParser(description="Tests the live page of acsd in Chromium.")
    parser.add_argument("--long", action="store_true", help="all tests")
    parser.add_argument("--url", help="address of a real acsd")
    parser.add_argument("names", nargs="*", help="only these, such as Plans.test_cancel_asks_first")
    arguments = parser.parse_args()
    if missing := find_missing():
        print(f"skipped: {', '.join(missing)} not installed (scripts/setup --for test)")
        return SKIPPED
    import page_tests
    from page_case import PageCase
    PageCase.url = arguments.url
    names = ["AnyAcsd"] if arguments.url else arguments.names or (() if arguments.long else SAMPLE)
    loader = unittest.TestLoader()
    suite = loader.loadTestsFromNames(names, page_tests) if names else loader.loadTestsFromModule(page_tests)
    try:
        result = unittest.TextTestRunner(verbosity=2).run(suite)
    finally:
        PageCase.close_browser()
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
