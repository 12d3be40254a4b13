// The instant actions of a robot: those that it offers, and the last ones with their outcome.

import {getJson} from "./api.js";
import {Commands, makeCommandButton} from "./commands.js";
import {make, setHidden, setText, showChildren} from "./dom.js";
import {formatClock} from "./format.js";
import {nameState, t} from "./text.js";

let areShown = false; // kept for the next detail

function makeRow(action) {
    const rest = [action.resultDescription, action.reason].filter(Boolean).join(" · ");
    return make("li", {class: "message action"},
        make("p", {class: "action-head"},
            make("time", {datetime: action.requestedAt, text: formatClock(Date.parse(action.requestedAt))}),
            make("span", {class: "message-name", text: action.actionType}),
            make("span", {class: "tag", text: nameState("actionStatus", action.status)})),
        rest ? make("p", {class: "muted", text: rest}) : null);
}

export class ActionList {
    constructor(robotId, entries) {
        this.robotId = robotId;
        this.lastEntry = this.#findNewest(entries);
        this.offers = make("div", {class: "row-buttons no-wall", hidden: true});
        this.list = make("ol", {class: "messages"});
        this.note = make("p", {class: "muted"});
        this.button = make("button", {type: "button", class: "button small", text: t("trace.show"), onclick: () => this.load()});
        this.node = make("section", {class: "actions"},
            make("h3", {}, make("span", {text: t("action.title")}), this.button), this.note, this.offers, this.list);
        if (areShown) {
            this.load();
        }
    }

    /** Loads again after each event about an action of the robot, and when all may have changed. */
    update(isAll, entries) {
        const newest = this.#findNewest(entries);
        if (isAll || newest > this.lastEntry) {
            this.lastEntry = newest;
            if (areShown) {
                this.load();
            }
        }
    }

    /** One request at a time, so that the last answer is the newest. */
    async load() {
        areShown = true;
        this.button.textContent = t("trace.refresh");
        this.isStale = true;
        if (this.isLoading) {
            return;
        }
        this.isLoading = true;
        while (this.isStale) {
            this.isStale = false;
            await this.#loadOnce();
        }
        this.isLoading = false;
    }

    /** The number of the newest event about an action of the robot; 0 without one. */
    #findNewest(entries) {
        return entries.find((entry) => entry.kind === "action" && entry.robotId === this.robotId)?.id ?? 0;
    }

    async #loadOnce() {
        try {
            const {actions, offered} = await getJson(`/v1/robots/${encodeURIComponent(this.robotId)}/actions`);
            setText(this.note, offered.length === 0 ? t("action.noneOffered") : "");
            setHidden(this.offers, offered.length === 0);
            showChildren(this.offers, ...offered.map((offer) => makeCommandButton(Commands.sendAction(this.robotId, offer))));
            this.list.replaceChildren(...actions.reverse().map(makeRow));
        } catch (error) {
            setText(this.note, error.message);
        }
    }
}
