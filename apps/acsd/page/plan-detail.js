// The detail of a plan: why it waits, its steps and jobs, and what the operator may do with it.

import {getJson} from "./api.js";
import {AlarmRow, getAlarmKey} from "./alarm-view.js";
import {CauseRow, explainPlan, UNRESOLVED} from "./causes.js";
import {Commands, makeCommandButton} from "./commands.js";
import {KeyedList, make, makeFact, makeLink, setHidden, setText, showChildren} from "./dom.js";
import {formatTime, setSince} from "./format.js";
import {StepBar} from "./plan-view.js";
import {nameState, t} from "./text.js";
import {TraceList} from "./trace-list.js";

const RETRY = 3_000; // milliseconds

export class PlanDetail {
    /** former: the detail that this one replaces. If it is that of the same plan, its plan is shown until acsd has answered. */
    constructor(context, {id}, former) {
        this.context = context;
        this.id = id;
        this.error = make("p", {class: "form-error", role: "alert", hidden: true});
        this.steps = new StepBar();
        this.facts = make("dl", {class: "facts"});
        this.buttons = make("div", {class: "row-buttons no-wall"});
        this.stepTitle = make("h3", {text: t("plan.steps")});
        this.stepList = make("ol", {class: "step-list"});
        this.causeList = make("ul", {class: "alarms"});
        this.causes = new KeyedList(this.causeList, (cause) => cause.key, (cause) => new CauseRow(cause, context.select));
        this.alarmList = make("ul", {class: "alarms"});
        this.alarms = new KeyedList(this.alarmList, getAlarmKey, (alarm) => new AlarmRow(alarm, context));
        this.node = make("div", {class: "detail-body"}, this.error, this.steps.node, this.causeList, this.alarmList, this.facts,
            this.buttons, this.stepTitle, this.stepList, new TraceList(`plan=${encodeURIComponent(id)}`).node);
        this.plan = former instanceof PlanDetail && former.id === id ? former.plan : null;
        this.isLoading = false;
        this.timer = null; // for another attempt
        if (this.plan !== null) {
            this.#show();
        }
        this.load();
    }

    /** The jobs are in the answer for one plan only. */
    async load() {
        if (this.isLoading) {
            this.isStale = true;
            return;
        }
        this.isLoading = true;
        do {
            this.isStale = false;
            clearTimeout(this.timer);
            try {
                this.plan = await getJson(`/v1/plans/${encodeURIComponent(this.id)}`);
                this.#setError("");
                this.#show();
            } catch (error) {
                this.#showFailure(error);
            }
        } while (this.isStale);
        this.isLoading = false;
    }

