#!/usr/bin/env python3
"""e17_arm_job: the result that it prints is what the arm did, according to the floor and to the controller's relays."""

import json
import re
import unittest
import urllib.request

from scenario_case import FINISH_SECONDS, STATUS_SECONDS, TIME_SCALE, ScenarioCase, main

PROGRAM = 11  # TrayLoad: from A{ml106}.CP{ml107}.TP{ml108} to the robot's TP{ml109}
INPUTS = ("ml106=1", "ml107=2", "ml108=1", "ml109=2")  # TRAY_01 is at A01.CP02.TP01.
FINISHED, FAILED, NOT_STARTED = 0, 1, 3
LINE = re.compile(rf"program {PROGRAM} (finished|failed|not started), job (\d+): (.*)")


class ArmJob(ScenarioCase):
    def start_controller(self, *options):
        """The arm CR01, whose base is docked at A01.CP02."""
        self.line.share_world()
        self.line.start_broker()
        self.line.start_vehicles(TIME_SCALE, ("CR01,type=CR,node=D-A01.CP02",)).wait_ready()
        self.arm = self.line.start_arm(TIME_SCALE, "--ready", *options).wait_ready()

    def run_lesson(self, *inputs, program=PROGRAM):
        lesson = self.line.start("e17_arm_job", *self.arm["stream"].split(":"), program, *inputs)
        code = lesson.wait(FINISH_SECONDS)
        self.text = lesson.log.read_text()
        lesson.stop()  # Closes its log: the next job has the same one.
        self.line.forget(lesson)
        return code, self.text.splitlines()[-1]

    def read_words(self):
        url = f"http://{self.arm['http']}/project/plc/m/val_s32?st=400&len=16"
        with urllib.request.urlopen(url, timeout=STATUS_SECONDS) as answer:
            return json.load(answer)

    def read_moves(self):
        journal = self.line.folder / "world.json.journal"
        return [(event["carrier"], event["from"], event["to"]) for event in map(json.loads, journal.read_text().splitlines())
                if event["event"] == "CarrierMoved"]

    def test_a_finished_job_has_moved_the_tray(self):
        self.start_controller()
        code, line = self.run_lesson(*INPUTS)
        self.assertEqual(code, FINISHED, line)
        how, job, detail = LINE.fullmatch(line).groups()
        self.assertEqual((how, detail), ("finished", f"echo {job}"))
        self.assertEqual(self.read_words()[:10], [1, 1, 0, PROGRAM, int(job), int(job), 1, 2, 1, 2])
        self.assertEqual(self.read_moves(), [("TRAY_01", "A01.CP02.TP01", "CR01.TP02")])

    def test_the_same_job_again_fails_because_the_tray_is_gone(self):
        self.start_controller()
        first = self.run_lesson(*INPUTS)
        code, line = self.run_lesson(*INPUTS)
        self.assertEqual((first[0], code), (FINISHED, FAILED), line)
        self.assertEqual(LINE.fullmatch(line)[1], "failed")
        self.assertNotEqual(LINE.fullmatch(line)[2], LINE.fullmatch(first[1])[2], "two jobs have one number")
        self.assertEqual(self.read_words()[:4], [2, 1, 1, PROGRAM])
        self.assertEqual(len(self.read_moves()), 1)

    def test_a_wrong_input_is_found_before_the_start(self):
        self.start_controller("--fault", "1 wrong-value")
        code, line = self.run_lesson(*INPUTS)
        self.assertEqual(code, NOT_STARTED, line)
        self.assertIn("/project/plc/set_relay_value: ", line)
        self.assertEqual(self.read_words()[:3], [0, 0, 0])
        self.assertEqual(self.read_moves(), [])

    def test_a_refused_start_moves_nothing(self):
        self.start_controller("--fault", "1 estop")
        code, line = self.run_lesson(*INPUTS)
        self.assertEqual(code, NOT_STARTED, line)
        self.assertIn("/project/robot/start: ", line)
        self.assertEqual(self.read_words()[:3], [0, 0, 0])

    def test_the_end_of_a_job_is_found_after_a_lost_connection(self):
        self.start_controller("--program", f"{PROGRAM}=40s", "--fault", f"1 drop program={PROGRAM}")
        code, line = self.run_lesson(*INPUTS)
        self.assertEqual(code, FINISHED, line)
        self.assertIn("connection lost: ", self.text)
        self.assertEqual(self.read_moves(), [("TRAY_01", "A01.CP02.TP01", "CR01.TP02")])

    def test_a_word_of_the_program_is_no_input(self):
        self.start_controller()
        for wrong in ("ml104=1", "ml116=1", "ml106", "x106=1", "ml106=1x"):
            self.assertEqual(self.run_lesson(wrong)[0], 2, wrong)


if __name__ == "__main__":
    main()
