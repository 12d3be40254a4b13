"""What data that is hostile must not do."""

from page_case import PageCase

NODE = "N020"  # on the east lane of the example site


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
