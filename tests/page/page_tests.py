"""The tests that test_page.py runs."""

import time
import unittest
from datetime import timedelta

from browser import list_processes, read_cpu_seconds
from mock_acsd import Refusal
from mock_floor import Floor as MockFloor
from mock_floor import format_time, get_now
from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys

FINISHED_LIMIT = 100
CPU_LIMIT = 0.2  # of a core, for the renderer
MEASURED_SECONDS = 20
NODE = "N020"  # on the east lane of the example site


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


class Floor(PageCase):
    def get_place(self, robot_id):
        return self.run_script("return acsdPage.floor.robotLayer.getPlace(arguments[0])", robot_id)

    def test_a_robot_moves(self):
        mock = self.start_mock()
        self.open()
        first = self.get_place("LR01")
        wait_until(lambda: self.get_place("LR01") != first, "LR01 is shown elsewhere")
        # Drawing, too: the canvas has another picture.
        read = "return document.querySelector('.canvas-pane-2 canvas').toDataURL()"
        picture = self.run_script(read)
        wait_until(lambda: self.run_script(read) != picture, "the floor is drawn again")
        mock.freeze()

    def test_nothing_is_drawn_while_nothing_moves(self):
        self.start_mock().freeze()
        self.open()
        wait_until(lambda: self.run_script("const layer = acsdPage.floor.robotLayer;"
                                           "return layer.timer === null && !layer.isRequested"), "the robots are stationary")
        count = ("const layer = acsdPage.floor.robotLayer; if (layer.counted === undefined) {"
                 "const draw = layer.draw; layer.counted = 0;"
                 "layer.draw = function (...all) { this.counted += 1; draw.apply(this, all); }; } return layer.counted")
        self.run_script(count)
        entries = self.run_script("return acsdPage.model.entries.length")
        # Three entries later, which change no robot.
        for _ in range(3):
            with self.mock.lock:
                self.mock.simulation.note("note", "nothing")
                self.mock.publish()
        wait_until(lambda: self.run_script("return acsdPage.model.entries.length") == entries + 3, "three entries")
        self.assertEqual(self.run_script(count), 0)

    def test_a_click_opens_a_robot_with_its_messages(self):
        mock = self.start_mock()
        mock.freeze()
        self.open()
        place = self.get_place("LR02")
        self.click_floor(place["x"], place["y"])
        self.wait_for_text("#detail-title", "LR02")
        self.click_button("Show", "#detail .trace")
        self.wait_for_text("#detail .trace", "visualization")
        self.click("#detail .message summary")
        self.wait_for_text("#detail .message pre", "lastNodeId")

    def test_no_trace(self):
        self.start_mock(is_traced=False)
        self.open("?lang=en#robot/LR01")
        self.wait_for_text("#detail .trace", "Messages")
        self.assertNotIn("--trace", self.get_text("#detail"))
        self.click_button("Show", "#detail .trace")
        self.wait_for_text("#detail .trace", "--trace DIR")

    def test_block_and_unblock_a_node(self):
        mock = self.start_mock()
        self.open()
        mock.freeze()
        self.click_floor(*mock.simulation.floor.places[NODE])
        self.wait_for_text("#detail-title", NODE)
        self.click_button("Block")
        self.find("#confirm-reason").send_keys("wet floor")
        self.click("#confirm-action")
        self.wait_for_post("/v1/site/block", {"kind": "node", "id": NODE, "reason": "wet floor"})
        self.wait_for_text("#detail", "wet floor")
        self.click_button("Unblock")
        self.click("#confirm-action")
        self.wait_for_post("/v1/site/unblock", {"kind": "node", "id": NODE})
        wait_until(lambda: "wet floor" not in self.get_text("#detail"), "the node is not blocked")

    def test_the_detail_of_a_station_is_current(self):
        mock = self.start_mock()
        mock.freeze()
        simulation = mock.simulation
        station, node = next(iter(simulation.floor.stations.items()))
        self.open()
        self.run_script("acsdPage.select({kind: 'station', id: arguments[0]})", station)
        self.wait_for_text("#detail", node)
        with mock.lock:
            plan = simulation.add_plan("LR")
            plan.steps[0]["position"] = station
            mock.publish()
        self.wait_for_text("#detail", plan.plan_id)
        with mock.lock:
            del simulation.floor.stations[station]
            mock.site_revision += 1
            mock.publish()
        self.wait_for_text("#detail", "acsd does not know it any more.")
        with mock.lock:
            simulation.floor.stations[station] = node
            mock.site_revision += 1
            mock.publish()
        self.wait_for_text("#detail", node)
        self.assertEqual(self.get_text("#detail .row-buttons button"), "Block")

    def test_a_selected_place_is_still_blocked(self):
        count = """
            const [x, y, name] = arguments, layer = acsdPage.floor.siteLayer, canvas = layer.context.canvas, size = 60;
            const scale = canvas.width / parseFloat(canvas.style.width || canvas.clientWidth);
            const [left, top] = [layer.toX(x) * scale - size / 2, layer.toY(y) * scale - size / 2];
            layer.draw(layer.context);
            const {data} = layer.context.getImageData(left, top, size, size), colour = acsdPage.theme.colours[name];
            const wanted = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
            let found = 0;
            for (let i = 0; i < data.length; i += 4) {
                found += wanted.every((value, k) => Math.abs(data[i + k] - value) < 24);
            }
            return found"""
        self.expected_log = ("Canvas2D: Multiple readback",)
        mock = self.start_mock(robots=1)
        floor = mock.simulation.floor
        edge_id, start, end = floor.edges[0]
        middle = [(a + b) / 2 for a, b in zip(floor.places[start], floor.places[end])]
        station, dock = next(iter(floor.stations.items()))
        places = {("node", NODE): floor.places[NODE], ("edge", edge_id): middle, ("station", station): floor.places[dock]}
        mock.freeze()
        for kind, id in places:
            floor.blocks[(kind, id)] = {"kind": kind, "id": id, "reason": "", "since": format_time(get_now())}
        self.open()
        for (kind, id), (x, y) in places.items():
            red = self.run_script(count, x, y, "heavy")
            self.assertGreater(red, 20, kind)
            self.run_script("acsdPage.floor.setSelection({kind: arguments[0], id: arguments[1]}, false)", kind, id)
            self.assertGreater(self.run_script(count, x, y, "heavy"), 0.8 * red, kind)
            self.assertGreater(self.run_script(count, x, y, "accent"), 20, kind)

    def test_trajectories_and_maps(self):
        floor = MockFloor.read_example()
        edge_id, start, end = floor.edges[0]
        (x, y), last = floor.places[start], floor.places[end]
        floor.trajectories[edge_id] = [(x, y), (x + 1, y + 1.5), last]
        floor.add_node("UPSTAIRS", 0, 0, "floor-2")
        self.start_mock(floor=floor).freeze()
        self.open()
        self.click_floor(x + 1, y + 1.5)
        self.wait_for_text("#detail-title", edge_id)
        self.find("#map-tools select").send_keys("floor-2")
        wait_until(lambda: self.run_script("return acsdPage.floor.mapId") == "floor-2", "the other map")
        self.press(Keys.ESCAPE)
        self.click_floor(0, 0)
        self.wait_for_text("#detail-title", "UPSTAIRS")

    def test_the_map_of_the_selection_is_shown(self):
        floor = MockFloor.read_example()
        floor.add_node("UPSTAIRS", 300, 200, "floor-2")
        floor.add_node("UPSTAIRS-END", 310, 200, "floor-2")
        floor.add_edge("UP", "UPSTAIRS", "UPSTAIRS-END")
        floor.stations["UP.CP01"] = "UPSTAIRS"
        mock = self.start_mock(floor=floor)
        mock.freeze()
        with mock.lock:
            robot = mock.simulation.robots["LR01"]
            robot.node, robot.x, robot.y = "UPSTAIRS", 300, 200
            plan = mock.simulation.add_plan("LR")
            plan.robot_id = "LR01"
        selections = [("node", "UPSTAIRS"), ("edge", "UP"), ("station", "UP.CP01"), ("robot", "LR01"), ("plan", plan.plan_id)]

        def check(map_id, what):
            wait_until(lambda: self.run_script("return acsdPage.floor.mapId") == map_id, f"{what}: {map_id}")
            self.assertEqual(self.find("#map-tools select").get_property("value"), map_id)

        def is_seen(x, y):
            return self.run_script("return acsdPage.floor.map.getBounds().contains([arguments[1], arguments[0]])", x, y)

        for kind, id in selections:
            self.open(f"?lang=en#{kind}/{id}")
            check("floor-2", kind)
            self.assertTrue(is_seen(300, 200) and is_seen(310, 200), "the whole map is seen")
        self.find("#map-tools button[title^='Zoom in']").click()
        for kind, id in selections:
            self.run_script("location.hash = arguments[0]", f"#node/{NODE}")
            check("floor-1", kind)
            self.assertTrue(is_seen(*floor.places[NODE]), kind)
            self.run_script("location.hash = `#${arguments[0]}/${arguments[1]}`", kind, id)
            check("floor-2", kind)
            self.assertTrue(is_seen(310 if kind == "edge" else 300, 200), kind)

    def test_a_link_to_a_robot_shows_the_whole_floor(self):
        self.start_mock().freeze()
        self.open()
        get_view = "const {map} = acsdPage.floor; return [map.getCenter().lat, map.getCenter().lng, map.getZoom()]"
        whole = self.run_script(get_view)
        for robot_id in self.mock.simulation.robots:
            self.open(f"?lang=en#robot/{robot_id}")
            self.assertEqual(self.run_script(get_view), whole)

    def test_zoom_and_fit(self):
        self.start_mock()
        self.open()
        get_zoom = "return acsdPage.floor.map.getZoom()"
        first = self.run_script(get_zoom)
        self.press("+", "+")
        self.assertGreater(self.run_script(get_zoom), first)
        self.press("f")
        self.assertAlmostEqual(self.run_script(get_zoom), first, places=3)

    def test_large_floor(self):
        self.start_mock(floor=MockFloor.make_grid(5000), robots=20, has_traffic=False)
        self.open()
        self.assertGreater(self.run_script("return acsdPage.floor.index.nodes.size"), 4900)
        times = self.run_script(
            "const layer = acsdPage.floor.siteLayer, times = [];"
            "for (let i = 0; i < 10; i += 1) { const begin = performance.now(); layer.draw(layer.context); "
            "times.push(performance.now() - begin); } return times")
        print(f"\n  drawing 5,000 nodes: {sorted(times)[len(times) // 2]:.1f} ms")


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

    def test_abort_without_reason(self):
        self.open_plan()
        self.click_button("Abort plan")
        self.click("#confirm-action")
        self.wait_for_post(f"{self.path}/abort")
        self.wait_for_text("#detail .facts", "Aborted")

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


    def open_actions(self, robot_id="LR01"):
        self.open(f"?lang=en#robot/{robot_id}")
        self.click_button("Show", "#detail .actions")
        wait_until(lambda: self.find_all("#detail .actions .row-buttons button"), "the actions are offered")

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
        refused = {"count": 2, "last": {"command": "StepReport", "planId": self.plan.plan_id, "message": "unknown step"}}
        self.select("plan", self.plan.plan_id)
        self.change(lambda _: self.mock.refused.update(refused))
        self.wait_for_texts("#detail .alarms", "The MCS has refused reports.", "StepReport: unknown step",
                            "Correct the plan in the MCS; its log has the reason.")


