// Light, dark, or as the system has it; and the colours of the style sheet for the canvases.

const STORED = "acsd.theme";
const THEMES = ["system", "light", "dark"];
const COLOURS = ["floor", "lane", "track", "node", "node-text", "station", "station-line", "station-text", "area-text", "heavy",
    "accent", "text", "route", "load", "battery", "battery-back",
    ...["drive", "work", "idle", "charge", "stop", "fault", "off"].flatMap((group) => [group, `${group}-line`, `${group}-ink`])];

function toCamelCase(name) {
    return name.replace(/-(\w)/g, (_, letter) => letter.toUpperCase());
}

export class Theme {
    constructor() {
        this.colours = {};
        this.rem = 16;
        this.font = "sans-serif";
        this.listeners = [];
        const asked = new URLSearchParams(location.search).get("theme") ?? localStorage.getItem(STORED);
        this.name = THEMES.includes(asked) ? asked : "system";
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.refresh());
        addEventListener("resize", () => this.refresh());
        this.refresh();
    }

    listen(listener) {
        this.listeners.push(listener);
    }

    switchOn() {
        this.name = THEMES[(THEMES.indexOf(this.name) + 1) % THEMES.length];
        localStorage.setItem(STORED, this.name);
        this.refresh();
    }

    refresh() {
        const root = document.documentElement;
        const isDark = this.name === "dark" || (this.name === "system" && matchMedia("(prefers-color-scheme: dark)").matches);
        root.dataset.theme = isDark ? "dark" : "light";
        const style = getComputedStyle(root);
        for (const name of COLOURS) {
            this.colours[toCamelCase(name)] = style.getPropertyValue(`--${name}`).trim();
        }
        this.rem = parseFloat(style.fontSize);
        this.font = style.getPropertyValue("--font").trim();
        this.listeners.forEach((listener) => listener());
    }
}
