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

/** A link to what `select` shows. */
export function makeLink(select, kind, id, text = id) {
    return make("button", {type: "button", class: "link", "data-key": `${kind}/${id}`, text, onclick: () => select({kind, id})});
}

/** A row of a list of facts, for showChildren. */
export function makeFact(key, label, ...children) {
    return [make("dt", {"data-key": key, text: label}), make("dd", {"data-key": key}, ...children)];
}

/** Nodes stay in place where possible: one that moves loses the focus and a click that has begun. */
function placeChildren(container, nodes) {
    const focused = document.activeElement;
    const kept = new Set(nodes);
    [...container.childNodes].filter((node) => !kept.has(node)).forEach((node) => node.remove());
    let next = container.firstChild;
    for (const node of nodes) {
        if (next !== null && next.nextSibling === node) {
            next.remove(); // it comes back further down
            next = node;
        }
        if (node === next) {
            next = next.nextSibling;
        } else {
            container.insertBefore(node, next);
        }
    }
    if (focused !== document.activeElement && container.contains(focused)) {
        focused.focus({preventScroll: true});
    }
}

/** [[name, node]], each name once. */
function nameNodes(nodes) {
    const counts = new Map();
    return [...nodes].map((node) => {
        const name = `${node.nodeName} ${node.dataset?.key ?? ""}`;
        const count = counts.get(name) ?? 0;
        counts.set(name, count + 1);
        return [`${name} ${count}`, node];
    });
}

/** The former node with what the new one shows, or the new one. */
function updateNode(former, node) {
    if (former === undefined) {
        return node;
    }
    if (node.nodeName === "BUTTON") {
        setText(former, node.textContent);
        return former;
    }
    if (former.isEqualNode(node)) {
        return former;
    }
    if (!former.querySelector?.("button")) {
        return node;
    }
    [...former.attributes].filter(({name}) => !node.hasAttribute(name)).forEach(({name}) => former.removeAttribute(name));
    [...node.attributes].forEach(({name, value}) => setAttribute(former, name, value));
    showChildren(former, ...node.childNodes);
    return former;
}

/** Shows these new nodes, but keeps the buttons that were there before, and what is around them: one may have the focus, a click
 *  that has begun, or a command that runs. Every button needs a data-key, which stands for what it does; elements of a list need
 *  one if their order changes. */
export function showChildren(container, ...nodes) {
    const former = new Map(nameNodes(container.childNodes));
    placeChildren(container, nameNodes(nodes).map(([name, node]) => updateNode(former.get(name), node)));
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

    show(items) {
        const kept = new Map();
        for (const item of items) {
            const key = this.#getKey(item);
            const row = this.#rows.get(key) ?? kept.get(key) ?? this.#create(item);
            row.update(item);
            kept.set(key, row);
        }
        this.#rows = kept;
        placeChildren(this.#container, [...kept.values()].map((row) => row.node));
    }
}
