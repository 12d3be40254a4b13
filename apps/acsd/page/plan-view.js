// The list of plans: what each does, how far it is, and why it waits.

import {getJson} from "./api.js";
import {KeyedList, make, setAttribute, setClass, setHidden, setText} from "./dom.js";
import {formatTime, setSince} from "./format.js";
import {getPlanGlyph, setGlyph} from "./glyphs.js";
import {FINISHED_LIMIT} from "./model.js";
import {nameState, t} from "./text.js";

/** One part for each step of the plan. */
export class StepBar {
    constructor() {
        this.node = make("span", {class: "steps", "aria-hidden": "true"});
    }

    update(plan) {
        while (this.node.childElementCount > plan.steps.length) {
            this.node.lastElementChild.remove();
        }
        plan.steps.forEach((step, i) => {
            const part = this.node.children[i] ?? this.node.appendChild(make("span"));
            setClass(part, `step step-${step.status.replace(/\W/g, "")}`);
            const state = nameState("stepStatus", step.status);
            setAttribute(part, "title", `${step.stepNo}. ${step.action} @ ${step.position}: ${state}`);
        });
    }
}

/** The current step; before the start the first one, of a completed plan (stepNo 0) the last one. Step numbers may have gaps. */
export function describeStep(plan) {
    const step = plan.steps.find((candidate) => candidate.stepNo === plan.stepNo)
        ?? plan.steps.find((candidate) => candidate.status === "Pending") ?? plan.steps.at(-1);
    return step === undefined ? "" : `${plan.steps.indexOf(step) + 1}/${plan.steps.length} ${step.action} @ ${step.position}`;
}

class PlanRow {
    constructor(plan, select) {
        this.glyph = make("span", {class: "row-glyph"});
        this.id = make("span", {class: "row-id"});
        this.lot = make("span", {class: "muted row-lot"});
        this.priority = make("span", {class: "tag"});
        this.robot = make("span", {class: "row-robot"});
        this.steps = new StepBar();
        this.step = make("span", {class: "row-step"});
        this.state = make("span", {class: "row-state"});
        this.since = make("span", {class: "wait-since"});
        this.reason = make("span", {class: "wait-text"});
        this.wait = make("span", {class: "wait"}, this.since, this.reason);
        const main = make("span", {class: "row-main"},
            make("span", {class: "row-head"}, this.id, this.priority, this.state, this.robot), this.steps.node,
            make("span", {class: "row-line"}, this.step, this.lot), this.wait);
        this.button = make("button", {type: "button", onclick: () => select({kind: "plan", id: plan.planId})}, this.glyph, main);
        this.node = make("li", {}, this.button);
        this.node.dataset.id = plan.planId;
    }

    update(plan) {
        if (this.plan === plan) {
            return;
        }
        this.plan = plan;
        setGlyph(this.glyph, plan.waits !== null && plan.status === "InProgress" ? "wait" : getPlanGlyph(plan));
        setText(this.id, plan.planId);
        setText(this.lot, plan.lotId ? `${t("plan.lot")} ${plan.lotId}` : "");
        setText(this.priority, plan.priority === null ? "" : t("plan.priorityShort", {n: plan.priority}));
        setHidden(this.priority, plan.priority === null);
        setText(this.robot, plan.robotId ?? "");
        this.steps.update(plan);
        setText(this.step, describeStep(plan));
        const isEnded = plan.endedAt !== null;
        const isPlain = plan.status === (plan.robotId === null ? "Pending" : "InProgress"); // as the title of its group states
        setText(this.state, isEnded ? `${nameState("planStatus", plan.status)} ${formatTime(plan.endedAt)}`
            : isPlain ? "" : nameState("planStatus", plan.status));
        setHidden(this.wait, plan.waits === null && !(isEnded && plan.message));
        if (plan.waits !== null) {
            setSince(this.since, plan.waits.since);
            const place = plan.waits.queuePosition;
            setText(this.reason, (place === null ? "" : `${t("plan.queuePosition", {n: place})} `) + plan.waits.message);
        } else {
            setSince(this.since, null);
            setText(this.reason, plan.message);
        }
        const kind = plan.status === "Failed" || plan.status === "Aborted" ? " is-failed" : plan.status === "Paused" ? " is-paused"
            : plan.waits !== null && plan.robotId !== null ? " is-waiting" : "";
        setClass(this.button, `row plan-row${kind}`);
    }
}

export class PlanView {
    constructor(context) {
        this.context = context;
        this.root = document.getElementById("view-plans");
        this.isFinishedShown = false;
        this.finished = [];
        this.request = null; // for the finished plans
        context.model.listen((changes) => {
            // Some may have ended without an event.
            if (changes.isAll && this.isFinishedShown) {
                this.#loadFinished();
            }
        });
        this.build();
    }

