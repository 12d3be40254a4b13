// The dialogs: confirmation, login, search, help; and the short messages at the edge.

import {LostAnswer, post} from "./api.js";
import {make, setHidden, setText} from "./dom.js";
import {makeGlyph} from "./glyphs.js";
import {t} from "./text.js";

const TOAST_TIME = 7_000; // milliseconds
const FOUND_LIMIT = 12;
const REASON_LIMIT = 500; // bytes
// Whether this browser has logged in: scripts cannot read the cookie.
const SESSION = "acsd.session";

/** A short message; kind "info" or "error". */
export function showToast(text, kind = "info") {
    const glyph = makeGlyph(kind === "error" ? "error" : "done");
    const toast = make("div", {class: `toast ${kind}`}, make("span", {class: "toast-glyph"}, glyph), make("span", {text}));
    document.getElementById("toasts").append(toast);
    setTimeout(() => toast.remove(), kind === "error" ? 2 * TOAST_TIME : TOAST_TIME);
}

export function openDialog(id) {
    const dialog = document.getElementById(id);
    if (!dialog.open) {
        dialog.showModal();
    }
    return dialog;
}

/** The button is pressed only once by Enter that is held down. */
export function ignoreHeldEnter(button) {
    button.addEventListener("keydown", (event) => {
        if (event.repeat && event.key === "Enter") {
            event.preventDefault();
        }
    });
}

/** Enter goes from the inputs to the button that confirms, and does not press it, not even if the key is held down. */
export function leaveByEnter(inputs) {
    const confirm = document.getElementById("confirm-action");
    ignoreHeldEnter(confirm);
    for (const input of inputs) {
        input.addEventListener("keydown", (event) => {
            if (event.key === "Enter" && !event.isComposing) {
                event.preventDefault();
                confirm.focus();
            }
        });
    }
}

/** As acsd counts them. */
export function countBytes(text) {
    return new TextEncoder().encode(text).length;
}

/** The form is refused while the input has more bytes than acsd accepts. `key`: of the message with {n}. */
export function limitBytes(input, limit, key) {
    input.addEventListener("input", () => {
        const isTooLong = countBytes(input.value.trim()) > limit;
        input.setCustomValidity(isTooLong ? t(key, {n: limit}) : "");
    });
}

export function makeReasonInput(limit = REASON_LIMIT) {
    const input = make("input", {id: "confirm-reason", type: "text", autocomplete: "off"});
    limitBytes(input, limit, "dialog.reasonTooLong");
    return input;
}

/** Why a request has failed; "" without a login, which has a dialog of its own. */
function describeError(error) {
    if (error instanceof LostAnswer) {
        return `${t("error.lost", {reason: error.message})} ${t(error.isRemembered ? "error.repeat" : "error.repeatAction")}`;
    }
    return error.status === 401 ? "" : error.status === 0 ? t("error.connection", {reason: error.message}) : error.message;
}

export function showError(error) {
    const text = describeError(error);
    if (text !== "") {
        showToast(text, "error");
    }
}

/** Asks before a command. `send` gets what `read` returns. What was entered stays, with the reason, until `send` succeeds or the
 *  user goes back. Resolves when the dialog is closed and nothing is being sent. */
export function askToSend({title, parts, inputs = [], action, kind = "danger", read, send}) {
    const dialog = document.getElementById("confirm-dialog");
    const cancel = make("button", {type: "button", class: "button", text: t("dialog.cancel"), onclick: () => dialog.close()});
    const confirm = make("button", {type: "submit", class: `button ${kind}`, id: "confirm-action", text: action});
    const message = make("p", {class: "form-error", role: "alert", hidden: true});
    const form = make("form", {}, make("h2", {id: "confirm-title", text: title}), ...parts, message,
        make("div", {class: "dialog-buttons"}, cancel, confirm));
    const isShown = () => dialog.open && form.isConnected; // the dialog may have another question by now
    const setMessage = (text) => {
        setText(message, text);
        setHidden(message, text === "");
    };
    const submit = async () => {
        confirm.disabled = true;
        setMessage("");
        try {
            await send(read());
            if (isShown()) {
                dialog.close();
            }
        } catch (error) {
            confirm.disabled = false;
            if (isShown()) {
                setMessage(describeError(error));
                (inputs[0] ?? cancel).focus();
            } else {
                showError(error);
            }
        }
    };
    dialog.replaceChildren(form);
    openDialog("confirm-dialog");
    // Enter must not confirm by accident.
    (inputs[0] ?? cancel).focus();
    return new Promise((resolve) => {
        let sent = null;
        form.addEventListener("submit", (event) => {
            event.preventDefault();
            sent = submit();
        });
        dialog.addEventListener("close", async () => {
            await sent;
            resolve();
        }, {once: true});
    });
}

/** Asks before a command with consequences; sends {reason}, or {} without one. */
export function askConfirmation({title, text, action, hasReason = false, reasonLimit, send}) {
    const inputs = hasReason ? [makeReasonInput(reasonLimit)] : [];
    const labels = inputs.map((input) => make("label", {for: input.id, text: t("dialog.reason")}));
    const read = () => Object.fromEntries(inputs.map(({value}) => ["reason", value.trim()]).filter(([, reason]) => reason !== ""));
    const done = askToSend({title, parts: [make("p", {text}), ...labels, ...inputs], inputs, action, read, send});
    leaveByEnter(inputs);
    return done;
}

