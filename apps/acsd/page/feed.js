// Keeps the model up to date: a snapshot, then the events after it. Reads the event stream with fetch: unlike EventSource this
// shows the keep-alive comments, without which an idle stream and a dead one look the same, and the status of a refusal.

import {ApiError, getJson, request} from "./api.js";
import {setServerTime} from "./format.js";

const SILENCE = 30_000; // milliseconds without a byte until the data counts as old; acsd sends a keep-alive every 15 s
const SHORT = 5_000; // milliseconds; a stream that ended later is continued at once: acsd ends each after an hour
const RETRIES = [500, 1_000, 2_000, 4_000, 8_000];
const SITE_RETRY = 2_000;

/** Splits the text of an event stream; returns what is complete. */
export class EventParser {
    #rest = "";

    feed(text) {
        const blocks = (this.#rest + text).replaceAll("\r\n", "\n").split("\n\n");
        this.#rest = blocks.pop();
        return blocks.map((block) => this.#parse(block)).filter((event) => event !== null);
    }

    #parse(block) {
        const event = {type: "message", id: null, data: ""};
        let hasData = false;
        for (const line of block.split("\n")) {
            const colon = line.indexOf(":");
            const name = colon < 0 ? line : line.slice(0, colon);
            const value = colon < 0 ? "" : line.slice(colon + 1).replace(/^ /, "");
            if (name === "event") {
                event.type = value;
            } else if (name === "id") {
                event.id = value;
            } else if (name === "data") {
                event.data += (hasData ? "\n" : "") + value;
                hasData = true;
            }
        }
        return hasData ? event : null;
    }
}

/** States: "connecting", "live", "silent" (no byte for 30 s), "lost" (with `reason`), "standby" (with `reason`), "login". */
export class Feed {
    #model;
    #onState;
    #state = {name: "connecting", reason: "", since: Date.now()};
    #lastByte = Date.now();
    #lastSign = Date.now(); // a byte, or a new attempt
    #lastID = null;
    #run = 0;
    #abort = null;
    #siteRevision = null;
    #siteLoad = null; // until acsd has answered
    #isSiteStale = false;
    #siteTimer = null;

    constructor(model, onState) {
        this.#model = model;
        this.#onState = onState;
        setInterval(() => this.#watch(), 1_000);
    }

    /** When data came last, in milliseconds of this machine's clock. */
    getLastByte() {
        return this.#lastByte;
    }

    start() {
        this.stop();
        this.#lastID = null;
        this.#keepGoing(this.#run);
    }

    /** Ends the stream. */
    stop() {
        this.#run += 1;
        this.#abort?.abort();
        clearTimeout(this.#siteTimer); // the next snapshot has the site with it
    }

    #set(name, reason = "") {
        if (this.#state.name !== name || this.#state.reason !== reason) {
            this.#state = {name, reason};
            this.#onState(this.#state);
        }
    }

    #watch() {
        if (Date.now() - this.#lastSign > SILENCE) {
            this.#lastSign = Date.now();
            if (this.#state.name === "live") {
                this.#set("silent");
            }
            this.#abort?.abort();
        }
    }

    async #keepGoing(run) {
        for (let attempt = 0; run === this.#run;) {
            const abort = new AbortController();
            this.#abort = abort;
            this.#lastSign = Date.now();
            let reason = "";
            let isStandby = false;
            const begin = Date.now();
            try {
                await this.#read(run, abort.signal, () => { attempt = 0; });
            } catch (error) {
                if (run !== this.#run) {
                    return;
                }
                if (error instanceof ApiError && error.status === 401) {
                    this.#set("login");
                    return;
                }
                reason = error.name === "AbortError" ? "" : error.message;
                isStandby = error instanceof ApiError && error.status === 503 && reason.startsWith("standby");
            }
            if (run !== this.#run) {
                return;
            }
            if (this.#state.name === "live" && reason === "" && Date.now() - begin > SHORT) {
                continue;
            }
            if (this.#state.name !== "silent" || reason !== "") {
                this.#set(isStandby ? "standby" : "lost", reason);
            }
            await new Promise((resolve) => { setTimeout(resolve, RETRIES[Math.min(attempt, RETRIES.length - 1)]); });
            attempt += 1;
        }
    }

    /** Until the stream ends. */
    async #read(run, signal, onConnected) {
        if (this.#lastID === null) {
            await this.#loadSnapshot();
        }
        const response = await request(`/v1/events?after=${this.#lastID}`, {signal, headers: {Accept: "text/event-stream"}});
        onConnected();
        this.#noteByte();
        const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
        const parser = new EventParser();
        for (;;) {
            const {done, value} = await reader.read();
            if (done || run !== this.#run) {
                return;
            }
            this.#noteByte();
            for (const event of parser.feed(value)) {
                if (event.type === "reset") {
                    await this.#loadSnapshot();
                } else {
                    this.#handle(event);
                }
            }
        }
    }

    #noteByte() {
        this.#lastByte = this.#lastSign = Date.now();
        this.#set("live");
    }

    async #loadSnapshot() {
        const snapshot = await getJson("/v1/snapshot");
        this.#siteRevision = snapshot.status.siteRevision;
        await this.#loadSite();
        this.#lastID = snapshot.eventId;
        this.#readTime(snapshot.status);
        this.#model.setSnapshot(snapshot);
        this.#noteByte();
    }

    /** One request at a time, so that the last answer is the newest. */
    #loadSite() {
        this.#isSiteStale = true;
        this.#siteLoad ??= this.#loadStaleSite().finally(() => { this.#siteLoad = null; });
        return this.#siteLoad;
    }

    async #loadStaleSite() {
        while (this.#isSiteStale) {
            this.#isSiteStale = false;
            this.#model.setSite(await getJson("/v1/site"));
        }
    }

    /** Again after a failure; without a login, all is loaded after it. */
    async #refreshSite() {
        const run = this.#run;
        try {
            await this.#loadSite();
        } catch (error) {
            if (run === this.#run && error.status !== 401) {
                clearTimeout(this.#siteTimer);
                this.#siteTimer = setTimeout(() => this.#refreshSite(), SITE_RETRY);
            }
        }
    }

    #handle(event) {
        // The snapshot after a reset has the events that were on their way then.
        if (event.id !== null) {
            if (Number(event.id) <= this.#lastID) {
                return;
            }
            this.#lastID = Number(event.id);
        }
        const data = JSON.parse(event.data);
        if (event.type === "changes") {
            this.#model.apply(data);
            if (data.status !== undefined && data.status.siteRevision !== this.#siteRevision) {
                this.#siteRevision = data.status.siteRevision;
                this.#refreshSite();
            }
        } else if (event.type === "entry") {
            this.#model.addEntry({...data, id: Number(event.id)});
        }
    }

    /** acsd's clock, to a second. */
    #readTime(status) {
        setServerTime(Date.parse(status.startedAt) + status.uptimeSeconds * 1_000);
    }
}
