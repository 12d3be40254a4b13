// The correction of the record of a robot's ports.

import {leaveByEnter, openDialog} from "./dialogs.js";
import {make} from "./dom.js";
import {t} from "./text.js";

const LONGEST_ID = 128; // bytes

const isTooLong = (text) => new TextEncoder().encode(text).length > LONGEST_ID;

/** Asks what is on each port. Resolves to the body of the request, or null if the user cancels or changes nothing. */
export function askCarriers({title, text, ports, carrierIds}) {
    const dialog = document.getElementById("confirm-dialog");
    const inputs = ports.map((port, i) => make("input", {
        id: `port-${i}`, type: "text", autocomplete: "off", spellcheck: "false", placeholder: t("robot.empty"),
        value: carrierIds[i] ?? ""}));
    for (const input of inputs) {
        input.addEventListener("input", () => {
            input.setCustomValidity(isTooLong(input.value.trim()) ? t("carriers.tooLong", {n: LONGEST_ID}) : "");
        });
    }
    dialog.replaceChildren(make("form", {method: "dialog"},
        make("h2", {id: "confirm-title", text: title}), make("p", {text}),
        make("div", {class: "port-inputs"}, ...ports.flatMap((port, i) => [
            make("label", {for: inputs[i].id, text: port}), inputs[i]])),
        make("div", {class: "dialog-buttons"},
            make("button", {type: "button", class: "button", text: t("dialog.cancel"), onclick: () => dialog.close("cancel")}),
            make("button", {
                type: "submit", value: "confirm", class: "button danger", id: "confirm-action", text: t("dialog.set")}))));
    dialog.returnValue = "";
    openDialog("confirm-dialog");
    inputs[0].select();
    leaveByEnter(inputs);
    return new Promise((resolve) => {
        dialog.addEventListener("close", () => {
            const isChanged = ({value}, i) => value !== (carrierIds[i] ?? "");
            resolve(dialog.returnValue !== "confirm" || !inputs.some(isChanged) ? null : {
                carrierIds: inputs.map((input, i) => (isChanged(input, i) ? input.value.trim() : input.value) || null)});
        }, {once: true});
    });
}
