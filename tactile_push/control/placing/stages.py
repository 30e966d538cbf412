# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of a goal, in words whose places in a tuple are the codes in messages."""

NO_GOAL = 'no goal'
# Before the object is pushed: the finger is up, or down and feels nothing.
LIFTED, AWAITING_CONTACT = 'lifted', 'waiting for contact'
LEARNING, PLACING, LETTING_GO = 'learning', 'placing', 'letting go'
# How it ends. Only the first lets the object go.
RELEASED, MISSED, CANCELLED = 'released', 'missed', 'cancelled'
OBJECT_LOST, CONTRADICTED, NOTHING_KNOWN = 'object lost', 'contradiction', 'nothing known'
# The finger has left the object on purpose and touches it elsewhere; last, as bags have the others.
REGRASPING = 'regrasping'
# Of the law that settles, whose goals do not end: by what is known of the object, or without it.
SETTLING, SETTLING_BLINDLY = SETTLES = ('settling', 'settling by law (18)')
# The same of the law that steers.
STEERING, STEERING_BLINDLY = STEERS = ('steering', 'steering by law (18)')
STAGES = (
    *(NO_GOAL, LIFTED, AWAITING_CONTACT, LEARNING, PLACING, LETTING_GO),
    *(RELEASED, MISSED, CANCELLED, OBJECT_LOST, CONTRADICTED, NOTHING_KNOWN),
    *(REGRASPING, *SETTLES, *STEERS),
)
FAILURES = frozenset({MISSED, OBJECT_LOST, CONTRADICTED, NOTHING_KNOWN})
ENDS = FAILURES | {RELEASED, CANCELLED}

# Why a goal is not taken.
NOT_FINITE = 'not finite'
OTHER_FRAME = 'another frame'
OTHER_ROTATION = 'no rotation about z'
FACES_AWAY = 'the edge would face away'
OUTSIDE_WORKSPACE = 'outside the workspace'
NO_EDGE = 'the object has no edge'
HELD_STILL = 'stopped until resumed'
REFUSALS = (
    *('', NOT_FINITE, OTHER_FRAME, OTHER_ROTATION),
    *(FACES_AWAY, OUTSIDE_WORKSPACE, NO_EDGE, HELD_STILL),
)

# Whether a goal can be reached.
UNKNOWN = 'unknown'
WITH_RESERVE, AT_THE_LIMITS, OUT_OF_REACH = 'with reserve', 'at the limits', 'out of reach'
VERDICTS = (UNKNOWN, WITH_RESERVE, AT_THE_LIMITS, OUT_OF_REACH)
# What forbids a goal, which can be reached as soon as this one is no limit; the first of several.
# `CONTACT`: from where the finger touches, sticking and slipping do not lead there.
# `SENSOR`: the tip's pole would point so far from the contact that it is not felt.
FRICTION, EDGE, WORKSPACE, BELT, CONTACT = 'friction', 'edge', 'workspace', 'belt', 'contact'
SENSOR = 'sensor'
REASONS = ('', FRICTION, EDGE, WORKSPACE, BELT, CONTACT, SENSOR)
