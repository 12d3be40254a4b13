// The detail of a node, an edge or a station: who is there, and whether it is blocked.

import {Commands, makeCommandButton} from "./commands.js";
import {make, makeFact, makeLink, showChildren} from "./dom.js";
import {formatNumber, setSince} from "./format.js";
import {t} from "./text.js";

export class PlaceDetail {
    constructor(context, {kind, id}) {
        this.context = context;
        this.kind = kind;
        this.id = id;
        this.facts = make("dl", {class: "facts"});
        this.buttons = make("div", {class: "row-buttons no-wall"});
        this.node = make("div", {class: "detail-body"}, this.facts, this.buttons);
        this.update();
    }

    #listLinks(kind, ids) {
        return ids.length === 0 ? ["–"] : ids.flatMap((id, i) => [i > 0 ? ", " : "", makeLink(this.context.select, kind, id)]);
    }

    update() {
        const {model, floor} = this.context;
        const {index} = floor;
        const item = index && {node: index.nodes, edge: index.edges, station: index.stations}[this.kind]?.get(this.id);
        const block = model.findBlock(this.kind, this.id);
        if (!item) {
            this.facts.replaceChildren(make("dd", {text: t("detail.gone")}));
            showChildren(this.buttons);
            return;
        }
        const nodes = {node: [this.id], edge: [item.startNodeId, item.endNodeId], station: item.nodeIds}[this.kind];
        const robots = [...model.robots.values()];
        const here = this.kind === "edge" ? robots.filter((robot) => robot.node === nodes[0] && robot.nextNode === nodes[1])
            : robots.filter((robot) => nodes.includes(robot.node) && robot.nextNode === null);
        const reserving = this.kind === "edge" ? []
            : robots.filter((robot) => robot.reservedNodes.some((id) => nodes.includes(id)));
        const coming = robots.filter((robot) => robot.route.some((step) => nodes.includes(step.nodeId)));
        const isAhead = (step) => step.position === this.id && ["Pending", "Dispatched", "InProgress"].includes(step.status);
        const plans = this.kind === "station" ? [...model.plans.values()].filter((plan) => plan.steps.some(isAhead)) : [];
        const rows = [];
        const add = (key, ...children) => rows.push(...makeFact(key, t(key), ...children));
        if (block !== null) {
            const since = make("span", {class: "wait-since"});
            setSince(since, block.since);
            add("place.blocked", make("div", {class: "wait"}, since, make("span", {text: block.reason || t("place.noReason")})));
        }
        add("place.robots", ...this.#listLinks("robot", here.map((robot) => robot.robotId)));
        if (this.kind !== "edge") {
            add("place.reserved", ...this.#listLinks("robot", reserving.map((robot) => robot.robotId)));
        }
        add("place.routes", ...this.#listLinks("robot", coming.map((robot) => robot.robotId)));
        if (this.kind === "station") {
            add("robot.carriers", here.flatMap((robot) => robot.carrierIds.filter(Boolean)
                .map((carrier) => `${carrier} (${robot.robotId})`)).join(", ") || "–");
            add("place.plans", ...this.#listLinks("plan", plans.map((plan) => plan.planId)));
        }
        if (this.kind === "node") {
            const stations = index.stationsOfNode.get(this.id) ?? [];
            add("place.station", ...this.#listLinks("station", stations.map((station) => station.stationId)));
        } else {
            add("place.nodes", ...this.#listLinks("node", nodes));
        }
        if (this.kind !== "edge") {
            add("robot.place", `x ${formatNumber(item.x)} m, y ${formatNumber(item.y)} m`,
                item.mapId ? make("span", {class: "muted", text: ` ${item.mapId}`}) : null);
        }
        showChildren(this.facts, ...rows);
        showChildren(this.buttons, makeCommandButton(block === null ? Commands.block(this.kind, this.id)
            : Commands.unblock(this.kind, this.id)));
    }
}
