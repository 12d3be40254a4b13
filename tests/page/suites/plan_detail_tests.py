"""The detail of a plan whose state cannot be loaded."""

from mock_acsd import Refusal
from page_case import wait_until
from suites.plan_tests import PlanCase


class PlanDetail(PlanCase):
    def setUp(self):
        super().setUp()
        self.expected_log = ("/v1/plans",)
        self.open(f"?lang=en#plan/{self.plan.plan_id}")
        self.wait_for_text("#detail .row-buttons", "Pause")

    def refuse_plans(self):
        """Returns what ends it."""
        get = self.mock.get

        def refuse(path, query):
            if path.startswith("/v1/plans/"):
                raise Refusal(500, "the store cannot be read")
            return get(path, query)

        def accept():
            self.mock.get = get

        self.mock.get = refuse
        return accept

    def end_plan(self):
        with self.mock.lock:
            self.mock.simulation.end_plan(self.plan, "Aborted", "the last change")
            self.mock.publish()

    def test_a_change_that_cannot_be_loaded(self):
        """The detail shows that, and is loaded again without a further change."""
        accept = self.refuse_plans()
        self.end_plan()
        self.wait_for_text("#detail [role=alert]", "(the store cannot be read)")
        self.assertIn("In progress", self.get_text("#detail .facts"), "what is known stays")
        accept()
        self.wait_for_text("#detail .facts", "the last change")
        wait_until(lambda: self.get_text("#detail [role=alert]") == "", "the detail is current")
        self.assertEqual(self.get_text("#detail .row-buttons"), "")

    def test_a_plan_that_cannot_be_loaded(self):
        accept = self.refuse_plans()
        self.run_script("acsdPage.select(null); acsdPage.select({kind: 'plan', id: arguments[0]})", self.plan.plan_id)
        self.wait_for_text("#detail [role=alert]", "(the store cannot be read)")
        accept()
        self.wait_for_text("#detail .row-buttons", "Pause")
        self.assertEqual(self.get_text("#detail [role=alert]"), "")

    def test_a_plan_that_is_gone(self):
        with self.mock.lock:
            del self.mock.simulation.plans[self.plan.plan_id]
        self.mock.send_reset()
        self.wait_for_text("#detail .facts", "acsd does not know it any more.")
        for selector in (".row-buttons", ".step-list", ".alarms", ".steps"):
            self.assertEqual(self.get_text(f"#detail {selector}"), "", selector)
        self.assertEqual(self.find_all("#detail .step"), [])
        # A plan with its id may come later.
        with self.mock.lock:
            self.mock.simulation.plans[self.plan.plan_id] = self.plan
            self.mock.simulation.changed_plans.add(self.plan.plan_id)
            self.mock.publish()
        self.wait_for_text("#detail .row-buttons", "Pause")

    def test_a_detail_that_is_closed_loads_no_more(self):
        self.refuse_plans()
        self.end_plan()
        self.wait_for_text("#detail [role=alert]", "(the store cannot be read)")
        self.run_script("acsdPage.select(null); window.loads = 0; const send = window.fetch; window.fetch = (path, ...rest) => {"
                        "window.loads += String(path).startsWith('/v1/plans/'); return send(path, ...rest); };")
        self.run_script("return new Promise((go) => setTimeout(go, 4_000))")
        self.assertEqual(self.run_script("return window.loads"), 0)
