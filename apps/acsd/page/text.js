// Texts of the page in English and Korean.

import {quote} from "./shell.js";
import english from "./text.en.js";
import korean from "./text.ko.js";

const LANGUAGES = {en: english, ko: korean};
const STORED = "acsd.language";

let language = "en";
let koreanAlarms = {};

function pickLanguage() {
    const asked = new URLSearchParams(location.search).get("lang") ?? localStorage.getItem(STORED)
        ?? navigator.languages.map((name) => name.slice(0, 2)).find((name) => name in LANGUAGES);
    return Object.hasOwn(LANGUAGES, asked ?? "") ? asked : "en";
}

export function getLanguage() {
    return language;
}

/** The text of a key, with {name} replaced. */
export function t(key, values = {}) {
    const text = LANGUAGES[language][key] ?? english[key] ?? key;
    return text.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? String(values[name]) : whole));
}

/** A state as it is shown; one that the page does not know stays as it is. */
export function nameState(kind, state) {
    const key = `${kind}.${state}`;
    return key in english ? t(key) : state;
}

/** Title, cause and remedy of an alarm in the language of the page, else as acsd sends them. Commands in it name the robot, plan
 *  and job of the alarm: those of acsd already do. */
export function explainAlarm(alarm) {
    const own = language === "ko" ? koreanAlarms[alarm.errorCode] : undefined;
    const values = {ROBOT: alarm.robotId, PLAN: alarm.planId, JOB: alarm.jobId, CODE: alarm.errorCode};
    const fillWord = (word) => (values[word] ? quote(values[word]) : word);
    const fill = (text) => text?.replace(/`[^`]*`/g, (command) => command.replace(/\b[A-Z]+\b/g, fillWord));
    return {
        title: own?.title ?? alarm.title ?? "",
        cause: fill(own?.cause) ?? alarm.cause ?? "",
        remedy: fill(own?.remedy) ?? alarm.remedy ?? "",
    };
}

/** Fills the elements of the HTML that name a text: data-text is the content, data-label the accessible name and tooltip. */
export function fillTexts(root = document) {
    for (const node of root.querySelectorAll("[data-text]")) {
        node.textContent = t(node.dataset.text);
    }
    for (const node of root.querySelectorAll("[data-label]")) {
        const label = t(node.dataset.label);
        node.setAttribute("aria-label", label);
        if (node.tagName === "BUTTON") {
            node.title = node.dataset.key ? `${label} (${node.dataset.key})` : label;
        }
    }
}

/** {code: {title, cause, remedy}} */
export function setKoreanAlarms(alarms) {
    koreanAlarms = alarms;
}

async function loadKoreanAlarms() {
    try {
        const response = await fetch("/page/alarms.ko.json");
        setKoreanAlarms(response.ok ? await response.json() : {});
    } catch {
        // Shown in English.
    }
}

export async function startTexts() {
    await setLanguage(pickLanguage(), false);
}

export async function setLanguage(name, isKept = true) {
    language = name;
    document.documentElement.lang = name;
    if (isKept) {
        localStorage.setItem(STORED, name);
    }
    if (name === "ko" && Object.keys(koreanAlarms).length === 0) {
        await loadKoreanAlarms();
    }
}