class Events(PageCase):
    """What happened before the page was opened."""

    def happen(self, first, last, has_changes=False):
        """An event for each number; with has_changes 9 others between two of them."""
        with self.mock.lock:
            for number in range(first, last + 1):
                self.mock.simulation.note("note", f"entry no. {number}")
                for _ in range(9 if has_changes else 0):
                    self.mock._send("changes", {"alarms": []})
                self.mock.publish()

    def list_entries(self):
        return self.run_script(
            "return [...document.querySelectorAll('#view-events .entry')].map((row) => row.lastChild.textContent)")

    def wait_for_entries(self, first, last):
        """Newest first, at the top of the view."""
        expected = [f"entry no. {number}" for number in range(last, first - 1, -1)]
        wait_until(lambda: self.list_entries()[:len(expected)] == expected, f"the entries {first} to {last}")

    def start(self):
        self.start_mock().freeze()
        with self.mock.lock:
            self.mock.publish()

    def test_the_last_hundred(self):
        self.start()
        self.happen(1, 150, has_changes=True)
        self.open()
        self.click("#tab-events")
        self.wait_for_entries(51, 150)
        self.happen(151, 152)
        self.wait_for_entries(51, 152)

    def test_fewer_than_acsd_keeps(self):
        self.start()
        self.mock._events.clear()  # events before the first one are lost
        self.happen(1, 7)
        self.open()
        self.click("#tab-events")
        self.wait_for_entries(1, 7)
        self.assertEqual(len(self.list_entries()), 7)

    def test_after_lost_events(self):
        self.start()
        self.happen(1, 3)
        self.open()
        self.click("#tab-events")
        self.wait_for_entries(1, 3)
        # The page gets no event of these.
        with self.mock.lock:
            clients, self.mock._clients = self.mock._clients, []
            self.happen(4, 6)
            self.mock._clients = clients
        self.mock.send_reset()
        self.happen(7, 7)
        self.wait_for_entries(1, 7)

    def test_none(self):
        self.start()
        with self.mock.lock:
            self.mock._events.clear()
            self.mock._event_id = 0
        self.open()
        self.click("#tab-events")
        self.wait_for_text("#view-events", "No events.")


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

    def test_the_system_view_names_the_connected_broker(self):
        self.open()
        self.click("#tab-system")
        self.wait_for_text("#view-system", "mqtt://broker-1.example:1883")

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


