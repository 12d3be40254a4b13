"""What the tests of the live page share: one browser for all, a mock for each test, and waiting with a limit."""

import threading
import time
import unittest

from browser import Browser
from mock_acsd import MockAcsd
from selenium.common.exceptions import StaleElementReferenceException, WebDriverException
from selenium.webdriver import ActionChains
from selenium.webdriver.common.by import By

WAIT_SECONDS = 30


def wait_until(get, what):
    """The first answer of get that is true."""
    never, end = threading.Event(), time.monotonic() + WAIT_SECONDS
    while True:
        try:
            found = get()
        except (StaleElementReferenceException, IndexError, KeyError):
            found = None
        if found:
            return found
        if time.monotonic() > end:
            raise AssertionError(f"not within {WAIT_SECONDS} s: {what}")
        never.wait(0.05)


class PageCase(unittest.TestCase):
    """url: of a real acsd; None: a mock."""

    url = None
    size = (1366, 768)
    browser = None

    @classmethod
    def setUpClass(cls):
        PageCase.browser = PageCase.browser or Browser(*cls.size)

    @staticmethod
    def close_browser():
        if PageCase.browser is not None:
            PageCase.browser.close()
            PageCase.browser = None

    def setUp(self):
        self.driver = self.browser.driver
        self.browser.resize(*self.size)
        self.browser.read_log()
        self.expected_log = ()

    def tearDown(self):
        """Errors in the console of the browser fail the test: an exception of the page, or what the policy has refused."""
        expected = ("/v1/trace", *self.expected_log)  # 404 without --trace
        log = [line for line in self.browser.read_log() if not any(text in line for text in expected)]
        self.driver.execute_script("localStorage.clear()")
        self.driver.delete_all_cookies()
        self.driver.get("about:blank")
        self.assertEqual(log, [])

    def hold_answers(self):
        """Returns the event that lets acsd execute commands."""
        may_answer, post = threading.Event(), self.mock.post
        self.addCleanup(may_answer.set)

        def answer_late(*arguments):
            may_answer.wait()
            return post(*arguments)

        self.mock.post = answer_late
        return may_answer

    def start_mock(self, **options):
        self.mock = MockAcsd(**options)
        self.enterContext(self.mock)
        self.base = f"http://{self.mock.address}/"
        return self.mock

    def open(self, address="?lang=en", is_live=True):
        self.driver.get("about:blank")
        self.driver.get((self.url or self.base) + address)
        wait_until(lambda: self.run_script("return globalThis.acsdPage !== undefined"), "the page runs")
        if is_live:
            self.wait_for_state("live")

    def wait_for_state(self, name):
        wait_until(lambda: self.run_script("return acsdPage.feedState.name") == name, f"the connection is {name}")

    def run_script(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def find_all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def get_text(self, selector):
        """As it is shown."""
        found = self.find_all(selector)
        return " ".join(node.text for node in found if node.is_displayed())

    def wait_for_text(self, selector, text):
        wait_until(lambda: text in self.get_text(selector), f"{selector} shows {text!r}")

    def click(self, selector):
        def try_click():
            try:
                found = [node for node in self.find_all(selector) if node.is_displayed() and node.is_enabled()]
                found[0].click()
                return True
            except WebDriverException:
                return False

        wait_until(try_click, f"{selector} can be clicked")

    def click_button(self, text, inside="#detail"):
        def try_click():
            try:
                buttons = self.find_all(f"{inside} button")
                next(button for button in buttons if button.is_displayed() and button.text == text).click()
                return True
            except (StopIteration, WebDriverException):
                return False

        wait_until(try_click, f"the button {text} of {inside} can be clicked")

    def press(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()

    def click_floor(self, x, y):
        """A place in metres."""
        offset = self.run_script(
            "const layer = acsdPage.floor.robotLayer, box = layer.map.getContainer().getBoundingClientRect();"
            "return [box.left + layer.toX(arguments[0]), box.top + layer.toY(arguments[1])]", x, y)
        for kind in ("mousePressed", "mouseReleased"):
            self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {
                "type": kind, "x": offset[0], "y": offset[1], "button": "left", "clickCount": 1})

    def wait_for_post(self, path, body=None):
        """The POST with this path; its key, and no other request, is checked here."""
        def get():
            with self.mock.lock:
                return next((post for post in self.mock.posts if post[0] == path), None)

        post = wait_until(get, f"POST {path}")
        self.assertEqual(post[1], body)
        self.assertRegex(post[2] or "", r"^[A-Za-z0-9._-]{1,64}$")
        return post

    def list_posts(self):
        with self.mock.lock:
            return list(self.mock.posts)


