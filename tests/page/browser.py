"""Headless Chromium for the tests and pictures of the live page."""

import os
import shutil
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service


class Browser:
    """driver: of selenium. Its folder is removed at the end."""

    def __init__(self, width=1366, height=768, scale=1, is_dark=False, is_touch=False, language="en"):
        self.folder = tempfile.mkdtemp(prefix="acs-page-")
        options = Options()
        for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--hide-scrollbars",
                         "--no-first-run", "--disable-extensions", "--disable-background-networking",
                         f"--user-data-dir={self.folder}", f"--lang={language}", f"--window-size={width},{height}",
                         f"--force-device-scale-factor={scale}"):
            options.add_argument(argument)
        if is_dark:
            options.add_argument("--force-dark-mode")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        options.binary_location = shutil.which("chromium") or "chromium"
        service = Service(shutil.which("chromedriver") or "chromedriver", env={**os.environ, "LANGUAGE": language})
        self.driver = webdriver.Chrome(service=service, options=options)
        self.resize(width, height, scale, is_touch)

    def resize(self, width, height, scale=1, is_touch=False):
        """The size of the page itself."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": scale, "mobile": is_touch})

    def read_log(self):
        """What the page has written to its console, errors of the policy among it."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def close(self):
        self.driver.quit()
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def list_processes(folder):
    """pid -> type ("browser", "renderer", "gpu-process" …) of the Chromium with this user folder."""
    found = {}
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            with open(f"/proc/{name}/cmdline", "rb") as file:
                arguments = file.read().decode(errors="replace").replace("\0", " ").split()
        except OSError:
            continue
        if any(folder in argument for argument in arguments):
            kinds = [argument.removeprefix("--type=") for argument in arguments if argument.startswith("--type=")]
            found[int(name)] = kinds[0] if kinds else "browser"
    return found


def read_cpu_seconds(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii", errors="replace") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
