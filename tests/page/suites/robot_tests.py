"""What an operator does with a robot."""

import threading

from mock_acsd import Refusal
from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys


class Carriers(PageCase):
    """What a robot carries, and how an operator corrects it."""

    def start_with_carriers(self, *carrier_ids):
        """LR01 has a port for each and stays where it is."""
        mock = self.start_mock()
        with mock.lock:
            robot = mock.simulation.robots["LR01"]
            robot.is_fixed = True
            robot.ports = [f"LR01.CP0{i + 1}" for i in range(len(carrier_ids))]
        self.set_carriers(*carrier_ids)
        return mock

    def set_carriers(self, *carrier_ids):
        with self.mock.lock:
            self.mock.simulation.robots["LR01"].carrier_ids = list(carrier_ids)
            self.mock.simulation.changed_robots.add("LR01")
            self.mock.publish()

    def test_carriers_are_corrected(self):
        """A port that was not edited keeps what a plan has recorded while the dialog was open."""
        self.start_with_carriers("C_0", None)
        self.open("?lang=en#robot/LR01")
        self.set_carriers("C_1", None)
        self.wait_for_text("#detail .ports", "C_1")
        self.click_button("Correct carriers")
        self.wait_for_text("#confirm-dialog", "LR01.CP02")
        self.assertEqual([self.find(f"#port-{i}").get_attribute("value") for i in range(2)], ["C_1", ""])
        self.set_carriers("C_9", None)
        self.wait_for_text("#detail .ports", "C_9")
        self.find("#port-1").send_keys(" C_2 ", Keys.ENTER)
        self.assertEqual(self.list_posts(), [])
        self.press(Keys.ENTER)
        self.wait_for_post("/v1/robots/LR01/carriers", {"carrierIds": ["C_9", "C_2"]})
        self.wait_for_text("#detail .ports", "C_2")

    def test_carriers_are_current_after_a_snapshot(self):
        self.start_with_carriers("C_0", None)
        self.open("?lang=en#robot/LR01")
        self.wait_for_text("#detail .ports", "C_0")
        self.run_script("window.firstRobots = acsdPage.model.robots")
        self.mock.send_reset()
        wait_until(lambda: self.run_script("return acsdPage.model.robots !== window.firstRobots"), "the new snapshot")
        self.set_carriers("C_9", None)
        self.wait_for_text("#detail .ports", "C_9")
        self.click_button("Correct carriers")
        self.assertEqual(self.find("#port-0").get_attribute("value"), "C_9")
        self.find("#port-1").send_keys("C_2")
        self.click("#confirm-action")
        self.wait_for_post("/v1/robots/LR01/carriers", {"carrierIds": ["C_9", "C_2"]})

    def test_carriers_are_removed_or_confirmed(self):
        self.start_with_carriers("C_1")
        self.open("?lang=en#robot/LR01")
        for entered, expected in ((None, "C_1"), ("", None)):
            self.click_button("Correct carriers")
            if entered is not None:
                self.find("#port-0").clear()
            self.click("#confirm-action")
            wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "the dialog is closed")
            wait_until(lambda value=expected: self.list_posts()[-1:] and self.list_posts()[-1][1] == {"carrierIds": [value]},
                       f"{expected} is sent")
        self.wait_for_text("#detail .ports", "empty")
        self.click_button("Correct carriers")
        self.find("#port-0").send_keys("x" * 129)
        self.click("#confirm-action")
        self.assertTrue(self.find("#confirm-dialog").is_displayed(), "an id that is too long is refused")
        self.click_button("Back", "#confirm-dialog")
        self.assertEqual(len(self.list_posts()), 2)

    def test_a_remedy_offers_to_correct_the_carriers(self):
        mock = self.start_with_carriers("C_1")
        with mock.lock:
            mock.simulation.set_alarm("LR01", "ACS-1004", "light", "A port is taken.", "Port taken", "",
                                      "Then correct the record with `acsctl carriers LR01`.")
        self.open()
        self.click("#tab-alarms")
        self.click_button("Correct carriers", "#view-alarms")
        self.assertEqual(self.find("#port-0").get_attribute("value"), "C_1")
        self.click("#confirm-action")
        self.wait_for_post("/v1/robots/LR01/carriers", {"carrierIds": ["C_1"]})


