"""Alarms and their remedies."""

import threading

from page_case import PageCase, wait_until


class Alarms(PageCase):
    def test_an_alarm_appears_and_clears(self):
        mock = self.start_mock()
        self.open()
        with mock.lock:
            mock.simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01 is disconnected.", "Robot disconnected", "No state.",
                                      "Check the network.", minutes=3)
            mock.publish()
        self.wait_for_text("#strip-alarms", "1 heavy")
        self.click("#tab-alarms")
        for text in ("Robot disconnected", "LR01 is disconnected.", "No state.", "Check the network.", "3 min"):
            self.wait_for_text("#view-alarms", text)
        self.assertEqual(self.driver.title, "(1) acsd")
        self.click_button("Clear alarm", "#view-alarms")
        self.click("#confirm-action")
        self.wait_for_post("/v1/alarms/clear", {"robotId": "LR01", "errorCode": "ACS-1002"})
        self.wait_for_text("#view-alarms", "No alarms.")

    def test_a_background_tab_shows_heavy_alarms_in_its_title(self):
        mock = self.start_mock()
        mock.freeze()
        self.open()
        self.run_script("Object.defineProperty(document, 'hidden', {value: true, configurable: true});"
                        "document.dispatchEvent(new Event('visibilitychange'))")
        with mock.lock:
            mock.simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01 is disconnected.", "Robot disconnected", "", "")
            mock.publish()
        wait_until(lambda: self.driver.title == "(1) acsd", "the title has the number of heavy alarms")
        with mock.lock:
            mock.simulation.clear_alarms("LR01", "ACS-1002")
            mock.publish()
        wait_until(lambda: self.driver.title == "acsd", "the alarm has ended")

    def test_heavy_alarms_come_first_and_look_heavy(self):
        mock = self.start_mock()
        with mock.lock:
            mock.simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01 is disconnected.", "Robot disconnected", "", "", minutes=9)
            mock.simulation.set_alarm("LR02", "ACS-1009", "light", "LR02 does not move.", "Robot stalled", "", "")
        self.open("?lang=en")
        self.click("#tab-alarms")
        list_codes = "return [...document.querySelectorAll('#view-alarms .alarm')].map((row) => row.dataset.id)"
        wait_until(lambda: self.run_script(list_codes) == ["ACS-1002", "ACS-1009"], "the heavy alarm is first")
        for code, level, shape, text in (("ACS-1002", "heavy", "error", "Heavy"), ("ACS-1009", "light", "light", "Light")):
            row = f"#view-alarms .alarm[data-id='{code}']"
            self.assertIn(level, self.find(row).get_attribute("class").split())
            self.assertEqual(self.find(f"{row} .row-glyph svg").get_attribute("data-name"), shape)
            self.assertEqual(self.get_text(f"{row} .alarm-level"), text)
        self.assertIn("heavy", self.find("#tab-alarms .count").get_attribute("class"))
        self.click("#language-button")
        self.wait_for_text("#view-alarms .heavy .alarm-level", "중알람")
        self.assertEqual(self.get_text("#view-alarms .light .alarm-level"), "경알람")

    def test_korean_alarm(self):
        self.start_mock()
        self.open("?lang=ko")
        self.run_script("return import('/page/text.js').then((text) => text.setKoreanAlarms({'ACS-1002': {title: '로봇 통신 끊김', "
                        "cause: '원인 문구', remedy: '조치 문구 `acsctl robot ROBOT`'}}))")
        with self.mock.lock:
            self.mock.simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01 is disconnected.", "Robot disconnected", "", "")
            self.mock.publish()
        self.click("#tab-alarms")
        for text in ("로봇 통신 끊김", "원인 문구", "조치 문구 acsctl robot LR01", "LR01 is disconnected."):
            self.wait_for_text("#view-alarms", text)

    def test_a_command_of_a_remedy_has_its_button(self):
        mock = self.start_mock()
        with mock.lock:
            mock.simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01 is disconnected.", "Robot disconnected", "",
                                      "If the robot has left the floor, run `acsctl maintenance LR01 on`.")
        self.open()
        self.click("#tab-alarms")
        self.click_button("Maintenance on", "#view-alarms")
        self.wait_for_post("/v1/robots/LR01/maintenance", {"on": True})

    def test_buttons_stay_while_another_alarm_comes(self):
        """That with the focus keeps it; that whose command runs cannot be pressed again."""
        mock = self.start_mock()
        mock.freeze()
        with mock.lock:
            simulation = mock.simulation
            simulation.set_alarm("LR02", "ACS-1009", "heavy", "LR02 does not move.", "Robot stalled", "", "", minutes=1)
            simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01 is disconnected.", "Robot disconnected", "",
                                 "If the robot has left the floor, run `acsctl maintenance LR01 on`.", minutes=2)
        self.open()
        self.click("#tab-alarms")
        row = "#view-alarms .alarm[data-id='ACS-1002']"
        self.wait_for_text(row, "Maintenance on")
        self.run_script("const row = document.querySelector(arguments[0]); window.kept = [...row.querySelectorAll('button')];"
                        "row.querySelector('button.link').focus()", row)
        is_kept = ("const found = [...document.querySelector(arguments[0]).querySelectorAll('button')];"
                   "return found.length === window.kept.length && found.every((button, i) => button === window.kept[i])")
        may_answer, post = threading.Event(), mock.post
        self.addCleanup(may_answer.set)

        def answer_late(*arguments):
            may_answer.wait()
            return post(*arguments)

        def change_alarms(change, code):
            """Waits until the list has the alarm with this code, or no longer."""
            is_shown = bool(self.find_all(f"#view-alarms .alarm[data-id='{code}']"))
            with mock.lock:
                change()
                mock.publish()
            wait_until(lambda: bool(self.find_all(f"#view-alarms .alarm[data-id='{code}']")) != is_shown, f"{code} has changed")

        change_alarms(lambda: simulation.set_alarm("CR01", "NEW", "heavy", "", "New", "", ""), "NEW")
        change_alarms(lambda: simulation.clear_alarms("CR01", "NEW"), "NEW")
        change_alarms(lambda: simulation.clear_alarms("LR02", "ACS-1009"), "ACS-1009")
        self.assertTrue(self.run_script(is_kept, row), "the buttons are the same")
        self.assertTrue(self.run_script("return document.activeElement === window.kept[0]"), "the focus stays")
        mock.post = answer_late
        self.click_button("Maintenance on", row)
        change_alarms(lambda: simulation.set_alarm("CR01", "NEW", "heavy", "", "New", "", ""), "NEW")
        named = self.find(f"{row} button[data-path$='/maintenance']")
        self.assertFalse(named.is_enabled(), "the command runs")
        may_answer.set()
        wait_until(named.is_enabled, "acsd has answered")
        self.wait_for_post("/v1/robots/LR01/maintenance", {"on": True})

    def test_buttons_follow_the_remedy_and_the_step(self):
        mock = self.start_mock()
        mock.simulation.advance(0.2)
        mock.freeze()
        remedy = "Run `acsctl maintenance LR01 {}`."
        with mock.lock:
            plan = mock.simulation.robots["LR01"].plan
            alarm = mock.simulation.set_alarm("LR01", "ACS-1009", "light", "", "Stalled", "", remedy.format("on"), plan)
        self.open()
        self.click("#tab-alarms")
        row = "#view-alarms .alarm[data-id='ACS-1009']"
        self.wait_for_text(row, "Maintenance on")
        self.wait_for_text(row, f"{plan.plan_id} / 1")
        with mock.lock:
            alarm.update(remedy=remedy.format("off"), stepNo=2)
            mock.simulation.has_changed_alarms = True
            mock.publish()
        self.wait_for_text(row, "Maintenance off")
        self.wait_for_text(row, f"{plan.plan_id} / 2")
        self.assertNotIn("Maintenance on", self.get_text(row))

    def list_commands(self, code):
        """Those that the alarm with this code names."""
        return [node.text for node in self.find_all(f"#view-alarms .alarm[data-id='{code}'] code")]

    def test_a_remedy_of_acsd_is_shown_as_it_is(self):
        """acsd has filled it; the id of the plan begins with a word that stands for one."""
        mock = self.start_mock()
        with mock.lock:
            plan = next(iter(mock.simulation.plans.values()))
            command = f"acsctl resolve {plan.plan_id} {plan.get_job_id()} done"
            mock.simulation.set_alarm("LR01", "ACS-1008", "heavy", "unknown", "Job outcome unknown", "", f"Run `{command}`.", plan)
        self.open()
        self.click("#tab-alarms")
        self.wait_for_text("#view-alarms", "Job outcome unknown")
        self.assertEqual(self.list_commands("ACS-1008"), [command])

    def test_an_unresolved_job_of_a_plan_that_is_gone(self):
        """Only the alarm has the buttons: acsd keeps a limited number of ended plans."""
        mock = self.start_mock()
        with mock.lock:
            plan = next(iter(mock.simulation.plans.values()))
            remedy = ", ".join(f"`acsctl resolve GONE {plan.get_job_id()} {outcome}`" for outcome in ("done", "failed", "again"))
            alarm = mock.simulation.set_alarm("LR01", "ACS-1008", "heavy", "unknown", "Job outcome unknown", "", remedy, plan)
            alarm["planId"] = "GONE"
        self.open()
        self.click("#tab-alarms")
        row = "#view-alarms .alarm[data-id='ACS-1008']"
        self.wait_for_text(row, "Clear alarm")
        buttons = self.find_all(f"{row} button.button")
        self.assertEqual([button.text for button in buttons], ["Job was done", "Job failed", "Clear alarm"])
        self.assertEqual({button.get_attribute("data-path") for button in buttons[:2]},
                         {f"/v1/plans/GONE/jobs/{plan.get_job_id()}/resolve"})

    def test_ids_in_commands_are_quoted_for_a_shell(self):
        mock = self.start_mock()
        mock.freeze()
        ids = ("A B", "it's", "A`B", "A` `acsctl maintenance CR01 on` `B")
        quoted = ["'" + id.replace("'", r"'\''") + "'" for id in ids]
        commands = [[f"acsctl maintenance {id} on", f"acsctl carriers {id}"] for id in quoted]
        with mock.lock:
            simulation = mock.simulation
            for code, id in enumerate(ids):
                robot = simulation.robots.pop(f"LR0{code + 1}")
                robot.robot_id = id
                simulation.robots[id] = robot
                simulation.set_alarm(id, str(code), "light", "", "", "", "Run `{}`, then `{}`.".format(*commands[code]))
        self.open()
        self.click("#tab-alarms")
        for code, id in enumerate(ids):
            row = f"#view-alarms .alarm[data-id='{code}']"
            self.wait_for_text(row, "Clear alarm")
            self.assertEqual(self.list_commands(code), commands[code])
            self.assertEqual([button.text for button in self.find_all(f"{row} button.button")],
                             ["Maintenance on", "Correct carriers", "Clear alarm"])
            self.click_button("Maintenance on", row)
            self.wait_for_post(f"/v1/robots/{id}/maintenance", {"on": True})

    def test_a_korean_command_is_filled_once_and_quoted(self):
        mock = self.start_mock()
        mock.freeze()
        with mock.lock:
            simulation = mock.simulation
            robot = simulation.robots.pop("LR01")
            robot.robot_id = "PLAN's"
            simulation.robots["PLAN's"] = robot
            alarm = simulation.set_alarm("PLAN's", "ACS-1008", "heavy", "", "", "", "", next(iter(simulation.plans.values())))
            alarm["planId"], alarm["jobId"] = "JOB ROBOT", "J-1._:@%+/,"
        self.open("?lang=ko")
        self.run_script("return import('/page/text.js').then((text) => text.setKoreanAlarms({'ACS-1008': {title: '제목', "
                        "cause: '원인 ROBOT', remedy: '`acsctl maintenance ROBOT on`을 `acsctl resolve PLAN JOB done`'}}))")
        mock.send_reset()
        self.click("#tab-alarms")
        self.wait_for_text("#view-alarms", "원인 ROBOT")
        self.assertEqual(self.list_commands("ACS-1008"), [
            "acsctl maintenance 'PLAN'\\''s' on", "acsctl resolve 'JOB ROBOT' J-1._:@%+/, done"])
        self.click_button("정비 시작", "#view-alarms")
        self.wait_for_post("/v1/robots/PLAN's/maintenance", {"on": True})

    def test_a_phone_opens_heavy_alarms(self):
        mock = self.start_mock()
        self.browser.resize(360, 740, 2, True)
        self.open()
        self.assertTrue(self.find("#view-floor").is_displayed())
        with mock.lock:
            mock.simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01 is disconnected.", "Robot disconnected", "", "")
        self.open()
        wait_until(lambda: self.find("#view-alarms").is_displayed(), "the alarms")
        self.open("?lang=en#robot/LR01")
        self.wait_for_text("#detail-title", "LR01")
