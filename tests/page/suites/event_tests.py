"""The list of events."""

from page_case import PageCase, wait_until


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
