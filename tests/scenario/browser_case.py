"""The live page of a real acsd in Chromium. A test that imports this ends with exit code 77 if chromium, chromedriver or
python3-selenium is missing."""

import sys

from scenario_case import REPOSITORY, ScenarioCase

sys.path.insert(0, str(REPOSITORY / "tests" / "page"))
from missing_packages import SKIPPED, find_missing  # noqa: E402

if missing := find_missing():
    print(f"skipped: {', '.join(missing)} not installed (scripts/setup --for test)")
    sys.exit(SKIPPED)
from page_case import PageCase, wait_until  # noqa: E402,F401


class BrowserCase(ScenarioCase, PageCase):
    """A line, and the page of its acsd."""

    @classmethod
    def tearDownClass(cls):
        PageCase.close_browser()

    def setUp(self):
        ScenarioCase.setUp(self)
        PageCase.setUp(self)

    def tearDown(self):
        ScenarioCase.tearDown(self)
        PageCase.tearDown(self)

    def open_page(self, address):
        """In English."""
        self.url = f"http://{address}/"
        self.open()
