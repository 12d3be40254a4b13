// Why a plan or a robot makes no progress, beside its wait reason: the causes that acsctl why names, each with its remedy.

import {Commands, makeCommandButton} from "./commands.js";
import {make, setClass, setHidden, setText} from "./dom.js";
import {setSince} from "./format.js";
import {makeGlyph} from "./glyphs.js";
import {nameState, t} from "./text.js";

export const UNRESOLVED = "ACS-1008";
const STORE = "ACS-1005";
const FINAL_STEPS = ["Completed", "Failed", "Skipped"];
const DEEPEST = 6; // plans that wait for each other

/** The remedies are those of acsctl why. */
export function describeLinkRemedy(link) {
    if (link.name === "mqtt") {
        return t("remedy.mqtt");
    }
    // The connection itself works.
    const isRefused = (link.reason ?? "").startsWith("connected, not registered");
    return t(isRefused ? "remedy.registration" : "remedy.mcs");
}

/** Causes: {key, isHeavy, title, since, reason, cause, remedy, command, selection}. */
export function listLinkCauses(model, mayMatter = () => true) {
    return (model.status?.links ?? []).filter((link) => !link.up && mayMatter(link)).map((link) => ({
        key: `link ${link.name}`, isHeavy: true, title: t("cause.link", {name: link.name}), since: link.since, reason: link.reason,
        remedy: describeLinkRemedy(link)}));
}

function makeTscCause(status) {
    const title = t("cause.tsc", {state: nameState("tsc", status.tsc)});
    const cause = {key: `tsc ${status.tsc}`, title, reason: status.tscReason};
    // That it ends by itself.
    return status.tscReason?.startsWith("Not all robots have reported") ? {...cause, remedy: t("remedy.restart")}
        : {...cause, remedy: t("remedy.tsc"), command: Commands.resumeTSC()};
}

function makeMaintenanceCause(robot) {
    const id = robot.robotId;
    return {key: `maintenance ${id}`, title: t("cause.maintenance", {id}), remedy: t("remedy.maintenance"),
        command: Commands.setMaintenance(robot), selection: {kind: "robot", id}};
}

function makePausedCause(plan) {
    return {key: `paused ${plan.planId}`, title: t("cause.paused", {id: plan.planId}), remedy: t("remedy.paused"),
        command: Commands.resumePlan(plan), selection: {kind: "plan", id: plan.planId}};
}

function makeBlockCause({kind, id, reason, since}) {
    return {key: `block ${kind} ${id}`, title: t("cause.blocked", {kind: t(`kind.${kind}`), id}), since, reason,
        remedy: t("remedy.unblock", {kind: t(`kindInside.${kind}`), id}), command: Commands.unblock(kind, id),
        selection: {kind, id}};
}

/** {cause, remedy} of a refused report; both are those of acsctl why. */
export function describeRefusal(report) {
    return {cause: t(report.retried ? "cause.retried" : "cause.refused"),
        remedy: t(report.planId === null ? "remedy.refusedOther" : "remedy.refused")};
}

function makeRefusedCause(status) {
    const {last} = status.refusedReports;
    return {key: "refused", title: t("cause.refusedReports"), reason: [last.command, last.message].filter(Boolean).join(": "),
        ...describeRefusal(last)};
}

function isStopped(plan) {
    return plan.waits !== null || plan.status === "Paused";
}

/** The plan, the robots it waits for, and the plans that keep those: {plans, robots}, sets of ids. */
function follow(model, plan, depth = 0, found = {plans: new Set(), robots: new Set()}) {
    if (depth > DEEPEST || found.plans.has(plan.planId)) {
        return found;
    }
    found.plans.add(plan.planId);
    for (const robotId of [...plan.waits?.robots.map((robot) => robot.robotId) ?? [], plan.robotId]) {
        const robot = model.robots.get(robotId);
        if (robot === undefined) {
            continue;
        }
        found.robots.add(robotId);
        const other = model.plans.get(robot.planId);
        if (other !== undefined && isStopped(other)) {
            follow(model, other, depth + 1, found);
        }
    }
    return found;
}

function isAtStation(block, stationId, index) {
    return block.kind === "station" ? block.id === stationId
        : block.kind === "node" && (index?.stations.get(stationId)?.nodeIds ?? []).includes(block.id);
}

function isOnRoute(block, robot, index) {
    const nodes = [robot.node, ...robot.route.map((step) => step.nodeId)];
    if (block.kind === "node") {
        return nodes.slice(1).includes(block.id);
    }
    const edge = block.kind === "edge" ? index?.edges.get(block.id) : undefined;
    return edge !== undefined && nodes.some((node, i) => node === edge.startNodeId && nodes[i + 1] === edge.endNodeId);
}

