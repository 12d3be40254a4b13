"""What holds for every acsd, and the header of the page."""

from datetime import timedelta

from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys


class AnyAcsd(PageCase):
    """What holds for every acsd with robots at work, also a real one (--url)."""

    def setUp(self):
        super().setUp()
        if self.url is None:
            self.start_mock()

    def test_both_languages_and_themes(self):
        self.open("?lang=ko&theme=dark")
        self.assertEqual(self.find("html").get_attribute("lang"), "ko")
        self.assertEqual(self.find("html").get_attribute("data-theme"), "dark")
        self.wait_for_text("#tab-robots", "로봇")
        self.click("#language-button")
        self.wait_for_text("#tab-robots", "Robots")
        self.click("#theme-button")
        wait_until(lambda: self.find("html").get_attribute("data-theme") == "light", "the theme is light")
        self.assertNotIn(".", self.get_text("#tabs"), "a text is missing")

    def test_every_robot_is_listed(self):
        self.open()
        count = self.run_script("return acsdPage.model.robots.size")
        self.assertGreater(count, 0)
        self.click("#tab-robots")
        wait_until(lambda: len(self.find_all("#view-robots li")) == count, f"{count} robots are listed")

    def test_robots_move(self):
        self.open()
        get_places = "return JSON.stringify([...acsdPage.floor.robotLayer.motions.values()].map((motion) => motion.shown))"
        first = self.run_script(get_places)
        self.assertNotEqual(first, "[]")
        wait_until(lambda: self.run_script(get_places) != first, "a robot is shown elsewhere")

    def test_tsc(self):
        self.open()
        self.click_button("Pause TSC", "#strip")
        self.wait_for_text("#toasts", "TSC")
        wait_until(lambda: self.get_text("#strip-tsc .cell-value") in ("Pausing", "Paused"), "the TSC pauses")
        self.click_button("Resume TSC", "#strip")
        self.click("#confirm-action")
        wait_until(lambda: self.get_text("#strip-tsc .cell-value") == "Auto", "the TSC is Auto")

    def test_phone(self):
        self.browser.resize(360, 740, 2, True)
        self.open()
        for name in ("floor", "plans", "robots", "alarms", "events", "system"):
            self.click(f"#tab-{name}")
            wait_until(lambda shown=name: self.find(f"#view-{shown}").is_displayed(), f"{name} is shown")
            self.assertEqual(self.find("#map").is_displayed(), name == "floor")
            self.assertLessEqual(self.run_script("return document.documentElement.scrollWidth"), 360, name)
            self.assertLessEqual(self.run_script(f"return document.getElementById('view-{name}').scrollWidth"), 360, name)

    def test_robot_by_keyboard(self):
        self.open()
        robot_id = self.run_script("return [...acsdPage.model.robots.keys()][0]")
        self.press("/")
        wait_until(lambda: self.find("#find-dialog").is_displayed(), "the search is open")
        self.press(robot_id)
        self.wait_for_text("#find-results", robot_id)
        self.press(Keys.ENTER)
        self.wait_for_text("#detail-title", robot_id)
        self.press(Keys.ESCAPE)
        wait_until(lambda: not self.find("#detail").is_displayed(), "the detail is closed")

    def test_an_instant_action(self):
        self.open()
        robot_id = self.run_script("return [...acsdPage.model.robots.keys()].sort()[0]")
        self.open(f"?lang=en#robot/{robot_id}")
        self.click_button("Show", "#detail .actions")
        self.click_button("stateRequest", "#detail .actions")
        self.click("#confirm-action")
        self.wait_for_text("#toasts", "stateRequest is sent")
        self.wait_for_text("#detail .actions ol", "waiting" if self.url is None else "finished")

    def test_wall(self):
        self.browser.resize(1920, 1080)
        self.open("?lang=en#wall")
        wait_until(lambda: self.find("#view-alarms").is_displayed() and self.find("#view-plans").is_displayed(), "plans and alarms")
        buttons = self.find_all("button.button, button.icon-button")
        self.assertEqual([button.text for button in buttons if button.is_displayed()], [])
        self.assertGreaterEqual(self.run_script("return parseFloat(getComputedStyle(document.documentElement).fontSize)"), 20)
        self.press("w")
        wait_until(lambda: self.find("#tabs").is_displayed(), "the tabs are back")


