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
