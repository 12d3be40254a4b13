"""Search of English and Korean pages. Korean writes particles at the end of a word, and compounds without a space, so that whole
words would find little: 알람 is to find 알람을 and 경알람. Hangul is therefore indexed and searched in pairs of syllables."""

import json
import re

from sphinx.search.en import SearchEnglish

HANGUL = re.compile(r"[\uac00-\ud7a3]+")
# A query's last syllables that only join it to its sentence; the longest first. They are kept if one syllable would be left.
PARTICLES = ("에서는", "으로는", "에서", "으로", "까지", "부터", "에는", "이나", "입니다", "합니다", "을", "를", "이", "가", "은", "는", "의", "에", "와",
             "과", "도", "로")


def split_hangul(word):
    """Its pairs of syllables; a word of one syllable as it is."""
    return [word[i:i + 2] for i in range(len(word) - 1)] or [word]


class SearchEnglishAndKorean(SearchEnglish):
    lang = "en-ko"
    language_name = "English and Korean"
    js_splitter_code = """
/* docs/site/korean_search.py */
const HANGUL = /[\\uac00-\\ud7a3]+/g;
const PARTICLES = %s;
function splitHangul(word) {
  const particle = PARTICLES.find((end) => word.endsWith(end) && word.length > end.length + 1);
  const stem = particle ? word.slice(0, -particle.length) : word;
  return stem.length < 2 ? [stem] : Array.from({length: stem.length - 1}, (_, i) => stem.slice(i, i + 2));
}
function splitQuery(query) {
  const others = query.replace(HANGUL, " ").split(/[^\\p{Letter}\\p{Number}_]+/gu);
  return others.concat((query.match(HANGUL) || []).flatMap(splitHangul)).filter((term) => term);
}
""" % json.dumps(PARTICLES)

    def split(self, input):  # noqa: A002  the name of the base class
        words = self._word_re.findall(HANGUL.sub(" ", input))
        for word in HANGUL.findall(input):
            words += split_hangul(word)
        return words


def setup(app):
    app.add_search_language(SearchEnglishAndKorean)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
