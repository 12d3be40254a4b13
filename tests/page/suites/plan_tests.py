"""Plans and why they wait."""

from mock_acsd import Refusal
from mock_floor import format_time, get_now
from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys

FINISHED_LIMIT = 100
NODE = "N020"  # on the east lane of the example site


class PlanCase(PageCase):
    """The mock is frozen, and LR01 has a plan."""

    def setUp(self):
        super().setUp()
        self.start_mock()
        self.mock.simulation.advance(0.2)
        self.mock.freeze()
        self.plan = self.mock.simulation.robots["LR01"].plan


class Plans(PlanCase):
    def setUp(self):
        super().setUp()
        self.path = f"/v1/plans/{self.plan.plan_id}"
        self.open()

    def open_plan(self):
        self.click(f"#plans-active li[data-id='{self.plan.plan_id}'] .row")
        self.wait_for_text("#detail-title", self.plan.plan_id)

    def test_pause_and_resume(self):
        self.open_plan()
        self.click_button("Pause")
        self.wait_for_post(f"{self.path}/pause")
        self.wait_for_text("#detail .facts", "The plan is paused.")
        self.click_button("Resume")
        self.wait_for_post(f"{self.path}/resume")
        self.wait_for_text("#detail .facts", "In progress")
        self.assertEqual(len({key for _, _, key in self.list_posts()}), 2)

    def test_cancel_asks_first(self):
        self.open_plan()
        self.click_button("Cancel plan")
        wait_until(lambda: self.find("#confirm-dialog").is_displayed(), "the question")
        self.assertIn(self.plan.plan_id, self.get_text("#confirm-dialog"))
        # Enter in the field of the reason does not confirm.
        self.press("too late", Keys.ESCAPE)
        wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "the question is closed")
        self.assertEqual(self.list_posts(), [])
        self.click_button("Cancel plan")
        self.find("#confirm-reason").send_keys("wrong lot")
        self.click("#confirm-action")
        self.wait_for_post(f"{self.path}/cancel", {"reason": "wrong lot"})
        wait_until(lambda: not self.find_all(f"#plans-active li[data-id='{self.plan.plan_id}']"), "the plan is not active")

    def test_a_reason_has_at_most_500_bytes(self):
        """A syllable of Hangul has three."""
        self.open_plan()
        self.click_button("Cancel plan")
        self.find("#confirm-reason").send_keys("가" * 167)
        self.click("#confirm-action")
        self.assertTrue(self.find("#confirm-dialog").is_displayed(), "a reason that is too long is refused")
        self.click_button("Back", "#confirm-dialog")
        wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "the question is closed")
        self.assertEqual(self.list_posts(), [])
        self.click_button("Cancel plan")
        self.find("#confirm-reason").send_keys("가" * 166 + "12")
        self.click("#confirm-action")
        self.wait_for_post(f"{self.path}/cancel", {"reason": "가" * 166 + "12"})

    def test_abort_without_reason(self):
        self.open_plan()
        self.click_button("Abort plan")
        self.click("#confirm-action")
        self.wait_for_post(f"{self.path}/abort")
        self.wait_for_text("#detail .facts", "Aborted")

    def test_a_command_without_an_answer_is_sent_again_as_the_same(self):
        """It may have been executed."""
        self.open_plan()
        self.run_script(
            "const send = window.fetch; window.fetch = async (path, options) => {"
            "const answer = await send(path, options);"
            "if (options?.method === 'POST' && window.isCut) { throw new TypeError('cut'); } return answer; };"
            "window.isCut = true")
        self.click_button("Cancel plan")
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", "No complete answer from acsd (cut).")
        self.run_script("window.isCut = false")
        self.click("#confirm-action")
        wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "acsd has accepted it")
        keys = [key for _, _, key in self.list_posts()]
        self.assertEqual(keys, 3 * keys[:1])

    def test_priority_of_a_waiting_plan(self):
        plan = next(plan for plan in self.mock.simulation.plans.values() if plan.robot_id is None)
        self.run_script("acsdPage.select({kind: 'plan', id: arguments[0]})", plan.plan_id)
        self.click_button("Priority")
        wait_until(lambda: self.find_all("#confirm-number"), "the question")
        self.press("9", Keys.ENTER)
        self.wait_for_post(f"/v1/plans/{plan.plan_id}/priority", {"priority": 9})
        self.wait_for_text("#detail .facts", "9")

    def test_unresolved_job_and_skipped_step(self):
        job_id = self.plan.get_job_id()
        with self.mock.lock:
            self.plan.get_step()["status"] = "InProgress"
            self.mock.simulation.set_alarm("LR01", "ACS-1008", "heavy", "unknown", "Job outcome unknown", "", "", self.plan)
            self.mock.simulation.changed_plans.add(self.plan.plan_id)
            self.mock.publish()
        self.open_plan()
        self.click_button("Skip step", "#detail .step-list > li:nth-child(2)")
        self.click("#confirm-action")
        self.wait_for_post(f"{self.path}/steps/2/skip")
        self.click_button("Job was done")
        self.click("#confirm-action")
        self.wait_for_post(f"{self.path}/jobs/{job_id}/resolve", {"outcome": "done"})

    def test_an_unresolved_job_of_an_ended_plan(self):
        """acsd does not repeat it."""
        simulation = self.mock.simulation
        self.open_plan()
        with self.mock.lock:
            self.plan.get_step()["status"] = "InProgress"
            simulation.end_plan(self.plan, "Aborted")
            simulation.set_alarm("LR01", "ACS-1008", "heavy", "unknown", "Job outcome unknown", "", "", self.plan)
            self.mock.publish()
        self.wait_for_text("#detail .facts", "Aborted")
        self.wait_for_text("#detail .jobs", "Job failed")
        self.assertEqual([button.text for button in self.find_all("#detail .jobs button")], ["Job was done", "Job failed"])

    def test_a_change_of_the_plan_keeps_the_focus(self):
        """On the button for one outcome of a job, and on a button elsewhere that sends the same command as one of the detail."""
        simulation = self.mock.simulation
        with self.mock.lock:
            self.plan.get_step()["status"] = "InProgress"
            self.plan.waits = simulation.make_wait("The TSC is paused.")
            self.mock.tsc = "Paused"
            simulation.set_alarm("LR01", "ACS-1008", "heavy", "unknown", "Job outcome unknown", "", "", self.plan)
            simulation.changed_plans.add(self.plan.plan_id)
            self.mock.publish()
        self.open_plan()
        self.wait_for_text("#detail .jobs", "Job failed")
        self.wait_for_text("#detail .alarms button", "Resume TSC")
        for number, (inside, text) in enumerate((("#detail .jobs", "Job failed"), ("#strip", "Resume TSC"))):
            self.run_script("[...document.querySelectorAll(`${arguments[0]} button`)]"
                            ".find((button) => button.textContent === arguments[1]).focus()", inside, text)
            with self.mock.lock:
                self.plan.lot_id = f"CHANGED_{number}"
                simulation.changed_plans.add(self.plan.plan_id)
                self.mock.publish()
            self.wait_for_text("#detail .facts", self.plan.lot_id)
            self.assertEqual(self.run_script(
                "const {activeElement} = document;"
                "return [activeElement.textContent, activeElement.closest(arguments[0]) !== null]", inside), [text, True])

    def test_waits_and_finished(self):
        self.wait_for_text("#plans-queue", "No suitable robot is free.")
        with self.mock.lock:
            self.mock.simulation.end_plan(self.plan, "Failed", "LR01: motor fault")
            self.mock.publish()
        wait_until(lambda: not self.find_all(f"#plans-active li[data-id='{self.plan.plan_id}']"), "the plan is not active")
        self.click("#finished-button")
        self.wait_for_text("#plans-finished", "LR01: motor fault")
        self.find("#view-plans .filter").send_keys("no such plan")
        wait_until(lambda: not self.find_all("#view-plans .rows li"), "the filter hides all")

    def test_of_ended_plans_the_newest_are_kept(self):
        with self.mock.lock:
            simulation = self.mock.simulation
            plans = [simulation.add_plan("LR") for _ in range(FINISHED_LIMIT + 2)]
            for plan in plans:
                simulation.end_plan(plan, "Completed")
            simulation.ended_plans.append(plans[1])  # it ends again
            self.mock.publish()
        expected = [plan.plan_id for plan in plans[3:] + plans[1:2]]
        get_ids = "return [...acsdPage.model.ended.keys()]"
        wait_until(lambda: plans[-1].plan_id in self.run_script(get_ids), "the plans have ended")
        self.assertEqual(self.run_script(get_ids), expected)
        self.click("#finished-button")
        wait_until(lambda: len(self.find_all("#plans-finished li")) == FINISHED_LIMIT, "as many are listed")

    def end_unseen(self, message):
        """The page gets no event of it. Returns the plan."""
        with self.mock.lock:
            simulation = self.mock.simulation
            plan = simulation.add_plan("LR")
            clients, self.mock._clients = self.mock._clients, []
            simulation.end_plan(plan, "Failed", message)
            self.mock.publish()
            self.mock._clients = clients
        return plan

    def test_plans_that_ended_before_a_snapshot_are_listed(self):
        self.click("#finished-button")
        self.wait_for_text("#finished-button", "Hide finished")
        self.end_unseen("ended unseen")
        self.mock.send_reset()
        self.wait_for_text("#plans-finished", "ended unseen")
        self.expected_log = ("/v1/plans",)
        get = self.mock.get

        def refuse(path, query):
            if path == "/v1/plans":
                raise Refusal(500, "the history cannot be read")
            return get(path, query)

        self.mock.get = refuse
        self.end_unseen("ended unseen, too")
        self.mock.send_reset()
        self.wait_for_text("#toasts", "the history cannot be read")
        # No list with a gap.
        self.wait_for_text("#finished-button", "Show finished")
        self.assertFalse(self.find("#plans-finished").is_displayed())
        self.mock.get = get
        self.click("#finished-button")
        self.wait_for_text("#plans-finished", "ended unseen, too")

    def test_a_late_answer_changes_no_finished_plans(self):
        """Neither those of a newer answer, nor those of a list that was hidden meanwhile."""
        self.run_script(
            "const fetched = window.fetch; window.answers = []; window.fetch = async (...all) => {"
            "  const answer = await fetched(...all);"
            "  if (String(all[0]).startsWith('/v1/plans?')) {"
            "    const text = await answer.text();"
            "    return new Promise((go) => { window.answers.push(() => go(new Response(text, answer))); });"
            "  }"
            "  return answer;"
            "};")

        def wait_for_answers(count):
            wait_until(lambda: self.run_script("return window.answers.length") == count, f"{count} answers are held")

        def pass_on(number):
            self.run_script("window.answers[arguments[0]](); return new Promise((go) => setTimeout(go, 100))", number)

        self.click("#finished-button")
        wait_for_answers(1)
        self.end_unseen("ended unseen")
        self.mock.send_reset()
        wait_for_answers(2)
        pass_on(1)
        self.wait_for_text("#plans-finished", "ended unseen")
        pass_on(0)
        self.assertIn("ended unseen", self.get_text("#plans-finished"))
        self.mock.send_reset()
        wait_for_answers(3)
        self.click("#finished-button")
        self.wait_for_text("#finished-button", "Show finished")
        pass_on(2)
        self.assertEqual(self.get_text("#finished-button"), "Show finished")
        self.assertFalse(self.find("#plans-finished").is_displayed())

    def begin_again(self):
        """A new plan has the id of the finished one (plan.reuse_finished_id), which acsd then deletes."""
        simulation = self.mock.simulation
        simulation.finished = [plan for plan in simulation.finished if plan.plan_id != self.plan.plan_id]
        plan = simulation.add_plan("LR")
        simulation.changed_plans.remove(plan.plan_id)
        del simulation.plans[plan.plan_id]
        plan.plan_id = self.plan.plan_id
        simulation.plans[plan.plan_id] = plan
        simulation.changed_plans.add(plan.plan_id)
        return plan

    def test_the_id_of_a_finished_plan_is_used_again(self):
        """A plan is either finished or not, and is listed as it ended last."""
        simulation, plan_id = self.mock.simulation, self.plan.plan_id
        count_rows = lambda name: len(self.find_all(f"#plans-{name} li[data-id='{plan_id}']"))
        is_known = "return [acsdPage.model.plans.has(arguments[0]), acsdPage.model.ended.has(arguments[0])]"
        self.click("#finished-button")
        self.wait_for_text("#finished-button", "Hide finished")
        plan = self.plan
        for message in ("ended first", "ended second", "ended third"):
            with self.mock.lock:
                simulation.end_plan(plan, "Failed", message)
                self.mock.publish()
            self.wait_for_text("#plans-finished", message)
            self.assertEqual(count_rows("finished"), 1)
            self.assertEqual(self.run_script(is_known, plan_id), [False, True])
            self.mock.send_reset()
            wait_until(lambda text=message: self.run_script("return acsdPage.views.plans.finished[0]?.message") == text,
                       "acsd has listed it")
            with self.mock.lock:
                plan = self.begin_again()
                if message == "ended first":
                    self.mock.publish()
                else:  # the page gets it with a snapshot
                    simulation.changed_plans.clear()
                    self.mock.send_reset()
            wait_until(lambda: count_rows("queue") == 1, "the new plan waits")
            self.assertEqual(count_rows("finished"), 0)
            self.assertEqual(self.run_script(is_known, plan_id), [True, False])

    def test_the_numbers_of_steps_may_have_gaps(self):
        described = self.run_script(
            "const steps = [10, 20, 30].map((stepNo) => ({stepNo, action: 'Load', position: 'A01', status: 'Pending'}));"
            "return import('/page/plan-view.js').then((view) => view.describeStep({stepNo: 20, steps}))")
        self.assertEqual(described, "2/3 Load @ A01")

    def test_a_completed_plan_has_all_its_steps(self):
        with self.mock.lock:
            for step in self.plan.steps:
                step["status"] = "Completed"
            self.mock.simulation.end_plan(self.plan, "Completed")
            self.mock.publish()
        row = f"#plans-finished li[data-id='{self.plan.plan_id}']"
        self.click("#finished-button")
        self.wait_for_text(row, "2/2 CassetteUnload")
        self.assertIn("Completed", self.get_text(row))

    def test_what_to_unblock(self):
        with self.mock.lock:
            self.mock.simulation.floor.blocks[("edge", "N005-N006")] = {
                "kind": "edge", "id": "N005-N006", "reason": "", "since": format_time(get_now())}
            self.mock.site_revision += 1
            self.plan.waits = self.mock.simulation.make_wait("LR01: edge N005-N006 is blocked.")
            self.mock.simulation.changed_plans.add(self.plan.plan_id)
            self.mock.publish()
        self.open_plan()
        self.wait_for_text("#detail", "Unblock edge N005-N006 when it is free.")
        self.run_script("acsdPage.select({kind: 'node', id: arguments[0]})", NODE)
        self.click_button("Block")
        self.wait_for_text("#confirm-dialog", f"Block node {NODE}?")
        self.press(Keys.ESCAPE)

    def test_viewer(self):
        self.expected_log = ("/pause",)
        self.mock.role = "viewer"
        self.open_plan()
        self.click_button("Pause")
        self.wait_for_text("#toasts", "may only read")


