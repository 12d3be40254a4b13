"""What the page costs."""

import time

from browser import list_processes, read_cpu_seconds
from mock_floor import Floor as MockFloor
from page_case import PageCase, wait_until

CPU_LIMIT = 0.2  # of a core, for the renderer
MEASURED_SECONDS = 20


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
