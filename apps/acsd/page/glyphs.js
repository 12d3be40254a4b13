// The shape of each state, for the lists (SVG) and the floor (canvas). States differ by shape, not by colour alone.

import {makeSvg} from "./dom.js";

// Paths in a box of 16 by 16; filled unless they are in STROKED.
const PATHS = {
    idle: "M8 3a5 5 0 1 0 0 10a5 5 0 1 0 0-10z",
    moving: "M4.5 2.5 13 8l-8.5 5.5z",
    docking: "M3 3l6.5 5L3 13zM11 3h2.5v10H11z",
    working: "M8 1.5 14.5 8 8 14.5 1.5 8z",
    charging: "M9.5 1 3.5 9h3.8L6.5 15l6-8H8.7z",
    error: "M8 1.5 15 14H1zM7.2 6v4h1.6V6zM7.2 11v1.6h1.6V11z",
    stopped: "M3.5 3H7v10H3.5zM9 3h3.5v10H9z",
    disconnected: "M3 3l10 10M13 3 3 13",
    manual: "M3 13V3l5 6 5-6v10",
    unknown: "M5 5.5a3 3 0 1 1 4.5 2.6Q8 9 8 10.3M8 12.5v.9",
    maintenance: "M3 13l5-5M13.2 4.3 10.5 7l-1.8-.3-.4-1.9L11 2.2A3.6 3.6 0 0 0 6.8 7.2M13.2 4.3A3.6 3.6 0 0 1 8.6 9.2",
    light: "M8 2a6 6 0 1 0 0 12A6 6 0 1 0 8 2zM7.2 5v3.8h1.6V5zM7.2 10v1.6h1.6V10z",
    block: "M8 2a6 6 0 1 0 0 12A6 6 0 1 0 8 2zM4.5 7.1v1.8h7V7.1z",
    wait: "M4 2h8v2L9 8l3 4v2H4v-2l3-4-3-4z",
    done: "M2.5 8.5 6.5 12.5 13.5 4",
    failed: "M3.5 3.5l9 9M12.5 3.5l-9 9",
    skipped: "M3 4l4 4-4 4M8.5 4l4 4-4 4",
    plan: "M3 2.5h10v3H3zM3 6.8h10v3H3zM3 11h10v3H3z",
    find: "M7 2.5a4.5 4.5 0 1 0 0 9a4.5 4.5 0 1 0 0-9M10.3 10.3 14 14",
    wall: "M1.5 3h13v8.5h-13zM5 14h6",
    light_theme: "M8 5a3 3 0 1 0 0 6a3 3 0 1 0 0-6M8 1v2M8 13v2M1 8h2M13 8h2M3 3l1.5 1.5M11.5 11.5 13 13M13 3 11.5 4.5M5 11 3 13",
    dark_theme: "M12.5 10.5A6 6 0 0 1 5.5 3.5a5.5 5.5 0 1 0 7 7z",
    system_theme: "M8 2.5a5.5 5.5 0 1 0 0 11zM8 2.5a5.5 5.5 0 0 1 0 11",
    help: "M5.5 5.8a2.6 2.6 0 1 1 3.8 2.3Q8 8.8 8 10M8 12v.9",
    plus: "M8 3v10M3 8h10",
    minus: "M3 8h10",
    fit: "M2.5 6V2.5H6M10 2.5h3.5V6M13.5 10v3.5H10M6 13.5H2.5V10",
    route: "M3 13.5V9q0-2 2-2h6q2 0 2-2V2.5M10.8 4.5 13 2.3l2.2 2.2",
    labels: "M2.5 4h8l3 4-3 4h-8z",
    close: "M3.5 3.5l9 9M12.5 3.5l-9 9",
    back: "M10 3 5 8l5 5",
    floor: "M2.5 2.5h11v11h-11zM2.5 8h11M8 2.5v11",
    robot: "M2.5 5h8.5v6H2.5zM12.5 5.5 15 8l-2.5 2.5z",
    system: "M3 4h10M3 8h10M3 12h10M6 2.5v3M10.5 6.5v3M5 10.5v3",
    list: "M5.5 4h8M5.5 8h8M5.5 12h8M2.5 4h.8M2.5 8h.8M2.5 12h.8",
};
const STROKED = new Set(["disconnected", "manual", "unknown", "maintenance", "done", "failed", "skipped", "find", "wall",
    "light_theme", "system_theme", "help", "plus", "minus", "fit", "route", "labels", "close", "back", "floor", "system", "list"]);
const OUTLINED = new Set(["idle"]);

const ROBOT_GLYPHS = {
    Idle: "idle", Moving: "moving", UnDocking: "moving", Arrival: "docking", Docking: "docking", Working: "working",
    Charging: "charging", Error: "error", Stopped: "stopped", Disconnected: "disconnected", Manual: "manual", Init: "unknown",
};
const PLAN_GLYPHS = {
    Pending: "wait", InProgress: "moving", Paused: "stopped", Completed: "done", Failed: "failed", Cancelled: "close",
    Aborted: "failed",
};

export function getRobotGlyph(robot) {
    return robot.maintenance ? "maintenance" : ROBOT_GLYPHS[robot.status] ?? "unknown";
}

/** The group of states that share a colour: "drive", "work", "idle", "charge", "stop", "fault" or "off". */
export function getRobotGroup(robot) {
    if (robot.status === "Error") {
        return "fault";
    }
    if (robot.status === "Disconnected" || robot.status === "Init") {
        return "off";
    }
    if (robot.maintenance || robot.status === "Stopped" || robot.status === "Manual") {
        return "stop";
    }
    return {Idle: "idle", Working: "work", Charging: "charge"}[robot.status] ?? "drive";
}

export function getPlanGlyph(plan) {
    return PLAN_GLYPHS[plan.status] ?? "unknown";
}

export function makeGlyph(name) {
    const path = makeSvg("path", {d: PATHS[name] ?? PATHS.unknown});
    const isStroked = STROKED.has(name) || OUTLINED.has(name);
    const svg = makeSvg("svg", {viewBox: "0 0 16 16", class: isStroked ? "glyph stroked" : "glyph", "aria-hidden": "true"}, path);
    svg.dataset.name = name;
    return svg;
}

/** Replaces the glyph in a node if it is another one. */
export function setGlyph(node, name) {
    if (node.firstElementChild?.dataset.name !== name) {
        node.replaceChildren(makeGlyph(name));
    }
}

const paths = new Map();

/** Draws on a canvas, centred at x, y, `size` pixels wide. */
export function drawGlyph(context, name, x, y, size, colour) {
    let path = paths.get(name);
    if (path === undefined) {
        path = new Path2D(PATHS[name] ?? PATHS.unknown);
        paths.set(name, path);
    }
    const scale = size / 16;
    context.save();
    context.translate(x - size / 2, y - size / 2);
    context.scale(scale, scale);
    if (STROKED.has(name) || OUTLINED.has(name)) {
        context.strokeStyle = colour;
        context.lineWidth = 2.2;
        context.lineCap = context.lineJoin = "round";
        context.stroke(path);
    } else {
        context.fillStyle = colour;
        context.fill(path, "evenodd");
    }
    context.restore();
}