    #setError(text) {
        setText(this.error, text);
        setHidden(this.error, text === "");
    }

    /** What is shown stays, unless the plan is gone. Without a login, all is loaded after it. */
    #showFailure(error) {
        if (error.status === 404 && error.isFromAcsd) {
            this.#showGone();
            return;
        }
        this.#setError(t("plan.notLoaded", {reason: error.message}));
        if (error.status !== 401) {
            this.timer = setTimeout(() => {
                if (this.node.isConnected) {
                    this.load();
                }
            }, RETRY);
        }
    }

    #showGone() {
        this.plan = null;
        this.#setError("");
        this.steps.update({steps: []});
        for (const list of [this.causes, this.alarms]) {
            list.clear();
        }
        for (const node of [this.causeList, this.alarmList, this.stepTitle]) {
            setHidden(node, true);
        }
        this.facts.replaceChildren(make("dd", {text: t("detail.gone")}));
        showChildren(this.buttons);
        showChildren(this.stepList);
    }

    update(changes) {
        if (changes.isAll || changes.plans.has(this.id)) {
            this.load();
        } else if (changes.alarms && this.plan !== null) {
            this.#show();
        } else if (this.plan !== null) {
            this.#showCauses();
        }
    }

    /** Also those of other plans, robots and places for which the plan waits. Returns its alarms. */
    #showCauses() {
        const {causes, alarms} = explainPlan(this.context.model, this.context.floor.index, this.plan);
        setHidden(this.causeList, causes.length === 0);
        this.causes.show(causes);
        setHidden(this.alarmList, alarms.length === 0);
        this.alarms.show(alarms);
        return alarms;
    }

    #show() {
        const {plan} = this;
        const alarms = this.#showCauses();
        this.steps.update(plan);
        setHidden(this.stepTitle, false);
        this.#showFacts(plan);
        this.#showButtons(plan);
        showChildren(this.stepList, ...plan.steps.map((step) => this.#makeStep(plan, step, alarms)));
    }

    #makeLink(kind, id) {
        return makeLink(this.context.select, kind, id);
    }

    #showFacts(plan) {
        const rows = [];
        const add = (key, ...children) => rows.push(...makeFact(key, t(key), ...children));
        add("plan.status", nameState("planStatus", plan.status),
            plan.message ? make("p", {class: plan.endedAt === null ? "muted" : "reason", text: plan.message}) : null);
        if (plan.waits !== null) {
            const since = make("span", {class: "wait-since"});
            setSince(since, plan.waits.since);
            add("plan.waits", make("div", {class: "wait"}, since, make("span", {text: plan.waits.message})),
                make("ul", {class: "reasons"}, ...plan.waits.robots.map(({robotId, reason}) => make("li", {"data-key": robotId},
                    this.#makeLink("robot", robotId), ` ${reason}`))));
            if (plan.waits.queuePosition !== null) {
                add("plan.place", t("plan.queuePosition", {n: plan.waits.queuePosition}));
            }
        }
        add("plan.robot", plan.robotId ? this.#makeLink("robot", plan.robotId) : "–");
        add("plan.priority", String(plan.priority ?? "–"));
        add("plan.lot", plan.lotId || "–");
        const carriers = new Set(plan.steps.flatMap((step) => step.carrierIds ?? []));
        add("plan.carriers", [...carriers].join(", ") || "–");
        add("plan.accepted", formatTime(plan.acceptedAt));
        add("plan.started", formatTime(plan.startedAt));
        if (plan.endedAt !== null) {
            add("plan.ended", formatTime(plan.endedAt));
        }
        showChildren(this.facts, ...rows);
    }

    #showButtons(plan) {
        if (plan.endedAt !== null) {
            showChildren(this.buttons);
            return;
        }
        showChildren(this.buttons,
            makeCommandButton(plan.status === "Paused" ? Commands.resumePlan(plan) : Commands.pausePlan(plan)),
            ...plan.robotId === null ? [makeCommandButton(Commands.setPriority(plan, () => this.plan))] : [],
            makeCommandButton(Commands.cancelPlan(plan), "danger"), makeCommandButton(Commands.abortPlan(plan), "danger"));
    }

    #makeStep(plan, step, alarms) {
        // The id of a job is unique within its plan only, and some of the alarms are those of other plans.
        const isOfJob = (alarm, job) => alarm.errorCode === UNRESOLVED && alarm.planId === plan.planId && alarm.jobId === job.jobId;
        // acsd does not repeat a job of an ended plan.
        const outcomes = ["done", "failed", ...(plan.endedAt === null ? ["again"] : [])];
        const isUnresolved = (job) => job.status === "Unresolved" || alarms.some((alarm) => isOfJob(alarm, job));
        const jobs = step.jobs ?? [];
        const canSkip = plan.endedAt === null && plan.robotId !== null && (step.status === "Pending" || jobs.some(isUnresolved));
        return make("li", {class: `step-item step-${step.status.replace(/\W/g, "")}`, "data-key": String(step.stepNo)},
            make("div", {class: "row-head"}, make("span", {class: "step-no", text: String(step.stepNo)}),
                make("span", {class: "row-id", text: step.action}),
                this.#makeLink("station", step.position),
                make("span", {class: "row-state", text: nameState("stepStatus", step.status)})),
            make("ul", {class: "jobs"}, ...jobs.map((job) => make("li", {"data-key": job.jobId},
                make("span", {text: [job.from, job.to].map((place) => place || "–").join(" → ")}), " ",
                make("span", {class: "muted", text: nameState("jobStatus", isUnresolved(job) ? "Unresolved" : job.status)}),
                make("p", {class: "muted job-id", text: job.jobId}),
                isUnresolved(job) ? make("div", {class: "row-buttons no-wall"}, ...outcomes
                    .map((outcome) => makeCommandButton(Commands.resolveJob(plan, job.jobId, outcome), "danger"))) : null))),
            canSkip ? make("div", {class: "row-buttons no-wall"},
                makeCommandButton(Commands.skipStep(plan, step.stepNo), "small")) : null);
    }
}
