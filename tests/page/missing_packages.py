"""What the tests in Chromium need besides Python."""

import importlib.util
import shutil

SKIPPED = 77  # exit code


def find_missing():
    missing = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
    return missing + ([] if importlib.util.find_spec("selenium") else ["python3-selenium"])
