#!/usr/bin/env python3
"""The files of the live page, without a browser: both languages have the same texts, every text that is used exists, foreign text
never becomes HTML, nothing is loaded from elsewhere, and colours have enough contrast."""

import json
import pathlib
import re
import unittest

PAGE = pathlib.Path(__file__).resolve().parent.parent.parent / "apps" / "acsd" / "page"
DESCRIPTION = PAGE.parent.parent.parent / "docs" / "reference" / "openapi.json"
TEXT = re.compile(r'^    "([^"]+)": "((?:[^"\\]|\\.)*)",$', re.MULTILINE)
LONGEST_LINE = 132
LEAST_CONTRAST = 4.5  # WCAG AA
# What a reader must be able to read, on what it is shown.
PAIRS = (("text", "surface"), ("text", "surface-2"), ("text", "back"), ("muted", "surface"), ("muted", "surface-2"),
         ("accent", "surface"), ("heavy", "surface"), ("heavy", "heavy-back"), ("text", "heavy-back"), ("warn", "surface"),
         ("warn", "warn-back"), ("good", "surface"), ("accent-ink", "accent"), ("station-text", "floor"), ("text", "floor"), ("drive-ink", "drive"),
         ("work-ink", "work"), ("idle-ink", "idle"), ("charge-ink", "charge"), ("stop-ink", "stop"), ("off-ink", "off"))


def read_texts(language):
    return dict(TEXT.findall((PAGE / f"text.{language}.js").read_text(encoding="utf-8")))


def list_sources(*endings):
    return [path for path in sorted(PAGE.iterdir()) if path.suffix in endings]


