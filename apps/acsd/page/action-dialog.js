// The question before an instant action, with its parameters.

import {askToSend, countBytes, leaveByEnter, makeReasonInput} from "./dialogs.js";
import {make} from "./dom.js";
import {t} from "./text.js";

const NUMBERS = ["NUMBER", "FLOAT", "INTEGER"];
const PARAMETER_LIMIT = 8_000; // bytes of all keys and values, as JSON

function makeInput({valueType, required}, i) {
    const attributes = {id: `parameter-${i}`, required, autocomplete: "off"};
    if (valueType === "BOOL") {
        return make("select", attributes, make("option", {value: "", text: "–"}),
            make("option", {value: "true", text: "true"}), make("option", {value: "false", text: "false"}));
    }
    if (NUMBERS.includes(valueType)) {
        return make("input", {...attributes, type: "number", step: valueType === "INTEGER" ? 1 : "any"});
    }
    return make("input", {...attributes, type: "text"});
}

/** Whether all numbers in the value are those that were entered. */
function isExact(value) {
    if (typeof value === "number") {
        return Number.isFinite(value) && (!Number.isInteger(value) || Number.isSafeInteger(value));
    }
    return typeof value !== "object" || value === null || Object.values(value).every(isExact);
}

/** {value, fault} of what was entered: acsd checks the type. A text that is no JSON is a string, but of an OBJECT or ARRAY. */
function readInput(input, valueType) {
    if (input.value === "") {
        return {};
    }
    if (valueType === "STRING") {
        return {value: input.value};
    }
    let value;
    try {
        value = NUMBERS.includes(valueType) ? Number(input.value) : JSON.parse(input.value);
    } catch {
        return ["OBJECT", "ARRAY"].includes(valueType) ? {fault: t("parameter.json", {type: valueType})} : {value: input.value};
    }
    return isExact(value) ? {value: value ?? input.value} : {fault: t("parameter.inexact")};
}

/** Asks for the parameters, and sends the body of the request. */
export function askAction({title, text, offer, send}) {
    const inputs = offer.parameters.map(makeInput);
    const reason = makeReasonInput();
    const readValues = () => offer.parameters.map(({key, valueType}, i) => [key, readInput(inputs[i], valueType).value])
        .filter(([, value]) => value !== undefined);
    const check = (edited) => {
        const bytes = readValues().reduce((sum, [key, value]) => sum + countBytes(key) + countBytes(JSON.stringify(value)), 0);
        const excess = bytes > PARAMETER_LIMIT ? t("parameter.tooLong", {n: PARAMETER_LIMIT}) : "";
        inputs.forEach((input, i) => {
            const {fault} = readInput(input, offer.parameters[i].valueType);
            input.setCustomValidity(fault ?? (input === edited ? excess : ""));
        });
    };
    const parts = [make("p", {text}), offer.description ? make("p", {class: "muted", text: offer.description}) : null,
        ...offer.parameters.flatMap(({key, valueType, required}, i) => {
            const type = required ? valueType : `${valueType}, ${t("dialog.optional")}`;
            inputs[i].addEventListener("input", () => check(inputs[i]));
            return [make("label", {for: inputs[i].id, text: `${key} (${type})`}), inputs[i]];
        }),
        make("label", {for: reason.id, text: t("dialog.reason")}), reason];
    const read = () => ({
        actionType: offer.actionType, parameters: Object.fromEntries(readValues()), reason: reason.value.trim() || undefined});
    const done = askToSend({title, parts, inputs, action: t("dialog.send"), read, send});
    leaveByEnter([...inputs, reason]);
    return done;
}
