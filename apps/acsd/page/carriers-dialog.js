// The correction of the record of a robot's ports.

import {leaveByEnter, limitBytes, openDialog} from "./dialogs.js";
import {make} from "./dom.js";
import {t} from "./text.js";

const LONGEST_ID = 128; // bytes

/** Asks what is on each port. Resolves to the body of the request, null if the user cancels. getRobot: the robot as it is then. */
export function askCarriers({title, text, getRobot}) {
    const dialog = document.getElementById("confirm-dialog");
    const {ports, carrierIds: shown} = getRobot();
    const inputs = ports.map((port, i) => make("input", {
        id: `port-${i}`, type: "text", autocomplete: "off", spellcheck: "false", placeholder: t("robot.empty"),
        value: shown[i] ?? ""}));
    inputs.forEach((input) => limitBytes(input, LONGEST_ID, "carriers.tooLong"));
    dialog.replaceChildren(make("form", {method: "dialog"},
        make("h2", {id: "confirm-title", text: title}), make("p", {text}), make("p", {class: "muted", text: t("carriers.note")}),
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
            // A plan may have changed the record meanwhile: a port that was not edited keeps what it has now.
            const {carrierIds: present} = getRobot();
            const read = ({value}, i) => value === (shown[i] ?? "") ? present[i] ?? null : value.trim() || null;
            resolve(dialog.returnValue === "confirm" ? {carrierIds: inputs.map(read)} : null);
        }, {once: true});
    });
}