function listBlocks(model, index, plans, robots) {
    const waiting = plans.filter((plan) => plan.waits !== null);
    const named = waiting.flatMap((plan) => [plan.waits.message, ...plan.waits.robots.map(({reason}) => reason)]);
    const stations = waiting.flatMap((plan) => plan.steps.filter((step) => !FINAL_STEPS.includes(step.status)))
        .map((step) => step.position);
    return [...model.blocks.values()].filter((block) => named.some((text) => text.includes(`${block.kind} ${block.id} is blocked`))
        || stations.some((station) => isAtStation(block, station, index))
        || robots.some((robot) => isOnRoute(block, robot, index)));
}

/** {causes, alarms} of a plan. */
export function explainPlan(model, index, plan) {
    const isEnded = plan.endedAt !== null;
    const ids = isEnded ? {plans: new Set([plan.planId]), robots: new Set()} : follow(model, plan);
    const plans = [plan, ...[...ids.plans].filter((id) => id !== plan.planId).map((id) => model.plans.get(id))];
    const robots = [...ids.robots].map((id) => model.robots.get(id));
    const {status} = model;
    const causes = isEnded ? [] : [
        ...listLinkCauses(model),
        ...status !== null && status.tsc !== "Auto" && plans.some((other) => other.waits !== null) ? [makeTscCause(status)] : [],
        ...plans.slice(1).filter((other) => other.status === "Paused").map(makePausedCause),
        ...robots.filter((robot) => robot.maintenance).map(makeMaintenanceCause),
        ...listBlocks(model, index, plans, robots).map(makeBlockCause),
    ];
    if (status?.refusedReports.last?.planId === plan.planId) {
        causes.push(makeRefusedCause(status));
    }
    const isCause = (alarm) => {
        // An unresolved job is explained with its plan.
        const isOfPlan = alarm.errorCode === UNRESOLVED && alarm.planId !== null;
        return alarm.errorCode === STORE || (isOfPlan ? ids.plans.has(alarm.planId) : ids.robots.has(alarm.robotId));
    };
    return {causes, alarms: model.findAlarms((alarm) => alarm.planId === plan.planId || (!isEnded && isCause(alarm)))};
}

/** {causes, alarms} of a robot. */
export function explainRobot(model, index, robot) {
    return {
        causes: [...listLinkCauses(model, (link) => link.name === "mqtt" && robot.topic !== null),
            ...listBlocks(model, index, [], [robot]).map(makeBlockCause)],
        alarms: model.findAlarms((alarm) => alarm.robotId === robot.robotId),
    };
}

/** A cause that is no alarm, in the form of one. */
export class CauseRow {
    constructor(cause, select) {
        this.title = make("span", {class: "row-id"});
        this.since = make("span", {class: "muted"});
        this.reason = make("p", {class: "alarm-message"});
        this.causeLabel = make("dt", {text: t("alarm.cause")});
        this.cause = make("dd");
        this.remedy = make("dd");
        const link = cause.selection === undefined ? null : make("button", {
            type: "button", class: "link", text: cause.selection.id, onclick: () => select(cause.selection)});
        this.buttons = make("div", {class: "row-buttons no-wall"}, make("span", {class: "alarm-links"}, link),
            cause.command === undefined ? null : makeCommandButton(cause.command));
        setHidden(this.buttons, cause.command === undefined);
        const texts = make("dl", {class: "alarm-text"}, this.causeLabel, this.cause, make("dt", {text: t("alarm.remedy")}),
            this.remedy);
        this.node = make("li", {}, make("span", {class: "row-glyph"}, makeGlyph(cause.isHeavy ? "failed" : "block")),
            make("div", {class: "row-main"}, make("div", {class: "alarm-head"}, this.title, this.since), this.reason, texts,
                this.buttons));
        this.node.dataset.id = cause.key;
    }

    update(cause) {
        setClass(this.node, `alarm cause ${cause.isHeavy ? "heavy" : "light"}`);
        setText(this.title, cause.title);
        setSince(this.since, cause.since);
        setText(this.reason, cause.reason ?? "");
        setHidden(this.reason, !cause.reason);
        setText(this.cause, cause.cause ?? "");
        setHidden(this.cause, cause.cause === undefined);
        setHidden(this.causeLabel, cause.cause === undefined);
        setText(this.remedy, cause.remedy);
    }
}
