// The keys of the commands whose answer was lost: such a command gets its key again, so that it has no second effect.

import {makeKey} from "./api.js";

const KEPT = 600_000; // milliseconds; acsd keeps its answer for a key for 10 minutes
const LIMIT = 100;

const lost = new Map(); // "path\ntext" -> {key, time, state}, oldest first

const getName = (path, text) => `${path}\n${text}`;

/** What a command sets: a later command that sets the same makes the lost one obsolete. An action sets nothing, it happens. */
function getState(path, text) {
    return path.endsWith("/actions") ? getName(path, text) : path.replace(/\/(?:pause|resume|block|unblock)$/, "");
}

/** {key, time, isRepeated}: time is when the command was sent first, isRepeated whether the answer was lost then. */
export function takeKey(path, text) {
    const now = Date.now();
    const found = lost.get(getName(path, text));
    return found !== undefined && now - found.time < KEPT ? {key: found.key, time: found.time, isRepeated: true}
        : {key: makeKey(), time: now, isRepeated: false};
}

export function keepKey(path, text, {key, time}) {
    lost.delete(getName(path, text));
    lost.set(getName(path, text), {key, time, state: getState(path, text)});
    if (lost.size > LIMIT) {
        lost.delete(lost.keys().next().value);
    }
}

/** acsd has answered. */
export function dropKey(path, text) {
    lost.delete(getName(path, text));
}

/** acsd has executed the command. */
export function dropObsoleteKeys(path, text) {
    const state = getState(path, text);
    [...lost].filter(([, command]) => command.state === state).forEach(([name]) => lost.delete(name));
}
