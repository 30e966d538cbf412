# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the sensor and its line."""

import math
import random
import time
from dataclasses import replace

from sensor_msgs.msg import JointState

from tactile_push.devices import Sentence
from tactile_push.devices.sentence import checksum
from tactile_push.nodes.ros.diagnostics import ERROR
from tactile_push.tactile import NO_CONTACT, Reading
from tactile_push.testing import field

from .bench import Bench, expect
from .finger import Finger
from .messages import yaw
from .promise import ONE_PERIOD, SILENT, Setup, fault
from .proxy import Corruption

START = -0.06  # of the finger, in finger_base [m]
ROOM = 0.003  # to both sides [m]
NARROW = Setup(controller=(('workspace_min', START - ROOM), ('workspace_max', START + ROOM)))
BRAKING = 0.004  # what the finger may overshoot: max_speed for a control period and two ways [m]
TURN = math.radians(15.0)
FAR = math.radians(35.0)
SPOILED = 3.0  # for so long a fault that need not stop the finger lasts [s]


def misread(azimuth_deg: float, elevation_deg: float) -> Reading:
    """Return a reading that no contact has."""
    return Reading(math.radians(azimuth_deg), math.radians(elevation_deg))


def _stops_and_goes_on(bench: Bench) -> None:
    """Wait for the stop, mend the device, and wait for the finger to move again."""
    finger = bench.finger
    bench.stopped(time.monotonic())
    finger.expect_reason('contact silent')
    finger.proxy.mend()
    finger.wait_until_moving(10.0)


@fault('device unplugged', SILENT)
def device_unplugged(bench: Bench) -> None:
    """Contact silent; the driver says so, finds the device again; pushes on."""
    bench.finger.proxy.unplug()
    at = time.monotonic()
    bench.stopped(at)
    bench.finger.expect_reason('contact silent')
    bench.finger.expect_level('sensor_driver', ERROR)
    bench.finger.proxy.mend()
    bench.finger.wait_until_moving(10.0)


@fault('device silent', SILENT)
def device_silent(bench: Bench) -> None:
    """Contact silent; pushes on."""
    bench.finger.proxy.spoil = lambda data: b''
    _stops_and_goes_on(bench)


