"""The connection to acsd: lost, restored, refused."""

from mock_acsd import Refusal
from mock_floor import format_time, get_now
from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys


class Connection(PageCase):
    def test_reset(self):
        mock = self.start_mock()
        mock.freeze()
        self.open()
        with mock.lock:
            plan = next(iter(mock.simulation.plans.values()))
            plan.lot_id = "LOT_AFTER_RESET"
        mock.send_reset()
        self.wait_for_text("#view-plans", "LOT_AFTER_RESET")

    def test_a_lost_connection_is_shown_and_restored(self):
        self.expected_log = ("net::ERR",)
        mock = self.start_mock()
        self.open()
        mock.is_down = True
        mock.drop_clients()
        self.wait_for_text("#banner", "This page shows the state of")
        self.assertIn("is-old", self.find("body").get_attribute("class"))
        with mock.lock:
            mock.simulation.set_alarm("LR01", "ACS-1009", "light", "meanwhile", "Robot stalled", "", "")
            mock.publish()
        mock.is_down = False
        self.wait_for_state("live")
        self.assertFalse(self.find("#banner").is_displayed())
        self.wait_for_text("#strip-alarms", "1")

    def test_a_standby_is_shown_until_it_leads(self):
        self.expected_log = ("net::ERR", "503")
        mock = self.start_mock()
        self.open()
        mock.standby = "standby: acs2 leads"
        mock.drop_clients()
        self.wait_for_text("#banner", "standby: acs2 leads")
        self.wait_for_text("#live", "Standby")
        self.assertIn("is-old", self.find("body").get_attribute("class"))
        mock.standby = None
        self.wait_for_state("live")
        self.assertFalse(self.find("#banner").is_displayed())

    def test_silence(self):
        mock = self.start_mock()
        self.open()
        mock.is_silent = True
        # The clock of the page is 31 s ahead, again if an event was still on its way.
        def is_shown():
            self.run_script("const now = Date.now; Date.now = () => now() + 31_000")
            return "more than 30 s" in self.get_text("#banner")

        wait_until(is_shown, "the page states that its data is old")
        self.assertIn("is-old", self.find("body").get_attribute("class"))
        mock.is_silent = False
        self.wait_for_state("live")

    def test_acsd_restarts(self):
        """The event ids of the new run are lower."""
        self.expected_log = ("net::ERR",)
        mock = self.start_mock()
        self.open()
        wait_until(lambda: mock._event_id > 5, "events")
        mock.freeze()
        with mock.lock:
            mock._event_id, mock.simulation.robots["LR02"].battery = 1, 3
            mock._events.clear()
        mock.drop_clients()
        wait_until(lambda: self.run_script("return acsdPage.model.robots.get('LR02').battery") == 3, "the snapshot of the new run")

    def test_pages_left_hold_no_connection(self):
        """The browser opens 6 connections to one server."""
        self.start_mock()
        for _ in range(8):
            self.open()
        wait_until(lambda: len(self.mock._clients) == 1 or self.mock.publish(), "one event stream")
        self.driver.back()
        self.driver.back()
        self.wait_for_state("live")

    def test_login(self):
        self.expected_log = ("401",)
        self.start_mock(token="s3cret")
        self.open(is_live=False)
        wait_until(lambda: self.find("#login-dialog").is_displayed(), "the login")
        self.press("wrong", Keys.ENTER)
        self.wait_for_text("#login-dialog", "does not accept")
        self.press("s3cret", Keys.ENTER)
        self.wait_for_state("live")
        self.assertFalse(self.find("#login-dialog").is_displayed())
        self.assertNotIn("s3cret", self.run_script("return document.cookie + JSON.stringify(localStorage)"))
        self.click("#tab-system")
        self.click_button("Log out", "#view-system")
        wait_until(lambda: self.find("#login-dialog").is_displayed(), "the login again")

    def test_a_lost_session(self):
        """The data is old until the next login, and Esc does not close the dialog."""
        self.expected_log = ("401",)
        mock = self.start_mock(token="s3cret")
        self.open(is_live=False)
        wait_until(lambda: self.find("#login-dialog").is_displayed(), "the login")
        self.press("s3cret", Keys.ENTER)
        self.wait_for_state("live")
        mock.token = "renewed"
        mock.drop_clients()
        self.wait_for_state("login")
        self.wait_for_text("#banner", "acsd requires a login.")
        self.wait_for_text("#banner", "This page shows the state of")
        self.assertIn("is-old", self.find("body").get_attribute("class"))
        for _ in range(3):
            self.press(Keys.ESCAPE, Keys.ESCAPE)
            wait_until(lambda: self.run_script("return document.activeElement.id") == "login-token", "the login is still open")
        self.press("renewed", Keys.ENTER)
        self.wait_for_state("live")
        self.assertFalse(self.find("#banner").is_displayed())
        self.assertFalse(self.find("#login-dialog").is_displayed())

    def block(self, node_id):
        """The answer about the site has it from now on."""
        with self.mock.lock:
            self.mock.simulation.floor.blocks[("node", node_id)] = {
                "kind": "node", "id": node_id, "reason": "", "since": format_time(get_now())}
            self.mock.site_revision += 1
            self.mock.publish()
            return self.mock.site_revision

    def is_blocked(self, node_id):
        return self.run_script("return acsdPage.model.findBlock('node', arguments[0]) !== null", node_id)

    def test_an_older_answer_about_the_site(self):
        """It does not replace a newer one."""
        self.start_mock()
        self.mock.freeze()
        self.open()
        first, second = list(self.mock.simulation.floor.places)[:2]
        self.run_script(
            "const send = window.fetch; window.held = null; window.fetch = async (path, ...rest) => {"
            "  const answer = await send(path, ...rest);"
            "  if (path !== '/v1/site' || window.held !== null) { return answer; }"
            "  const text = await answer.text();"
            "  return new Promise((go) => { window.held = () => go(new Response(text, answer)); });"
            "};")
        self.block(first)
        wait_until(lambda: self.run_script("return window.held !== null"), "the first answer is held")
        revision = self.block(second)
        wait_until(lambda: self.run_script("return acsdPage.model.status.siteRevision") == revision, "the second change is known")
        self.run_script("return new Promise((go) => setTimeout(go, 500))")
        self.run_script("window.held(); return new Promise((go) => setTimeout(go, 100))")
        wait_until(lambda: self.is_blocked(first) and self.is_blocked(second), "both are blocked")

    def test_the_site_is_loaded_again_after_a_failure(self):
        self.expected_log = ("/v1/site",)
        self.start_mock()
        self.mock.freeze()
        self.open()
        node_id = next(iter(self.mock.simulation.floor.places))
        get, refused = self.mock.get, []

        def refuse(path, query):
            if path == "/v1/site":
                refused.append(path)
                raise Refusal(503, "acsd is busy.")
            return get(path, query)

        self.mock.get = refuse
        self.block(node_id)
        wait_until(lambda: refused, "the request fails")
        self.mock.get = get
        wait_until(lambda: self.is_blocked(node_id), "it is blocked")
        self.assertEqual(self.run_script("return acsdPage.feedState.name"), "live")
