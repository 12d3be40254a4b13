#!/usr/bin/env python3
"""Makes the pictures of the live page for the documents: docs/guide/pictures/page-*.png, from the mock."""

import argparse
import base64
import pathlib
import sys

from browser import Browser
from mock_acsd import MockAcsd
from mock_troubles import add_troubles
from page_case import wait_until
from png_palette import shrink

FOLDER = pathlib.Path(__file__).resolve().parent.parent.parent / "docs" / "guide" / "pictures"
LIMIT = 150_000  # bytes of a picture
DESK, PHONE, WALL = (1366, 768, 1, False), (360, 700, 2, True), (1920, 1080, 1, False)


def list_pictures(mock):
    """(name, size, address, tab)"""
    unresolved = next(alarm["planId"] for alarm in mock.simulation.alarms if alarm["errorCode"] == "ACS-1008")
    return (("floor", DESK, "?lang=en&theme=light", "plans"), ("robot", DESK, "?lang=en&theme=light#robot/LR01", "robots"),
            ("plan", DESK, f"?lang=en&theme=light#plan/{unresolved}", "plans"), ("alarm", DESK, "?lang=en&theme=light", "alarms"),
            ("korean", DESK, "?lang=ko&theme=light", "alarms"), ("dark", DESK, "?lang=en&theme=dark", "robots"),
            ("phone", PHONE, "?lang=en&theme=light", "plans"), ("wall", WALL, "?lang=en&theme=dark#wall", None))


def take(browser, base, picture, folder):
    name, size, address, tab = picture
    driver = browser.driver
    driver.get("about:blank")
    browser.resize(*size)
    driver.get(base + address)
    wait_until(lambda: driver.execute_script("return globalThis.acsdPage?.feedState.name === 'live'"), "the page is live")
    if tab is not None and "#" not in address:
        driver.execute_script("document.getElementById(arguments[0]).click()", f"tab-{tab}")
    driver.execute_script("document.querySelectorAll('#detail h3 button').forEach((button) => button.click())")
    # Everything is drawn: two frames of the browser later.
    driver.execute_async_script("const done = arguments[0]; document.activeElement.blur();"
                                "setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 900)")
    data = shrink(base64.b64decode(driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]))
    path = folder / f"page-{name}.png"
    path.write_bytes(data)
    print(f"{path.name}: {len(data) // 1000} kB")
    return len(data) <= LIMIT


def main():
    parser = argparse.ArgumentParser(description="Makes the pictures of the live page.")
    parser.add_argument("--out", type=pathlib.Path, default=FOLDER, help="folder (default: docs/guide/pictures)")
    parser.add_argument("names", nargs="*", help="only these, such as floor")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    with MockAcsd(robots=10) as mock, Browser() as browser:
        add_troubles(mock)
        mock.freeze()
        pictures = [picture for picture in list_pictures(mock) if not arguments.names or picture[0] in arguments.names]
        sizes = [take(browser, f"http://{mock.address}/", picture, arguments.out) for picture in pictures]
    if not all(sizes):
        print(f"a picture has more than {LIMIT // 1000} kB", file=sys.stderr)
    return 0 if all(sizes) else 1


if __name__ == "__main__":
    sys.exit(main())
