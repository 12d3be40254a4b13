#!/usr/bin/env python3
"""Faults of a real line on the live page, in Chromium: it shows the cause and the remedy of each, in English and in Korean, with
the update of the event feed that names the fault."""

import json

from browser_case import BrowserCase, wait_until
from line_faults import (ArmMotorOff, BrokerGone, DiskFull, EdgeBlocked, FaultCase, RegistrationRefused, ReportsRefused,
                         VehicleKilled, VehicleLost)
from scenario_case import REPOSITORY, main

KOREAN_ALARMS = REPOSITORY / "apps" / "acsd" / "page" / "alarms.ko.json"


class PageFaults(FaultCase, BrowserCase):
    def check(self, kind, tab, selector, list_texts):
        """The function returns what is shown: a list of texts for each language, the remedy last. The page is open from before the
        fault, and is not loaded again."""
        fault = kind(self)
        fault.start()
        self.open_page(self.address)
        self.click(f"#tab-{tab}")
        self.begin(fault)
        if tab == "plans":
            self.click(f"#view-plans li[data-id='{fault.plans[-1]}'] .row")
        texts = list_texts(fault)
        for text in texts["en"]:
            self.wait_for_text(selector, text)
        self.click("#language-button")
        for text in texts["ko"]:
            self.wait_for_text(selector, text)
        fault.end()
        self.wait_until_over(fault)
        wait_until(lambda: self.get_text("#strip-ready .cell-value") == "가능", "acsd is ready")
        if kind is not ReportsRefused:  # the page keeps the last refused report, as acsd does
            wait_until(lambda: texts["ko"][-1] not in self.get_text(selector), "the remedy is gone")

    def list_alarm_texts(self, fault):
        alarm = next(alarm for alarm in self.read_status(self.address)["alarms"] if alarm["errorCode"] == fault.code)
        korean = json.loads(KOREAN_ALARMS.read_text(encoding="utf-8"))[fault.code]
        def show(text):
            return text.replace("ROBOT", alarm["robotId"]).replace("`", "")

        return {language: [alarm["message"], *(show(source[name]) for name in ("title", "cause", "remedy"))]
                for language, source in (("en", alarm), ("ko", korean))}

    def check_alarm(self, kind):
        self.check(kind, "alarms", "#view-alarms", self.list_alarm_texts)

    def find_link_reason(self, name):
        return next(link["reason"] for link in self.read_json("/v1/status")["links"] if link["name"] == name)

    def test_the_broker_is_gone(self):
        self.check(BrokerGone, "system", "#view-system", lambda fault: {
            "en": [self.find_link_reason("mqtt"), fault.remedy],
            "ko": [self.find_link_reason("mqtt"), "MQTT 브로커와 브로커까지의 네트워크를 점검하십시오."]})

    def test_the_broker_is_gone_above_the_alarms(self):
        self.check(BrokerGone, "alarms", "#view-alarms", lambda fault: {
            "en": ["The link mqtt is down", self.find_link_reason("mqtt"), fault.remedy],
            "ko": ["mqtt 통신이 끊겼습니다.", self.find_link_reason("mqtt"), "MQTT 브로커와 브로커까지의 네트워크를 점검하십시오."]})

    def test_the_emergency_stop_of_an_arm_on_the_plan(self):
        self.check(ArmMotorOff, "plans", "#detail .alarms", self.list_alarm_texts)

    def test_the_mcs_refuses_the_registration(self):
        self.check(RegistrationRefused, "system", "#view-system", lambda fault: {
            "en": [fault.cause, fault.remedy], "ko": [fault.cause, "MCS가 이 ACS의 등록만 수락해야 합니다."]})

    def test_the_mcs_refuses_reports(self):
        self.check(ReportsRefused, "system", "#view-system", lambda fault: {
            "en": ["Refused by the test.", "The state of the MCS differs from that of acsd.", fault.remedy],
            "ko": ["Refused by the test.", "MCS의 상태가 acsd와 다릅니다.", "MCS에서 Plan을 수정하십시오."]})

    def test_an_edge_is_blocked(self):
        self.check(EdgeBlocked, "plans", "#detail", lambda fault: {
            "en": [f"edge {fault.edges[0]} is blocked: wet floor", f"Unblock edge {fault.edges[0]} when it is free."],
            "ko": [f"edge {fault.edges[0]} is blocked: wet floor", f"{fault.edges[0]}에 장애물이 없으면 사용 금지를 해제하십시오."]})

    def test_a_vehicle_is_lost(self):
        self.check_alarm(VehicleLost)

    def test_the_program_of_a_vehicle_is_killed(self):
        self.check_alarm(VehicleKilled)

    def test_the_emergency_stop_of_an_arm_is_pressed(self):
        self.check_alarm(ArmMotorOff)

    def test_the_disk_is_full(self):
        self.check_alarm(DiskFull)


if __name__ == "__main__":
    main()
