// What happened before the page was opened: the entries that acsd still has among its events.

import {request} from "./api.js";
import {EventParser} from "./feed.js";

const KEPT = 4_096; // acsd keeps at most this number of events, those of other types among them
const FIRST = 512;
const WANTED = 100;
const TIME_LIMIT = 20_000; // milliseconds

/** The entries of the events after `after` up to `last`, oldest first; null if acsd no longer has all of them. */
async function readEntries(after, last) {
    const abort = new AbortController();
    const timer = setTimeout(() => abort.abort(), TIME_LIMIT);
    try {
        const response = await request(`/v1/events?after=${after}`, {signal: abort.signal, headers: {Accept: "text/event-stream"}});
        const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
        const parser = new EventParser();
        const entries = [];
        for (;;) {
            const {done, value} = await reader.read();
            for (const event of done ? [] : parser.feed(value)) {
                const id = Number(event.id);
                if (event.type === "reset") {
                    return null;
                }
                if (id <= last && event.type === "entry") {
                    entries.push({...JSON.parse(event.data), id});
                }
                if (id >= last) {
                    return entries;
                }
            }
            if (done) {
                return entries;
            }
        }
    } finally {
        clearTimeout(timer);
        abort.abort();
    }
}

/** The entries up to this event, oldest first: at least 100 if acsd has them. acsd does not state how many events it has. */
export async function loadPast(last) {
    let entries = [];
    let known = 0; // acsd has this number of events
    let lost = Math.min(KEPT, last) + 1; // and not this one
    for (let count = Math.min(FIRST, lost - 1); count > known;) {
        const found = await readEntries(last - count, last);
        if (found === null) {
            lost = count;
        } else {
            known = count;
            entries = found;
        }
        if (entries.length >= WANTED || lost - known <= 1 + known / 16) {
            break;
        }
        count = Math.min(lost - 1, found === null ? Math.floor((known + lost) / 2) : 4 * count);
    }
    return entries;
}
