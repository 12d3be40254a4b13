#!/usr/bin/env python3
"""A site of 5,000 nodes on the live page of a real acsd, in Chromium."""

from browser_case import BrowserCase, wait_until
from large_site import make_large_site
from line_faults import FaultCase
from plan_samples import make_carrying_plan
from scenario_case import main
from selenium.webdriver.common.keys import Keys

NODES = 5000
LAST = "G04999"
BESIDE = (42, 30)  # a place between the floor of the example and the grid, in metres
IS_DRAWN = """
    const layer = acsdPage.floor.siteLayer;
    const pixel = [layer.toX(arguments[0]), layer.toY(arguments[1])].map((value) => Math.round(value * layer.ratio));
    return layer.context.getImageData(...pixel, 1, 1).data[3] > 0;
"""


class LargeSitePage(FaultCase, BrowserCase):
    def is_drawn(self, node_id):
        place = self.run_script("const {x, y} = acsdPage.floor.index.nodes.get(arguments[0]); return [x, y]", node_id)
        return self.run_script(IS_DRAWN, *place)

    def test_the_page_draws_it_and_can_be_used(self):
        self.expected_log = ("willReadFrequently",)  # of the reads of pixels below
        path = self.line.folder / "site.lif.json"
        nodes, _ = make_large_site(path, NODES)
        self.start_line(overrides=(f"site.map={path}",))
        self.open_page(self.address)
        self.assertEqual(self.run_script("return acsdPage.floor.index.nodes.size"), nodes)
        for node in ("N001", "G00000", "G00099", "G02550", "G04900", LAST):
            wait_until(lambda node=node: self.is_drawn(node), f"{node} is drawn")

        self.assertFalse(self.run_script(IS_DRAWN, *BESIDE))

        get_place = "return JSON.stringify(acsdPage.floor.robotLayer.getPlace('LR01'))"
        first = self.run_script(get_place)
        self.submit(make_carrying_plan("P1"))
        wait_until(lambda: self.run_script(get_place) != first, "LR01 is shown elsewhere")

        self.press("/")
        wait_until(lambda: self.find("#find-dialog").is_displayed(), "the search is open")
        self.press(LAST)
        self.wait_for_text("#find-results", LAST)
        self.press(Keys.ENTER)
        self.wait_for_text("#detail-title", LAST)
        self.click_button("Block")
        self.click("#confirm-action")
        wait_until(lambda: any(button.text == "Unblock" for button in self.find_all("#detail button")), "the node is blocked")
        self.assertEqual([block["id"] for block in self.read_json("/v1/site")["blocked"]], [LAST])
        self.wait_for_plan("P1", "Completed")


if __name__ == "__main__":
    main()
