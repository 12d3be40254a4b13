// Times and numbers as text.

import {setText} from "./dom.js";
import {getLanguage, t} from "./text.js";

let serverOffset = 0; // milliseconds that the clock of acsd is ahead of this one

/** Times are compared with acsd's clock: that of the browser's machine may be wrong. */
export function setServerTime(milliseconds) {
    serverOffset = milliseconds - Date.now();
}

export function getServerNow() {
    return Date.now() + serverOffset;
}

export function formatDuration(milliseconds) {
    const seconds = Math.max(0, Math.floor(milliseconds / 1000));
    if (seconds < 60) {
        return t("time.seconds", {n: seconds});
    }
    const minutes = Math.floor(seconds / 60);
    if (minutes < 60) {
        return t("time.minutes", {n: minutes});
    }
    const hours = Math.floor(minutes / 60);
    if (hours < 24) {
        return t("time.hours", {n: hours, m: minutes % 60});
    }
    return t("time.days", {n: Math.floor(hours / 24), h: hours % 24});
}

export function formatClock(milliseconds) {
    const time = new Date(milliseconds);
    return [time.getHours(), time.getMinutes(), time.getSeconds()].map((part) => String(part).padStart(2, "0")).join(":");
}

/** Local date and time; "–" for null. */
export function formatTime(text) {
    if (text === null || text === undefined) {
        return "–";
    }
    const time = new Date(text);
    const isToday = time.toDateString() === new Date(getServerNow()).toDateString();
    return isToday ? formatClock(time)
        : `${time.toLocaleDateString(getLanguage(), {month: "short", day: "numeric"})} ${formatClock(time)}`;
}

export function formatNumber(value, digits = 2) {
    const rounded = Number(value.toFixed(digits)) + 0; // not -0, which would have a sign
    return rounded.toLocaleString(getLanguage(), {minimumFractionDigits: digits, maximumFractionDigits: digits});
}

function showSince(node) {
    const age = formatDuration(getServerNow() - Date.parse(node.dataset.since));
    setText(node, node.dataset.sinceKey === undefined ? age : t(node.dataset.sinceKey, {time: age}));
}

/** Makes the node show for how long, from then on; null shows nothing. `key`: of a text with {time}. */
export function setSince(node, text, key) {
    if (text === null || text === undefined) {
        delete node.dataset.since;
        setText(node, "");
        return;
    }
    if (node.dataset.since !== text) {
        node.dataset.since = text;
        node.title = new Date(text).toLocaleString(getLanguage());
    }
    if (key !== undefined) {
        node.dataset.sinceKey = key;
    }
    showSince(node);
}

/** Once a second: the durations that can be seen. */
export function updateSince() {
    for (const node of document.querySelectorAll("[data-since]")) {
        if (node.offsetParent !== null) {
            showSince(node);
        }
    }
}
