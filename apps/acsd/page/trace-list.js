// The newest messages of a robot or plan, from the message trace of acsd.

import {getLines} from "./api.js";
import {make, setText} from "./dom.js";
import {formatClock} from "./format.js";
import {t} from "./text.js";

const LIMIT = 40;

let areShown = false; // kept for the next detail

/** What a message is, in a few words: its MCS command, or the last levels of its topic. */
function nameMessage(line) {
    if (line.topic) {
        return line.topic.split("/").slice(-1)[0];
    }
    try {
        const message = JSON.parse(line.text);
        return message.command ?? message.type ?? line.link;
    } catch {
        return (line.text ?? "").slice(0, 60);
    }
}

function formatText(text) {
    try {
        return JSON.stringify(JSON.parse(text), null, 2);
    } catch {
        return text;
    }
}

function makeLine(line) {
    if (line.lost !== undefined) {
        return make("li", {class: "message muted", text: t("trace.lost", {n: line.lost})});
    }
    const body = make("pre", {tabindex: 0});
    const details = make("details", {}, make("summary", {},
        make("time", {datetime: line.time, text: formatClock(Date.parse(line.time))}),
        make("span", {class: "direction", text: line.direction === "in" ? "→" : "←", title: t(`trace.${line.direction}`)}),
        make("span", {class: "tag", text: line.link}), make("span", {class: "message-name", text: nameMessage(line)})), body);
    details.addEventListener("toggle", () => {
        setText(body, details.open ? formatText(line.text ?? "") : "");
    });
    return make("li", {class: "message"}, details);
}

export class TraceList {
    /** The query of /v1/trace: "robot=LR01" or "plan=P1", encoded. */
    constructor(query) {
        this.query = query;
        this.list = make("ol", {class: "messages"});
        this.note = make("p", {class: "muted"});
        this.button = make("button", {type: "button", class: "button small", text: t("trace.show"), onclick: () => this.load()});
        const title = make("h3", {}, make("span", {text: t("trace.title")}), this.button);
        this.node = make("section", {class: "trace"}, title, this.note, this.list);
        if (areShown) {
            this.load();
        }
    }

    async load() {
        areShown = true;
        this.button.disabled = true;
        this.button.textContent = t("trace.refresh");
        try {
            const lines = await getLines(`/v1/trace?limit=${LIMIT}&${this.query}`);
            setText(this.note, lines.length === 0 ? t("trace.none") : "");
            this.list.replaceChildren(...lines.reverse().map(makeLine));
        } catch (error) {
            this.list.replaceChildren();
            setText(this.note, error.status === 404 ? t("trace.off") : error.message);
        }
        this.button.disabled = false;
    }
}
