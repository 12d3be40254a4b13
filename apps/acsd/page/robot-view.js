// The list of robots.

import {KeyedList, make, setClass, setHidden, setText} from "./dom.js";
import {getRobotGlyph, getRobotGroup, setGlyph} from "./glyphs.js";
import {nameState, t} from "./text.js";

const LOW_BATTERY = 20; // percent

export class Battery {
    constructor() {
        this.fill = make("span", {class: "battery-fill"});
        this.text = make("span", {class: "battery-text"});
        const bar = make("span", {class: "battery-bar", "aria-hidden": "true"}, this.fill);
        this.node = make("span", {class: "battery"}, bar, this.text);
    }

    update(percent) {
        setHidden(this.node, percent === null);
        if (percent !== null) {
            setText(this.text, `${percent} %`);
            this.fill.style.width = `${Math.max(0, Math.min(100, percent))}%`;
            setClass(this.node, percent < LOW_BATTERY ? "battery low" : "battery");
        }
    }
}

export function describePlace(robot) {
    return robot.nextNode !== null ? `${robot.node ?? "?"} → ${robot.nextNode}` : robot.node ?? t("robot.unknownPlace");
}

class RobotRow {
    constructor(robot, select) {
        this.badge = make("span");
        this.id = make("span", {class: "row-id"});
        this.state = make("span", {class: "row-state"});
        this.type = make("span", {class: "tag"});
        this.place = make("span", {class: "muted row-place"});
        this.battery = new Battery();
        this.plan = make("span", {class: "row-step"});
        this.load = make("span", {class: "row-load"});
        this.reason = make("span", {class: "wait"});
        this.button = make("button", {type: "button", class: "row", onclick: () => select({kind: "robot", id: robot.robotId})},
            this.badge, make("span", {class: "row-main"},
                make("span", {class: "row-head"}, this.id, this.type, this.state, this.battery.node),
                make("span", {class: "row-line"}, this.plan, this.load, this.place), this.reason));
        this.node = make("li", {}, this.button);
        this.node.dataset.id = robot.robotId;
    }

    update(robot) {
        if (this.robot === robot) {
            return;
        }
        this.robot = robot;
        setClass(this.badge, `badge group-${getRobotGroup(robot)}`);
        setGlyph(this.badge, getRobotGlyph(robot));
        setText(this.id, robot.robotId);
        setText(this.type, robot.type);
        setText(this.state, robot.maintenance ? t("robot.maintenance") : nameState("robotStatus", robot.status));
        setText(this.place, describePlace(robot));
        this.battery.update(robot.battery);
        setText(this.plan, robot.planId ?? t("robot.noPlan"));
        setText(this.load, robot.carrierIds.filter((carrier) => carrier !== null).join(", "));
        setText(this.reason, robot.reason ?? robot.warnings.join(" "));
        setHidden(this.reason, this.reason.textContent === "");
    }
}

const RANKS = {fault: 0, off: 1, stop: 2};

export class RobotView {
    constructor(context) {
        this.context = context;
        this.root = document.getElementById("view-robots");
        this.build();
    }

    build() {
        this.filter = make("input", {
            type: "search", class: "filter", placeholder: t("robot.filterShort"), "aria-label": t("robot.filter"),
            title: t("robot.filter"), value: this.filter?.value,
            oninput: () => this.update()});
        const list = make("ul", {class: "rows", "aria-label": t("tab.robots")});
        this.list = new KeyedList(list, (robot) => robot.robotId, (robot) => new RobotRow(robot, this.context.select));
        this.empty = make("p", {class: "empty", text: t("robot.none")});
        this.root.replaceChildren(make("div", {class: "view-head no-wall"}, this.filter), this.empty, list);
        this.update();
    }

    isAffected(changes) {
        return changes.robots.size > 0;
    }

    getCount() {
        return this.context.model.robots.size;
    }

    /** Robots that need attention first, then by id. */
    update() {
        const wanted = this.filter.value.trim().toLowerCase();
        const getRank = (robot) => RANKS[getRobotGroup(robot)] ?? 3;
        const listTexts = (robot) => [robot.robotId, robot.status, robot.planId, robot.node, robot.position, ...robot.carrierIds];
        const robots = [...this.context.model.robots.values()]
            .filter((robot) => wanted === "" || listTexts(robot).some((text) => (text ?? "").toLowerCase().includes(wanted)))
            .sort((a, b) => getRank(a) - getRank(b) || a.robotId.localeCompare(b.robotId));
        setHidden(this.empty, robots.length > 0);
        this.list.show(robots);
    }
}
