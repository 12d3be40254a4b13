"""What the pictures show beside robots at work: alarms, an unresolved job, a paused plan, blocks and a lost link."""

from mock_floor import format_time, get_now


def run_ahead(mock, seconds):
    """The robots spread over the floor."""
    with mock.lock:
        for _ in range(int(seconds * 5)):
            mock.simulation.advance(0.2)
        mock.publish()


def add_troubles(mock, ahead_seconds=40):
    run_ahead(mock, ahead_seconds)
    with mock.lock:
        simulation = mock.simulation
        robots = list(simulation.robots.values())
        logistics = [robot for robot in robots if robot.type == "LR" and robot.plan is not None]
        control = [robot for robot in robots if robot.type == "CR" and robot.plan is not None]
        lost = simulation.fix(logistics[-1].robot_id, "Disconnected", "No connection for 4 min.")
        simulation.set_alarm(
            lost.robot_id, "ACS-1002", "heavy",
            f"{lost.robot_id} is disconnected: no state on uagv/v2/ACME/{lost.robot_id}/state for 30 s.",
            "Robot disconnected", "No VDA5050 connection, or no state within robot.offline_after.",
            "Check the robot, its network and the broker. For a robot that was removed from the floor, set maintenance.",
            lost.plan, 4)
        lost.plan.waits = simulation.make_wait(f"{lost.robot_id} is disconnected.")
        unresolved = simulation.fix(control[0].robot_id, "Working")
        unresolved.plan.get_step()["status"] = "InProgress"
        unresolved.plan.job_status[unresolved.plan.step_no - 1] = "InProgress"
        simulation.set_alarm(
            unresolved.robot_id, "ACS-1008", "heavy", f"Job {unresolved.plan.get_job_id()}: no report shows whether it was done.",
            "Job outcome unknown", "After a restart, a power loss of the robot, or contradicting loads.",
            "Check where the carrier is and resolve the job.", unresolved.plan, 11)
        unresolved.plan.waits = simulation.make_wait(
            f"Job {unresolved.plan.get_job_id()} is unresolved: an operator decides its outcome.")
        simulation.set_alarm(
            logistics[1].robot_id, "ACS-1011", "light", f"{logistics[1].robot_id}.CP01 reports C_017; the record has no carrier.",
            "Reported loads differ from the record", "A carrier was moved by hand, or a sensor is wrong.",
            "Check the port, then correct the record or clear the alarm.", None, 2)
        logistics[2].plan.status = "Paused"
        logistics[2].plan.waits = simulation.make_wait("The plan is paused.")
        simulation.fix(logistics[2].robot_id, "Stopped")
        simulation.changed_plans.update(simulation.plans)
        simulation.changed_robots.update(simulation.robots)
        for kind, place, reason in (("edge", "N005-N006", "Floor repair"), ("station", "A02.SET09", "Equipment down")):
            simulation.floor.blocks[(kind, place)] = {"kind": kind, "id": place, "reason": reason, "since": format_time(get_now())}
        mock.site_revision += 1
        mock.publish()
