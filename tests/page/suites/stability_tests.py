"""Buttons and links stay while what is around them changes: with the focus, a click that has begun, and a command that runs."""

from mock_floor import format_time, get_now
from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys


class Stability(PageCase):
    def setUp(self):
        super().setUp()
        self.start_mock()
        self.simulation = self.mock.simulation
        self.simulation.advance(0.2)
        self.mock.freeze()
        self.robot = self.simulation.robots["LR01"]
        self.plan = self.robot.plan

    def change(self, change):
        with self.mock.lock:
            change()
            self.mock.publish()

    def block(self, kind, id, reason=""):
        self.simulation.floor.blocks[(kind, id)] = {
            "kind": kind, "id": id, "reason": reason, "since": format_time(get_now())}
        self.mock.site_revision += 1

    def select(self, kind, id):
        self.run_script("acsdPage.select({kind: arguments[0], id: arguments[1]})", kind, id)
        self.wait_for_text("#detail-title", id)

    def keep(self, inside, focused):
        """Notes the buttons; the one with this text gets the focus."""
        return self.run_script(
            "window.kept = [...document.querySelectorAll(`${arguments[0]} button`)];"
            "window.focused = window.kept.find((button) => button.textContent === arguments[1]);"
            "window.focused.focus(); return window.kept.map((button) => button.textContent)", inside, focused)

    def check_kept(self, *gone):
        """All but those with these texts."""
        self.assertEqual(self.run_script(
            "return window.kept.filter((button) => !button.isConnected).map((button) => button.textContent)"), list(gone))
        self.assertTrue(self.run_script("return document.activeElement === window.focused"), "the focus stays")

    def move_mouse(self, kind, place):
        self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {
            "type": kind, "x": place[0], "y": place[1], "button": "left", "clickCount": 1})

    def begin_click(self):
        """On the button with the focus. Returns its place."""
        place = self.run_script(
            "window.focused.scrollIntoView({block: 'center'}); const box = window.focused.getBoundingClientRect();"
            "return [box.left + box.width / 2, box.top + box.height / 2]")
        self.move_mouse("mousePressed", place)
        return place

    def end_click(self):
        """Where the button is now."""
        place = self.run_script("const box = window.focused.getBoundingClientRect();"
                                "return [box.left + box.width / 2, box.top + box.height / 2]")
        self.move_mouse("mouseReleased", place)

    def check_it_runs(self, change, may_answer):
        """The button with the focus is still disabled after the change, until acsd has answered."""
        change()
        self.assertTrue(self.run_script("return window.focused.isConnected && window.focused.disabled"), "the command runs")
        may_answer.set()
        wait_until(lambda: self.run_script("return !window.focused.disabled"), "acsd has answered")
        self.assertEqual(len(self.list_posts()), 1)

    def change_plan(self, lot_id, robots, status="Pending"):
        def change():
            self.plan.lot_id, self.plan.steps[1]["status"] = lot_id, status
            self.plan.waits = self.simulation.make_wait(f"It waits for {lot_id}.", None, robots)
            self.simulation.changed_plans.add(self.plan.plan_id)

        self.change(change)
        self.wait_for_text("#detail .facts", f"It waits for {lot_id}.")
        self.wait_for_text("#detail .facts dd", self.plan.lot_id)

    def test_plan(self):
        self.open()
        self.plan.steps[0]["status"] = "InProgress"
        self.change(lambda: self.simulation.set_alarm("LR01", "ACS-1008", "heavy", "", "Unknown", "", "", self.plan))
        self.select("plan", self.plan.plan_id)
        self.change_plan("LOT_1", [("LR02", "busy"), ("CR01", "busy")])
        self.wait_for_text("#detail .jobs", "Job failed")
        shown = self.keep("#detail", "LR02")
        for text in ("CR01", "LR01", "Pause", "Cancel plan", "Job was done", "Skip step", self.plan.steps[0]["position"]):
            self.assertIn(text, shown)
        self.change_plan("LOT_2", [("LR03", "busy"), ("LR02", "charges"), ("CR01", "busy")])
        self.check_kept()
        self.assertIn("LR02 charges", self.get_text("#detail .reasons"))
        self.change_plan("LOT_3", [("CR01", "busy"), ("LR02", "charges")], "Completed")
        self.check_kept("Skip step")  # that of the second step

        self.keep("#detail", "Cancel plan")
        self.begin_click()
        self.change_plan("LOT_4", [])
        self.end_click()
        self.wait_for_text("#confirm-dialog", "Cancel")
        self.click_button("Back", "#confirm-dialog")

        self.keep("#detail", "Pause")
        may_answer = self.hold_answers()
        self.click_button("Pause")
        self.check_it_runs(lambda: self.change_plan("LOT_5", []), may_answer)

    def test_priority(self):
        """The question has the present priority."""
        plan = next(plan for plan in self.simulation.plans.values() if plan.robot_id is None)
        self.open()
        self.select("plan", plan.plan_id)
        self.wait_for_text("#detail button", "Priority")
        self.keep("#detail", "Priority")

        def change():
            plan.priority = 77
            self.simulation.changed_plans.add(plan.plan_id)

        self.change(change)
        self.wait_for_text("#detail .facts", "77")
        self.check_kept()
        self.click_button("Priority")
        self.assertEqual(self.find("#confirm-number").get_attribute("value"), "77")

    def change_outbox(self, reports):
        self.change(lambda: self.mock.outbox.update(reports=reports))
        self.wait_for_text("#view-system", f"{reports} reports")

    def test_system_view(self):
        self.open()
        self.run_script("localStorage.setItem('acsd.session', 'open')")
        self.open()
        self.click("#tab-system")
        for kind, id in (("node", "N020"), ("edge", "N005-N006")):
            self.change(lambda place=(kind, id): self.block(*place))
            self.wait_for_text("#view-system", id)
        for focused in ("Edge N005-N006", "Log out", "Pause TSC"):
            shown = self.keep("#view-system", focused)
            self.assertEqual(shown, ["Pause TSC", "Node N020", "Edge N005-N006", "Log out"])
            self.change_outbox(1 + len(focused))
            self.check_kept()
        self.change(lambda: self.simulation.floor.blocks.pop(("node", "N020")) and self.block("station", "A01.CP01"))
        self.wait_for_text("#view-system", "A01.CP01")
        self.check_kept("Node N020")

        self.keep("#view-system", "Edge N005-N006")
        self.begin_click()
        self.change_outbox(3)
        self.end_click()
        self.wait_for_text("#detail-title", "N005-N006")
        self.run_script("acsdPage.select(null)")

        self.keep("#view-system", "Pause TSC")
        may_answer = self.hold_answers()
        self.click_button("Pause TSC", "#view-system")
        self.check_it_runs(lambda: self.change_outbox(4), may_answer)

    def change_carriers(self, carrier_id, inside="#detail .facts"):
        def change():
            self.robot.carrier_ids = [carrier_id]
            self.simulation.changed_robots.add("LR01")

        self.change(change)
        self.wait_for_text(inside, carrier_id)

    def stop_robot(self):
        """At a station. Returns it."""
        station, node = next(iter(self.simulation.floor.stations.items()))
        self.robot.is_fixed, self.robot.progress, self.robot.route, self.robot.node = True, 0.0, [], node
        self.simulation.changed_robots.add("LR01")
        return station

    def test_station(self):
        station = self.stop_robot()
        self.open()
        self.select("station", station)
        self.change_carriers("C_1")
        self.keep("#detail .detail-body", "LR01")
        self.change_carriers("C_2")
        self.check_kept()

        self.keep("#detail", "Block")
        self.begin_click()
        self.change_carriers("C_3")
        self.end_click()
        self.wait_for_text("#confirm-dialog", "Block station")

        may_answer = self.hold_answers()
        self.click("#confirm-action")
        self.check_it_runs(lambda: self.change_carriers("C_4"), may_answer)

    def test_robot(self):
        """The link to its place is that to the present one."""
        self.stop_robot()
        self.open()
        self.select("robot", "LR01")
        self.wait_for_text("#detail .facts", self.plan.plan_id)
        places = [node for node in self.simulation.floor.places if node != self.robot.node]
        for focused, change in ((self.robot.node, lambda: setattr(self.robot, "node", places[0])),
                                (self.plan.plan_id, lambda: setattr(self.plan, "step_no", 2)),
                                ("Correct carriers", lambda: setattr(self.robot, "is_in_maintenance", True))):
            self.keep("#detail .detail-body", focused)
            self.change(lambda change=change: change() or self.simulation.changed_robots.add("LR01"))
            self.change_carriers(f"C_{focused}")
            self.check_kept(*["Maintenance on"] if focused == "Correct carriers" else [])
        self.keep("#detail .facts", places[0])
        self.begin_click()
        self.change(lambda: setattr(self.robot, "node", places[1]) or self.simulation.changed_robots.add("LR01"))
        self.wait_for_text("#detail .facts", places[1])
        self.end_click()
        self.wait_for_text("#detail-title", places[1])

    def test_strip(self):
        self.mock.tsc = "Pausing"
        self.open()
        self.keep("#strip", "Resume TSC")
        self.change(lambda: setattr(self.mock, "tsc", "Paused"))
        self.wait_for_text("#strip-tsc", "Paused")
        self.check_kept()
        self.click_button("Resume TSC", "#strip")
        may_answer = self.hold_answers()
        self.click("#confirm-action")
        self.check_it_runs(lambda: None, may_answer)

    def test_the_focus_is_back_after_a_command(self):
        """Of a button that is pressed with the keyboard; also if the user goes back, or acsd refuses the command."""
        self.expected_log = ("/pause",)
        self.mock.role = "viewer"
        self.open()
        self.select("plan", self.plan.plan_id)
        self.wait_for_text("#detail button", "Cancel plan")
        for text in ("Cancel plan", "Pause"):
            self.keep("#detail", text)
            self.press(Keys.ENTER)
            if text == "Pause":
                self.wait_for_text("#toasts", "may only read")
            else:
                self.click_button("Back", "#confirm-dialog")
            wait_until(lambda: self.run_script("return document.activeElement === window.focused"), "the focus is back")
            # Enter that is held down does not press the button again.
            self.driver.execute_cdp_cmd("Input.dispatchKeyEvent", {
                "type": "keyDown", "key": "Enter", "code": "Enter", "windowsVirtualKeyCode": 13, "text": "\r", "autoRepeat": True})
            self.assertFalse(self.run_script("return window.focused.disabled"), text)
