# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Compare two bags topic by topic, message by message, field by field."""

import math
import re
from collections.abc import Callable, Collection, Iterator

from tactile_push.bags import BagError, BagReader, Message, Topic
from tactile_push.bags.headers import HeaderStamps
from tactile_push.comparing.differences import Difference, FieldDiff, Tolerances, TopicDiff, is_part
from tactile_push.comparing.fields import Lone, Unequal, compare_messages, field_paths, seconds
from tactile_push.comparing.pairing import Pair, pairs_by_stamp, pairs_in_order

_REMARK = re.compile(r'\s*(?:^|\s)#.*$', re.MULTILINE)
_PROGRESS_EVERY = 1000  # messages


def diff(
    a: BagReader,
    b: BagReader,
    *,
    tolerances: Tolerances | None = None,
    topics: Collection[str] | None = None,
    ignore: Collection[str] = (),
    times: bool = False,
    progress: Callable[[int], None] | None = None,
) -> list[TopicDiff]:
    """Compare two bags and return one `TopicDiff` for each topic, in the order of their names.

    Messages of a topic belong together if their headers have the same stamp, the first with the
    first where a stamp repeats; without headers, by their order. A topic without messages counts as
    missing. `times` compares log and publish times too; `progress` is called with the number of
    messages read, now and then. BagError if a bag cannot be read or a named topic or field is not
    there.
    """
    there = {name for bag in (a, b) for name in bag.topics}
    tolerances = tolerances or Tolerances()
    named = {*(topics or ()), *ignore, *(topic for topic, _ in tolerances.fields)}
    if unknown := sorted(named - there):
        raise BagError(f'no topic {unknown[0]} in {a.path} or {b.path}: they have {_list(there)}')
    selected = {name for name in there if topics is None or name in topics} - {*ignore}
    for topic, field in tolerances.fields:
        if topic in selected:
            _check_field(a, b, topic, field, times)
    comparison = _Comparison(a, b, tolerances, times)
    results = {name: comparison.start(name) for name in sorted(selected)}
    done = 0
    for pair in comparison.pairs(results.values()):
        comparison.compare(results[pair.topic], pair)
        before = done
        done += (pair.a is not None) + (pair.b is not None)
        if progress is not None and done // _PROGRESS_EVERY != before // _PROGRESS_EVERY:
            progress(done)
    return [comparison.finish(result) for result in results.values() if any(result.counts)]


