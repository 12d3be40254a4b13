// The commands in texts of alarms: between backticks, their ids quoted for a POSIX shell.

// A backtick between quotes belongs to an id.
const COMMAND = /`((?:[^`'\\]|\\.|'[^']*')*)`/;
const WORD = /(?:[^\s'\\]|\\.|'[^']*')+/g;
const PLAIN = /^[A-Za-z0-9._:@%+/,-]+$/;

/** The word as acsd and acsctl quote it. */
export function quote(word) {
    return PLAIN.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

/** The parts of the text: those with an odd index are commands, without their backticks. */
export function splitText(text) {
    return text.split(COMMAND);
}

/** The words of each command in the text, as a shell reads them. */
export function listCommands(text) {
    const unquote = (word) => word.replace(/\\(.)|'([^']*)'/g, (_, escaped, quoted) => escaped ?? quoted);
    return splitText(text).filter((_, i) => i % 2 === 1).map((command) => (command.match(WORD) ?? []).map(unquote));
}
