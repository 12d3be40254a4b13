"""Plans for the example site, as an MCS sends them."""

TRAY_MEMORIES = 25
SET_MEMORIES = 32


def make_carrying_plan(plan_id):
    """LR: a cassette from one place to another."""
    return {
        "planId": plan_id, "lotId": "LOT", "priority": 1,
        "steps": [
            {"stepNo": 1, "action": "CassetteLoad", "position": "A01.CP01", "carrierIds": ["C-" + plan_id],
             "jobs": [{"jobId": plan_id + "-1", "from": "A01.CP01", "to": "AMR.CP01"}]},
            {"stepNo": 2, "action": "CassetteUnload", "position": "A01.CP02", "carrierIds": ["C-" + plan_id],
             "jobs": [{"jobId": plan_id + "-2", "from": "AMR.CP01", "to": "A01.CP02"}]}]}


def make_memory_plan(plan_id, jobs):
    """CR: `jobs` memories from its trays into a set. The trays must be on record (make_tray_memory_plan)."""
    return {
        "planId": plan_id, "lotId": "LOT",
        "steps": [{"stepNo": 1, "action": "MemoryPickAndPlace", "position": "A01.SET01", "jobs": [
            {"jobId": f"{plan_id}-{number}",
             "from": f"AMR.TP{number // TRAY_MEMORIES % 3 + 1:02}.MP{number % TRAY_MEMORIES + 1:02}",
             "to": f"A01.SET01.MP{number % SET_MEMORIES + 1:02}"}
            for number in range(jobs)]}]}


def make_tray_memory_plan(plan_id, jobs):
    """The same, after a step that loads the three trays."""
    plan = make_memory_plan(plan_id, jobs)
    plan["steps"][0]["stepNo"] = 2
    plan["steps"].insert(0, {
        "stepNo": 1, "action": "TrayLoad", "position": "A01.CP01", "carrierIds": ["T1", "T2", "T3"], "jobs": [
            {"jobId": f"{plan_id}-T{tray}", "from": f"A01.CP01.TP{tray:02}", "to": f"AMR.TP{tray:02}"}
            for tray in range(1, 4)]})
    return plan
