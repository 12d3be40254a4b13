// What the operator may do: each command is one POST. Those with consequences ask first.

import {askAction} from "./action-dialog.js";
import {LostAnswer, post} from "./api.js";
import {askCarriers} from "./carriers-dialog.js";
import {askConfirmation, askNumber, ignoreHeldEnter, showError, showToast} from "./dialogs.js";
import {make} from "./dom.js";
import {dropKey, dropObsoleteKeys, keepKey, takeKey} from "./lost-commands.js";
import {listCommands} from "./shell.js";
import {t} from "./text.js";

const BLOCK_REASON_LIMIT = 200; // bytes

const encode = encodeURIComponent;

/** {label, path, body, ask}: ask is the key of the question, null for a command without one. */
function makePlanControl(name, plan, ask, hasReason = false) {
    const id = plan.planId;
    return {label: t(`command.${name}`), path: `/v1/plans/${encode(id)}/${name}`, ask, hasReason, values: {id}};
}

export const Commands = {
    pausePlan: (plan) => makePlanControl("pause", plan, null),
    resumePlan: (plan) => makePlanControl("resume", plan, null),
    cancelPlan: (plan) => makePlanControl("cancel", plan, "ask.cancel", true),
    abortPlan: (plan) => makePlanControl("abort", plan, "ask.abort", true),
    /** getPlan: the plan as it is then. */
    setPriority: (plan, getPlan) => ({label: t("command.priority"), path: `/v1/plans/${encode(plan.planId)}/priority`,
        number: "priority", getValue: () => getPlan().priority ?? 0, values: {id: plan.planId}}),
    resolveJob: (plan, jobId, outcome) => ({label: t(`command.resolve.${outcome}`),
        path: `/v1/plans/${encode(plan.planId)}/jobs/${encode(jobId)}/resolve`, body: {outcome}, ask: `ask.resolve.${outcome}`,
        values: {id: jobId}}),
    skipStep: (plan, stepNo) => ({label: t("command.skip"), path: `/v1/plans/${encode(plan.planId)}/steps/${stepNo}/skip`,
        ask: "ask.skip", values: {id: plan.planId, n: stepNo}}),
    setMaintenance: (robot) => ({label: t(robot.maintenance ? "command.maintenanceOff" : "command.maintenanceOn"),
        path: `/v1/robots/${encode(robot.robotId)}/maintenance`, body: {on: !robot.maintenance},
        ask: robot.maintenance ? "ask.maintenanceOff" : null, values: {id: robot.robotId}}),
    /** getRobot: the robot as it is then; each snapshot replaces model.robots. */
    setCarriers: (robot, model) => ({label: t("command.carriers"), path: `/v1/robots/${encode(robot.robotId)}/carriers`,
        getRobot: () => model.robots.get(robot.robotId) ?? robot, values: {id: robot.robotId}}),
    sendAction: (robotId, offer) => ({label: offer.actionType, path: `/v1/robots/${encode(robotId)}/actions`, offer,
        values: {id: robotId, action: offer.actionType}}),
    clearAlarm: (alarm) => ({label: t("command.clear"), path: "/v1/alarms/clear", ask: "ask.clear", body: {
        robotId: alarm.robotId, errorCode: alarm.errorCode, ...(alarm.planId ? {planId: alarm.planId} : {}),
        ...(alarm.jobId ? {jobId: alarm.jobId} : {})}, values: {id: alarm.errorCode, robot: alarm.robotId}}),
    pauseTSC: () => ({label: t("command.tscPause"), path: "/v1/tsc/pause", ask: null}),
    resumeTSC: () => ({label: t("command.tscResume"), path: "/v1/tsc/resume", ask: "ask.tscResume"}),
    block: (kind, id) => ({label: t("command.block"), path: "/v1/site/block", body: {kind, id}, ask: "ask.block", hasReason: true,
        reasonLimit: BLOCK_REASON_LIMIT, values: {kind: t(`kindInside.${kind}`), id}}),
    unblock: (kind, id) => ({label: t("command.unblock"), path: "/v1/site/unblock", body: {kind, id}, ask: "ask.unblock",
        values: {kind: t(`kindInside.${kind}`), id}}),
};

