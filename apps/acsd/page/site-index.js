// The floor of GET /v1/site, indexed for drawing and for finding what is under the pointer.

const CELL = 4; // metres
const SAMPLES = 64; // points of one edge in the grid

function getDistance(point, start, end) {
    const [x, y] = [end[0] - start[0], end[1] - start[1]];
    const length = x * x + y * y;
    const along = (point[0] - start[0]) * x + (point[1] - start[1]) * y;
    const share = length === 0 ? 0 : Math.max(0, Math.min(1, along / length));
    return Math.hypot(point[0] - start[0] - share * x, point[1] - start[1] - share * y);
}

export class SiteIndex {
    constructor(site) {
        this.nodes = new Map(site.nodes.map((node) => [node.nodeId, node]));
        this.edges = new Map();
        this.stations = new Map();
        this.stationsOfNode = new Map();
        this.edgeBetween = new Map(); // "start/end" -> edge
        this.maps = [...new Set(site.nodes.map((node) => node.mapId ?? ""))].sort();
        this.grid = new Map();
        site.edges.forEach((edge) => this.#addEdge(edge));
        site.stations.forEach((station) => this.#addStation(station));
        this.nodes.forEach((node) => this.#put(node.x, node.y, {kind: "node", item: node}));
        this.edges.forEach((edge) => this.#putEdge(edge));
        this.areas = this.#findAreas();
    }

    /** Stations A01.CP01 and A01.SET02 are of the area A01: its name and middle. */
    #findAreas() {
        const areas = new Map();
        for (const station of this.stations.values()) {
            const [name, ...rest] = station.stationId.split(".");
            if (rest.length > 0) {
                const area = areas.get(`${station.mapId} ${name}`)
                    ?? {name, mapId: station.mapId, low: [Infinity, Infinity], high: [-Infinity, -Infinity]};
                area.low = [Math.min(area.low[0], station.x), Math.min(area.low[1], station.y)];
                area.high = [Math.max(area.high[0], station.x), Math.max(area.high[1], station.y)];
                areas.set(`${station.mapId} ${name}`, area);
            }
        }
        return [...areas.values()].map(({name, mapId, low, high}) => ({
            name, mapId, x: (low[0] + high[0]) / 2, y: (low[1] + high[1]) / 2, height: high[1] - low[1]}));
    }

    #addEdge(edge) {
        const start = this.nodes.get(edge.startNodeId);
        const end = this.nodes.get(edge.endNodeId);
        if (start === undefined || end === undefined) {
            return;
        }
        const points = edge.trajectory?.length >= 2 ? edge.trajectory : [[start.x, start.y], [end.x, end.y]];
        const known = {...edge, points, mapId: start.mapId ?? "", isBothWays: false};
        const opposite = this.edgeBetween.get(`${edge.endNodeId}/${edge.startNodeId}`);
        if (opposite !== undefined) {
            known.isBothWays = opposite.isBothWays = true;
        }
        this.edgeBetween.set(`${edge.startNodeId}/${edge.endNodeId}`, known);
        this.edges.set(edge.edgeId, known);
    }

    /** A station is at its nodes, or in their middle. */
    #addStation(station) {
        const nodes = station.nodeIds.map((id) => this.nodes.get(id)).filter((node) => node !== undefined);
        if (nodes.length === 0) {
            return;
        }
        const known = {
            ...station, mapId: nodes[0].mapId ?? "",
            x: nodes.reduce((sum, node) => sum + node.x, 0) / nodes.length,
            y: nodes.reduce((sum, node) => sum + node.y, 0) / nodes.length,
            isLabelAbove: false,
        };
        // The label is on the side that no lane comes from.
        const edge = [...this.edges.values()].find((candidate) => candidate.endNodeId === nodes[0].nodeId);
        if (edge !== undefined) {
            const [x, y] = edge.points.at(-2);
            known.isLabelAbove = nodes[0].y - y > Math.abs(nodes[0].x - x);
        }
        this.stations.set(station.stationId, known);
        nodes.forEach((node) => this.stationsOfNode.set(node.nodeId, [...this.stationsOfNode.get(node.nodeId) ?? [], known]));
        this.#put(known.x, known.y, {kind: "station", item: known});
    }

    #put(x, y, entry) {
        const key = `${Math.floor(x / CELL)}/${Math.floor(y / CELL)}`;
        const cell = this.grid.get(key);
        if (cell === undefined) {
            this.grid.set(key, [entry]);
        } else if (cell.at(-1) !== entry) {
            cell.push(entry);
        }
    }

    #putEdge(edge) {
        const entry = {kind: "edge", item: edge};
        for (let i = 1; i < edge.points.length; i += 1) {
            const [start, end] = [edge.points[i - 1], edge.points[i]];
            const count = Math.min(SAMPLES, Math.ceil(Math.hypot(end[0] - start[0], end[1] - start[1]) / CELL) + 1);
            for (let k = 0; k <= count; k += 1) {
                this.#put(start[0] + (end[0] - start[0]) * k / count, start[1] + (end[1] - start[1]) * k / count, entry);
            }
        }
    }

    /** {kind, id} within `reach` metres of x, y on this map; stations before nodes before edges; null if there is none. */
    find(x, y, reach, mapId) {
        let found = null;
        const cells = Math.ceil(reach / CELL);
        const ranks = {station: 0, node: 1, edge: 2};
        for (let column = -cells; column <= cells; column += 1) {
            for (let row = -cells; row <= cells; row += 1) {
                for (const entry of this.grid.get(`${Math.floor(x / CELL) + column}/${Math.floor(y / CELL) + row}`) ?? []) {
                    const distance = entry.kind === "edge" ? this.#getEdgeDistance(entry.item, [x, y])
                        : Math.hypot(entry.item.x - x, entry.item.y - y);
                    const rank = ranks[entry.kind];
                    if ((entry.item.mapId ?? "") === mapId && distance <= (entry.kind === "edge" ? reach * 0.6 : reach)
                        && (found === null || rank < found.rank || (rank === found.rank && distance < found.distance))) {
                        found = {kind: entry.kind, id: entry.item[`${entry.kind}Id`], rank, distance};
                    }
                }
            }
        }
        return found;
    }

    #getEdgeDistance(edge, point) {
        let best = Infinity;
        for (let i = 1; i < edge.points.length; i += 1) {
            best = Math.min(best, getDistance(point, edge.points[i - 1], edge.points[i]));
        }
        return best;
    }

    /** Corners of a map; null if it has no node. */
    getBounds(mapId) {
        const nodes = [...this.nodes.values()].filter((node) => (node.mapId ?? "") === mapId);
        if (nodes.length === 0) {
            return null;
        }
        const [xs, ys] = [nodes.map((node) => node.x), nodes.map((node) => node.y)];
        const reduce = (values, pick) => values.reduce((best, value) => pick(best, value));
        return [[reduce(ys, Math.min), reduce(xs, Math.min)], [reduce(ys, Math.max), reduce(xs, Math.max)]];
    }

    /** The points from one node to the next, along the trajectory of the edge. */
    getPoints(startId, endId) {
        const edge = this.edgeBetween.get(`${startId}/${endId}`);
        if (edge !== undefined) {
            return edge.points;
        }
        const end = this.nodes.get(endId);
        return end === undefined ? [] : [[end.x, end.y]];
    }
}
