// The live page of acsd: joins the model, the floor and the lists.

import {setLoginHandler} from "./api.js";
import {AlarmView} from "./alarm-view.js";
import {Detail} from "./detail.js";
import {showError, showFind, showHelp, showLogin} from "./dialogs.js";
import {make, setAttribute, setClass, setHidden, setText} from "./dom.js";
import {EventView} from "./event-view.js";
import {Feed} from "./feed.js";
import {Floor} from "./floor.js";
import {formatClock, formatDuration, updateSince} from "./format.js";
import {makeGlyph, setGlyph} from "./glyphs.js";
import {Changes, Model} from "./model.js";
import {PlanView} from "./plan-view.js";
import {RobotView} from "./robot-view.js";
import {Strip} from "./strip.js";
import {SystemView} from "./system-view.js";
import {fillTexts, getLanguage, setLanguage, startTexts, t} from "./text.js";
import {Theme} from "./theme.js";

const LIST_PERIOD = 500; // milliseconds between two updates of the lists
// Names and glyphs.
const TABS = [["floor", "floor"], ["plans", "plan"], ["robots", "robot"], ["alarms", "error"], ["events", "list"],
    ["system", "system"]];
const PHONE = "(max-width: 760px)"; // as in style.css
const SELECTABLE = ["robot", "plan", "node", "edge", "station"];

class Page {
    constructor() {
        this.model = new Model();
        this.theme = new Theme();
        this.context = {
            model: this.model, theme: this.theme, select: (selection) => this.select(selection),
            openTab: (name) => this.openTab(name),
            showError,
        };
        this.floor = this.context.floor = new Floor(this.context);
        this.strip = new Strip(this.context);
        this.detail = new Detail(this.context);
        this.views = {plans: new PlanView(this.context), robots: new RobotView(this.context), alarms: new AlarmView(this.context),
            events: new EventView(this.context), system: new SystemView(this.context)};
        this.tab = "plans";
        this.pending = new Changes();
        this.timer = null;
        this.feedState = {name: "connecting", reason: ""};
        this.feed = new Feed(this.model, (state) => this.#showFeed(state));
    }

    start() {
        this.model.listen((changes) => this.#collect(changes));
        setLoginHandler(() => showLogin(() => this.feed.start()));
        this.#makeTabs();
        this.#listenToButtons();
        addEventListener("keydown", (event) => this.#onKey(event));
        addEventListener("hashchange", () => this.#readHash());
        document.addEventListener("visibilitychange", () => this.#schedule());
        // A page that the browser keeps for its back button must not keep a connection: there are 6 for each server.
        addEventListener("pagehide", () => this.feed.stop());
        addEventListener("pageshow", (event) => {
            if (event.persisted) {
                this.feed.start();
            }
        });
        setInterval(() => this.#tick(), 1_000);
        this.showTexts();
        this.openTab(matchMedia(PHONE).matches ? "floor" : "plans");
        this.#readHash();
        this.#showFeed(this.feedState);
        this.feed.start();
    }

    // Updates: the floor has its own pace, the lists are brought up to date a few times per second, and only if they can be seen.

    #collect(changes) {
        this.pending.merge(changes);
        this.#showTitle();
        if (changes.isAll) {
            this.#openHeavyAlarms();
            this.#flush();
        } else {
            this.#schedule();
        }
    }

    /** At once: the title can be seen while the page cannot. */
    #showTitle() {
        const heavy = this.model.status?.alarms.heavy ?? 0;
        const title = heavy > 0 ? `(${heavy}) acsd` : "acsd";
        if (document.title !== title) {
            document.title = title;
        }
    }

    /** On a phone, which shows one tab: with the first snapshot, unless the user has opened something else. */
    #openHeavyAlarms() {
        const isFirst = !this.hasSnapshot;
        this.hasSnapshot = true;
        const isUntouched = this.tab === "floor" && this.detail.selection === null;
        if (isFirst && isUntouched && matchMedia(PHONE).matches && this.#hasHeavyAlarm()) {
            this.openTab("alarms");
        }
    }

    #hasHeavyAlarm() {
        return this.model.alarms.some((alarm) => alarm.level === "heavy");
    }

    #schedule() {
        if (this.timer === null && !document.hidden) {
            this.timer = setTimeout(() => this.#flush(), LIST_PERIOD);
        }
    }

    #flush() {
        clearTimeout(this.timer);
        this.timer = null;
        const changes = this.pending;
        this.pending = new Changes();
        if (changes.isAll || this.strip.isAffected(changes)) {
            this.strip.update();
        }
        for (const [name, view] of Object.entries(this.views)) {
            view.isStale ||= changes.isAll || view.isAffected(changes) || (name === "system" && changes.site);
            if (view.isStale && !view.root.hidden) {
                view.isStale = false;
                view.update();
            }
        }
        this.detail.update(changes);
        this.#showCounts();
    }

    #tick() {
        updateSince();
        if (this.feedState.name !== "live") {
            this.#showFeed(this.feedState);
        }
        const clock = document.getElementById("clock");
        if (clock !== null) {
            setText(clock, formatClock(Date.now()));
        }
    }

