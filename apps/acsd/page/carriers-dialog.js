// The correction of the record of a robot's ports.

import {askToSend, leaveByEnter, limitBytes} from "./dialogs.js";
import {make} from "./dom.js";
import {t} from "./text.js";

const LONGEST_ID = 128; // bytes

/** Asks what is on each port, and sends the body of the request. getRobot: the robot as it is then. */
export function askCarriers({title, text, getRobot, send}) {
    const {ports, carrierIds: shown} = getRobot();
    const inputs = ports.map((port, i) => make("input", {
        id: `port-${i}`, type: "text", autocomplete: "off", spellcheck: "false", placeholder: t("robot.empty"),
        value: shown[i] ?? ""}));
    inputs.forEach((input) => limitBytes(input, LONGEST_ID, "carriers.tooLong"));
    const read = () => {
        // A plan may have changed the record meanwhile: a port that was not edited keeps what it has now.
        const {carrierIds: present} = getRobot();
        return {carrierIds: inputs.map(({value}, i) => value === (shown[i] ?? "") ? present[i] ?? null : value.trim() || null)};
    };
    const parts = [make("p", {text}), make("p", {class: "muted", text: t("carriers.note")}),
        make("div", {class: "port-inputs"}, ...ports.flatMap((port, i) => [
            make("label", {for: inputs[i].id, text: port}), inputs[i]]))];
    const done = askToSend({title, parts, inputs, action: t("dialog.set"), read, send});
    inputs[0].select();
    leaveByEnter(inputs);
    return done;
}
