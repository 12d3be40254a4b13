// The robots with their routes. A frame is drawn only while a robot moves or something has changed, and at most every FRAME
// milliseconds; between two reports a robot is shown on the line between its places.

import {CanvasLayer} from "./canvas-layer.js";
import {drawGlyph, getRobotGlyph, getRobotGroup} from "./glyphs.js";
import {LabelSpace} from "./label-space.js";

const FRAME = 130; // milliseconds
const JUMP = 6; // metres; a longer way is not shown as a drive
const SHORTEST = 120; // milliseconds between two places
const LONGEST = 1_200;
const LOW_BATTERY = 20; // percent

function turnTowards(from, to, share) {
    const turn = Math.atan2(Math.sin(to - from), Math.cos(to - from));
    return from + turn * share;
}

/** Where a robot is shown. */
class Motion {
    constructor(pose) {
        this.from = this.to = this.shown = pose;
        this.begin = this.end = 0;
        this.reported = 0;
    }

    setTarget(pose, now) {
        const interval = now - this.reported;
        this.reported = now;
        if (Math.hypot(pose.x - this.shown.x, pose.y - this.shown.y) > JUMP || interval > 10 * LONGEST) {
            this.from = this.to = this.shown = pose;
            this.end = now;
            return;
        }
        this.from = this.shown;
        this.to = pose;
        this.begin = now;
        // A little longer than the interval, so that the robot does not stop before each report.
        this.end = now + 1.15 * Math.max(SHORTEST, Math.min(LONGEST, interval));
    }

    advance(now) {
        if (this.shown === this.to) {
            return false;
        }
        if (now >= this.end) {
            this.shown = this.to;
            return true;
        }
        const share = Math.max(0, (now - this.begin) / (this.end - this.begin));
        this.shown = {
            x: this.from.x + (this.to.x - this.from.x) * share,
            y: this.from.y + (this.to.y - this.from.y) * share,
            theta: turnTowards(this.from.theta, this.to.theta, share),
        };
        return true;
    }
}

export class RobotLayer extends CanvasLayer {
    constructor(theme) {
        super(2, 0);
        this.theme = theme;
        this.robots = new Map();
        this.motions = new Map();
        this.sprites = new Map();
        this.index = null;
        this.mapId = "";
        this.selected = null;
        this.areRoutesShown = true;
        this.timer = null;
    }

    onMove() {
        this.place();
    }

    setSite(index, mapId) {
        this.index = index;
        this.mapId = mapId;
        this.request();
    }

    clearSprites() {
        this.sprites.clear();
        this.request();
    }

    setSelected(robotId) {
        this.selected = robotId;
        this.request();
    }

    setRoutesShown(areShown) {
        this.areRoutesShown = areShown;
        this.request();
    }

    /** All robots of a snapshot. */
    setRobots(robots) {
        this.robots = robots;
        this.motions = new Map();
        robots.forEach((robot) => this.#update(robot, performance.now()));
        this.#schedule();
    }

    updateRobots(ids) {
        const now = performance.now();
        ids.forEach((id) => this.#update(this.robots.get(id), now));
        this.#schedule();
    }

    #update(robot, now) {
        const pose = this.#findPose(robot);
        const motion = this.motions.get(robot.robotId);
        if (pose === null) {
            this.motions.delete(robot.robotId);
        } else if (motion === undefined) {
            this.motions.set(robot.robotId, new Motion(pose));
        } else {
            motion.setTarget(pose, now);
        }
    }

    /** A robot without a pose is at its node. */
    #findPose(robot) {
        const node = this.index?.nodes.get(robot.node);
        if (robot.pose !== null) {
            return robot.pose;
        }
        return node === undefined ? null : {x: node.x, y: node.y, theta: Math.PI / 2};
    }

