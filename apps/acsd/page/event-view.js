// What has happened: the entries that acsd still had when the view was opened, and those since then.

import {KeyedList, make, setHidden, setText} from "./dom.js";
import {formatClock} from "./format.js";
import {loadPast} from "./past.js";
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
        this.loadedID = null; // the entries up to this event are loaded
        this.isLoading = false;
        this.build();
    }

    build() {
        const list = make("ol", {class: "entries", role: "log", "aria-live": "off", "aria-label": t("tab.events")});
        this.select = make("select", {"aria-label": t("event.kind"), onchange: () => {
            this.kind = this.select.value;
            this.update();
        }}, make("option", {value: "", text: t("event.all")}),
        ...KINDS.map((kind) => make("option", {value: kind, text: nameState("entry", kind), selected: kind === this.kind})));
        this.list = new KeyedList(list, (entry) => entry.id, (entry) => new EntryRow(entry));
        this.empty = make("p", {class: "empty"});
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
        this.#loadPast();
        setText(this.empty, t(this.isLoading ? "event.loading" : "event.none"));
        setHidden(this.empty, entries.length > 0);
        this.list.show(entries);
    }

    /** Once for each snapshot, and only if the view is open: the events before it may be megabytes. */
    async #loadPast() {
        const {model} = this.context;
        const last = model.firstEventID;
        if (this.root.hidden || this.isLoading || last === null || last === this.loadedID) {
            return;
        }
        this.isLoading = true;
        let entries = [];
        try {
            entries = await loadPast(last);
        } catch (error) {
            this.context.showError(error); // tried again after the next snapshot
        }
        this.loadedID = last;
        this.isLoading = false;
        model.addEntries(entries);
    }
}