    build() {
        const makeSection = (key, name) => {
            const count = make("span", {class: "count"});
            const list = make("ul", {class: "rows", id: `plans-${name}`, "aria-label": t(key)});
            const section = make("section", {class: "group"}, make("h2", {class: "group-title"}, t(key), count), list);
            const makeRow = (plan) => new PlanRow(plan, this.context.select);
            return {section, count, list: new KeyedList(list, (plan) => plan.planId, makeRow)};
        };
        this.filter = make("input", {
            type: "search", class: "filter", placeholder: t("plan.filterShort"), "aria-label": t("plan.filter"),
            title: t("plan.filter"), value: this.filter?.value,
            oninput: () => this.update()});
        this.active = makeSection("plan.active", "active");
        this.queue = makeSection("plan.queue", "queue");
        this.done = makeSection("plan.finished", "finished");
        this.empty = make("p", {class: "empty", text: t("plan.none")});
        this.more = make("button", {type: "button", class: "button", id: "finished-button", onclick: () => this.toggleFinished()});
        this.root.replaceChildren(make("div", {class: "view-head no-wall"}, this.filter, this.more), this.empty,
            this.active.section, this.queue.section, this.done.section);
        this.update();
    }

    toggleFinished() {
        this.isFinishedShown = !this.isFinishedShown;
        if (this.isFinishedShown) {
            this.#loadFinished();
        } else {
            this.request = null;
            this.update();
        }
    }

    /** Only the answer to the last request counts, and none after the list was hidden. Without an answer the list is hidden: it
     *  would have a gap. */
    async #loadFinished() {
        const request = this.request = getJson(`/v1/plans?state=finished&limit=${FINISHED_LIMIT}`);
        try {
            const {plans} = await request;
            if (request !== this.request) {
                return;
            }
            this.finished = plans;
        } catch (error) {
            if (request !== this.request) {
                return;
            }
            this.isFinishedShown = false;
            this.context.showError(error);
        }
        this.update();
    }

    isAffected(changes) {
        return changes.plans.size > 0;
    }

    getCount() {
        return this.context.model.plans.size;
    }

    #matches(plan) {
        const wanted = this.filter.value.trim().toLowerCase();
        return wanted === "" || [plan.planId, plan.lotId, plan.robotId, ...plan.steps.map((step) => step.position)]
            .some((text) => (text ?? "").toLowerCase().includes(wanted));
    }

    update() {
        const {model} = this.context;
        const plans = [...model.plans.values()].filter((plan) => this.#matches(plan));
        // A wall screen does not scroll: what waits comes first there.
        const getRank = (plan) => (document.body.classList.contains("wall") && plan.waits !== null ? 0 : 1);
        const active = plans.filter((plan) => plan.robotId !== null)
            .sort((a, b) => getRank(a) - getRank(b) || (a.startedAt ?? "").localeCompare(b.startedAt ?? "")
                || a.planId.localeCompare(b.planId));
        const getPlace = (plan) => plan.waits?.queuePosition ?? Infinity;
        const queue = plans.filter((plan) => plan.robotId === null)
            .sort((a, b) => getPlace(a) - getPlace(b) || a.acceptedAt.localeCompare(b.acceptedAt));
        this.#show(this.active, active);
        this.#show(this.queue, queue);
        this.#show(this.done, this.isFinishedShown ? this.#listFinished() : []);
        setText(this.more, t(this.isFinishedShown ? "plan.hideFinished" : "plan.showFinished"));
        setAttribute(this.more, "aria-pressed", String(this.isFinishedShown));
        setHidden(this.empty, active.length + queue.length > 0);
    }

    /** Those that acsd has listed, and those that have ended since. Of two plans that had the same id, the one that ended last. */
    #listFinished() {
        const {plans, ended} = this.context.model;
        const found = new Map(this.finished.map((plan) => [plan.planId, plan]));
        for (const plan of ended.values()) {
            const listed = found.get(plan.planId);
            if (listed === undefined || listed.endedAt < plan.endedAt) {
                found.set(plan.planId, plan);
            }
        }
        return [...found.values()].filter((plan) => !plans.has(plan.planId) && this.#matches(plan))
            .sort((a, b) => b.endedAt.localeCompare(a.endedAt)).slice(0, FINISHED_LIMIT);
    }

    #show(section, plans) {
        setText(section.count, String(plans.length));
        setHidden(section.section, plans.length === 0);
        section.list.show(plans);
    }
}