class _Comparison:
    """A comparison in progress."""

    def __init__(self, a: BagReader, b: BagReader, tolerances: Tolerances, times: bool) -> None:
        self._a = a
        self._b = b
        self._tolerances = tolerances
        self._times = times
        self._stamped = HeaderStamps(a), HeaderStamps(b)
        self._same_definition: set[str] = set()
        self._opaque: set[str] = set()  # topics that cannot be decoded
        self._known: dict[tuple[str, str], float] = {}

    def start(self, name: str) -> TopicDiff:
        """Return what the topics show before a message is read."""
        in_a, in_b = self._a.topics.get(name), self._b.topics.get(name)
        counts = self._a.counts.get(name, 0), self._b.counts.get(name, 0)
        result = TopicDiff(
            name,
            (in_a.type_name if in_a else None, in_b.type_name if in_b else None),
            counts,
            by_stamp=all(name in stamps for stamps in self._stamped),
        )
        if not all(counts):
            if any(counts):
                result.remarks.append(f'only {"A" if counts[0] else "B"} has the topic')
        elif in_a and in_b and in_a.type_name != in_b.type_name:
            result.remarks.append(f'type {in_a.type_name} in A, {in_b.type_name} in B')
        elif in_a and in_b and in_a.encodings != in_b.encodings:
            result.remarks.append(f'{in_a.in_words} in A, {in_b.in_words} in B')
        elif in_a and in_b and _bare(in_a) != _bare(in_b):
            result.remarks.append(f'A and B define {in_a.type_name} differently')
        else:
            self._same_definition.add(name)
        if result in self._comparable([result]) and not self._a.topics[name].decodes:
            self._opaque.add(name)
            result.notes.append(f'compared byte by byte: {self._a.topics[name].in_words}')
        return result

    def pairs(self, results: Collection[TopicDiff]) -> Iterator[Pair]:
        """Read the messages of the topics that can be compared."""
        comparable = self._comparable(results)
        by_stamp = [result.name for result in comparable if result.by_stamp]
        if by_stamp:
            yield from pairs_by_stamp(self._a, self._b, by_stamp)
        for result in comparable:
            if not result.by_stamp:
                yield from pairs_in_order(self._a, self._b, result.name)

    def _comparable(self, results: Collection[TopicDiff]) -> list[TopicDiff]:
        """Select the topics of which both bags have messages of one type and encoding."""
        return [
            result
            for result in results
            if all(result.counts)
            and len({*result.types}) == 1
            and len({bag.topics[result.name].encodings for bag in (self._a, self._b)}) == 1
        ]

    def compare(self, result: TopicDiff, pair: Pair) -> None:
        """Add a pair of messages to the result."""
        if pair.a is None:
            first = result.first_only_b
            result.only_b += 1
            result.first_only_b = pair.key if first is None else min(pair.key, first)
        elif pair.b is None:
            first = result.first_only_a
            result.only_a += 1
            result.first_only_a = pair.key if first is None else min(pair.key, first)
        else:
            result.compared += 1
            self._compare(result, pair.key, pair.a, pair.b)

    def _compare(self, result: TopicDiff, key: int, a: Message, b: Message) -> None:
        found: set[str] = set()
        for unequal in self._differences(a, b):
            tolerance = self._tolerance(result.name, unequal.field)
            if isinstance(unequal, Lone):
                fields = result.fields_only_a if unequal.in_a else result.fields_only_b
                if unequal.field not in fields and tolerance != math.inf:
                    fields.append(unequal.field)
            elif unequal.distance > tolerance:
                difference = Difference(key, unequal.where, unequal.a, unequal.b, unequal.distance)
                entry = result.fields.setdefault(unequal.field, FieldDiff(difference, difference))
                entry.add(difference)
                if unequal.field not in found:
                    entry.messages += 1
                    found.add(unequal.field)
        result.different += bool(found)

    def _differences(self, a: Message, b: Message) -> Iterator[Unequal | Lone]:
        if self._times:
            for name in ('log_time', 'publish_time'):
                time_a, time_b = getattr(a, name), getattr(b, name)
                if time_a != time_b:
                    in_words = seconds(time_a), seconds(time_b)
                    yield Unequal(name, name, *in_words, abs(time_a - time_b) / 1e9)
        if a.topic in self._opaque:
            for unequal in compare_messages(a.data, b.data):
                assert isinstance(unequal, Unequal)
                where = f'bytes {unequal.where}'
                yield Unequal('bytes', where, unequal.a, unequal.b, math.inf)
        elif a.data != b.data or a.topic not in self._same_definition:
            yield from compare_messages(self._a.decode(a), self._b.decode(b))

    def _tolerance(self, topic: str, path: str) -> float:
        known = self._known.get((topic, path))
        if known is None:
            known = self._known[topic, path] = self._tolerances.of(topic, path)
        return known

    @staticmethod
    def finish(result: TopicDiff) -> TopicDiff:
        """Add what is only known when all was read."""
        if result.by_stamp and result.only_a and result.only_b and not result.compared:
            result.remarks.append('no stamp is in both bags')
        return result


def _check_field(a: BagReader, b: BagReader, topic: str, field: str, times: bool) -> None:
    """Refuse a tolerance for a field that no message has; the first message usually has it."""
    known = {'log_time', 'publish_time'} if times else set()
    if field in known:
        return
    empty = True
    for bag in (a, b):
        for message in bag.messages([topic]):
            empty = False
            paths = set(field_paths(bag.decode(message)))
            if any(is_part(field, path) for path in paths):
                return
            known |= paths
    if not empty:
        fields = [path for path in known if not path.endswith((')', '[]'))]
        raise BagError(f'no field {field} in {topic}: it has {_list(fields)}')


def _bare(topic: Topic) -> list[str]:
    """Return a definition without what makes no difference to a message."""
    lines = _REMARK.sub('', topic.definition).splitlines()
    return [' '.join(line.split()) for line in lines if line.strip()]


def _list(names: Collection[str]) -> str:
    return ', '.join(sorted(names)) or 'none'