    // Tabs

    #makeTabs() {
        this.tabs = new Map();
        const list = document.getElementById("tabs");
        for (const [name, glyph] of TABS) {
            const text = make("span", {class: "tab-text"});
            const count = make("span", {class: "count"});
            const tab = make("button", {type: "button", class: `tab tab-${name}`, id: `tab-${name}`, role: "tab",
                "aria-controls": `view-${name}`, onclick: () => this.openTab(name)},
            make("span", {class: "tab-glyph"}, makeGlyph(glyph)), text, count);
            list.append(tab);
            this.tabs.set(name, {tab, text, count});
        }
        list.addEventListener("keydown", (event) => {
            const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
            if (step === undefined) {
                return;
            }
            event.preventDefault();
            const names = [...this.tabs.keys()].filter((name) => this.tabs.get(name).tab.offsetParent !== null);
            const next = names[(names.indexOf(this.tab) + step + names.length) % names.length];
            this.openTab(next);
            this.tabs.get(next).tab.focus();
        });
    }

    openTab(name) {
        // On a phone the detail covers the tab.
        if (this.detail.selection !== null && matchMedia(PHONE).matches) {
            this.select(null);
        }
        this.tab = name;
        document.body.dataset.tab = name;
        for (const [other, {tab}] of this.tabs) {
            setAttribute(tab, "aria-selected", String(other === name));
            tab.tabIndex = other === name ? 0 : -1;
        }
        this.#showViews();
    }

    #showViews() {
        // On a wall screen alarms and plans are shown together; beside the tab of the floor, which only a phone has, the plans.
        const shown = document.body.classList.contains("wall") ? ["alarms", "plans"] : [this.tab === "floor" ? "plans" : this.tab];
        for (const [name, view] of Object.entries(this.views)) {
            setHidden(view.root, !shown.includes(name));
        }
        this.#flush();
    }

    #showCounts() {
        for (const [name, view] of Object.entries(this.views)) {
            const count = view.getCount();
            setText(this.tabs.get(name).count, count === null || count === 0 ? "" : String(count));
        }
        setClass(this.tabs.get("alarms").count, this.#hasHeavyAlarm() ? "count heavy" : "count");
    }

    // Selection; in the address as #robot/LR01

    select(selection) {
        const hash = selection === null ? "" : `#${selection.kind}/${encodeURIComponent(selection.id)}`;
        if (location.hash !== hash) {
            history.pushState(null, "", hash === "" ? location.pathname + location.search : hash);
        }
        this.#applySelection(selection, false);
    }

    #applySelection(selection, mayMove) {
        const wasOpen = !this.detail.root.hidden;
        if (selection !== null && !wasOpen) {
            this.focusedBefore = document.activeElement;
        }
        this.detail.show(selection);
        this.floor.setSelection(selection, mayMove);
        if (selection !== null) {
            this.detail.root.focus({preventScroll: true});
        } else if (wasOpen) {
            this.focusedBefore?.focus?.({preventScroll: true});
        }
    }

    #readHash() {
        const [kind, ...rest] = location.hash.slice(1).split("/");
        let id = null;
        try {
            id = decodeURIComponent(rest.join("/"));
        } catch {
            // Not an address of this page.
        }
        this.setWall(kind === "wall");
        this.#applySelection(SELECTABLE.includes(kind) && id ? {kind, id} : null, true);
    }

    #listFindable() {
        const {index} = this.floor;
        const list = (kind, ids) => [...ids ?? []].map((id) => ({kind, id}));
        return [...list("robot", this.model.robots.keys()), ...list("plan", this.model.plans.keys()),
            ...list("plan", this.model.ended.keys()), ...list("station", index?.stations.keys()),
            ...list("node", index?.nodes.keys()), ...list("edge", index?.edges.keys())];
    }

    find() {
        showFind(() => this.#listFindable(), (selection) => {
            this.select(selection);
            this.floor.setSelection(selection, true);
        });
    }

    // Language, theme, wall, keys

    showTexts() {
        fillTexts();
        for (const [name, {text}] of this.tabs) {
            setText(text, t(`tab.${name}`));
        }
        this.strip.build();
        Object.values(this.views).forEach((view) => view.build());
        this.detail.build();
        this.floor.showTools();
        setGlyph(document.getElementById("find-button"), "find");
        setGlyph(document.getElementById("wall-button"), "wall");
        setGlyph(document.getElementById("help-button"), "help");
        const language = document.getElementById("language-button");
        setText(language, getLanguage() === "ko" ? "EN" : "한");
        language.title = `${t("language.other")} (l)`;
        language.setAttribute("aria-label", t("language.other"));
        this.#showTheme();
        this.#showFeed(this.feedState);
    }

    #showTheme() {
        const button = document.getElementById("theme-button");
        setGlyph(button, `${this.theme.name}_theme`);
        button.title = `${t("theme.title", {name: t(`theme.${this.theme.name}`)})} (t)`;
        button.setAttribute("aria-label", t("theme.title", {name: t(`theme.${this.theme.name}`)}));
    }

    async switchLanguage() {
        await setLanguage(getLanguage() === "ko" ? "en" : "ko");
        this.showTexts();
    }

    switchTheme() {
        this.theme.switchOn();
        this.#showTheme();
    }

    setWall(isOn) {
        if (document.body.classList.contains("wall") === isOn) {
            return;
        }
        document.documentElement.classList.toggle("wall", isOn);
        document.body.classList.toggle("wall", isOn);
        this.theme.refresh();
        this.views.plans.isStale = true;
        this.#showViews();
    }

    toggleWall() {
        const isOn = !document.body.classList.contains("wall");
        history.replaceState(null, "", isOn ? "#wall" : location.pathname + location.search);
        if (isOn) {
            this.#applySelection(null, false);
        }
        this.setWall(isOn);
    }

    #listenToButtons() {
        const actions = {find: () => this.find(), wall: () => this.toggleWall(), theme: () => this.switchTheme(),
            language: () => this.switchLanguage(), help: () => this.help()};
        for (const [name, action] of Object.entries(actions)) {
            document.getElementById(`${name}-button`).addEventListener("click", action);
        }
    }

    #listKeys() {
        const openTab = (name, i) => [String(i + 1), `key.${name}`, () => this.openTab(name)];
        return [["/", "key.find", () => this.find()], ["f", "key.fit", () => this.floor.fit()],
            ["+", "key.zoomIn", () => this.floor.zoom(0.5)], ["-", "key.zoomOut", () => this.floor.zoom(-0.5)],
            ["r", "key.routes", () => this.floor.toggleRoutes()],
            ["k", "key.legend", () => this.floor.toggleLegend()], ["m", "key.map", () => document.getElementById("map").focus()],
            ...["plans", "robots", "alarms", "events", "system"].map(openTab),
            ["w", "key.wall", () => this.toggleWall()], ["t", "key.theme", () => this.switchTheme()],
            ["l", "key.language", () => this.switchLanguage()], ["?", "key.help", () => this.help()]];
    }

    help() {
        const keys = [...this.#listKeys(), ["Esc", "key.close"], ["← ↑ → ↓", "key.pan"]];
        showHelp(keys.map(([key, text]) => [key, t(text)]));
    }

    #onKey(event) {
        const isTyping = event.target.matches("input, select, textarea");
        if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector("dialog[open]") !== null) {
            return;
        }
        if (event.key === "Escape") {
            if (isTyping) {
                event.target.blur();
            } else if (this.detail.selection !== null) {
                this.select(null);
            } else if (document.body.classList.contains("wall")) {
                this.toggleWall();
            }
            return;
        }
        const found = isTyping ? undefined : this.#listKeys().find(([key]) => key === event.key);
        if (found !== undefined && !(event.target.id === "map" && ["+", "-"].includes(event.key))) {
            event.preventDefault();
            found[2]();
        }
    }

    // Connection

    #showFeed(state) {
        this.feedState = state;
        const age = Date.now() - this.feed?.getLastByte();
        const isLive = state.name === "live";
        const live = document.getElementById("live");
        setClass(live, `live ${isLive ? "good" : "bad"}`);
        if (live.dataset.state !== state.name + getLanguage()) {
            live.dataset.state = state.name + getLanguage();
            live.replaceChildren(make("span", {class: "live-dot"}),
                make("span", {class: "live-text", text: t(`live.${state.name}`)}),
                make("time", {id: "clock", class: "clock", text: formatClock(Date.now())}));
        }
        const isWithoutData = ["silent", "lost", "standby", "login"].includes(state.name);
        const isOld = isWithoutData && this.model.status !== null;
        document.body.classList.toggle("is-old", isOld);
        const banner = document.getElementById("banner");
        setHidden(banner, !isWithoutData);
        if (!banner.hidden) {
            const key = state.name === "lost" && state.reason ? "banner.lostWhy" : `banner.${state.name}`;
            const old = isOld ? t("banner.old", {time: formatClock(Date.now() - age), age: formatDuration(age)}) : "";
            setText(banner, `${t(key, {reason: state.reason})} ${old}`.trim());
        }
    }
}

await startTexts();
const page = new Page();
globalThis.acsdPage = page; // for the console of the browser, and for tests
page.start();
