// Helpers for the DOM. Every text goes through textContent: ids and messages come from other systems.

import {splitText} from "./shell.js";

const SVG = "http://www.w3.org/2000/svg";
const SHOWN_ATTRIBUTES = ["title", "aria-label"];
// Characters without a shape that change how others are shown: the direction of writing, joiners, separators of lines.
const HIDDEN = /[\u00ad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]/g;

/** The text with a sign for each hidden character, as acsctl shows it. */
export function makeVisible(text) {
    return String(text).replace(HIDDEN, "\ufffd");
}

/** make("li", {class: "row", text: "…", "aria-label": "…", onclick: f}, child, …): children may be strings or null. */
export function make(tag, attributes = {}, ...children) {
    const node = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (value === null || value === undefined || value === false) {
            continue;
        }
        if (name === "text") {
            node.textContent = makeVisible(value);
        } else if (name.startsWith("on")) {
            node.addEventListener(name.slice(2), value);
        } else {
            node.setAttribute(name, value === true ? "" : SHOWN_ATTRIBUTES.includes(name) ? makeVisible(value) : value);
        }
    }
    node.append(...children.filter((child) => child !== null && child !== undefined)
        .map((child) => (typeof child === "string" ? makeVisible(child) : child)));
    return node;
}

export function makeSvg(tag, attributes, ...children) {
    const node = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) {
        node.setAttribute(name, value);
    }
    node.append(...children);
    return node;
}

/** Shows text with `code` in backticks. */
export function setMarkedText(node, text) {
    if (node.dataset.marked !== text) {
        node.dataset.marked = text;
        node.replaceChildren(...splitText(makeVisible(text)).map((part, i) => (i % 2 === 1 ? make("code", {text: part}) : part)));
    }
}

/** Only a change touches the DOM. */
export function setText(node, text) {
    const shown = makeVisible(text);
    if (node.textContent !== shown) {
        node.textContent = shown;
    }
}

export function setClass(node, name) {
    if (node.className !== name) {
        node.className = name;
    }
}

export function setHidden(node, isHidden) {
    if (node.hidden !== isHidden) {
        node.hidden = isHidden;
    }
}

export function setAttribute(node, name, value) {
    if (value === null) {
        node.removeAttribute(name);
        return;
    }
    const shown = SHOWN_ATTRIBUTES.includes(name) ? makeVisible(value) : value;
    if (node.getAttribute(name) !== shown) {
        node.setAttribute(name, shown);
    }
}

/** A list whose elements stay while their key does: create(item) makes one with a method update(item). */
export class KeyedList {
    #container;
    #getKey;
    #create;
    #rows = new Map();

    constructor(container, getKey, create) {
        this.#container = container;
        this.#getKey = getKey;
        this.#create = create;
    }

    clear() {
        this.#rows.clear();
        this.#container.replaceChildren();
    }

    /** Rows stay in place where possible: one that moves loses the focus and a click that has begun. */
    show(items) {
        const focused = document.activeElement;
        const kept = new Set(items.map((item) => this.#getKey(item)));
        for (const [key, row] of this.#rows) {
            if (!kept.has(key)) {
                row.node.remove();
                this.#rows.delete(key);
            }
        }
        let next = this.#container.firstElementChild;
        for (const item of items) {
            const key = this.#getKey(item);
            let row = this.#rows.get(key);
            if (row === undefined) {
                row = this.#create(item);
                this.#rows.set(key, row);
            }
            row.update(item);
            if (next !== null && next.nextElementSibling === row.node) {
                next.remove(); // it comes back further down
                next = row.node;
            }
            if (row.node === next) {
                next = next.nextElementSibling;
            } else {
                this.#container.insertBefore(row.node, next);
            }
        }
        if (focused !== document.activeElement && this.#container.contains(focused)) {
            focused.focus({preventScroll: true});
        }
    }
}