/** The commands that a text of acsd names between backticks and for which the page has a button. */
export function listNamedCommands(text, model) {
    return listCommands(text).flatMap(([program, name, id, ...rest]) => {
        const [jobId, outcome] = rest;
        if (program === "acsctl" && name === "resolve" && ["done", "failed"].includes(outcome)) {
            const isGone = model.findPlan(id) === null; // otherwise its detail has the buttons
            return isGone ? [Commands.resolveJob({planId: id}, jobId, outcome)] : [];
        }
        const command = [program, name, ...rest].join(" ");
        if (command === "acsctl maintenance on" || command === "acsctl maintenance off") {
            return [Commands.setMaintenance({robotId: id, maintenance: command.endsWith("off")})];
        }
        const robot = command === "acsctl carriers" ? model.robots.get(id) : undefined;
        return robot?.ports.length > 0 ? [Commands.setCarriers(robot, model)] : [];
    });
}

async function sendCommand({path}, body) {
    const text = JSON.stringify(body);
    const used = takeKey(path, text);
    try {
        const {message, isReplay} = await post(path, body, used.key);
        dropObsoleteKeys(path, text);
        showToast(used.isRepeated && isReplay ? t("command.replayed", {message}) : message);
    } catch (error) {
        if (error instanceof LostAnswer) {
            keepKey(path, text, used);
        } else if (error.isFinal) {
            dropKey(path, text);
        }
        throw error;
    }
}

/** Asks if need be, sends, and shows the answer. */
async function askAndSend(command) {
    const send = (answers = {}) => sendCommand(command,
        Object.keys(answers).length === 0 ? command.body : {...command.body, ...answers});
    const {label: title, values} = command;
    if (command.number !== undefined) {
        await askNumber({title, label: t("ask.priority", values), value: command.getValue(),
            send: (value) => send({[command.number]: value})});
    } else if (command.getRobot !== undefined) {
        await askCarriers({title, text: t("ask.carriers", values), getRobot: command.getRobot, send});
    } else if (command.offer !== undefined) {
        await askAction({title, text: t("ask.action", values), offer: command.offer, send});
    } else if (command.ask) {
        await askConfirmation({title, text: t(command.ask, values), action: title, hasReason: command.hasReason,
            reasonLimit: command.reasonLimit, send});
    } else {
        await send().catch(showError);
    }
}

const running = new Set(); // the names of the commands that are asked for or sent

/** The same in each language. */
function getName({path, body, offer}) {
    return JSON.stringify([path, body, offer?.actionType]);
}

/** Not twice at a time, whichever of its buttons is pressed. */
async function runCommand(command) {
    const name = getName(command);
    if (running.has(name)) {
        return;
    }
    const setDisabled = (isDisabled) => [...document.querySelectorAll("button[data-command]")]
        .filter((button) => button.dataset.command === name).forEach((button) => { button.disabled = isDisabled; });
    running.add(name);
    setDisabled(true); // this takes the focus away
    try {
        await askAndSend(command);
    } finally {
        running.delete(name);
        setDisabled(false);
    }
}

/** A button that cannot be pressed while its command runs. */
export function makeCommandButton(command, kind = "") {
    const button = make("button", {type: "button", class: `button ${kind}`.trim(), text: command.label});
    button.dataset.path = command.path;
    button.dataset.key = JSON.stringify(command);
    button.dataset.command = getName(command);
    button.disabled = running.has(button.dataset.command);
    ignoreHeldEnter(button);
    button.addEventListener("click", async (event) => {
        event.stopPropagation();
        const hadFocus = document.activeElement === button;
        await runCommand(command);
        // The focus may still be in the dialog that was closed.
        if (hadFocus && document.activeElement.matches("body, dialog:not([open]) *")) {
            button.focus({preventScroll: true});
        }
    });
    return button;
}