class Header(PageCase):
    """The strip at the top, and the view of acsd itself."""

    def setUp(self):
        super().setUp()
        self.mock = self.start_mock()
        self.mock.freeze()

    def test_the_other_language_has_all_states(self):
        with self.mock.lock:
            self.mock.links[1].update(up=False, reason="connection refused")
            self.mock.simulation.fix("LR01", "Disconnected")
        self.open()
        self.wait_for_text("#strip-links", "MQTT")
        get_shapes = "return [...document.querySelectorAll('#strip-robots svg')].map((glyph) => glyph.dataset.name)"
        shapes = self.run_script(get_shapes)
        self.assertIn("disconnected", shapes)
        for label, robots in (("통신", "통신 끊김"), ("Links", "Disconnected")):
            self.click("#language-button")
            self.wait_for_text("#strip-links", label)
            self.assertIn("MQTT", self.get_text("#strip-links"))
            self.assertEqual(len(self.find_all("#strip-links .link-state.down")), 1)
            self.assertEqual(self.run_script(get_shapes), shapes)
            self.assertEqual(self.find("#strip-robots .mini").get_attribute("title"), robots)

    def test_a_link_that_is_up_is_not_red(self):
        with self.mock.lock:
            self.mock.links[1].update(up=False, reason="connection refused")
        self.open()
        wait_until(lambda: self.find_all("#strip-links .down"), "the link is down")
        get_colour = "return getComputedStyle(document.querySelector(arguments[0])).color"
        up, down = (self.run_script(get_colour, f"#strip-links .link-state{kind}") for kind in (":not(.down)", ".down"))
        self.assertNotEqual(up, down)

    def test_no_log_out_without_a_login(self):
        self.open()
        self.click("#tab-system")
        self.wait_for_text("#view-system", "Version")
        self.assertNotIn("Log out", self.get_text("#view-system"))
        self.assertEqual([node for node in self.find_all("#view-system .session") if node.is_displayed()], [], "nor its frame")

    def test_the_system_view_explains_refused_reports(self):
        last = {"command": "ErrorReport", "planId": None, "message": "unknown code", "retried": False}
        with self.mock.lock:
            self.mock.refused.update(count=1, last=last)
        self.open("?lang=en")
        self.click("#tab-system")
        for text in ("ErrorReport · unknown code", "Refused reports are not sent again.",
                     "Correct the cause in the MCS; its log has the reason."):
            self.wait_for_text("#view-system", text)
        with self.mock.lock:
            self.mock.refused.update(last={**last, "planId": "P1", "retried": True})
        for text in ("Refused reports are sent again after the next registration.", "Correct the plan in the MCS; its log has the reason."):
            self.wait_for_text("#view-system", text)

    def test_the_system_view_names_the_connected_broker(self):
        self.open()
        self.click("#tab-system")
        self.wait_for_text("#view-system", "mqtt://broker-1.example:1883")

    def test_what_is_not_reported_yet_is_no_fault(self):
        describe = self.mock.describe_status
        self.mock.describe_status = lambda: {**describe(), "isConnected": None}
        for language, text in (("ko", "아직 보고하지 않음"), ("en", "not reported yet")):
            self.open(f"?lang={language}")
            self.click("#tab-system")
            self.wait_for_text("#view-system", text)
            self.assertEqual(self.find_all("#view-system .state.bad"), [])
        self.mock.describe_status = describe
        self.wait_for_text("#view-system .state.good", "connected")
        with self.mock.lock:
            self.mock.links[1].update(up=False, reason="connection refused")
        self.wait_for_text("#view-system .state.bad", "not connected")

    def test_placeholders_are_not_cut(self):
        for language in ("en", "ko"):
            self.open(f"?lang={language}")
            for tab in ("plans", "robots"):
                self.click(f"#tab-{tab}")
                is_cut = self.run_script("const field = document.querySelector(arguments[0]); field.value = field.placeholder;"
                                         "const isCut = field.scrollWidth > field.clientWidth; field.value = ''; return isCut",
                                         f"#view-{tab} .filter")
                self.assertFalse(is_cut, (language, tab))

    def test_the_time_since_the_start_counts_on(self):
        with self.mock.lock:
            self.mock.started_at -= timedelta(minutes=5)
        self.open()
        self.click("#tab-system")
        self.wait_for_text("#view-system", "(5 min ago)")
        # An event with a new status; then three minutes pass.
        with self.mock.lock:
            self.mock.outbox["reports"] = 3
            self.mock.publish()
        self.wait_for_text("#view-system", "3 reports")
        self.assertNotIn("NaN", self.get_text("#view-system"))
        self.run_script("const now = Date.now; Date.now = () => now() + 180_000")
        self.wait_for_text("#view-system", "(8 min ago)")
        self.click("#language-button")
        self.wait_for_text("#view-system", "(8분 전)")


