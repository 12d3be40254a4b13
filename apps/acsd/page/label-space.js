// Rectangles of a picture that are taken, in cells of 8 pixels, so that no label covers another one.

const CELL = 8;
const COLUMNS = 8192;

export class LabelSpace {
    #cells = new Set();

    #list(x, y, width, height) {
        const cells = [];
        for (let column = Math.floor((x - width / 2) / CELL); column <= Math.floor((x + width / 2) / CELL); column += 1) {
            for (let row = Math.floor((y - height / 2) / CELL); row <= Math.floor((y + height / 2) / CELL); row += 1) {
                cells.push(row * COLUMNS + column);
            }
        }
        return cells;
    }

    /** The rectangle around x, y; whatever is there. */
    take(x, y, width, height) {
        this.#list(x, y, width, height).forEach((cell) => this.#cells.add(cell));
    }

    /** Only if all of it is free. */
    tryTake(x, y, width, height) {
        const cells = this.#list(x, y, width, height);
        const isFree = !cells.some((cell) => this.#cells.has(cell));
        if (isFree) {
            cells.forEach((cell) => this.#cells.add(cell));
        }
        return isFree;
    }
}
