// What has happened since the page was opened.

import {KeyedList, make, setHidden} from "./dom.js";
import {formatClock} from "./format.js";
import {t, nameState} from "./text.js";

const SHOWN = 200;
const KINDS = ["plan", "step", "job", "alarm", "robot", "tsc", "link", "command", "action", "note"];

class EntryRow {
    constructor(entry) {
        this.node = make("li", {class: `entry entry-${KINDS.includes(entry.kind) ? entry.kind : "note"}`},
            make("time", {datetime: entry.time, text: formatClock(Date.parse(entry.time))}),
            make("span", {class: "tag", text: nameState("entry", entry.kind)}),
            make("span", {text: entry.text.replaceAll("->", "→")}));
    }

    update() {
        // An entry never changes.
    }
}

export class EventView {
    constructor(context) {
        this.context = context;
        this.root = document.getElementById("view-events");
        this.kind = "";
        this.build();
    }

    build() {
        const list = make("ol", {class: "entries", role: "log", "aria-live": "off", "aria-label": t("tab.events")});
        this.select = make("select", {"aria-label": t("event.kind"), onchange: () => {
            this.kind = this.select.value;
            this.update();
        }}, make("option", {value: "", text: t("event.all")}),
        ...KINDS.map((kind) => make("option", {value: kind, text: nameState("entry", kind), selected: kind === this.kind})));
        this.list = new KeyedList(list, (entry) => entry.number, (entry) => new EntryRow(entry));
        this.empty = make("p", {class: "empty", text: t("event.none")});
        this.root.replaceChildren(make("div", {class: "view-head"}, this.select), this.empty, list);
        this.update();
    }

    isAffected(changes) {
        return changes.entries;
    }

    getCount() {
        return null;
    }

    update() {
        const entries = this.context.model.entries.filter((entry) => this.kind === "" || entry.kind === this.kind).slice(0, SHOWN);
        setHidden(this.empty, entries.length > 0);
        this.list.show(entries);
    }
}
