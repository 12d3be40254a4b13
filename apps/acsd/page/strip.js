// The strip at the top: the state of everything in one line.

import {Commands, makeCommandButton} from "./commands.js";
import {make, setAttribute, setClass, setHidden, setText, showChildren} from "./dom.js";
import {setSince} from "./format.js";
import {getRobotGlyph, getRobotGroup, makeGlyph} from "./glyphs.js";
import {nameState, t} from "./text.js";

const ROBOT_ORDER = ["Error", "Disconnected", "Stopped", "Manual", "Init", "Working", "Moving", "Arrival", "Docking", "UnDocking",
    "Charging", "Idle"];

class Cell {
    constructor(name, label, onclick) {
        this.value = make("span", {class: "cell-value"});
        this.extra = make("span", {class: "cell-extra"});
        this.node = make(onclick ? "button" : "div", {class: "cell", id: `strip-${name}`, type: onclick ? "button" : null, onclick},
            make("span", {class: "cell-label", text: label}), make("span", {class: "cell-line"}, this.value, this.extra));
    }

    set(value, kind = "") {
        setText(this.value, value);
        setClass(this.node, `cell ${kind}`.trim());
    }
}

export class Strip {
    constructor(context) {
        this.context = context;
        this.root = document.getElementById("strip");
        this.build();
    }

    build() {
        const open = (tab) => () => this.context.openTab(tab);
        this.ready = new Cell("ready", t("strip.state"), open("system"));
        this.tsc = new Cell("tsc", "TSC", open("system"));
        this.linkCell = new Cell("links", t("strip.links"), open("system"));
        this.outbox = new Cell("outbox", t("strip.outbox"), open("system"));
        this.plans = new Cell("plans", t("strip.plans"), open("plans"));
        this.robots = new Cell("robots", t("strip.robots"), open("robots"));
        this.alarms = new Cell("alarms", t("strip.alarms"), open("alarms"));
        this.tscButton = make("span", {class: "no-wall tsc-button"});
        this.shownLinks = this.shownRobots = null; // the new cells are empty
        this.root.replaceChildren(this.ready.node, this.alarms.node, this.tsc.node, this.tscButton, this.linkCell.node,
            this.outbox.node, this.plans.node, this.robots.node);
        this.update();
    }

    isAffected(changes) {
        return changes.status || changes.alarms;
    }

    update() {
        const {status} = this.context.model;
        setHidden(this.root, status === null);
        if (status === null) {
            return;
        }
        this.ready.set(t(status.ready ? "system.isReady" : "system.notReady"), status.ready ? "good" : "bad");
        setAttribute(this.ready.node, "title", status.notReadyReasons.join("\n"));
        this.tsc.set(nameState("tsc", status.tsc), status.tsc === "Auto" ? "" : "warn");
        const command = status.tsc === "Auto" ? Commands.pauseTSC() : Commands.resumeTSC();
        showChildren(this.tscButton, makeCommandButton(command, "small"));
        this.#showLinks(status);
        this.outbox.set(String(status.outbox.reports), "");
        setSince(this.outbox.extra, status.outbox.oldest);
        this.plans.set(String(status.plans.active));
        setText(this.plans.extra, t("strip.waiting", {n: status.plans.waiting}));
        this.#showRobots(status.robots);
        const {heavy, light} = status.alarms;
        this.alarms.set(String(heavy + light), heavy > 0 ? "bad" : light > 0 ? "warn" : "");
        setText(this.alarms.extra, heavy > 0 ? t("strip.heavy", {n: heavy}) : "");
    }

    #showLinks(status) {
        const isUp = status.links.every((link) => link.up);
        setClass(this.linkCell.node, isUp ? "cell" : "cell bad");
        setAttribute(this.linkCell.node, "title", status.links.filter((link) => link.reason).map((link) => link.reason).join("\n"));
        const shown = status.links.map((link) => `${link.name}${link.up}`).join();
        if (this.shownLinks !== shown) {
            this.shownLinks = shown;
            this.linkCell.value.replaceChildren(...status.links.map((link) => make("span", {
                class: link.up ? "link-state" : "link-state down",
            }, makeGlyph(link.up ? "done" : "failed"), nameState("link", link.name))));
        }
    }

    #showRobots({total, byStatus}) {
        this.robots.set(String(total));
        const shown = JSON.stringify(byStatus);
        if (this.shownRobots === shown) {
            return;
        }
        this.shownRobots = shown;
        // One count for each shape.
        const counts = new Map();
        for (const status of ROBOT_ORDER.filter((name) => (byStatus[name] ?? 0) > 0)) {
            const glyph = getRobotGlyph({status, maintenance: false});
            const count = counts.get(glyph) ?? {number: 0, names: [], group: getRobotGroup({status, maintenance: false})};
            count.number += byStatus[status];
            count.names.push(nameState("robotStatus", status));
            counts.set(glyph, count);
        }
        this.robots.extra.replaceChildren(...[...counts].map(([glyph, {number, names, group}]) => make("span", {
            class: "mini", title: names.join(", ")}, make("span", {class: `badge group-${group}`}, makeGlyph(glyph)),
        make("span", {class: "sr-only", text: names.join(", ")}), String(number))));
    }
}
