// A layer of the map with a canvas of its own, which is somewhat larger than the view so that dragging shows no bare edges.

import {DomUtil, Layer} from "/page/leaflet.js";

export class CanvasLayer extends Layer {
    /** Order among the layers: 1 is the lowest. `margin`: share of the view by which the canvas exceeds it on each side. */
    constructor(order, margin) {
        super();
        this.order = order;
        this.margin = margin;
        this.isRequested = false;
    }

    onAdd(map) {
        this.map = map;
        this.canvas = document.createElement("canvas");
        this.canvas.setAttribute("aria-hidden", "true");
        this.context = this.canvas.getContext("2d");
        const name = `canvas${this.order}`;
        const pane = map.getPane(name) ?? map.createPane(name);
        pane.classList.add("canvas-pane", `canvas-pane-${this.order}`);
        pane.append(this.canvas);
        this.place();
    }

    onRemove() {
        this.canvas.remove();
        this.map = null;
    }

    getEvents() {
        return {move: this.onMove, zoom: this.place, viewreset: this.place, resize: this.place, moveend: this.place};
    }

    onMove() {
        const origin = this.map.containerPointToLayerPoint([0, 0]);
        const size = this.map.getSize();
        const moved = origin.subtract(this.viewOrigin);
        if (Math.abs(moved.x) > size.x * this.margin || Math.abs(moved.y) > size.y * this.margin) {
            this.place();
        }
    }

    /** Moves the canvas to the view and draws. */
    place() {
        const size = this.map.getSize();
        const padding = {x: Math.round(size.x * this.margin), y: Math.round(size.y * this.margin)};
        this.viewOrigin = this.map.containerPointToLayerPoint([0, 0]);
        this.ratio = Math.min(window.devicePixelRatio || 1, 2);
        this.width = size.x + 2 * padding.x;
        this.height = size.y + 2 * padding.y;
        const pixels = [Math.round(this.width * this.ratio), Math.round(this.height * this.ratio)];
        if (this.canvas.width !== pixels[0] || this.canvas.height !== pixels[1]) {
            [this.canvas.width, this.canvas.height] = pixels;
            this.canvas.style.width = `${this.width}px`;
            this.canvas.style.height = `${this.height}px`;
        }
        DomUtil.setPosition(this.canvas, this.viewOrigin.subtract([padding.x, padding.y]));
        const zero = this.map.latLngToContainerPoint([0, 0]);
        this.scale = this.map.getZoomScale(this.map.getZoom(), 0); // pixels per metre
        this.offset = {x: zero.x + padding.x, y: zero.y + padding.y};
        this.request();
    }

    /** Draws with the next frame, once. */
    request() {
        if (this.isRequested || !this.map) {
            return;
        }
        this.isRequested = true;
        requestAnimationFrame((time) => {
            this.isRequested = false;
            if (this.map) {
                this.context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
                this.context.clearRect(0, 0, this.width, this.height);
                this.draw(this.context, time);
            }
        });
    }

    /** Metres to pixels of the canvas. */
    toX(x) {
        return this.offset.x + x * this.scale;
    }

    toY(y) {
        return this.offset.y - y * this.scale;
    }

    /** For paths in metres. */
    useMetres(context) {
        context.setTransform(this.ratio * this.scale, 0, 0, -this.ratio * this.scale, this.ratio * this.offset.x,
            this.ratio * this.offset.y);
    }

    usePixels(context) {
        context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    }

    isVisible(x, y, reach) {
        const pixelX = this.toX(x);
        const pixelY = this.toY(y);
        return pixelX > -reach && pixelY > -reach && pixelX < this.width + reach && pixelY < this.height + reach;
    }
}
