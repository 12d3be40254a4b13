// What the page knows of acsd: the last snapshot and every event after it.

export const FINISHED_LIMIT = 100; // finished plans, here and in their list
const KEPT_ENTRIES = 500;

/** Which parts have changed; ids where there are many. */
export class Changes {
    constructor() {
        this.isAll = false;
        this.status = false;
        this.alarms = false;
        this.site = false;
        this.entries = false;
        this.plans = new Set();
        this.robots = new Set();
    }

    merge(other) {
        for (const name of ["isAll", "status", "alarms", "site", "entries"]) {
            this[name] ||= other[name];
        }
        other.plans.forEach((id) => this.plans.add(id));
        other.robots.forEach((id) => this.robots.add(id));
    }
}

export class Model {
    constructor() {
        this.status = null;
        this.plans = new Map(); // unfinished
        this.ended = new Map(); // the last ones that finished while the page was open, the newest last
        this.robots = new Map();
        this.alarms = [];
        this.entries = []; // with the id of their event, newest first
        this.firstEventID = null; // of the last snapshot: the entries up to it are loaded when they are needed
        this.site = null;
        this.blocks = new Map(); // "kind/id" -> block
        this.listeners = [];
    }

    /** The listener is called with Changes. */
    listen(listener) {
        this.listeners.push(listener);
    }

    emit(changes) {
        this.listeners.forEach((listener) => listener(changes));
    }

    setSnapshot(snapshot) {
        this.status = snapshot.status;
        // After a restart acsd may number its events from a lower one.
        this.entries = this.entries.filter((entry) => entry.id <= snapshot.eventId);
        this.firstEventID = snapshot.eventId;
        this.plans = new Map(snapshot.plans.map((plan) => [plan.planId, plan]));
        this.plans.forEach((_, planId) => this.ended.delete(planId));
        this.robots = new Map(snapshot.robots.map((robot) => [robot.robotId, robot]));
        this.alarms = snapshot.alarms;
        const changes = new Changes();
        changes.isAll = true;
        this.emit(changes);
    }

    setSite(site) {
        this.site = site;
        this.blocks = new Map(site.blocked.map((block) => [`${block.kind}/${block.id}`, block]));
        const changes = new Changes();
        changes.site = true;
        this.emit(changes);
    }

    apply(data) {
        const changes = new Changes();
        if (data.status !== undefined) {
            this.status = data.status;
            changes.status = true;
        }
        for (const plan of data.plans ?? []) {
            this.plans.set(plan.planId, plan);
            this.ended.delete(plan.planId); // acsd deletes a finished plan whose id a new one has
            changes.plans.add(plan.planId);
        }
        for (const plan of data.ended ?? []) {
            this.plans.delete(plan.planId);
            this.ended.delete(plan.planId);
            this.ended.set(plan.planId, plan);
            changes.plans.add(plan.planId);
        }
        for (const planId of [...this.ended.keys()].slice(0, -FINISHED_LIMIT)) {
            this.ended.delete(planId);
        }
        for (const robot of data.robots ?? []) {
            this.robots.set(robot.robotId, robot);
            changes.robots.add(robot.robotId);
        }
        if (data.alarms !== undefined) {
            this.alarms = data.alarms;
            changes.alarms = true;
        }
        this.emit(changes);
    }

    addEntry(entry) {
        this.addEntries([entry]);
    }

    /** Each once, also if it is known. */
    addEntries(entries) {
        const all = new Map([...this.entries, ...entries].map((entry) => [entry.id, entry]));
        this.entries = [...all.values()].sort((a, b) => b.id - a.id).slice(0, KEPT_ENTRIES);
        const changes = new Changes();
        changes.entries = true;
        this.emit(changes);
    }

    findPlan(planId) {
        return this.plans.get(planId) ?? this.ended.get(planId) ?? null;
    }

    findBlock(kind, id) {
        return this.blocks.get(`${kind}/${id}`) ?? null;
    }

    /** Alarms of a robot, plan or job, heavy ones first. */
    findAlarms(matches) {
        return this.listAlarms().filter(matches);
    }

    listAlarms() {
        const getRank = (alarm) => (alarm.level === "heavy" ? 0 : 1);
        return [...this.alarms].sort((a, b) => getRank(a) - getRank(b) || (b.since ?? "").localeCompare(a.since ?? ""));
    }
}
