// The floor: a map in metres (Leaflet with CRS.Simple) with a layer for the site and one for the robots.

import {CRS, map as makeMap} from "/page/leaflet.js";
import {make, setHidden, setText} from "./dom.js";
import {getRobotGlyph, getRobotGroup, makeGlyph} from "./glyphs.js";
import {RobotLayer} from "./robot-layer.js";
import {SiteIndex} from "./site-index.js";
import {SiteLayer} from "./site-layer.js";
import {nameState, t} from "./text.js";

const REACH = 10; // pixels around the pointer
const LEGEND = ["Idle", "Moving", "Docking", "Working", "Charging", "Stopped", "Error", "Disconnected", "Manual", "Init"];

export class Floor {
    /** The context has model, theme, select({kind, id}). */
    constructor(context) {
        this.context = context;
        this.map = makeMap("map", {
            crs: CRS.Simple, minZoom: -4, maxZoom: 8, zoomSnap: 0, zoomDelta: 0.5, wheelPxPerZoomLevel: 90, zoomControl: false,
            attributionControl: false, zoomAnimation: false, fadeAnimation: false, inertia: false, keyboardPanDelta: 120,
            boxZoom: true, doubleClickZoom: false, tap: false,
        });
        this.map.setView([0, 0], 0);
        this.siteLayer = new SiteLayer(context.theme).addTo(this.map);
        this.robotLayer = new RobotLayer(context.theme).addTo(this.map);
        this.index = null;
        this.mapId = null;
        this.isTouched = false; // by the user; until then the floor fits the window
        this.selection = null;
        this.isMoveDue = false; // to the selection
        this.#listen();
        this.showTools();
    }

    #listen() {
        const {model, theme} = this.context;
        model.listen((changes) => this.#update(changes));
        theme.listen(() => {
            this.robotLayer.clearSprites();
            this.siteLayer.request();
        });
        this.map.on("click", (event) => this.#pick(event.containerPoint));
        this.map.on("mousemove", (event) => this.#showPointer(event.containerPoint));
        this.map.on("dragstart zoomstart", (event) => { this.isTouched ||= event.type === "dragstart" || this.isWheeled; });
        this.map.getContainer().addEventListener("wheel", () => { this.isWheeled = true; }, {passive: true});
        this.map.getContainer().addEventListener("keydown", () => { this.isTouched = true; });
        new ResizeObserver(() => {
            this.map.invalidateSize({animate: false, pan: false});
            if (!this.isTouched) {
                this.fit();
            }
        }).observe(this.map.getContainer());
        document.addEventListener("visibilitychange", () => this.robotLayer.request());
    }

    #update(changes) {
        const {model} = this.context;
        if (changes.site && model.site !== null) {
            this.#setSite();
        }
        if (changes.isAll) {
            this.robotLayer.setRobots(model.robots);
            this.#highlight();
            this.#moveToSelection();
        } else if (changes.robots.size > 0) {
            this.robotLayer.updateRobots(changes.robots);
        }
        if (changes.plans.size > 0 && this.selection?.kind === "plan") {
            this.#highlight();
        }
    }

    #setSite() {
        const isFirst = this.index === null;
        this.index = new SiteIndex(this.context.model.site);
        if (this.mapId === null || !this.index.maps.includes(this.mapId)) {
            this.mapId = this.index.maps[0] ?? "";
        }
        this.#showMap();
        if (isFirst || !this.isTouched) {
            this.fit();
        }
        this.showTools();
    }

