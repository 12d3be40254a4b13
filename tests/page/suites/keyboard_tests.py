"""The page without a mouse and for a screen reader."""

from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys


class Keyboard(PageCase):
    def setUp(self):
        super().setUp()
        self.start_mock()
        self.open()

    def test_help_and_tabs(self):
        self.press("?")
        self.wait_for_text("#help-dialog", "view for a wall screen")
        self.press(Keys.ESCAPE)
        wait_until(lambda: not self.find("#help-dialog").is_displayed(), "the help is closed")
        for key, name in (("2", "robots"), ("3", "alarms"), ("4", "events"), ("5", "system"), ("1", "plans")):
            self.press(key)
            self.assertTrue(self.find(f"#view-{name}").is_displayed(), name)
            self.assertEqual(self.find(f"#tab-{name}").get_attribute("aria-selected"), "true")

    def test_everything_has_a_name_and_a_visible_focus(self):
        self.run_script("document.activeElement.blur()")
        seen = set()
        for _ in range(60):
            self.press(Keys.TAB)
            if self.run_script("return document.activeElement === document.body"):
                continue  # after the last one
            name, is_visible, label = self.run_script(
                "const node = document.activeElement, style = getComputedStyle(node);"
                "return [node.id || node.className + node.textContent,"
                " style.outlineStyle !== 'none' && style.outlineWidth !== '0px',"
                " (node.getAttribute('aria-label') || node.textContent || node.placeholder || '').trim()]")
            seen.add(name)
            self.assertTrue(is_visible, f"the focus of {name}")
            self.assertTrue(label, name)
        for name in ("find-button", "map", "finished-button", "tab-plans"):
            self.assertIn(name, seen)

    def test_roles(self):
        for tab in self.find_all("[role=tab]"):
            self.assertTrue(self.find(f"#{tab.get_attribute('aria-controls')}"))
        tree = self.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        roles = ("button", "textbox", "searchbox", "tab", "combobox")
        unnamed = [node for node in tree if not node.get("ignored") and node["role"]["value"] in roles
                   and not node.get("name", {}).get("value")]
        self.assertEqual(unnamed, [])

    def test_focus_returns_from_the_detail(self):
        self.run_script("document.querySelector('#plans-active .row').focus()")
        self.press(Keys.ENTER)
        wait_until(lambda: self.find("#detail").is_displayed(), "the detail")
        self.press(Keys.ESCAPE)
        self.assertIn("plan-row", self.run_script("return document.activeElement.className"))


class Lists(PageCase):
    """Focus and clicks in a list whose rows come, go and change places."""

    def setUp(self):
        super().setUp()
        self.mock = self.start_mock()
        self.mock.simulation.advance(0.2)
        self.mock.freeze()

    def watch(self, selector):
        """Notes the ids of the rows that leave the list, also if they return."""
        self.run_script("window.removed = []; window.observer?.disconnect(); window.observer = new MutationObserver((changes) =>"
                        "changes.forEach((change) => change.removedNodes.forEach((row) => window.removed.push(row.dataset.id))));"
                        "window.observer.observe(document.querySelector(arguments[0]), {childList: true})", selector)

    def list_rows(self, selector):
        return self.run_script("return [...document.querySelectorAll(`${arguments[0]} > li`)].map((row) => row.dataset.id)",
                               selector)

    def focus(self, selector, id):
        self.run_script("[...document.querySelectorAll(`${arguments[0]} > li`)].find((row) => row.dataset.id === arguments[1])"
                        ".querySelector('button').focus()", selector, id)

    def get_focused_row(self):
        return self.run_script("return document.activeElement.closest('li')?.dataset.id ?? null")

    def change_robot(self, robot_id, status):
        with self.mock.lock:
            self.mock.simulation.fix(robot_id, status)
            self.mock.publish()

    def test_the_first_row_goes(self):
        self.open()
        rows = self.list_rows("#plans-active")
        self.assertGreater(len(rows), 2)
        self.watch("#plans-active")
        self.focus("#plans-active", rows[1])
        with self.mock.lock:
            self.mock.simulation.end_plan(self.mock.simulation.plans[rows[0]], "Completed")
            self.mock.publish()
        wait_until(lambda: rows[0] not in self.list_rows("#plans-active"), "the plan has ended")
        self.assertEqual(self.list_rows("#plans-active"), rows[1:])
        self.assertEqual(self.get_focused_row(), rows[1])
        self.assertEqual(self.run_script("return window.removed"), rows[:1])

    def test_a_robot_falls_from_the_top_and_rises(self):
        """Only its row moves, and keeps the focus."""
        robots = "#view-robots .rows"
        self.open()
        self.click("#tab-robots")
        calm = self.list_rows(robots)
        moving = calm[3]
        top = [moving, *(robot_id for robot_id in calm if robot_id != moving)]
        for focused in (calm[0], moving):
            for status, expected in (("Error", top), ("Idle", calm)):
                self.focus(robots, focused)
                self.watch(robots)
                self.change_robot(moving, status)
                wait_until(lambda rows=expected: self.list_rows(robots) == rows, f"{moving} is {status}")
                self.assertEqual(self.get_focused_row(), focused)
                self.assertEqual(self.run_script("return window.removed"), [moving])
