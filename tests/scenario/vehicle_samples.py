"""Messages of a VDA5050 2.0 vehicle for the example site, as a hostile vehicle sends them."""

import datetime
import json


def make_vehicle_message(serial, header_id, **members):
    now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%S.%f")[:-3] + "Z"
    return json.dumps({"headerId": header_id, "timestamp": now, "version": "2.0.0", "manufacturer": "ACS",
                       "serialNumber": serial} | members)


def make_idle_state(serial, number, errors=(), charge=42.0, node="", place=(0.0, 0.0), map_id="hall"):
    """The state of an idle vehicle with these errors (type, description)."""
    return make_vehicle_message(
        serial, number + 1, orderId="", orderUpdateId=0, lastNodeId=node, lastNodeSequenceId=0, nodeStates=[], edgeStates=[],
        actionStates=[], driving=False, operatingMode="AUTOMATIC",
        errors=[{"errorType": kind, "errorLevel": "WARNING", "errorDescription": text} for kind, text in errors],
        agvPosition={"x": place[0], "y": place[1], "theta": 0.0, "mapId": map_id, "positionInitialized": True},
        batteryState={"batteryCharge": charge, "charging": False},
        safetyState={"eStop": "NONE", "fieldViolation": False})
