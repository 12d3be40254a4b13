// The floor under the robots: lanes, nodes, stations and what is blocked. Drawn when the view or the site changes.

import {CanvasLayer} from "./canvas-layer.js";
import {drawGlyph} from "./glyphs.js";
import {LabelSpace} from "./label-space.js";

const NODE_SCALE = 9; // pixels per metre from which nodes are drawn
const ARROW_SCALE = 16;
const NODE_LABEL_SCALE = 2.4; // of the root size
const LANE_WIDTH = 0.55; // metres

function traceEdge(path, points) {
    path.moveTo(points[0][0], points[0][1]);
    for (let i = 1; i < points.length; i += 1) {
        path.lineTo(points[i][0], points[i][1]);
    }
}

export class SiteLayer extends CanvasLayer {
    constructor(theme) {
        super(1, 0.15);
        this.theme = theme;
        this.index = null;
        this.mapId = "";
        this.blocks = new Map();
        this.selection = null; // {kind, id}
        this.targets = new Set(); // stationIds of the selected plan
    }

    setSite(index, mapId, blocks) {
        this.index = index;
        this.mapId = mapId;
        this.blocks = blocks;
        this.lanes = new Path2D();
        this.oneWay = [];
        this.blocked = [];
        this.lanePlaces = [];
        for (const edge of index.edges.values()) {
            if (edge.mapId !== mapId) {
                continue;
            }
            if (!edge.isBothWays) {
                this.oneWay.push(edge);
            }
            if (!edge.isBothWays || edge.startNodeId < edge.endNodeId) {
                traceEdge(this.lanes, edge.points);
                this.#addPlaces(edge.points);
            }
        }
        for (const block of blocks.values()) {
            const item = {node: index.nodes, edge: index.edges, station: index.stations}[block.kind]?.get(block.id);
            if (item !== undefined && (item.mapId ?? "") === mapId) {
                this.blocked.push({kind: block.kind, item});
            }
        }
        this.request();
    }

