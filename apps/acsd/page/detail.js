// The detail of what is selected: a robot, a plan, or a part of the floor.

import {make, setHidden} from "./dom.js";
import {makeGlyph} from "./glyphs.js";
import {t} from "./text.js";
import {PlaceDetail} from "./place-detail.js";
import {PlanDetail} from "./plan-detail.js";
import {RobotDetail} from "./robot-detail.js";

export class Detail {
    constructor(context) {
        this.context = context;
        this.root = document.getElementById("detail");
        this.selection = null;
        this.content = null;
    }

    show(selection) {
        this.selection = selection;
        setHidden(this.root, selection === null);
        document.body.classList.toggle("has-detail", selection !== null);
        this.build();
        this.root.scrollTop = 0;
    }

    /** Of the same selection: in another language. */
    build() {
        const former = this.content;
        this.content = null;
        if (this.selection === null) {
            this.root.replaceChildren();
            return;
        }
        const {kind, id} = this.selection;
        const close = make("button", {type: "button", class: "icon-button", id: "detail-close", "aria-label": t("detail.close"),
            title: `${t("detail.close")} (Esc)`, onclick: () => this.context.select(null)}, makeGlyph("close"));
        const Content = {robot: RobotDetail, plan: PlanDetail}[kind] ?? PlaceDetail;
        const {scrollTop} = this.root;
        this.content = new Content(this.context, this.selection, former);
        this.root.replaceChildren(make("header", {class: "detail-head"},
            make("span", {class: "muted", text: t(`kind.${kind}`)}), make("h2", {id: "detail-title", text: id}), close),
        this.content.node);
        this.root.scrollTop = scrollTop;
    }

    update(changes) {
        this.content?.update(changes);
    }
}
