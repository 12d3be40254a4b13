"""Commands whose answer is lost: each has its effect once."""

from mock_acsd import Refusal
from mock_answers import send_bad_gateway, send_cut, send_page, send_refusal_of_proxy
from page_case import PageCase, wait_until

UNKNOWN = "The outcome of the command is unknown."


class Commands(PageCase):
    def setUp(self):
        super().setUp()
        self.start_mock()
        self.mock.simulation.advance(0.2)
        self.mock.freeze()

    def select(self, kind, id):
        self.run_script("acsdPage.select({kind: arguments[0], id: arguments[1]})", kind, id)
        self.wait_for_text("#detail-title", id)

    def list_keys(self, path):
        return [key for posted, _, key in self.list_posts() if posted == path]

    def confirm(self):
        self.click("#confirm-action")
        wait_until(lambda: not self.find("#confirm-dialog").is_displayed(), "acsd has accepted it")

    def test_an_answer_that_is_not_that_of_acsd(self):
        """acsd has executed the command all the same."""
        self.expected_log = ("net::ERR", "502", "504")
        self.open()
        waiting = [plan.plan_id for plan in self.mock.simulation.plans.values() if plan.robot_id is None]
        answers = ((send_cut, "202 Accepted"), (send_bad_gateway, "502 Bad Gateway"), (send_page, "200 OK"),
                   (send_refusal_of_proxy, "504 Gateway Timeout"))
        for plan_id, (answer, reason) in zip(waiting, answers, strict=False):
            with self.subTest(reason):
                self.mock.answer_post = answer
                self.select("plan", plan_id)
                self.click_button("Cancel plan")
                self.click("#confirm-action")
                self.wait_for_text("#confirm-dialog [role=alert]", UNKNOWN)
                self.assertIn(f"({reason})", self.get_text("#confirm-dialog [role=alert]"))
                self.mock.answer_post = None
                self.confirm()
                keys = self.list_keys(f"/v1/plans/{plan_id}/cancel")
                self.assertEqual(keys, 3 * keys[:1])

    def test_a_refusal_after_a_lost_answer(self):
        """Such a refusal states nothing about the first request."""
        self.expected_log = ("net::ERR", "502", "403")
        self.open()
        plan_id = next(plan.plan_id for plan in self.mock.simulation.plans.values() if plan.robot_id is None)
        self.mock.answer_post = send_bad_gateway
        self.select("plan", plan_id)
        self.click_button("Cancel plan")
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", UNKNOWN)
        self.mock.answer_post = None
        self.mock.role = "viewer"
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", "may only read")
        self.mock.role = "operator"
        self.confirm()
        keys = self.list_keys(f"/v1/plans/{plan_id}/cancel")
        self.assertEqual(keys, 3 * keys[:1])

    def test_a_refused_command_gets_a_new_key(self):
        self.expected_log = ("409",)
        self.open()
        plan = self.mock.simulation.robots["LR01"].plan
        self.select("plan", plan.plan_id)
        self.click_button("Cancel plan")
        execute = self.mock.execute
        self.mock.execute = lambda *_: self.refuse("not now")
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", "not now")
        self.mock.execute = execute
        self.confirm()
        self.assertEqual(len(set(self.list_keys(f"/v1/plans/{plan.plan_id}/cancel"))), 2)

    @staticmethod
    def refuse(sentence):
        raise Refusal(409, sentence)

    def execute_unseen(self, executed):
        """acsd executes commands, and the page sees nothing of it. Their paths are added to the list."""
        self.expected_log = ("net::ERR",)
        execute, publish = self.mock.execute, self.mock.publish

        def execute_and_note(parts, body):
            executed.append("/".join(parts))
            return execute(parts, body)

        self.mock.execute = execute_and_note
        self.mock.publish = lambda: None
        self.mock.answer_post = send_cut
        return publish

    def lose_answer(self, text, inside):
        self.click_button(text, inside)
        self.wait_for_text("#toasts", UNKNOWN)
        self.run_script("document.getElementById('toasts').replaceChildren()")

    def test_a_question_that_is_asked_again(self):
        executed = []
        self.open()
        plan_id = next(plan.plan_id for plan in self.mock.simulation.plans.values() if plan.robot_id is None)
        self.execute_unseen(executed)
        self.select("plan", plan_id)
        self.click_button("Cancel plan")
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", UNKNOWN)
        self.click_button("Back", "#confirm-dialog")
        self.mock.answer_post = None
        self.click_button("Cancel plan")
        self.confirm()
        self.wait_for_text("#toasts", "acsd has executed this command before, and not again: Cancel of plan")
        self.assertEqual(executed, [f"plans/{plan_id}/cancel"])

    def test_an_instant_action(self):
        """acsd does not store its key."""
        self.open()
        self.execute_unseen([])
        self.select("robot", "LR01")
        self.click_button("Show", "#detail .actions")
        self.click_button("stateRequest", "#detail .actions")
        self.click("#confirm-action")
        self.wait_for_text("#confirm-dialog [role=alert]", UNKNOWN)
        self.assertIn("no second effect, unless acsd was restarted", self.get_text("#confirm-dialog [role=alert]"))

    def test_a_command_without_a_question(self):
        executed = []
        self.open()
        self.execute_unseen(executed)
        self.lose_answer("Pause TSC", "#strip")
        self.mock.answer_post = None
        self.click_button("Pause TSC", "#strip")
        self.wait_for_text("#toasts", "and not again: The TSC is Paused.")
        self.assertEqual(executed, ["tsc/pause"])
        # acsd has answered: the next one is a new command.
        self.click_button("Pause TSC", "#strip")
        wait_until(lambda: len(executed) == 2, "it is executed")

    def test_a_lost_command_that_was_undone(self):
        """The same command is then a new one."""
        executed = []
        self.open()
        publish = self.execute_unseen(executed)
        self.lose_answer("Pause TSC", "#strip")
        self.mock.answer_post, self.mock.publish = None, publish
        self.click_button("Resume TSC", "#strip")
        self.confirm()
        self.wait_for_text("#strip-tsc", "Auto")
        self.click_button("Pause TSC", "#strip")
        self.wait_for_text("#strip-tsc", "Paused")
        self.assertEqual(executed, ["tsc/pause", "tsc/resume", "tsc/pause"])

    def test_a_lost_command_after_10_minutes(self):
        """acsd has forgotten its key."""
        self.open()
        self.execute_unseen([])
        self.lose_answer("Pause TSC", "#strip")
        self.lose_answer("Pause TSC", "#strip")
        self.run_script("const now = Date.now; Date.now = () => now() + 601_000")
        self.mock.answer_post = None
        self.click_button("Pause TSC", "#strip")
        wait_until(lambda: len(self.list_posts()) == 5, "it is sent")
        keys = self.list_keys("/v1/tsc/pause")
        self.assertEqual(keys, 4 * keys[:1] + keys[4:])
        self.assertNotEqual(keys[0], keys[4])

    def test_the_button_of_a_command_that_runs(self):
        """It is disabled wherever the command is shown, also in a detail that is opened meanwhile."""
        may_answer = self.hold_answers()
        self.open()
        self.click("#tab-system")
        self.wait_for_text("#view-system", "Pause TSC")
        self.select("plan", self.mock.simulation.robots["LR01"].plan.plan_id)
        self.click_button("Pause")
        self.click_button("Pause TSC", "#strip")
        self.click("#language-button")
        self.wait_for_text("#view-system", "TSC 일시정지")
        self.wait_for_text("#detail .facts", "상태")
        get_disabled = ("return ['#detail', '#strip', '#view-system'].map("
                        "(inside) => document.querySelector(`${inside} button[data-path$='/pause']`)?.disabled)")
        wait_until(lambda: None not in self.run_script(get_disabled), "all three are shown")
        self.assertEqual(self.run_script(get_disabled), [True, True, True])
        may_answer.set()
        wait_until(lambda: not self.find_all("button[data-command]:disabled"), "acsd has answered")
        self.assertEqual(len(self.list_posts()), 2)
