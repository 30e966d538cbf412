# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The numbers that a hypothesis is about: columns of its mean and covariance."""

THETA = 0  # angle of the edge [rad]
D = 1  # contact along the edge [m]
LOG_C = 2  # ln(c/1 m), which has no bound that a Gaussian could cross
ALPHA = 3  # half angle of the friction cone, atan(mu_c) [rad]
L = 4  # distance from the edge to the centre of mass [m]
R = 5  # radius of the finger's disk [m]
GROWTH = 6  # by how much c^2 grows while the object turns, see `resistance`
SHAPE = 7  # how far c^2 depends on the direction of motion, see `resistance`
TILT = 8  # mu_s times the height of the push above the support [m], see `resistance`
UNKNOWNS = 9
