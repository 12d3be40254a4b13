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
