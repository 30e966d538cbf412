# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The simulated plant with the nodes around it, and what they say."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from geometry_msgs.msg import PoseStamped, TwistStamped
from lifecycle_msgs.msg import Transition
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import JointState

from tactile_push.control import STATES, STOP_REASONS
from tactile_push.interface import (
    COMMAND,
    CONTACT,
    CONTROLLER_STATE,
    FINGER_SERVO,
    JOINT_VELOCITIES,
    PLANTS,
    PUSH_CONTROLLER,
    SENSOR_DRIVER,
    SENTENCE,
    SERVO_COMMANDS,
    SERVO_STATE,
    SIM_PLANT,
    TACTILE,
    TRUE_STATE,
)
from tactile_push.parameters.config_file import config_file
from tactile_push.parameters.sensor_kinds import SENSOR_KINDS
from tactile_push.testing.fork_server import ForkedNode
from tactile_push.testing.observer import Heard, Observer, field
from tactile_push.testing.processes import NodeProcesses

# Ten times as fast as real time if the machine can: the plant's time waits for contact and command.
TIMING = {'sensor_rate': 20.0, 'publish_clock': True, 'real_time_factor': 10.0}
MOVING = 1e-4  # [m/s]


class Rig:
    """Belt, object, finger and sensor as a plant simulates them, and the nodes around it.

    Parameters
    ----------
    nodes, observer : NodeProcesses, Observer
        Starts the nodes and hears them.
    device : str
        Where the simulated sensor is: a path for a pseudo terminal, or socket://host:port.
    namespace : str, optional
        Namespace of the nodes, '' for the root.

    Attributes
    ----------
    contacts, commands, states, tactile, truth : Heard
        Messages so far of `contact`, `finger/cmd_vel`, `push_controller/state`, `tactile` and
        `ground_truth/state`.
    """

    def __init__(
        self, nodes: NodeProcesses, observer: Observer, device: str, namespace: str = ''
    ) -> None:
        self.nodes = nodes
        self.observer = observer
        self.namespace = namespace
        self._device = device
        self._config = config_file('block.yaml')
        self.commands: Heard[TwistStamped] = observer.hear(TwistStamped, self.name(COMMAND))
        self.contacts: Heard[PoseStamped] = observer.hear(PoseStamped, self.name(CONTACT))
        self.states: Heard[JointState] = observer.hear(JointState, self.name(CONTROLLER_STATE))
        self.tactile: Heard[JointState] = observer.hear(JointState, self.name(TACTILE))
        self.truth: Heard[JointState] = observer.hear(JointState, self.name(TRUE_STATE))

    def name(self, name: str) -> str:
        """Return the full name of a node, topic or service of this rig.

        Parameters
        ----------
        name : str
            Its name in the rig's namespace.

        Returns
        -------
        str
            Such as '/left/contact'.
        """
        return f'/{self.namespace}/{name}' if self.namespace else f'/{name}'

    def process(self, node: str) -> str:
        """Return the key of a node's process in `nodes.running`.

        Parameters
        ----------
        node : str
            One of the package's nodes.

        Returns
        -------
        str
            The key.
        """
        return f'{self.namespace}.{node}' if self.namespace else node

    def start(
        self,
        config: str | Path = 'block',
        *,
        controller: bool = True,
        servo: bool = False,
        simulator: str = SIM_PLANT,
        sensor: str = SENTENCE,
        **plant: Any,
    ) -> None:
        """Start the nodes on simulated time and wait until they hear each other.

        The belt stands until the first command, so every run begins at the same angle.

        Parameters
        ----------
        config : str or path, optional
            Name of one of the package's configurations, or a parameter file.
        controller : bool, optional
            Whether to start `push_controller`; without it the test's own controller moves the
            finger.
        servo : bool, optional
            Whether `finger_servo` moves the joints of the plant's finger.
        simulator : str, optional
            The node that simulates, `sim_plant` or `mujoco_plant`.
        sensor : str, optional
            Which kind of sensor the finger has, 'sentence', 'wrench' or 'camera'.
        **plant : object
            Parameters of that node, such as the faults of the sensor.
        """
        self._config = config if isinstance(config, Path) else config_file(f'{config}.yaml')
        kind = SENSOR_KINDS[sensor]
        moved_by = {'commands': JOINT_VELOCITIES} if servo else {}
        self.start_node(simulator, TIMING | kind.plant | moved_by | plant)
        simulated = {'use_sim_time': True}
        self.start_node(kind.node, kind.parameters | simulated)
        self.start_node('contact_geometry', simulated)
        hearing = {CONTACT: 2}
        if servo:
            self.start_node(FINGER_SERVO, simulated)
            hearing |= {SERVO_STATE: 1, SERVO_COMMANDS: 3}
        if controller:
            self.start_node(PUSH_CONTROLLER, {'autostart': False, **simulated})
            self._change_controller(Transition.TRANSITION_CONFIGURE)
            hearing |= {CONTACT: 3, COMMAND: 5 if servo else 4, CONTROLLER_STATE: 1}
        self.observer.wait_for(
            lambda: self.contacts and self.truth and self._heard_by(hearing),
            'all nodes to hear each other',
        )
        if controller:
            self._change_controller(Transition.TRANSITION_ACTIVATE)

    def start_node(
        self, node: str, parameters: Mapping[str, Any], arguments: tuple[str, ...] = ()
    ) -> ForkedNode:
        """Start one of the package's nodes, at the rig's device and with its configuration.

        Parameters
        ----------
        node, parameters : str, mapping of str to object
            The node, and parameters that take precedence over the configuration.
        arguments : tuple of str, optional
            More ROS arguments.

        Returns
        -------
        ForkedNode
            The process.
        """
        if node in (*PLANTS, SENSOR_DRIVER):
            parameters = {'device': self._device, **parameters}
        if self.namespace:
            arguments += ('-r', f'__ns:=/{self.namespace}')
        return self.nodes.start(
            node, parameters, config=self._config, name=self.process(node), arguments=arguments
        )

    def add(self, node: Node) -> None:
        """Run a test's own node in this process, on the rig's simulated time.

        Parameters
        ----------
        node : rclpy.node.Node
            The node, made after the rig. It works while the test waits.
        """
        node.set_parameters([Parameter('use_sim_time', value=True)])
        self.observer.add(node)

    def ground_truth(self, name: str) -> float:
        """Return what only the simulator knows: the newest value of `ground_truth/state`.

        Parameters
        ----------
        name : str
            Name of the value, such as 'theta'.

        Returns
        -------
        float
            The value, in SI units; NaN for 'theta' and 'd' without contact.
        """
        self.observer.wait_for(lambda: self.truth, 'the ground truth')
        return field(self.truth[-1], name)

    @property
    def state(self) -> str:
        """What the controller does, one of `tactile_push.control.STATES`; '' before the first."""
        return STATES[int(field(self.states[-1], 'state'))] if self.states else ''

    @property
    def reason(self) -> str:
        """Why the controller stopped, one of `tactile_push.control.STOP_REASONS`; '' if not."""
        return STOP_REASONS[int(field(self.states[-1], 'stop_reason'))] if self.states else ''

    def wait_until_moving(self) -> None:
        """Wait until the finger has moved for a while."""
        seen = len(self.truth)
        self.observer.wait_for(
            lambda: sum(abs(field(m, 'v_x')) > MOVING for m in self.truth[seen:]) > 10,
            'the finger to move',
        )

    def wait_until_resting(self) -> None:
        """Wait until the plant's finger has no velocity."""
        seen = len(self.truth)
        self.observer.wait_for(
            lambda: self.truth[seen:] and self.ground_truth('v_x') == 0.0, 'the finger to stop'
        )

    def _change_controller(self, transition: int) -> None:
        if not self.observer.change_state(self.name(PUSH_CONTROLLER), transition):
            said = self.nodes.log(self.process(PUSH_CONTROLLER)).read_text(errors='replace')
            raise RuntimeError(f'{PUSH_CONTROLLER} refused transition {transition}: {said}')

    def _heard_by(self, subscribers: Mapping[str, int]) -> bool:
        count = self.observer.node.count_subscribers
        return all(count(self.name(topic)) >= n for topic, n in subscribers.items())
