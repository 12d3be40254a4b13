"""The drawing of the floor."""

from mock_floor import Floor as MockFloor
from mock_floor import format_time, get_now
from page_case import PageCase, wait_until
from selenium.webdriver.common.keys import Keys

NODE = "N020"  # on the east lane of the example site


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

    def test_the_reason_of_a_block_has_at_most_200_bytes(self):
        """A syllable of Hangul has three."""
        self.start_mock().freeze()
        self.open(f"?lang=en#node/{NODE}")
        self.click_button("Block")
        self.find("#confirm-reason").send_keys("가" * 67)
        self.click("#confirm-action")
        self.assertTrue(self.find("#confirm-dialog").is_displayed(), "a reason that is too long is refused")
        self.assertEqual(self.list_posts(), [])
        self.find("#confirm-reason").send_keys(Keys.BACKSPACE, "12")
        self.click("#confirm-action")
        self.wait_for_post("/v1/site/block", {"kind": "node", "id": NODE, "reason": "가" * 66 + "12"})

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