/** Asks for one number, and sends it. */
export function askNumber({title, label, value, send}) {
    const input = make("input", {id: "confirm-number", type: "number", step: 1, required: true, value});
    const done = askToSend({title, parts: [make("label", {for: input.id, text: label}), input], inputs: [input],
        action: t("dialog.set"), kind: "primary", read: () => Number(input.value), send});
    input.select();
    return done;
}

/** Asks for a token until acsd accepts one. */
export function showLogin(onLogin) {
    const dialog = document.getElementById("login-dialog");
    if (dialog.open) {
        return;
    }
    const token = make("input", {id: "login-token", type: "password", autocomplete: "current-password", required: true});
    const message = make("p", {class: "form-error", role: "alert"});
    const form = make("form", {},
        make("h2", {id: "login-title", text: t("login.title")}), make("p", {text: t("login.text")}),
        make("input", {type: "text", autocomplete: "username", value: "acsd", hidden: true}), // for password managers
        make("label", {for: "login-token", text: t("login.token")}), token, message,
        make("div", {class: "dialog-buttons"}, make("button", {type: "submit", class: "button primary", text: t("login.action")})));
    form.addEventListener("submit", async (event) => {
        event.preventDefault();
        message.textContent = "";
        try {
            await post("/v1/login", {token: token.value.trim()});
        } catch (error) {
            setText(message, error.status === 401 ? t("login.refused") : error.message);
            token.select();
            return;
        }
        localStorage.setItem(SESSION, "open");
        dialog.onclose = null;
        dialog.close();
        onLogin();
    });
    dialog.oncancel = (event) => event.preventDefault();
    // Browsers close it with the second Esc, whatever oncancel does.
    dialog.onclose = () => openDialog("login-dialog");
    dialog.replaceChildren(form);
    openDialog("login-dialog");
    token.focus();
}

export function hasLoggedIn() {
    return localStorage.getItem(SESSION) !== null;
}

export function forgetLogin() {
    localStorage.removeItem(SESSION);
}

/** Finds a robot, plan, alarm or part of the floor by its id. list() gives [{kind, id}]. */
export function showFind(list, onFound) {
    const dialog = document.getElementById("find-dialog");
    const items = list();
    const results = make("ul", {class: "find-results", id: "find-results", role: "listbox", "aria-label": t("find.results")});
    const input = make("input", {
        id: "find-input", type: "search", autocomplete: "off", spellcheck: "false", role: "combobox", "aria-expanded": "true",
        "aria-controls": "find-results",
    });
    let chosen = 0;
    let found = [];
    const choose = (item) => {
        dialog.close();
        onFound(item);
    };
    const show = () => {
        const wanted = input.value.trim().toLowerCase();
        found = wanted === "" ? [] : items.filter(({id}) => id.toLowerCase().includes(wanted))
            .sort((a, b) => a.id.toLowerCase().indexOf(wanted) - b.id.toLowerCase().indexOf(wanted)).slice(0, FOUND_LIMIT);
        chosen = Math.max(0, Math.min(chosen, found.length - 1));
        results.replaceChildren(...found.map((item, i) => make("li", {
            role: "option", id: `find-${i}`, "aria-selected": String(i === chosen), onclick: () => choose(item),
        }, make("span", {class: "muted", text: t(`kind.${item.kind}`)}), make("span", {text: item.id}))));
        input.setAttribute("aria-activedescendant", found.length > 0 ? `find-${chosen}` : "");
    };
    input.addEventListener("input", () => {
        chosen = 0;
        show();
    });
    input.addEventListener("keydown", (event) => {
        const step = {ArrowDown: 1, ArrowUp: -1}[event.key];
        if (step !== undefined) {
            event.preventDefault();
            chosen += step;
            show();
        } else if (event.key === "Enter") {
            event.preventDefault();
            if (found.length > 0) {
                choose(found[chosen]);
            }
        }
    });
    dialog.replaceChildren(make("div", {}, make("h2", {id: "find-title", text: t("find.title")}),
        make("label", {for: "find-input", text: t("find.text")}), input, results));
    openDialog("find-dialog");
    input.focus();
}

/** Keys: [[key, text]]. */
export function showHelp(keys) {
    const dialog = document.getElementById("help-dialog");
    dialog.replaceChildren(make("form", {method: "dialog"},
        make("h2", {id: "help-title", text: t("help.title")}),
        make("dl", {class: "keys"}, ...keys.flatMap(([key, text]) => [
            make("dt", {}, make("kbd", {text: key})), make("dd", {text})])),
        make("p", {class: "muted", text: t("help.colours")}),
        make("p", {class: "muted"}, `${t("help.leaflet")} `,
            make("a", {href: "/page/leaflet-copyright.txt", target: "_blank", rel: "noopener", text: t("help.licence")})),
        make("div", {class: "dialog-buttons"},
            make("button", {type: "submit", class: "button primary", autofocus: true, text: t("dialog.close")}))));
    openDialog("help-dialog");
}