    /** That of its node; null if the node is unknown and there are several maps. */
    #findMapId(robot) {
        const node = this.index.nodes.get(robot.node);
        return node !== undefined ? node.mapId ?? "" : this.index.maps.length <= 1 ? this.mapId : null;
    }

    #isOnMap(robot) {
        return this.#findMapId(robot) === this.mapId;
    }

    #schedule() {
        if (this.timer === null && !document.hidden) {
            this.timer = setTimeout(() => {
                this.timer = null;
                this.request();
            }, FRAME);
        }
    }

    draw(context) {
        if (this.index === null) {
            return;
        }
        const now = performance.now();
        let isMoving = false;
        for (const motion of this.motions.values()) {
            isMoving = motion.advance(now) || isMoving;
        }
        const shown = [...this.robots.values()].filter((robot) => this.motions.has(robot.robotId) && this.#isOnMap(robot));
        this.#drawRoutes(context, shown);
        // The selected robot last, and so on top; its label first.
        const isSelected = (robot) => robot.robotId === this.selected;
        const ordered = [...shown.filter((robot) => !isSelected(robot)), ...shown.filter(isSelected)];
        ordered.forEach((robot) => this.#drawRobot(context, robot));
        const space = new LabelSpace();
        ordered.reverse().forEach((robot) => this.#drawLabel(context, robot, space));
        if (isMoving) {
            this.#schedule();
        }
    }

    /** Reserved parts solid, the rest dashed; those of the selected robot on top and in its colour. */
    #drawRoutes(context, robots) {
        const colours = this.theme.colours;
        const others = {reserved: new Path2D(), horizon: new Path2D()};
        const own = {reserved: new Path2D(), horizon: new Path2D()};
        for (const robot of robots) {
            const isOwn = robot.robotId === this.selected;
            if (isOwn || this.areRoutesShown) {
                this.#traceRoute(robot, isOwn ? own : others);
            }
        }
        this.useMetres(context);
        context.lineCap = "butt";
        context.lineJoin = "round";
        const pixel = Math.max(1, this.theme.rem / 16) / this.scale;
        for (const [paths, colour, width] of [[others, colours.route, 3], [own, colours.accent, 5]]) {
            context.strokeStyle = colour;
            context.lineWidth = width * 0.55 * pixel;
            context.setLineDash([4 * pixel, 5 * pixel]);
            context.stroke(paths.horizon);
            context.setLineDash([]);
            context.lineWidth = width * pixel;
            context.stroke(paths.reserved);
        }
        this.usePixels(context);
    }

    #traceRoute(robot, paths) {
        if (robot.route.length === 0) {
            return;
        }
        const place = this.motions.get(robot.robotId).shown;
        let path = null;
        let last = [place.x, place.y];
        let before = robot.node;
        robot.route.forEach((step, i) => {
            const wanted = step.reserved ? paths.reserved : paths.horizon;
            if (path !== wanted) {
                path = wanted;
                path.moveTo(last[0], last[1]);
            }
            const points = this.index.getPoints(before, step.nodeId);
            // The robot is somewhere on the first edge already.
            const first = i === 0 ? points.length - 1 : 0;
            for (let k = Math.max(0, first); k < points.length; k += 1) {
                path.lineTo(points[k][0], points[k][1]);
                last = points[k];
            }
            before = step.nodeId;
        });
    }

    /** Length of the body in pixels. */
    getBodySize() {
        return Math.max(1.05 * this.theme.rem, Math.min(4 * this.theme.rem, this.scale * 1.0));
    }

    #drawRobot(context, robot) {
        const {x, y, theta} = this.motions.get(robot.robotId).shown;
        const size = this.getBodySize();
        if (!this.isVisible(x, y, 3 * size)) {
            return;
        }
        const [pixelX, pixelY] = [this.toX(x), this.toY(y)];
        const isSelected = robot.robotId === this.selected;
        if (isSelected) {
            context.beginPath();
            context.arc(pixelX, pixelY, size * 0.95, 0, 2 * Math.PI);
            context.strokeStyle = this.theme.colours.accent;
            context.lineWidth = 2.5;
            context.stroke();
        }
        const sprite = this.#getSprite(robot, size);
        context.translate(pixelX, pixelY);
        context.rotate(-theta);
        context.drawImage(sprite.canvas, -sprite.reach, -sprite.reach, 2 * sprite.reach, 2 * sprite.reach);
        context.rotate(theta);
        context.translate(-pixelX, -pixelY);
        drawGlyph(context, getRobotGlyph(robot), pixelX, pixelY, size * 0.46, this.theme.colours[`${getRobotGroup(robot)}Ink`]);
    }

    /** Left out where another one is. */
    #drawLabel(context, robot, space) {
        const {x, y} = this.motions.get(robot.robotId).shown;
        const size = this.getBodySize();
        const label = this.#getLabel(robot.robotId, robot.robotId === this.selected);
        const [pixelX, top] = [this.toX(x), this.toY(y) + size * 0.52];
        if (!this.isVisible(x, y, 3 * size) || !space.tryTake(pixelX, top + label.height / 2, label.width - 8, label.height - 8)) {
            return;
        }
        context.drawImage(label.canvas, pixelX - label.width / 2, top, label.width, label.height);
        if (robot.battery !== null && (robot.battery < LOW_BATTERY || this.scale > 24)) {
            this.#drawBattery(context, robot.battery, pixelX, top + label.height, size);
        }
    }

    #drawBattery(context, percent, x, y, size) {
        const colours = this.theme.colours;
        const [width, height] = [size * 0.8, Math.max(3, size * 0.1)];
        context.fillStyle = colours.batteryBack;
        context.fillRect(x - width / 2, y, width, height);
        context.fillStyle = percent < LOW_BATTERY ? colours.heavy : colours.battery;
        context.fillRect(x - width / 2, y, width * Math.max(0, Math.min(100, percent)) / 100, height);
    }

    #makeSprite(key, width, height, draw) {
        const sprite = this.sprites.get(key);
        if (sprite !== undefined) {
            return sprite;
        }
        const canvas = document.createElement("canvas");
        canvas.width = Math.ceil(width * this.ratio);
        canvas.height = Math.ceil(height * this.ratio);
        const context = canvas.getContext("2d");
        context.scale(this.ratio, this.ratio);
        draw(context);
        const made = {canvas, width, height, reach: width / 2};
        this.sprites.set(key, made);
        return made;
    }

    #getLabel(text, isSelected) {
        const rem = this.theme.rem;
        const font = `600 ${0.78 * rem}px ${this.theme.font}`;
        this.context.font = font;
        const width = Math.ceil(this.context.measureText(text).width + 8);
        const height = Math.ceil(1.05 * rem);
        return this.#makeSprite(`label ${text} ${isSelected} ${this.ratio}`, width, height, (context) => {
            context.font = font;
            context.textAlign = "center";
            context.textBaseline = "middle";
            context.lineJoin = "round";
            context.lineWidth = 3.5;
            context.strokeStyle = this.theme.colours.floor;
            context.strokeText(text, width / 2, height / 2);
            context.fillStyle = isSelected ? this.theme.colours.accent : this.theme.colours.text;
            context.fillText(text, width / 2, height / 2);
        });
    }

    /** The body, heading to the right: a rectangle for a logistics robot, an octagon for a control robot. */
    #getSprite(robot, size) {
        const group = getRobotGroup(robot);
        const isLoaded = robot.carrierIds.some((carrier) => carrier !== null);
        const rounded = Math.round(size);
        const reach = rounded;
        const key = `body ${robot.type} ${group} ${isLoaded} ${rounded} ${this.ratio}`;
        return this.#makeSprite(key, 2 * reach, 2 * reach, (context) => {
            const colours = this.theme.colours;
            context.translate(reach, reach);
            const [half, side] = [rounded * 0.46, rounded * 0.34];
            const nose = new Path2D();
            nose.moveTo(half * 1.08, -side * 0.62);
            nose.lineTo(half * 1.5, 0);
            nose.lineTo(half * 1.08, side * 0.62);
            nose.closePath();
            const body = new Path2D();
            if (robot.type === "CR") {
                const cut = side * 0.55;
                body.moveTo(-half + cut, -side);
                [[half - cut, -side], [half, -side + cut], [half, side - cut], [half - cut, side], [-half + cut, side],
                    [-half, side - cut], [-half, -side + cut]].forEach(([x, y]) => body.lineTo(x, y));
                body.closePath();
            } else {
                body.roundRect(-half, -side, 2 * half, 2 * side, side * 0.25);
            }
            context.lineJoin = "round";
            context.strokeStyle = colours.floor;
            context.lineWidth = 4;
            context.stroke(body);
            context.stroke(nose);
            context.fillStyle = colours[group];
            context.fill(body);
            context.strokeStyle = colours[`${group}Line`];
            context.lineWidth = Math.max(1.25, rounded * 0.05);
            if (group === "off") {
                context.setLineDash([3, 2.5]);
            }
            context.stroke(body);
            context.fillStyle = colours[`${group}Line`];
            context.fill(nose);
            if (isLoaded) {
                context.setLineDash([]);
                context.fillStyle = colours.load;
                context.strokeStyle = colours.floor;
                context.lineWidth = 1.5;
                const carrier = new Path2D();
                carrier.rect(-half - side * 0.12, -side * 0.75, side * 0.42, side * 1.5);
                context.fill(carrier);
                context.stroke(carrier);
            }
        });
    }

    /** The robot at this place of the map's container; null if there is none. */
    find(pixelX, pixelY, reach) {
        let found = null;
        for (const [robotId, motion] of this.motions) {
            const distance = Math.hypot(this.toX(motion.shown.x) - pixelX, this.toY(motion.shown.y) - pixelY);
            if (distance <= Math.max(reach, this.getBodySize() * 0.6) && (found === null || distance < found.distance)
                && this.#isOnMap(this.robots.get(robotId))) {
                found = {robotId, distance};
            }
        }
        return found?.robotId ?? null;
    }

    /** Where the robot is shown, in metres, and on which map; null if it is on none. */
    getPlace(robotId) {
        const motion = this.motions.get(robotId);
        const mapId = motion === undefined ? null : this.#findMapId(this.robots.get(robotId));
        return mapId === null ? null : {...motion.shown, mapId};
    }
}
