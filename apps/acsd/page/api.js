// Requests to /v1.

const TIME_LIMIT = 20_000; // milliseconds

/** An answer that is not 2xx, or no answer (status 0). isFromAcsd: the message is the sentence of acsd, so that no proxy has
 *  answered in its place. */
export class ApiError extends Error {
    constructor(status, message, isFromAcsd = false) {
        super(message);
        this.status = status;
        this.isFromAcsd = isFromAcsd;
    }

    /** Whether acsd keeps this answer for the key of the request: no request with the key has been executed. */
    get isFinal() {
        return this.isFromAcsd && this.status < 500 && this.status !== 401 && this.status !== 403;
    }
}

/** A command without an answer of acsd, which may have executed it. Again with the same key it has no second effect, unless acsd
 *  was restarted: it does not store the keys of instant actions. */
export class LostAnswer extends ApiError {
    constructor(reason, path) {
        super(0, reason);
        this.isRemembered = !path.endsWith("/actions");
    }
}

let onLoginNeeded = () => {};

/** Called whenever acsd answers 401. */
export function setLoginHandler(handler) {
    onLoginNeeded = handler;
}

function describeStatus(response) {
    return `${response.status} ${response.statusText}`.trim();
}

async function readError(response) {
    let sentence;
    try {
        sentence = (await response.json()).error;
    } catch {
        // Cut, or not from acsd.
    }
    const isFromAcsd = typeof sentence === "string";
    return new ApiError(response.status, isFromAcsd ? sentence : describeStatus(response), isFromAcsd);
}

export async function request(path, options = {}) {
    let response;
    try {
        response = await fetch(path, {
            credentials: "same-origin", cache: "no-store", signal: AbortSignal.timeout(TIME_LIMIT), ...options});
    } catch (error) {
        if (error.name === "AbortError") {
            throw error;
        }
        throw new ApiError(0, error.message);
    }
    if (!response.ok) {
        if (response.status === 401 && path !== "/v1/login") {
            onLoginNeeded();
        }
        throw await readError(response);
    }
    return response;
}

export async function getJson(path) {
    return (await request(path)).json();
}

/** The lines of an answer of type application/x-ndjson; a line that is no JSON is left out. */
export async function getLines(path) {
    const lines = [];
    for (const line of (await (await request(path)).text()).split("\n")) {
        try {
            lines.push(JSON.parse(line));
        } catch {
            // Empty, or cut.
        }
    }
    return lines;
}

/** randomUUID exists on https and localhost only. */
export function makeKey() {
    if (crypto.randomUUID !== undefined) {
        return crypto.randomUUID();
    }
    return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** The answer of acsd: {message, isReplay}, or {} of one without a body. isReplay: it is that to an earlier request. */
async function postOnce(path, options) {
    const response = await request(path, options);
    if (response.status === 204) {
        return {};
    }
    let answer = null;
    try {
        answer = await response.json();
    } catch {
        // Cut, or not from acsd.
    }
    if (typeof answer?.message !== "string") {
        throw new ApiError(0, describeStatus(response));
    }
    return {...answer, isReplay: response.headers.has("Idempotent-Replay")};
}

/** Sends a command, and returns the answer of acsd. After a lost answer it is sent once more: its key makes a second effect
 *  impossible. */
export async function post(path, body, key = makeKey()) {
    const options = {method: "POST", headers: {"Idempotency-Key": key}};
    if (body !== undefined) {
        options.headers["Content-Type"] = "application/json";
        options.body = JSON.stringify(body);
    }
    try {
        return await postOnce(path, options);
    } catch (error) {
        if (error.isFromAcsd) {
            throw error;
        }
    }
    try {
        return await postOnce(path, options);
    } catch (error) {
        throw error.isFinal ? error : new LostAnswer(error.message, path);
    }
}