@fault('sentences cut off', SILENT)
def sentences_cut(bench: Bench) -> None:
    """Contact silent; pushes on."""
    bench.finger.proxy.spoil = lambda data: data[: len(data) // 2]
    _stops_and_goes_on(bench)


@fault('1 % of bytes corrupted')
def corrupted_little(bench: Bench) -> None:
    """Pushes on; no wrong reading is published."""
    finger = bench.finger
    finger.proxy.spoil = Corruption(0.01)
    at = time.monotonic()
    bench.observer.spin(SPOILED)
    heard = len(finger.contacts.since(at))
    finger.proxy.mend()
    expect(heard > 0.5 * SPOILED * 50.0, f'only {heard} contacts in {SPOILED:g} s')
    finger.wait_until_moving()


@fault('10 % of bytes corrupted')
def corrupted(bench: Bench) -> None:
    """Goes on with what gets through, or stops; no wrong reading is published; pushes on."""
    finger = bench.finger
    finger.proxy.spoil = Corruption(0.1)
    bench.observer.spin(SPOILED)
    finger.rest_or_push()
    finger.proxy.mend()
    finger.wait_until_moving()


@fault('50 % of bytes corrupted', SILENT)
def corrupted_much(bench: Bench) -> None:
    """Contact silent; no wrong reading is published; pushes on."""
    bench.finger.proxy.spoil = Corruption(0.5)
    _stops_and_goes_on(bench)


@fault('line without line ends', SILENT)
def line_noise(bench: Bench) -> None:
    """Contact silent; pushes on."""
    bench.finger.proxy.spoil = lambda data: b'U' * 2000
    _stops_and_goes_on(bench)


@fault('wrong baud rate', SILENT)
def wrong_baud_rate(bench: Bench) -> None:
    """Contact silent; the driver says that no sentence is valid; pushes on."""
    noise = random.Random(1)
    bench.finger.proxy.spoil = lambda data: noise.randbytes(len(data))
    at = time.monotonic()
    bench.stopped(at)
    bench.finger.expect_level('sensor_driver', ERROR)
    bench.finger.proxy.mend()
    bench.finger.wait_until_moving(10.0)


@fault('sensor stuck, same number', SILENT)
def sensor_stuck(bench: Bench) -> None:
    """Contact silent: a sentence counts once; pushes on."""
    first: list[bytes] = []

    def repeat(data: bytes) -> bytes:
        first.append(data)
        return first[0]

    bench.finger.proxy.spoil = repeat
    _stops_and_goes_on(bench)


@fault('no contact', SILENT)
def no_contact(bench: Bench) -> None:
    """Contact silent; pushes on."""
    bench.finger.proxy.alter = lambda sentence: replace(sentence, reading=NO_CONTACT)
    _stops_and_goes_on(bench)


@fault('readings not a number', SILENT)
def readings_not_a_number(bench: Bench) -> None:
    """Contact silent; pushes on."""

    def write_nan(data: bytes) -> bytes:
        fields = data[1 : data.index(b'*')].split(b',')
        body = b','.join([*fields[:3], b'nan', b'inf', b''])
        return b'$%s*%02X\r\n' % (body, checksum(body))

    bench.finger.proxy.spoil = write_nan
    _stops_and_goes_on(bench)


@fault('readings off the hemisphere', SILENT)
def readings_off_the_hemisphere(bench: Bench) -> None:
    """Contact silent; pushes on."""
    bench.finger.proxy.alter = lambda s: replace(s, reading=misread(0.0, 200.0))
    _stops_and_goes_on(bench)


@fault('readings out of plane', SILENT)
def readings_out_of_plane(bench: Bench) -> None:
    """Contact silent; pushes on."""
    bench.finger.proxy.alter = lambda s: replace(s, reading=misread(90.0, 45.0))
    _stops_and_goes_on(bench)


@fault('every tenth reading jumps')
def readings_jump(bench: Bench) -> None:
    """Pushes on; no isolated jump becomes a contact."""
    finger, draw = bench.finger, random.Random(1)

    def jump(sentence: Sentence) -> Sentence:
        if sentence.sequence % 10:
            return sentence
        return replace(sentence, reading=misread(draw.choice((0.0, 180.0)), 40.0))

    finger.proxy.alter = jump
    at = time.monotonic()
    bench.observer.spin(SPOILED)
    finger.proxy.mend()
    far = [m for m in finger.contacts.since(at) if abs(yaw(m)) > FAR]
    expect(not far, f'{len(far)} jumps became contacts')
    expect(finger.state == 'pushing', f'it is {finger.state}')
    finger.wait_until_moving()


def _turn_inward(finger: Finger) -> None:
    """Ask for an angle for which the law moves the finger inward, and wait for that."""
    last = finger.truth[-1]
    aside = math.copysign(TURN, field(last, 'finger_x'))
    finger.ask_for(field(last, 'theta') - aside)
    finger.wait_until_moving(10.0)


def _beyond(truth: JointState) -> bool:
    return abs(field(truth, 'finger_x')) >= ROOM


@fault('workspace limit', ONE_PERIOD, setup=NARROW)
def workspace_limit(bench: Bench) -> None:
    """Stops at the limit; moves inward on its own."""
    finger = bench.finger
    bench.observer.wait_for(
        lambda: _beyond(finger.truth[-1]), 'the finger to come to its limit', 40.0
    )
    bench.stopped(next(at for at, truth in finger.truth.timed(-50) if _beyond(truth)))
    finger.expect_reason('workspace limit')
    _turn_inward(finger)


@fault('sensor stuck, numbers go on', setup=NARROW)
def value_stuck(bench: Bench) -> None:
    """Cannot be told from a still object: stops at the workspace limit at the latest."""
    finger = bench.finger
    first: list[Reading] = []

    def freeze(sentence: Sentence) -> Sentence:
        first.append(sentence.reading)
        return replace(sentence, reading=first[0])

    finger.proxy.alter = freeze
    finger.stopped(time.monotonic(), 40.0)
    finger.proxy.mend()
    x = field(finger.truth[-1], 'finger_x')
    expect(abs(x) < ROOM + BRAKING, f'the finger went {1000.0 * x:.1f} mm')
    _turn_inward(finger)
