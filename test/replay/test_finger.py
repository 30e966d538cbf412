# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What one finger makes of a whole record and of parts of it, and in which order it writes it."""

import math

import pytest

from support.bag_copies import DATA, contents, copied, replayed
from tactile_push.bags import BagReader, BagWriter

REPLAYED = ('/contact', '/contact_geometry/state', '/push_controller/state', '/finger/cmd_vel')
BAGS = ['block', 'stops']


@pytest.mark.parametrize('late', [30_000_000, 40_000_000_000])
@pytest.mark.parametrize('name', BAGS)
def test_commands_may_be_recorded_after_what_the_node_says_of_them(name, late, tmp_path):
    with BagReader(DATA / name) as reader, BagWriter(tmp_path / 'bag') as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        rows = []
        for message in reader.messages():
            later = late if message.topic == '/finger/cmd_vel' else 0
            rows.append((message.log_time + later, message.topic, message.data))
        for log_time, topic, data in sorted(rows, key=lambda row: row[0]):
            writer.write(topic, data, log_time, log_time)
        for key, text in reader.notes.items():
            writer.note(key, text)
    replayed(tmp_path / 'bag', out=tmp_path / 'out')
    assert contents(tmp_path / 'out') == contents(tmp_path / 'bag')


def test_geometry_follows_its_parameters_too(tmp_path):
    config = tmp_path / 'finger.yaml'
    config.write_text('contact_geometry:\n  ros__parameters:\n    finger_radius: 0.027\n')
    replayed(DATA / 'block', config=config, out=tmp_path / 'out')
    with BagReader(tmp_path / 'out') as new, BagReader(DATA / 'block') as old:
        pairs = zip(new.messages(['/contact']), old.messages(['/contact']), strict=True)
        for ours, theirs in pairs:
            after, before = (r.decode(m).pose.position for r, m in ((new, ours), (old, theirs)))
            assert after.x == pytest.approx(2.0 * before.x, abs=1e-15)
            assert after.y == pytest.approx(2.0 * before.y, abs=1e-15)


def test_readings_alone_give_contacts_and_commands(tmp_path):
    only = {'/tactile', '/joint_states'}
    bag = copied(DATA / 'block', tmp_path / 'readings', keep=only.__contains__)
    (comparison,) = replayed(bag, out=tmp_path / 'out')
    with BagReader(DATA / 'block') as reader:
        expected = {
            m.log_time: reader.decode(m).twist.linear.x
            for m in reader.messages(['/finger/cmd_vel'])
        }
    assert len(comparison.ticks) > 200
    assert all(math.isnan(tick.v_x_recorded) for tick in comparison.ticks)
    # The ticks fall between the readings otherwise than they did: about the same commands.
    largest = max(abs(v_x) for v_x in expected.values())
    assert max(abs(tick.v_x) for tick in comparison.ticks) == pytest.approx(largest, rel=0.1)
    with BagReader(tmp_path / 'out') as reader:
        assert all(reader.counts[topic] > 100 for topic in REPLAYED)


def test_contacts_alone_give_commands(tmp_path):
    keep = {'/contact', '/push_controller/state', '/finger/cmd_vel'}
    bag = copied(DATA / 'stops', tmp_path / 'contacts', keep=keep.__contains__)
    (comparison,) = replayed(bag, out=tmp_path / 'out')
    assert not comparison.different()
    assert contents(tmp_path / 'out') == contents(bag)


def contact_of(message):
    """Return the stamp of a contact, or of the one that a tick used [s]; NaN if there is none."""
    stamp = message.header.stamp
    if not hasattr(message, 'name'):
        return stamp.sec + stamp.nanosec * 1e-9
    said = dict(zip(message.name, message.position, strict=True))
    used = stamp.sec + stamp.nanosec * 1e-9 - said['silence']
    return used if math.isfinite(said['theta']) else math.nan


@pytest.mark.parametrize('name', BAGS)
@pytest.mark.parametrize('end', ['/contact', '/push_controller/state'])
def test_contact_is_kept_and_used_whose_reading_the_recording_lacks_at_its_end(name, end, tmp_path):
    with BagReader(DATA / name) as reader, BagWriter(tmp_path / 'bag') as writer:
        for topic in reader.topics.values():
            writer.add_topic(topic.name, topic.type_name, definition=topic.definition)
        messages = list(reader.messages())
        at = [contact_of(reader.decode(m)) if m.topic == end else math.nan for m in messages]
        last = max(i for i, stamp in enumerate(at) if math.isfinite(stamp))
        for message in messages[: last + 1]:
            if message.topic in ('/contact_geometry/state', '/tactile'):
                stamp = reader.decode(message).header.stamp
                if stamp.sec + stamp.nanosec * 1e-9 > at[last] - 1e-6:
                    continue
            writer.write(message.topic, message.data, message.log_time, message.publish_time)
        for key, text in reader.notes.items():
            writer.note(key, text)
    (comparison,) = replayed(tmp_path / 'bag', out=tmp_path / 'out')
    assert not comparison.different()
    assert contents(tmp_path / 'out') == contents(tmp_path / 'bag')