class Detail(PageCase):
    """Where a robot is."""

    def test_a_place_just_below_zero_has_no_sign(self):
        mock = self.start_mock()
        mock.freeze()
        for x, y, theta, text in ((-0.004, -0.001, -0.004, "x 0.00 m, y 0.00 m, 0°"),
                                  (-0.006, -1.25, -0.02, "x -0.01 m, y -1.25 m, -1°")):
            with mock.lock:
                robot = mock.simulation.robots["LR01"]
                robot.x, robot.y, robot.theta = x, y, theta
            self.open("?lang=en#robot/LR01")
            self.wait_for_text("#detail .facts", text)


class Actions(PageCase):
    """Commands to a robot: maintenance and instant actions."""

    def open_actions(self, robot_id="LR01"):
        self.open(f"?lang=en#robot/{robot_id}")
        self.click_button("Show", "#detail .actions")
        wait_until(lambda: self.find_all("#detail .actions .row-buttons button"), "the actions are offered")

    def test_instant_actions(self):
        """They are offered with their parameters, sent after a question, and shown with their outcome."""
        mock = self.start_mock()
        self.open("?lang=en#robot/LR01")
        self.click_button("Show", "#detail .actions")
        self.click_button("initPosition", "#detail .actions")
        self.wait_for_text("#confirm-dialog", "Sets the position of the vehicle.")
        self.wait_for_text("#confirm-dialog", "count (INTEGER, optional)")
        self.find("#parameter-2").send_keys("7", Keys.ENTER)  # a string, although it is a number
        self.click("#confirm-action")  # x is missing
        self.assertTrue(self.find("#confirm-dialog").is_displayed())
        self.find("#parameter-0").send_keys("1.5")
        self.find("#confirm-reason").send_keys("moved by hand")
        self.assertEqual(self.list_posts(), [])
        self.click("#confirm-action")
        self.wait_for_post("/v1/robots/LR01/actions", {
            "actionType": "initPosition", "parameters": {"x": 1.5, "lastNodeId": "7"}, "reason": "moved by hand"})
        self.wait_for_text("#detail .actions", "waiting")
        mock.end_action("LR01", "Failed", "the position is unknown")
        self.wait_for_text("#detail .actions", "failed")
        self.wait_for_text("#detail .actions", "the position is unknown · moved by hand")
        self.click_button("stateRequest", "#detail .actions")
        self.click_button("Back", "#confirm-dialog")
        self.click_button("stateRequest", "#detail .actions")
        self.click("#confirm-action")
        wait_until(lambda: [body for _, body, _ in self.list_posts()][1:] == [{"actionType": "stateRequest", "parameters": {}}],
                   "the second action is sent, the one that was cancelled is not")

    def test_the_reason_of_an_action_has_at_most_500_bytes(self):
        self.start_mock()
        self.open_actions()
        self.click_button("stateRequest", "#detail .actions")
        self.find("#confirm-reason").send_keys("가" * 167)
        self.click("#confirm-action")
        self.assertTrue(self.find("#confirm-dialog").is_displayed(), "a reason that is too long is refused")
        self.assertEqual(self.list_posts(), [])
        self.find("#confirm-reason").send_keys(Keys.BACKSPACE)
        self.click("#confirm-action")
        self.wait_for_post("/v1/robots/LR01/actions", {
            "actionType": "stateRequest", "parameters": {}, "reason": "가" * 166})

    def test_a_refused_command_keeps_what_was_entered(self):
        """The dialog shows the reason, stays until acsd accepts the command, and needs no other one after a new login."""
        self.expected_log = ("/v1/robots/LR01", "/v1/site/block", "/v1/events")
        mock = self.start_mock()
        post, refusal = mock.post, None

        def refuse(*arguments):
            if refusal is not None:
                raise refusal
            return post(*arguments)

        mock.post = refuse
        self.open_actions()
        self.click_button("initPosition", "#detail .actions")
        self.find("#parameter-0").send_keys("1.5")
        self.find("#parameter-2").send_keys("N1")
        self.find("#confirm-reason").send_keys("moved by hand")
        for refusal in (Refusal(400, "x must be negative."), Refusal(409, "LR01 is not connected.")):
            self.click("#confirm-action")
            self.wait_for_text("#confirm-dialog [role=alert]", str(refusal))
        refusal = Refusal(401, "A token is required.")
        self.click("#confirm-action")
        wait_until(lambda: self.find("#login-dialog").is_displayed(), "the login")
        refusal, mock.token = None, "s3cret"
        self.press("s3cret", Keys.ENTER)
        wait_until(lambda: not self.find("#login-dialog").is_displayed(), "the user has logged in")
        self.assertEqual(self.get_text("#confirm-dialog [role=alert]"), "")
        self.assertEqual(self.list_posts(), [])
        self.click("#confirm-action")
        self.wait_for_post("/v1/robots/LR01/actions", {
            "actionType": "initPosition", "parameters": {"x": 1.5, "lastNodeId": "N1"}, "reason": "moved by hand"})
        wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "acsd has accepted it")

        refusal = Refusal(400, "Unknown carrier.")
        self.click_button("Correct carriers")
        self.find("#port-0").send_keys("C_7")
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", "Unknown carrier.")
        self.assertTrue(self.find("#port-0").get_attribute("value").endswith("C_7"))
        self.press(Keys.ESCAPE)
        wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "the user goes back")
        self.run_script("acsdPage.select({kind: 'node', id: 'N020'})")
        self.click_button("Block")
        self.find("#confirm-reason").send_keys("wet floor")
        refusal = Refusal(400, "The reason is too short.")
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", "The reason is too short.")
        self.assertEqual(self.find("#confirm-reason").get_attribute("value"), "wet floor")
        self.assertEqual(len(self.list_posts()), 1)

    def test_a_command_whose_dialog_was_left_runs_on(self):
        """Its button cannot be pressed again until acsd has answered, and a dialog that was opened meanwhile stays."""
        self.expected_log = ("/maintenance",)
        mock = self.start_mock()
        mock.freeze()
        may_answer = threading.Event()
        self.addCleanup(may_answer.set)
        with mock.lock:
            mock.simulation.robots["LR01"].is_in_maintenance = True

        def refuse(*_):
            may_answer.wait()
            raise Refusal(409, "LR01 is not connected.")

        mock.post = refuse
        self.open("?lang=en#robot/LR01")
        self.click_button("Maintenance off")
        self.click("#confirm-action")
        self.press(Keys.ESCAPE)
        wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "the user goes back")
        button = next(button for button in self.find_all("#detail button") if button.text == "Maintenance off")
        self.click_button("Correct carriers")
        self.assertFalse(button.is_enabled(), "the command runs")
        may_answer.set()
        self.wait_for_text("#toasts", "LR01 is not connected.")
        wait_until(button.is_enabled, "acsd has answered")
        self.assertTrue(self.find("#port-0").is_displayed())
        self.assertEqual(self.get_text("#confirm-dialog [role=alert]"), "")

    def test_parameters_have_at_most_8000_bytes(self):
        """Keys and values together, as acsd counts them."""
        self.start_mock()
        self.open_actions()
        self.click_button("initPosition", "#detail .actions")
        set_value = ("const input = document.getElementById(arguments[0]); input.value = arguments[1];"
                     "input.dispatchEvent(new Event('input', {bubbles: true}))")
        rest = 8_000 - len('x1.5' 'count7' 'lastNodeId""')
        for name, value in (("0", "1.5"), ("1", "77"), ("2", "가" * (rest // 3) + "x" * (rest % 3))):
            self.run_script(set_value, f"parameter-{name}", value)
        self.click("#confirm-action")
        self.assertTrue(self.find("#confirm-dialog").is_displayed(), "parameters that are too long are refused")
        self.assertIn("8000", self.run_script("return document.getElementById('parameter-2').validationMessage"))
        self.assertEqual(self.list_posts(), [])
        self.run_script(set_value, "parameter-1", "7")
        self.click("#confirm-action")
        wait_until(lambda: len(self.list_posts()) == 1, "it is sent")

    def test_values_of_parameters_are_sent_as_they_are(self):
        self.start_mock()
        self.open_actions()
        for number, expected in ((".5", 0.5), ("007", 7), ("-0.25", -0.25)):
            self.click_button("tune", "#detail .actions")
            self.find("#parameter-0").send_keys(number)
            self.find("#parameter-1").send_keys('{"n": [1, null]}')
            self.click("#confirm-action")
            wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "it is sent")
            wait_until(lambda value=expected: self.list_posts()[-1:] and self.list_posts()[-1][1]["parameters"] == {
                "__proto__": value, 'a "b"': {"n": [1, None]}}, f"{number} is sent as {expected}")
        for number, text in (("9007199254740993", ""), ("1", "{"), ("1", '{"n": 12345678901234567890}'), ("1", '{"n": 1e999}')):
            self.click_button("tune", "#detail .actions")
            self.find("#parameter-0").send_keys(number)
            self.find("#parameter-1").send_keys(text)
            self.click("#confirm-action")
            self.assertTrue(self.find("#confirm-dialog").is_displayed(), f"{number} {text} is refused")
            self.click_button("Back", "#confirm-dialog")
        self.assertEqual(len(self.list_posts()), 3)

    def test_enter_that_is_held_down_sends_no_action(self):
        self.start_mock()
        self.open_actions()
        self.click_button("initPosition", "#detail .actions")
        self.find("#parameter-2").send_keys("N1")
        self.find("#parameter-0").send_keys("1")
        for is_repeated in (False, True, True):
            self.driver.execute_cdp_cmd("Input.dispatchKeyEvent", {
                "type": "keyDown", "key": "Enter", "code": "Enter", "windowsVirtualKeyCode": 13, "text": "\r",
                "autoRepeat": is_repeated})
        self.assertEqual(self.run_script("return document.activeElement.id"), "confirm-action")
        self.assertTrue(self.find("#confirm-dialog").is_displayed())
        self.assertEqual(self.list_posts(), [])
        self.press(Keys.ENTER)
        wait_until(lambda: len(self.list_posts()) == 1, "a second Enter sends it")

    def test_actions_are_current(self):
        """After a snapshot without events, and when an older answer comes last; without the robot there are none."""
        mock = self.start_mock()
        self.open_actions()
        self.click_button("stateRequest", "#detail .actions")
        self.click("#confirm-action")
        self.wait_for_text("#detail .actions ol", "waiting")
        with mock.lock:
            mock.simulation.robots["LR01"].actions[-1]["status"] = "Finished"
        mock.send_reset()
        self.wait_for_text("#detail .actions ol", "finished")
        self.run_script("const fetched = window.fetch; let held = true; window.fetch = async (...all) => {"
                        "  const answer = await fetched(...all);"
                        "  if (held && String(all[0]).endsWith('/actions')) {"
                        "    held = false; await new Promise((go) => { window.letGo = go; });"
                        "  }"
                        "  return answer;"
                        "};")
        self.click_button("Refresh", "#detail .actions")
        wait_until(lambda: self.run_script("return window.letGo !== undefined"), "the first answer is held")
        mock.end_action("LR01", "Failed", "the newest")
        self.run_script("window.letGo()")
        self.wait_for_text("#detail .actions ol", "the newest")
        with mock.lock:
            robot = mock.simulation.robots.pop("LR01")
        mock.send_reset()
        wait_until(lambda: not self.find("#detail .actions").is_displayed(), "a robot that is gone has no actions")
        with mock.lock:
            mock.simulation.robots["LR01"] = robot
        mock.send_reset()
        wait_until(lambda: "Maintenance on" in self.get_text("#detail button"), "it is back")

    def test_maintenance_and_tsc(self):
        self.start_mock()
        self.open("?lang=en#robot/LR01")
        self.click_button("Maintenance on")
        self.wait_for_post("/v1/robots/LR01/maintenance", {"on": True})
        self.click_button("Maintenance off")
        self.click("#confirm-action")
        wait_until(lambda: self.list_posts()[-1][1] == {"on": False}, "maintenance is off")
        self.click_button("Pause TSC", "#strip")
        self.wait_for_post("/v1/tsc/pause")
        self.wait_for_text("#strip-tsc", "Paused")
        self.click_button("Resume TSC", "#strip")
        self.click("#confirm-action")
        self.wait_for_post("/v1/tsc/resume")
        self.wait_for_text("#strip-tsc", "Auto")
