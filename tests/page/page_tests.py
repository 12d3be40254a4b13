"""The tests that test_page.py runs."""

from suites.alarm_tests import Alarms
from suites.command_tests import Commands
from suites.connection_tests import Connection
from suites.event_tests import Events
from suites.floor_tests import Floor
from suites.general_tests import AnyAcsd, Header, Language
from suites.keyboard_tests import Keyboard, Lists
from suites.performance_tests import Performance
from suites.plan_detail_tests import PlanDetail
from suites.plan_tests import Causes, Plans
from suites.robot_tests import Actions, Carriers, Detail
from suites.safety_tests import Safety
from suites.stability_tests import Stability