class Causes(PlanCase):
    """What acsctl why names, on the page."""

    def setUp(self):
        super().setUp()
        self.open()

    def change(self, change):
        """Calls the function with the simulation, whose changes are then sent."""
        with self.mock.lock:
            change(self.mock.simulation)
            self.mock.publish()

    def select(self, kind, id):
        self.run_script("acsdPage.select({kind: arguments[0], id: arguments[1]})", kind, id)
        self.wait_for_text("#detail-title", id)

    def wait_for_texts(self, selector, *texts):
        for text in texts:
            self.wait_for_text(selector, text)

    def test_a_link_that_is_down(self):
        def cut(simulation):
            self.mock.links[1].update(up=False, reason="the MQTT broker does not answer")
            simulation.set_alarm("LR01", "ACS-1002", "heavy", "LR01: no connection.", "Robot disconnected", "", "Check the robot.")

        texts = ("The link mqtt is down", "the MQTT broker does not answer", "Check the MQTT broker and the network to it.")
        self.select("plan", self.plan.plan_id)
        self.change(cut)
        self.wait_for_texts("#detail", *texts, "LR01: no connection.")
        self.select("robot", "LR01")
        self.wait_for_texts("#detail", *texts, "LR01: no connection.")
        self.press(Keys.ESCAPE)
        self.click("#tab-alarms")
        self.wait_for_texts("#view-alarms", *texts)
        self.assertLess(self.get_text("#view-alarms").index(texts[0]), self.get_text("#view-alarms").index("LR01: no connection."))
        self.click("#language-button")
        self.wait_for_texts("#view-alarms", "mqtt 통신이 끊겼습니다.", "MQTT 브로커와 브로커까지의 네트워크를 점검하십시오.")

        self.change(lambda _: self.mock.links[1].update(up=True, reason=None))
        wait_until(lambda: "mqtt" not in self.get_text("#view-alarms"), "the link is up")

    def test_alarms_of_the_robots_of_a_waiting_plan(self):
        waiting = next(plan for plan in self.mock.simulation.plans.values() if plan.robot_id is None)

        def break_robots(simulation):
            waiting.waits = simulation.make_wait("No suitable robot is free.", 1, [("LR02", "Error"), ("LR01", "busy")])
            simulation.changed_plans.add(waiting.plan_id)
            simulation.set_alarm("LR02", "ARM-motorOff", "heavy", "The motor is off.", "Arm motor off", "Emergency stop.",
                                 "Release the emergency stop.")
            simulation.set_alarm("CR01", "ACS-1009", "light", "not concerned", "Robot stalled", "", "")
            simulation.set_alarm("LR01", "ACS-1008", "heavy", "job of another plan", "Job outcome unknown", "", "", self.plan)
            simulation.set_alarm("ACS", "ACS-1005", "heavy", "disk full", "Store cannot be written", "No space.", "Free space.")

        self.change(break_robots)
        self.select("plan", waiting.plan_id)
        self.wait_for_texts("#detail .alarms", "ARM-motorOff", "Emergency stop.", "Release the emergency stop.", "disk full")
        self.assertNotIn("not concerned", self.get_text("#detail"))
        self.assertNotIn("job of another plan", self.get_text("#detail"))
        # The plan of LR01 waits, too: its job is the reason.
        def wait(simulation):
            self.plan.waits = simulation.make_wait("Job is unresolved.")
            simulation.changed_plans.add(self.plan.plan_id)

        self.change(wait)
        self.wait_for_text("#detail .alarms", "job of another plan")

    def test_a_job_of_another_plan_with_the_same_id(self):
        """The id of a job is unique within its plan only."""
        other = self.mock.simulation.robots["LR02"].plan

        def wait(simulation):
            self.plan.waits = simulation.make_wait("LR02 is in the way.", None, [("LR02", "busy")])
            other.waits = simulation.make_wait("Job is unresolved.")
            simulation.changed_plans.update((self.plan.plan_id, other.plan_id))
            alarm = simulation.set_alarm("LR02", "ACS-1008", "heavy", "job of LR02", "Job outcome unknown", "", "", other)
            alarm["jobId"] = self.plan.get_job_id()

        self.change(wait)
        self.select("plan", self.plan.plan_id)
        self.wait_for_text("#detail .alarms", "job of LR02")
        self.wait_for_text("#detail .job-id", self.plan.get_job_id())
        self.assertNotIn("Unresolved", self.get_text("#detail .jobs"))
        self.assertNotIn("Job was done", self.get_text("#detail button"))

    def test_what_an_operator_has_stopped(self):
        station = self.plan.steps[0]["position"]

        def stop(simulation):
            self.mock.tsc = "Paused"
            simulation.robots["LR01"].is_in_maintenance = True
            simulation.changed_robots.add("LR01")
            self.plan.waits = simulation.make_wait("The TSC is paused.")
            simulation.changed_plans.add(self.plan.plan_id)
            simulation.floor.blocks[("station", station)] = {
                "kind": "station", "id": station, "reason": "equipment down", "since": format_time(get_now())}
            self.mock.site_revision += 1

        self.select("plan", self.plan.plan_id)
        self.change(stop)
        self.wait_for_texts("#detail .alarms", "The TSC is Paused.", "Robot LR01 is in maintenance.",
                            f"Station {station} is blocked.", "equipment down", f"Unblock station {station} when it is free.")
        self.click_button("Unblock")
        self.click("#confirm-action")
        self.wait_for_post("/v1/site/unblock", {"kind": "station", "id": station})
        self.click_button("Maintenance off")
        self.click("#confirm-action")
        self.wait_for_post("/v1/robots/LR01/maintenance", {"on": False})
        self.click_button("Resume TSC")
        self.click("#confirm-action")
        self.wait_for_post("/v1/tsc/resume")
        wait_until(lambda: self.get_text("#detail .alarms") == "", "no cause is left")

    def test_refused_reports_of_a_plan(self):
        last = {"command": "StepReport", "planId": self.plan.plan_id, "message": "unknown step", "retried": False}
        self.select("plan", self.plan.plan_id)
        self.change(lambda _: self.mock.refused.update(count=2, last=last))
        self.wait_for_texts("#detail .alarms", "The MCS has refused reports.", "StepReport: unknown step",
                            "Refused reports are not sent again.", "Correct the plan in the MCS; its log has the reason.")
        self.change(lambda _: self.mock.refused.update(count=3, last={**last, "retried": True}))
        self.wait_for_texts("#detail .alarms", "Refused reports are sent again after the next registration.")
