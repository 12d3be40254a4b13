// Requests to /v1.

const TIME_LIMIT = 20_000; // milliseconds

/** An answer that is not 2xx, or no answer (status 0). The message is the sentence of acsd. */
export class ApiError extends Error {
    constructor(status, message) {
        super(message);
        this.status = status;
    }
}

let onLoginNeeded = () => {};

/** Called whenever acsd answers 401. */
export function setLoginHandler(handler) {
    onLoginNeeded = handler;
}

async function readError(response) {
    try {
        return (await response.json()).error;
    } catch {
        return `${response.status} ${response.statusText}`;
    }
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
        throw new ApiError(response.status, await readError(response));
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

/** Sends a command. After a lost answer it is sent once more: its key makes a second effect impossible. */
export async function post(path, body, key = makeKey()) {
    const options = {method: "POST", headers: {"Idempotency-Key": key}};
    if (body !== undefined) {
        options.headers["Content-Type"] = "application/json";
        options.body = JSON.stringify(body);
    }
    try {
        return await request(path, options);
    } catch (error) {
        if (error.status !== 0) {
            throw error;
        }
        return request(path, options);
    }
}
