// acsd itself: ready state, links, TSC, outbox, and the session of the user.

import {post} from "./api.js";
import {describeLinkRemedy, describeRefusal} from "./causes.js";
import {Commands, makeCommandButton} from "./commands.js";
import {forgetLogin, hasLoggedIn} from "./dialogs.js";
import {make, makeFact, makeLink, setHidden, showChildren} from "./dom.js";
import {formatTime, setSince} from "./format.js";
import {makeGlyph} from "./glyphs.js";
import {nameState, t} from "./text.js";

function makeState(isGood, text) {
    return make("span", {class: isGood ? "state good" : "state bad"}, makeGlyph(isGood ? "done" : "failed"), text);
}

function makeSince(text, key) {
    const node = make("span", {class: "muted"});
    setSince(node, text, key);
    return node;
}

function makeExplanation(cause, remedy) {
    const makeRow = (key, text) => [make("dt", {text: t(key)}), make("dd", {text})];
    return make("dl", {class: "alarm-text"}, ...cause === "" ? [] : makeRow("alarm.cause", cause),
        ...makeRow("alarm.remedy", remedy));
}

export class SystemView {
    constructor(context) {
        this.context = context;
        this.root = document.getElementById("view-system");
        this.build();
    }

    build() {
        this.facts = make("dl", {class: "facts"});
        this.session = make("div", {class: "row-buttons session"});
        this.root.replaceChildren(this.facts, this.session);
        this.update();
    }

    isAffected(changes) {
        return changes.status;
    }

    getCount() {
        return null;
    }

    update() {
        const {status, blocks} = this.context.model;
        if (status === null) {
            return;
        }
        const rows = [];
        const add = (key, ...children) => rows.push(...makeFact(key, t(key), ...children));
        add("system.ready", makeState(status.ready, t(status.ready ? "system.isReady" : "system.notReady")),
            status.notReadyReasons.length > 0
                ? make("ul", {class: "reasons"}, ...status.notReadyReasons.map((reason) => make("li", {text: reason}))) : null);
        add("system.tsc", make("span", {class: status.tsc === "Auto" ? "state good" : "state warn"}, nameState("tsc", status.tsc)),
            status.tscReason ? make("span", {class: "muted", text: ` ${status.tscReason}`}) : null,
            make("div", {class: "row-buttons"},
                makeCommandButton(status.tsc === "Auto" ? Commands.pauseTSC() : Commands.resumeTSC())));
        for (const link of status.links) {
            rows.push(...makeFact(`link ${link.name}`, nameState("link", link.name),
                makeState(link.up, t(link.up ? "link.up" : "link.down")), " ", makeSince(link.since),
                link.broker ? make("span", {class: "muted", text: ` ${link.broker}`}) : null,
                link.reason ? make("p", {class: "reason", text: link.reason}) : null,
                link.up ? null : makeExplanation("", describeLinkRemedy(link))));
        }
        add("system.toMcs", status.isConnected === null ? make("span", {class: "muted", text: t("system.notReported")})
            : makeState(status.isConnected, t(status.isConnected ? "system.connected" : "system.disconnected")));
        add("system.outbox", t("system.reports", {n: status.outbox.reports}), " ",
            status.outbox.oldest ? makeSince(status.outbox.oldest) : null);
        const refused = status.refusedReports;
        const refusal = refused.last ? describeRefusal(refused.last) : null;
        add("system.refused", String(refused.count),
            refused.last ? make("p", {class: "reason", text: [refused.last.command, refused.last.planId, refused.last.message]
                .filter(Boolean).join(" · ")}) : null,
            refusal ? makeExplanation(refusal.cause, refusal.remedy) : null);
        const blockRows = [...blocks].map(([key, {kind, id, reason}]) => make("li", {"data-key": key},
            makeLink(this.context.select, kind, id, `${t(`kind.${kind}`)} ${id}`), reason ? ` ${reason}` : ""));
        add("system.blocked", blocks.size === 0 ? "–" : make("ul", {class: "reasons"}, ...blockRows));
        add("system.version", status.version);
        add("system.started", formatTime(status.startedAt), " ", makeSince(status.startedAt, "system.uptime"));
        showChildren(this.facts, ...rows);
        const logout = make("button", {
            type: "button", class: "button", "data-key": "logout", text: t("login.logout"), onclick: () => this.#logout()});
        showChildren(this.session, ...hasLoggedIn() ? [logout] : []);
        setHidden(this.session, !hasLoggedIn());
    }

    async #logout() {
        try {
            await post("/v1/logout");
            forgetLogin();
            location.reload();
        } catch (error) {
            this.context.showError(error);
        }
    }
}