class Language(PageCase):
    """What the user has set stays when the language is switched."""

    def setUp(self):
        super().setUp()
        self.start_mock(robots=30)
        self.mock.simulation.advance(0.2)
        self.mock.freeze()

    def test_filters(self):
        self.open()
        for tab, wanted in (("plans", "-003"), ("robots", "lr02")):
            self.click(f"#tab-{tab}")
            rows = f"#view-{tab} .rows li"
            self.find(f"#view-{tab} .filter").send_keys(wanted)
            wait_until(lambda: len(self.find_all(rows)) == 1, "one is listed")
        for language in ("ko", "en"):
            self.click("#language-button")
            wait_until(lambda: self.find("html").get_attribute("lang") == language, language)
            for tab, wanted in (("plans", "-003"), ("robots", "lr02")):
                self.click(f"#tab-{tab}")
                self.assertEqual(self.find(f"#view-{tab} .filter").get_attribute("value"), wanted)
                self.assertEqual(len(self.find_all(f"#view-{tab} .rows li")), 1)

    def check_scrolled(self, selector, tab_text):
        get_top = f"return document.querySelector('{selector}').scrollTop"
        self.run_script(f"document.querySelector('{selector}').scrollTop = 150")
        self.assertEqual(self.run_script(get_top), 150)
        self.click("#language-button")
        self.wait_for_text("#tabs", tab_text)
        self.assertEqual(self.run_script(get_top), 150)

    def test_scrolled_lists(self):
        self.open()
        for tab in ("plans", "robots"):
            self.click(f"#tab-{tab}")
            wait_until(lambda: len(self.find_all(f"#view-{tab} .rows li")) > 20, "many are listed")
            self.check_scrolled("#panel", "로봇")
            self.check_scrolled("#panel", "Robots")

    def test_a_scrolled_detail(self):
        self.browser.resize(1366, 400)
        plan = self.mock.simulation.robots["LR01"].plan
        self.open(f"?lang=en#plan/{plan.plan_id}")
        self.wait_for_text("#detail .row-buttons", "Pause")
        self.check_scrolled("#detail", "로봇")
        self.wait_for_text("#detail .row-buttons", "일시정지")
        self.assertEqual(self.run_script("return document.querySelector('#detail').scrollTop"), 150)
        self.run_script("acsdPage.select({kind: 'robot', id: 'LR01'})")
        self.assertEqual(self.run_script("return document.querySelector('#detail').scrollTop"), 0, "another detail is at its top")