    /** A point for every metre of a lane. */
    #addPlaces(points) {
        for (let i = 1; i < points.length; i += 1) {
            const [start, end] = [points[i - 1], points[i]];
            const count = Math.ceil(Math.hypot(end[0] - start[0], end[1] - start[1]));
            for (let k = 0; k < count; k += 1) {
                this.lanePlaces.push([start[0] + (end[0] - start[0]) * k / count, start[1] + (end[1] - start[1]) * k / count]);
            }
        }
    }

    draw(context) {
        if (this.index === null) {
            return;
        }
        const colours = this.theme.colours;
        const rem = this.theme.rem;
        this.useMetres(context);
        context.lineCap = context.lineJoin = "round";
        context.lineWidth = Math.max(LANE_WIDTH, 3 / this.scale);
        context.strokeStyle = colours.lane;
        context.stroke(this.lanes);
        context.lineWidth = 1 / this.scale;
        context.strokeStyle = colours.track;
        context.stroke(this.lanes);
        this.usePixels(context);
        if (this.scale >= ARROW_SCALE) {
            this.#drawArrows(context, colours);
        }
        this.#drawNodes(context, colours);
        this.#drawStations(context, colours);
        this.#drawSelection(context, colours);
        this.#drawBlocks(context, colours); // a selected place is still seen to be blocked
        this.#drawLabels(context, colours, rem);
    }

    #drawArrows(context, colours) {
        context.fillStyle = colours.node;
        const size = Math.min(0.38 * this.theme.rem, this.scale * 0.16);
        for (const edge of this.oneWay) {
            const last = edge.points.length - 1;
            const [start, end] = [edge.points[Math.floor(last / 2)], edge.points[Math.floor(last / 2) + 1]];
            const [x, y] = [(start[0] + end[0]) / 2, (start[1] + end[1]) / 2];
            if (!this.isVisible(x, y, 10)) {
                continue;
            }
            const angle = -Math.atan2(end[1] - start[1], end[0] - start[0]);
            const [cos, sin] = [Math.cos(angle) * size, Math.sin(angle) * size];
            const [pixelX, pixelY] = [this.toX(x), this.toY(y)];
            context.beginPath();
            context.moveTo(pixelX + cos, pixelY + sin);
            context.lineTo(pixelX - cos - sin * 0.8, pixelY - sin + cos * 0.8);
            context.lineTo(pixelX - cos + sin * 0.8, pixelY - sin - cos * 0.8);
            context.fill();
        }
    }

    #drawNodes(context, colours) {
        if (this.scale < NODE_SCALE) {
            return;
        }
        context.fillStyle = colours.node;
        const radius = Math.max(1.2, Math.min(0.25 * this.theme.rem, this.scale * 0.07));
        context.beginPath();
        for (const node of this.index.nodes.values()) {
            if ((node.mapId ?? "") === this.mapId && this.isVisible(node.x, node.y, radius)) {
                const [x, y] = [this.toX(node.x), this.toY(node.y)];
                context.moveTo(x + radius, y);
                context.arc(x, y, radius, 0, 2 * Math.PI);
            }
        }
        context.fill();
    }

    #getStationSize() {
        return Math.max(5, this.scale * 1.05);
    }

    #drawStations(context, colours) {
        const size = this.#getStationSize();
        context.lineWidth = 1;
        for (const station of this.index.stations.values()) {
            if (station.mapId !== this.mapId || !this.isVisible(station.x, station.y, size)) {
                continue;
            }
            context.beginPath();
            context.roundRect(this.toX(station.x) - size / 2, this.toY(station.y) - size / 2, size, size, size * 0.12);
            context.fillStyle = colours.station;
            context.fill();
            context.strokeStyle = colours.stationLine;
            context.stroke();
            if (this.targets.has(station.stationId)) {
                context.lineWidth = 3;
                context.strokeStyle = colours.accent;
                context.stroke();
                context.lineWidth = 1;
            }
        }
    }

    #getBlockSize() {
        return this.theme.rem * Math.max(0.9, Math.min(1.6, this.scale * 0.6 / this.theme.rem));
    }

    #drawBlocks(context, colours) {
        const size = this.#getBlockSize();
        for (const {kind, item} of this.blocked) {
            if (kind === "edge") {
                const path = new Path2D();
                traceEdge(path, item.points);
                this.useMetres(context);
                context.lineCap = "butt";
                context.lineWidth = Math.max(LANE_WIDTH * 0.6, 4 / this.scale);
                context.strokeStyle = colours.heavy;
                context.setLineDash([6, 5].map((length) => length * this.theme.rem / 16 / this.scale));
                context.stroke(path);
                context.setLineDash([]);
                this.usePixels(context);
            }
            const middle = kind === "edge" ? this.#getMiddle(item) : [item.x, item.y];
            const [x, y] = [this.toX(middle[0]), this.toY(middle[1])];
            context.beginPath();
            context.arc(x, y, size / 2, 0, 2 * Math.PI);
            context.fillStyle = colours.floor;
            context.fill();
            drawGlyph(context, "block", x, y, size * 1.25, colours.heavy);
        }
    }

    #getMiddle(edge) {
        const last = edge.points.length - 1;
        const [start, end] = [edge.points[Math.floor(last / 2)], edge.points[Math.ceil(last / 2)]];
        return last % 2 === 0 ? start : [(start[0] + end[0]) / 2, (start[1] + end[1]) / 2];
    }

    #drawSelection(context, colours) {
        if (this.selection === null) {
            return;
        }
        const {kind, id} = this.selection;
        const item = {node: this.index.nodes, edge: this.index.edges, station: this.index.stations}[kind]?.get(id);
        if (item === undefined || (item.mapId ?? "") !== this.mapId) {
            return;
        }
        context.strokeStyle = colours.accent;
        context.lineWidth = 3;
        if (kind === "edge") {
            const path = new Path2D();
            traceEdge(path, item.points);
            this.useMetres(context);
            context.lineWidth = Math.max(LANE_WIDTH, 8 / this.scale);
            context.stroke(path);
            this.usePixels(context);
            return;
        }
        context.beginPath();
        const radius = Math.max(kind === "station" ? this.#getStationSize() * 0.8 : 9,
            this.blocks.has(`${kind}/${id}`) ? this.#getBlockSize() * 0.8 : 0);
        context.arc(this.toX(item.x), this.toY(item.y), radius, 0, 2 * Math.PI);
        context.stroke();
    }

    #drawLabels(context, colours, rem) {
        const space = new LabelSpace();
        const height = 0.72 * rem;
        context.textAlign = "center";
        context.textBaseline = "middle";
        context.font = `500 ${height}px ${this.theme.font}`;
        const stations = [...this.index.stations.values()].filter((station) => station.mapId === this.mapId);
        const visible = stations.filter((station) => this.isVisible(station.x, station.y, 40));
        // All with their whole id or all without their area.
        const isShort = visible.some((station) => context.measureText(station.stationId).width > this.scale * 1.9);
        context.fillStyle = colours.stationText;
        for (const station of visible) {
            const text = isShort ? station.stationId.split(".").at(-1) : station.stationId;
            const distance = (this.#getStationSize() / 2 + height * 0.65) * (station.isLabelAbove ? -1 : 1);
            this.#drawLabel(context, space, text, this.toX(station.x), this.toY(station.y) + distance, height);
        }
        const size = this.#getStationSize();
        visible.forEach((station) => space.take(this.toX(station.x), this.toY(station.y), size, size));
        this.#drawAreas(context, colours, rem, space);
        if (this.scale < NODE_LABEL_SCALE * rem) {
            return;
        }
        context.font = `${0.62 * rem}px ${this.theme.font}`;
        context.fillStyle = colours.nodeText;
        for (const node of this.index.nodes.values()) {
            if ((node.mapId ?? "") === this.mapId && this.isVisible(node.x, node.y, 40)
                && !this.index.stationsOfNode.has(node.nodeId)) {
                const y = this.toY(node.y) + Math.max(0.7 * rem, this.scale * 0.27 + 0.35 * rem);
                this.#drawLabel(context, space, node.nodeId, this.toX(node.x), y, 0.62 * rem);
            }
        }
    }

    #drawLabel(context, space, text, x, y, height) {
        const width = context.measureText(text).width;
        if (width < this.scale * 1.95 && space.tryTake(x, y, width + 4, height)) {
            context.fillText(text, x, y);
        }
    }

    /** Large and pale, near the middle of the stations of an area, where there is room beside stations and lanes. */
    #drawAreas(context, colours, rem, space) {
        for (const edge of this.lanePlaces) {
            space.take(this.toX(edge[0]), this.toY(edge[1]), 4, 4);
        }
        context.fillStyle = colours.areaText;
        for (const area of this.index.areas) {
            const size = Math.min(2.2 * rem, this.scale * 1.3);
            if (area.mapId !== this.mapId || size < 0.7 * rem) {
                continue;
            }
            context.font = `700 ${size}px ${this.theme.font}`;
            const width = context.measureText(area.name).width;
            const [x, y] = [this.toX(area.x), this.toY(area.y)];
            const steps = Math.ceil((area.height * this.scale / 2 + 3 * size) / (size / 2));
            for (let i = 0; i <= 2 * steps; i += 1) {
                const place = y + (i % 2 === 0 ? -1 : 1) * Math.ceil(i / 2) * size / 2;
                if (space.tryTake(x, place, width, size)) {
                    context.fillText(area.name, x, place);
                    break;
                }
            }
        }
    }
}