def get_luminance(colour):
    def linearize(value):
        return value / 12.92 if value <= 0.03928 else ((value + 0.055) / 1.055) ** 2.4

    red, green, blue = (linearize(int(colour[i:i + 2], 16) / 255) for i in (1, 3, 5))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def get_contrast(colour, other):
    light, dark = sorted((get_luminance(colour), get_luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


class Texts(unittest.TestCase):
    def test_both_languages_have_the_same_keys(self):
        english, korean = read_texts("en"), read_texts("ko")
        self.assertGreater(len(english), 200)
        self.assertEqual(list(english), list(korean))

    def test_every_line_of_texts_is_read(self):
        for language in ("en", "ko"):
            text = (PAGE / f"text.{language}.js").read_text(encoding="utf-8")
            self.assertEqual(len(read_texts(language)), sum(line.startswith('    "') for line in text.splitlines()), language)

    def test_translations_have_the_same_values(self):
        english, korean = read_texts("en"), read_texts("ko")
        for key, text in english.items():
            self.assertEqual(sorted(re.findall(r"\{\w+\}", text)), sorted(re.findall(r"\{\w+\}", korean[key])), key)

    def test_used_texts_exist(self):
        texts = read_texts("en")
        for path in list_sources(".js", ".html"):
            source = path.read_text(encoding="utf-8")
            used = re.findall(r'\bt\("([^"]+)"', source) + re.findall(r'data-(?:text|label)="([^"]+)"', source)
            used += re.findall(r'\b(?:ask: |t\([^()]*\? )"([a-zA-Z]+\.[a-zA-Z.]+)"', source)
            for key in used:
                self.assertIn(key, texts, path.name)

    def test_every_word_of_the_api_has_a_text(self):
        schemas = json.loads(DESCRIPTION.read_text(encoding="utf-8"))["components"]["schemas"]
        words = {"alarmLevel": schemas["AlarmLevel"], "planStatus": schemas["PlanStatus"], "stepStatus": schemas["StepStatus"],
                 "jobStatus": schemas["JobStatus"], "robotStatus": schemas["RobotStatus"], "tsc": schemas["TscState"],
                 "link": schemas["Link"]["properties"]["name"], "entry": schemas["EventEntry"]["properties"]["kind"],
                 "actionStatus": schemas["Action"]["properties"]["status"],
                 "kind": schemas["Block"]["properties"]["kind"]}
        for kind, schema in words.items():
            for word in schema["enum"]:
                self.assertTrue(f"{kind}.{word}" in read_texts("en"), f"{kind}.{word}")

    def test_every_state_of_a_robot_has_a_text_and_a_shape(self):
        header = PAGE.parent.parent.parent / "libplan" / "include" / "acs" / "plan" / "ERobotStatus.hpp"
        states = re.findall(r"^    (\w+),", header.read_text(encoding="utf-8"), re.MULTILINE)
        glyphs = (PAGE / "glyphs.js").read_text(encoding="utf-8")
        self.assertGreater(len(states), 10)
        for state in states:
            self.assertIn(f"robotStatus.{state}", read_texts("en"))
            self.assertRegex(glyphs, rf"\b{state}: ")

    def test_remedies_are_those_of_acsctl(self):
        source = (PAGE.parent.parent / "acsctl" / "why" / "WhyExplainer.cpp").read_text(encoding="utf-8")
        for key in ("remedy.mqtt", "remedy.mcs", "remedy.registration", "cause.refused", "cause.retried", "remedy.refused",
                    "remedy.refusedOther"):
            self.assertIn(f'"{read_texts("en")[key]}"', source, key)

    def test_korean_texts_fit_every_id(self):
        """A particle depends on the last sound of the word before it, which is an id here."""
        for key, text in read_texts("ko").items():
            self.assertIsNone(re.search(r"[을이은과]\([를가는와]\)|\(으\)로", text), key)

    def test_korean_alarms(self):
        path = PAGE / "alarms.ko.json"
        if not path.exists():
            self.skipTest("there is no alarms.ko.json")
        for code, alarm in json.loads(path.read_text(encoding="utf-8")).items():
            self.assertEqual(sorted(alarm), ["cause", "remedy", "title"], code)


class Lines(unittest.TestCase):
    def test_no_line_is_too_long(self):
        for path in list_sources(".js", ".css", ".html"):
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                self.assertLessEqual(len(line), LONGEST_LINE, f"{path.name}:{number}")


class Safety(unittest.TestCase):
    def test_foreign_text_never_becomes_html(self):
        forbidden = re.compile(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|createContextualFragment|DOMParser|"
                               r"\beval\(|new Function|srcdoc|setHTML")
        for path in list_sources(".js", ".html"):
            self.assertIsNone(forbidden.search(path.read_text(encoding="utf-8")), path.name)

    def test_nothing_inline(self):
        source = (PAGE / "index.html").read_text(encoding="utf-8")
        self.assertIsNone(re.search(r"<style|\sstyle=|\son\w+=|<script(?![^>]*\ssrc=)|javascript:", source))

    def test_nothing_from_elsewhere(self):
        for path in list_sources(".js", ".html", ".css", ".svg"):
            source = path.read_text(encoding="utf-8").replace("http://www.w3.org/2000/svg", "")
            self.assertIsNone(re.search(r"https?://|//[a-z0-9.-]+\.(?:com|org|net|io)\b|@import|url\(", source), path.name)

    def test_imports_exist(self):
        for path in list_sources(".js"):
            for name in re.findall(r'^import [^"]*"([^"]+)";', path.read_text(encoding="utf-8"), re.MULTILINE):
                is_own = name.startswith("./") and (PAGE / name[2:]).is_file()
                self.assertTrue(is_own or name == "/page/leaflet.js", f"{path.name}: {name}")


class Colours(unittest.TestCase):
    def test_contrast(self):
        style = (PAGE / "style.css").read_text(encoding="utf-8")
        for name, head in (("light", ":root {"), ("dark", ':root[data-theme="dark"] {')):
            block = style.split(head, 1)[1].split("}", 1)[0]
            colours = dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", block))
            for colour, back in PAIRS:
                with self.subTest(theme=name, colour=colour, back=back):
                    self.assertGreaterEqual(get_contrast(colours[colour], colours[back]), LEAST_CONTRAST)


if __name__ == "__main__":
    unittest.main()