    #switchMap(mapId) {
        this.mapId = mapId;
        this.#showMap();
    }

    #showMap() {
        this.siteLayer.setSite(this.index, this.mapId, this.context.model.blocks);
        this.robotLayer.setSite(this.index, this.mapId);
        setHidden(document.getElementById("map-note"), this.index.nodes.size > 0);
        setText(document.getElementById("map-note"), t("floor.empty"));
    }

    fit() {
        const bounds = this.index?.getBounds(this.mapId);
        if (bounds) {
            const rem = this.context.theme.rem;
            this.isTouched = false;
            this.isWheeled = false;
            this.map.fitBounds(bounds, {
                animate: false, paddingTopLeft: [2 * rem, 2 * rem], paddingBottomRight: [2 * rem, 2.5 * rem]});
        }
    }

    zoom(steps) {
        this.isTouched = true;
        this.map.setZoom(this.map.getZoom() + steps, {animate: false});
    }

    toggleRoutes() {
        this.robotLayer.setRoutesShown(!this.robotLayer.areRoutesShown);
        this.showTools();
    }

    toggleLegend() {
        const legend = document.getElementById("legend");
        setHidden(legend, !legend.hidden);
        this.showTools();
    }

    /** {kind: "robot", "plan", "node", "edge" or "station", id}, or null. If it cannot be seen, shows its map and moves there. */
    setSelection(selection, mayMove) {
        this.selection = selection;
        this.#highlight();
        this.isMoveDue = mayMove;
        this.#moveToSelection();
    }

    /** With the first snapshot if the page is opened with a selection: until then its place is unknown. */
    #moveToSelection() {
        const {selection} = this;
        const place = this.isMoveDue && selection !== null && this.index !== null ? this.#findPlace(selection) : null;
        this.isMoveDue &&= this.context.model.status === null;
        if (place === null) {
            return;
        }
        if (place.mapId !== this.mapId) {
            this.#switchMap(place.mapId);
            this.showTools();
            if (!this.isTouched) {
                this.fit();
            }
        }
        const margin = this.isTouched ? 0.05 : 0; // the floor fits the window until the user moves it
        if (!this.map.getBounds().pad(-margin).contains([place.y, place.x])) {
            this.isTouched = true;
            this.map.setView([place.y, place.x], Math.max(this.map.getZoom(), 4), {animate: false});
        }
    }

    #findPlace({kind, id}) {
        const {model} = this.context;
        if (kind === "robot" || kind === "plan") {
            return this.robotLayer.getPlace(kind === "robot" ? id : model.findPlan(id)?.robotId);
        }
        const edge = kind === "edge" ? this.index.edges.get(id) : undefined;
        if (edge !== undefined) {
            const [x, y] = edge.points[Math.floor(edge.points.length / 2)];
            return {x, y, mapId: edge.mapId};
        }
        const item = this.index[kind === "node" ? "nodes" : "stations"].get(id);
        return item === undefined ? null : {x: item.x, y: item.y, mapId: item.mapId ?? ""};
    }

    #highlight() {
        const selection = this.selection;
        const plan = selection?.kind === "plan" ? this.context.model.findPlan(selection.id) : null;
        this.siteLayer.targets = new Set(plan?.steps.filter((step) => !["Completed", "Skipped"].includes(step.status))
            .map((step) => step.position) ?? []);
        this.siteLayer.selection = ["node", "edge", "station"].includes(selection?.kind) ? selection : null;
        this.siteLayer.request();
        this.robotLayer.setSelected(selection?.kind === "robot" ? selection.id : plan?.robotId ?? null);
    }

    #findAt(point) {
        if (this.index === null) {
            return null;
        }
        const robotId = this.robotLayer.find(point.x, point.y, REACH);
        if (robotId !== null) {
            return {kind: "robot", id: robotId};
        }
        const place = this.map.containerPointToLatLng(point);
        return this.index.find(place.lng, place.lat, Math.max(REACH / this.siteLayer.scale, 0.3), this.mapId);
    }

    #pick(point) {
        const found = this.#findAt(point);
        this.context.select(found === null ? null : {kind: found.kind, id: found.id});
    }

    #showPointer(point) {
        const found = this.#findAt(point);
        const container = this.map.getContainer();
        container.classList.toggle("is-pointing", found !== null);
        container.title = found === null ? "" : found.id;
    }

    /** The buttons on the map, in the language of the page. */
    showTools() {
        const makeTool = (glyph, label, key, action, isPressed) => {
            const button = make("button", {
                type: "button", class: "icon-button", "aria-label": t(label), title: `${t(label)} (${key})`, onclick: action,
                "aria-pressed": isPressed === undefined ? null : String(isPressed),
            });
            button.append(makeGlyph(glyph));
            return button;
        };
        const legend = document.getElementById("legend");
        const tools = [
            makeTool("plus", "floor.zoomIn", "+", () => this.zoom(0.5)),
            makeTool("minus", "floor.zoomOut", "-", () => this.zoom(-0.5)),
            makeTool("fit", "floor.fit", "f", () => this.fit()),
            makeTool("route", "floor.routes", "r", () => this.toggleRoutes(), this.robotLayer.areRoutesShown),
            makeTool("list", "floor.legend", "k", () => this.toggleLegend(), !legend.hidden),
        ];
        if ((this.index?.maps.length ?? 0) > 1) {
            const select = make("select", {"aria-label": t("floor.map"), onchange: () => {
                this.#switchMap(select.value);
                this.fit();
            }}, ...this.index.maps.map((name) => make("option", {value: name, text: name, selected: name === this.mapId})));
            tools.push(select);
        }
        const focused = [...document.getElementById("map-tools").children].indexOf(document.activeElement);
        document.getElementById("map-tools").replaceChildren(...tools);
        if (focused >= 0) {
            tools[focused]?.focus();
        }
        this.#showLegend(legend);
    }

    #showLegend(legend) {
        const rows = LEGEND.map((status) => {
            const robot = {status, maintenance: false};
            return make("li", {}, make("span", {class: `badge group-${getRobotGroup(robot)}`}, makeGlyph(getRobotGlyph(robot))),
                nameState("robotStatus", status));
        });
        rows.push(make("li", {}, make("span", {class: "badge group-stop"}, makeGlyph("maintenance")), t("robot.maintenance")));
        const lines = [["reserved", "legend.reserved"], ["horizon", "legend.horizon"], ["blocked", "legend.blocked"]]
            .map(([name, key]) => make("li", {}, make("span", {class: `line line-${name}`}), t(key)));
        legend.replaceChildren(make("ul", {}, ...rows), make("ul", {}, ...lines,
            make("li", {}, make("span", {class: "body body-lr"}), t("legend.lr")),
            make("li", {}, make("span", {class: "body body-cr"}), t("legend.cr")),
            make("li", {}, make("span", {class: "body body-load"}), t("legend.load"))));
    }
}
