// The detail of a robot.

import {ActionList} from "./action-list.js";
import {AlarmRow, getAlarmKey} from "./alarm-view.js";
import {CauseRow, explainRobot} from "./causes.js";
import {Commands, makeCommandButton} from "./commands.js";
import {KeyedList, make, makeFact, makeLink, setHidden, showChildren} from "./dom.js";
import {formatNumber, setSince} from "./format.js";
import {getRobotGlyph, getRobotGroup, makeGlyph} from "./glyphs.js";
import {Battery, describePlace} from "./robot-view.js";
import {nameState, t} from "./text.js";
import {TraceList} from "./trace-list.js";

const DEGREES = 180 / Math.PI;

export class RobotDetail {
    constructor(context, {id}) {
        this.context = context;
        this.id = id;
        this.buttons = make("div", {class: "row-buttons no-wall"});
        this.facts = make("dl", {class: "facts"});
        this.causeList = make("ul", {class: "alarms"});
        this.causes = new KeyedList(this.causeList, (cause) => cause.key, (cause) => new CauseRow(cause, context.select));
        this.alarmList = make("ul", {class: "alarms"});
        this.alarms = new KeyedList(this.alarmList, getAlarmKey, (alarm) => new AlarmRow(alarm, context));
        this.actions = new ActionList(id, context.model.entries);
        this.node = make("div", {class: "detail-body"}, this.causeList, this.alarmList, this.facts, this.buttons, this.actions.node,
            new TraceList(`robot=${encodeURIComponent(id)}`).node);
        this.update(null);
    }

    update(changes) {
        const robot = this.context.model.robots.get(this.id);
        const {model, floor} = this.context;
        const {causes, alarms} = robot === undefined
            ? {causes: [], alarms: model.findAlarms((alarm) => alarm.robotId === this.id)}
            : explainRobot(model, floor.index, robot);
        setHidden(this.causeList, causes.length === 0);
        this.causes.show(causes);
        setHidden(this.alarmList, alarms.length === 0);
        this.alarms.show(alarms);
        setHidden(this.actions.node, robot === undefined);
        if (robot === undefined) {
            this.facts.replaceChildren(make("dd", {text: t("detail.gone")}));
            showChildren(this.buttons);
            return;
        }
        this.actions.update(changes?.isAll ?? false, model.entries);
        if (changes === null || changes.isAll || changes.robots.has(this.id)) {
            this.#showFacts(robot);
            showChildren(this.buttons, makeCommandButton(Commands.setMaintenance(robot)),
                ...robot.ports.length > 0 ? [makeCommandButton(Commands.setCarriers(robot, model))] : []);
        }
    }

    #showFacts(robot) {
        const rows = [];
        const add = (key, ...children) => rows.push(...makeFact(key, t(key), ...children));
        add("robot.status", make("span", {class: `badge group-${getRobotGroup(robot)}`}, makeGlyph(getRobotGlyph(robot))), " ",
            nameState("robotStatus", robot.status), robot.maintenance ? ` · ${t("robot.maintenance")}` : "",
            robot.reason ? make("p", {class: "reason", text: robot.reason}) : null);
        add("robot.plan", robot.planId ? makeLink(this.context.select, "plan", robot.planId) : "–",
            robot.planId ? ` ${t("plan.step", {n: robot.stepNo ?? "–"})}` : "",
            robot.jobId ? make("span", {class: "muted", text: ` ${robot.jobId}`}) : null);
        add("robot.place", robot.node ? this.#makePlaceLink(robot) : describePlace(robot),
            robot.position ? make("span", {class: "muted", text: ` ${robot.position}`}) : null,
            robot.pose ? make("p", {class: "muted", text: `x ${formatNumber(robot.pose.x)} m, y ${formatNumber(robot.pose.y)} m, `
                + `${formatNumber(robot.pose.theta * DEGREES, 0)}°`}) : null);
        if (robot.battery !== null) {
            const battery = new Battery();
            battery.update(robot.battery);
            add("robot.battery", battery.node);
        }
        add("robot.carriers", make("ul", {class: "ports"}, ...robot.ports.map((port, i) => make("li", {},
            make("span", {class: "muted", text: port}), " ", robot.carrierIds[i] ?? t("robot.empty")))));
        add("robot.route", robot.route.length === 0 ? "–" : make("span", {class: "route"}, ...robot.route.flatMap((step, i) => [
            i > 0 ? " → " : "", make("span", {class: step.reserved ? "reserved" : "horizon", text: step.nodeId})])));
        add("robot.vehicle", [robot.type, robot.driver, robot.protocolVersion, robot.mode].filter(Boolean).join(" · "),
            robot.topic ? make("p", {class: "muted", text: robot.topic}) : null);
        if (robot.armUp !== null) {
            add("robot.arm", t(robot.armUp ? "link.up" : "link.down"));
        }
        const last = make("span");
        setSince(last, robot.lastMessageAt);
        add("robot.lastMessage", robot.lastMessageAt ? last : "–");
        if (robot.errors.length > 0) {
            add("robot.errors", make("ul", {class: "reasons"}, ...robot.errors.map((error) => make("li", {
                text: [error.level, error.type, error.description].filter(Boolean).join(" · ")}))));
        }
        if (robot.warnings.length > 0) {
            add("robot.warnings", make("ul", {class: "reasons"}, ...robot.warnings.map((warning) => make("li", {text: warning}))));
        }
        showChildren(this.facts, ...rows);
    }

    /** One link while the robot drives, to where it is then. */
    #makePlaceLink(robot) {
        const getNode = () => this.context.model.robots.get(this.id)?.node ?? robot.node;
        return make("button", {type: "button", class: "link", "data-key": "place", text: describePlace(robot),
            onclick: () => this.context.select({kind: "node", id: getNode()})});
    }
}
