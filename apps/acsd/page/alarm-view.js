// The list of alarms with cause and remedy, below the links that are down: these cause alarms of robots.

import {CauseRow, listLinkCauses} from "./causes.js";
import {Commands, listNamedCommands, makeCommandButton} from "./commands.js";
import {KeyedList, make, makeLink, setClass, setHidden, setMarkedText, setText, showChildren} from "./dom.js";
import {setSince} from "./format.js";
import {setGlyph} from "./glyphs.js";
import {explainAlarm, nameState, t} from "./text.js";

export function getAlarmKey(alarm) {
    return [alarm.robotId, alarm.errorCode, alarm.planId, alarm.jobId].join("\n");
}

/** Also used in the detail of a robot or plan. */
export class AlarmRow {
    constructor(alarm, {select, model}) {
        this.select = select;
        this.model = model;
        this.glyph = make("span", {class: "row-glyph"});
        this.code = make("span", {class: "tag"});
        this.title = make("span", {class: "row-id"});
        this.level = make("span", {class: "alarm-level"});
        this.since = make("span", {class: "muted"});
        this.message = make("p", {class: "alarm-message"});
        this.cause = make("dd", {class: "no-wall"});
        this.remedy = make("dd");
        this.explanation = make("dl", {class: "alarm-text"}, make("dt", {class: "no-wall", text: t("alarm.cause")}), this.cause,
            make("dt", {text: t("alarm.remedy")}), this.remedy);
        this.links = make("span", {class: "alarm-links"});
        this.named = make("span", {class: "row-buttons no-wall"});
        this.clear = makeCommandButton(Commands.clearAlarm(alarm));
        this.clear.classList.add("no-wall");
        this.node = make("li", {}, this.glyph, make("div", {class: "row-main"},
            make("div", {class: "alarm-head"}, this.level, this.title, this.since), this.message, this.explanation,
            make("div", {class: "row-buttons"}, this.code, this.links, this.named, this.clear)));
        this.node.dataset.id = alarm.errorCode;
    }

    update(alarm) {
        if (this.alarm === alarm) {
            return;
        }
        this.alarm = alarm;
        const isHeavy = alarm.level === "heavy";
        const text = explainAlarm(alarm);
        setClass(this.node, `alarm ${isHeavy ? "heavy" : "light"}`);
        setGlyph(this.glyph, isHeavy ? "error" : "light");
        setText(this.level, nameState("alarmLevel", alarm.level));
        setText(this.code, alarm.errorCode);
        setText(this.title, text.title || alarm.errorCode);
        setSince(this.since, alarm.since);
        setText(this.message, alarm.message);
        setMarkedText(this.cause, text.cause);
        setMarkedText(this.remedy, text.remedy);
        setHidden(this.explanation, text.cause === "" && text.remedy === "");
        const commands = listNamedCommands(text.remedy, this.model);
        showChildren(this.named, ...commands.map((command) => makeCommandButton(command)));
        setHidden(this.named, commands.length === 0);
        this.#showLinks(alarm);
    }

    #showLinks({robotId, planId, stepNo}) {
        showChildren(this.links,
            robotId === "ACS" ? make("span", {text: t("alarm.acsd")}) : makeLink(this.select, "robot", robotId),
            ...planId ? [makeLink(this.select, "plan", planId, [planId, stepNo].filter(Boolean).join(" / "))] : []);
    }
}

export class AlarmView {
    constructor(context) {
        this.context = context;
        this.root = document.getElementById("view-alarms");
        this.build();
    }

    build() {
        const list = make("ul", {class: "alarms", "aria-label": t("tab.alarms")});
        const causes = make("ul", {class: "alarms", "aria-label": t("strip.links")});
        this.causes = new KeyedList(causes, (cause) => cause.key, (cause) => new CauseRow(cause, this.context.select));
        this.list = new KeyedList(list, getAlarmKey, (alarm) => new AlarmRow(alarm, this.context));
        this.empty = make("p", {class: "empty", text: t("alarm.none")});
        this.root.replaceChildren(causes, this.empty, list);
        this.update();
    }

    isAffected(changes) {
        return changes.alarms || changes.status;
    }

    getCount() {
        return this.context.model.alarms.length;
    }

    update() {
        const alarms = this.context.model.listAlarms();
        this.causes.show(listLinkCauses(this.context.model));
        setHidden(this.empty, alarms.length > 0);
        this.list.show(alarms);
    }
}