class Safety(PageCase):
    def test_ids_are_text(self):
        evil = "<img src=x onerror=\"window.wasHacked=1\"><script>window.wasHacked=1</script>"
        mock = self.start_mock()
        with mock.lock:
            simulation = mock.simulation
            robot = simulation.robots.pop("LR01")
            robot.robot_id = evil
            simulation.robots[evil] = robot
            plan = simulation.add_plan("LR")
            plan.lot_id = evil
            plan.waits = simulation.make_wait(evil, 1, [(evil, evil)])
            simulation.set_alarm(evil, evil, "heavy", evil, evil, evil, evil, plan)
            simulation.floor.blocks[("node", NODE)] = {"kind": "node", "id": NODE, "reason": evil, "since": None}
            mock.not_ready = [evil]
            mock.links[0].update(up=False, reason=evil)
        mock.freeze()
        self.open()
        with mock.lock:
            simulation.note("note", evil)
            mock.publish()
        for tab in ("robots", "alarms", "events", "system", "plans"):
            self.click(f"#tab-{tab}")
            self.wait_for_text(f"#view-{tab}", "onerror")
        for selection in (("robot", evil), ("plan", plan.plan_id), ("node", NODE)):
            self.run_script("acsdPage.select({kind: arguments[0], id: arguments[1]})", *selection)
            self.wait_for_text("#detail", "onerror" if selection[0] != "robot" else "<img")
        self.assertEqual(self.find_all("body img, body script"), [])
        self.assertIsNone(self.run_script("return window.wasHacked"))

    def test_hidden_characters_and_long_ids(self):
        """An override of the direction of writing would reverse what follows; what is too long is not just cut."""
        evil, long_id = "A\u202eB\u2066", "LONG-" + "Z" * 120
        mock = self.start_mock()
        mock.freeze()
        with mock.lock:
            simulation = mock.simulation
            for text in (evil, long_id):
                robot = simulation.robots.pop("LR01" if text == evil else "LR02")
                robot.robot_id, robot.reason, robot.carrier_ids = text, text, [text]
                simulation.robots[text] = robot
                plan = simulation.add_plan("LR")
                plan.plan_id = plan.lot_id = text
                plan.robot_id, plan.waits = text, simulation.make_wait(text, None, [(text, text)])
                simulation.plans[text] = plan
                simulation.set_alarm(text, text, "heavy", text, text, text, text, plan)
            mock.links[0].update(up=False, reason=evil)
        find_errors = """
            const errors = [], hidden = /[\\u202a-\\u202e\\u2066-\\u2069]/;
            const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
            while (texts.nextNode()) {
                const node = texts.currentNode.parentElement;
                if (hidden.test(texts.currentNode.data) || hidden.test(node.title)) {
                    errors.push(`hidden: ${node.className}`);
                }
                if (node.offsetParent === null || !node.closest('.panel, .detail') || !texts.currentNode.data.includes('ZZZ')) {
                    continue;
                }
                const style = getComputedStyle(node), frame = node.closest('.panel, .detail').getBoundingClientRect();
                const isCut = node.scrollWidth > node.clientWidth && style.display !== 'inline'
                    && style.textOverflow !== 'ellipsis';
                if (isCut || node.getBoundingClientRect().right > frame.right + 1) {
                    errors.push(`cut: ${node.className}`);
                }
            }
            return errors"""
        for width, height, hash in ((1366, 768, ""), (1920, 1080, "#wall"), (360, 740, "")):
            self.browser.resize(width, height)
            self.open(f"?lang=en{hash}")
            for tab in () if hash else ("plans", "robots", "alarms", "system"):
                self.click(f"#tab-{tab}")
                self.wait_for_text(f"#view-{tab}", "A\ufffdB")
                self.assertEqual(self.run_script(find_errors), [], (width, tab))
            if hash:
                self.wait_for_text("#view-alarms", "A\ufffdB")
                self.assertEqual(self.run_script(find_errors), [], "wall")
                continue
            for kind, id in (("robot", long_id), ("plan", long_id), ("robot", evil), ("plan", evil)):
                self.run_script("acsdPage.select({kind: arguments[0], id: arguments[1]})", kind, id)
                self.wait_for_text("#detail-title", "ZZZ" if id == long_id else "A\ufffdB")
                self.wait_for_text("#detail .alarms", "Remedy")
                self.assertEqual(self.run_script(find_errors), [], (width, kind))
        for selector in (".row-id", ".wait-text", ".tag"):
            found = self.run_script("return getComputedStyle(document.querySelector(arguments[0])).unicodeBidi", selector)
            self.assertEqual(found, "isolate", selector)

    def test_policy(self):
        self.expected_log = ("Content Security Policy", "Refused to execute inline script")
        self.start_mock()
        self.open()
        self.run_script("const node = document.createElement('script'); node.textContent = 'window.wasHacked = 1';"
                        "document.body.append(node)")
        self.assertIsNone(self.run_script("return window.wasHacked"))


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


class Performance(PageCase):
    def test_cpu_with_100_robots(self):
        self.start_mock(floor=MockFloor.make_grid(400), robots=100, has_traffic=False)
        self.open()
        for tab in ("plans", "robots"):
            self.click(f"#tab-{tab}")
            with self.subTest(tab=tab):
                self.assertLess(self.measure(tab), CPU_LIMIT)

    def measure(self, tab):
        """The time that the renderers of the page use, as a share of one core. The mock has updates of 100 robots every 0.2 s."""
        first = self.run_script("return acsdPage.feed.getLastByte()")
        pids = [pid for pid, kind in list_processes(self.browser.folder).items() if kind == "renderer"]
        begin, used = time.monotonic(), sum(map(read_cpu_seconds, pids))
        wait_until(lambda: self.run_script("return acsdPage.feed.getLastByte()") - first > 1000 * MEASURED_SECONDS,
                   "the measurement")
        share = (sum(map(read_cpu_seconds, pids)) - used) / (time.monotonic() - begin)
        print(f"\n  100 robots, {tab}: {100 * share:.1f} % of a core for the renderer")
        return share


if __name__ == "__main__":
    unittest.main()
