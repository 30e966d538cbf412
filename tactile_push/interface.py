# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""The ROS interface: topics with their fields, frames, services and nodes.

Every name that nodes, bags, commands and documentation share stands here and nowhere else. This
module imports the standard library alone, so that the build can read it before anything is
installed.
"""

from collections.abc import Collection, Mapping
from typing import NamedTuple


class Field(NamedTuple):
    """A number in a sensor_msgs/JointState message."""

    name: str  #: of the joint in the message
    unit: str  #: SI; empty for counts, flags and codes
    words: str  #: what it says
    codes: str = ''  #: tuple whose index the number is, such as 'control.STATES'; '' if none
    array: str = 'position'  #: of the message, in which the number stands


class Topic(NamedTuple):
    """A topic."""

    name: str  #: relative, so that a namespace makes a second finger, or with a slash
    type_name: str  #: message type
    givers: tuple[str, ...]  #: nodes that publish it
    takers: tuple[str, ...]  #: nodes that subscribe to it
    content: str  #: what a message says, and when one is published
    fields: tuple[Field, ...] = ()  #: of a JointState message, in their order
    recorded: bool = True  #: whether it is recorded unless somebody names topics

    @property
    def field_names(self) -> tuple[str, ...]:
        """Names of the fields in their order."""
        return tuple(field.name for field in self.fields)


class Service(NamedTuple):
    """A service."""

    name: str  #: ~ stands for the node's name
    type_name: str  #: service type
    node: str  #: which node offers it
    content: str  #: what it does


class NodeSummary(NamedTuple):
    """A node."""

    name: str  #: of the node, its executable and its module in `tactile_push.nodes`
    summary: str  #: what it does
    managed: bool = False  #: whether it is a managed (lifecycle) node


# Frames.
FINGER_BASE = 'finger_base'  # fixed to the machine; commands are given in it
FINGER_DISK = 'finger_disk'  # centre of the finger's disk; contacts and poses are given in it
FINGERTIP = 'fingertip'  # turns with the tip; azimuth and elevation are measured in it

# Nodes.
SENSOR_DRIVER = 'sensor_driver'
WRENCH_SENSOR = 'wrench_sensor'
CAMERA_SENSOR = 'camera_sensor'
CONTACT_GEOMETRY = 'contact_geometry'
PUSH_CONTROLLER = 'push_controller'
ACTIVE_SENSING = 'active_sensing'
FINGER_SERVO = 'finger_servo'
SIM_PLANT = 'sim_plant'
MUJOCO_PLANT = 'mujoco_plant'
PLANTS = (SIM_PLANT, MUJOCO_PLANT)  # one of which takes the place of the hardware
EXPERIMENT = 'experiment'
BAG_RECORDER = 'bag_recorder'
BAG_PLAYER = 'bag_player'
LIVE_PAGE = 'live_page'

# Topics.
WRENCH = 'wrench'
IMAGE = 'image'
COMPRESSED_IMAGE = 'image/compressed'
TACTILE = 'tactile'
JOINT_STATES = 'joint_states'
CONTACT = 'contact'
GEOMETRY_STATE = 'contact_geometry/state'
COMMAND = 'finger/cmd_vel'
CONTROLLER_STATE = 'push_controller/state'
SERVO_COMMANDS = 'finger_velocity_controller/commands'
SERVO_STATE = 'finger_servo/state'
OBJECT_POSE = 'object_pose'
SENSING_STATE = 'active_sensing/state'
SENSING_MARKERS = 'active_sensing/markers'
PLACE_GOAL = 'place/goal'
PLACE_STATE = 'place/state'
PLACE_RELEASE = 'place/release'
TRUE_POSE = 'ground_truth/object_pose'
TRUE_STATE = 'ground_truth/state'
MARKERS = 'markers'
CLOCK = '/clock'
DIAGNOSTICS = '/diagnostics'
PARAMETER_EVENTS = '/parameter_events'

# Services.
TARE = 'wrench_sensor/tare'
TAKE_REFERENCE = 'camera_sensor/take_reference'
RESUME = 'push_controller/resume'
CANCEL = 'place/cancel'
PAUSE, STEP = '~/pause', '~/step'

# What the recorder notes in a bag beside the messages.
PARAMETERS_NOTE = 'tactile_push.parameters'  # JSON: full node name without the slash to values
VERSION_NOTE = 'tactile_push.version'

WRIST_JOINT = 'wrist_joint'  # in `joint_states` of a finger whose wrist holds the tip straight

# Kinds of sensor that the simulated finger may have.
SENSORS = (SENTENCE, FORCE_TORQUE, CAMERA) = ('sentence', 'wrench', 'camera')
# Laws of the controller: (18), the one that brings an object to a place and an angle, and those of
# one of the two, a place across the belt at which the object is carried straight ahead or an angle.
PUSH, PLACE, STEER, SETTLE = LAWS = ('push', 'place', 'steer', 'settle')
# Points of the finger tip of which one follows the commanded velocity across the belt.
POINTS = ('centre', 'pole', 'contact')
# What moves the finger: a velocity across the belt, or one of each joint.
VELOCITY, JOINT_VELOCITIES = COMMANDS = ('velocity', 'joint_velocities')
# Kinematics of a finger: two joints that turn, or one that slides across the belt.
PLANAR, LINEAR = KINEMATICS = ('planar', 'linear')
# What active sensing makes of readings while the direction of the finger tip is not known.
SILENT, WIDEN, STRAIGHT = WITHOUT_PSI = ('silent', 'widen', 'straight')

JOINT_STATE_TYPE = 'sensor_msgs/msg/JointState'
POSE_TYPE = 'geometry_msgs/msg/PoseStamped'
UNCERTAIN_POSE_TYPE = 'geometry_msgs/msg/PoseWithCovarianceStamped'
WRENCH_TYPE = 'geometry_msgs/msg/WrenchStamped'
IMAGE_TYPE = 'sensor_msgs/msg/Image'
COMPRESSED_IMAGE_TYPE = 'sensor_msgs/msg/CompressedImage'
TWIST_TYPE = 'geometry_msgs/msg/TwistStamped'
VELOCITIES_TYPE = 'std_msgs/msg/Float64MultiArray'
MARKERS_TYPE = 'visualization_msgs/msg/MarkerArray'
BOOL_TYPE = 'std_msgs/msg/Bool'

NODES = {
    node.name: node
    for node in (
        NodeSummary(
            SENSOR_DRIVER, "reads the tactile sensor's sentences from a device", managed=True
        ),
        NodeSummary(
            WRENCH_SENSOR,
            'finds the contact on a tip that sits on a force/torque sensor',
            managed=True,
        ),
        NodeSummary(
            CAMERA_SENSOR,
            'finds the contact on a tip that a camera sees from inside',
            managed=True,
        ),
        NodeSummary(CONTACT_GEOMETRY, 'computes the contact from a reading and the joint angles'),
        NodeSummary(
            PUSH_CONTROLLER,
            'turns the object with the control law (18) of the paper, or places it',
            managed=True,
        ),
        NodeSummary(
            ACTIVE_SENSING,
            'infers where the finger touches the object and where its centre of mass is',
        ),
        NodeSummary(FINGER_SERVO, 'moves a finger by the velocities of its joints', managed=True),
        NodeSummary(SIM_PLANT, 'simulates belt, object, finger and sensor in place of hardware'),
        NodeSummary(
            MUJOCO_PLANT,
            'does the same in MuJoCo, with a finger of joints and a push above the belt',
        ),
        NodeSummary(EXPERIMENT, 'starts the controller, records a run and ends after N steps'),
        NodeSummary(BAG_RECORDER, 'records topics into a bag'),
        NodeSummary(BAG_PLAYER, 'publishes the messages of a bag with their timing'),
        NodeSummary(LIVE_PAGE, 'shows what the nodes say on a page for browsers'),
    )
}


def _estimated(name: str, unit: str, words: str) -> tuple[Field, ...]:
    """Return the fields of an estimated quantity and its two intervals."""
    return (
        Field(name, unit, words),
        Field(f'{name}_lower', unit, f'lower end of the 95 % interval of {name}'),
        Field(f'{name}_upper', unit, f'upper end of the 95 % interval of {name}'),
        Field(f'{name}_least', unit, f'guaranteed lower bound on {name}'),
        Field(f'{name}_most', unit, f'guaranteed upper bound on {name}'),
    )


# fmt: off
TOPICS = {
    topic.name: topic
    for topic in (
        Topic(WRENCH, WRENCH_TYPE, ('the sensor', *PLANTS), (WRENCH_SENSOR,),
            "force and moment on the finger tip in the sensor's frame, at 20 Hz or more",
        ),
        Topic(IMAGE, IMAGE_TYPE, ('the sensor', *PLANTS), (CAMERA_SENSOR,),
            'what the camera in the finger tip sees: mono8, rgb8 or bgr8, of the calibrated size',
            recorded=False,
        ),
        Topic(COMPRESSED_IMAGE, COMPRESSED_IMAGE_TYPE, ('the sensor',), (CAMERA_SENSOR,),
            'the same as JPEG or PNG, with `image_transport` compressed',
            recorded=False,
        ),
        Topic(TACTILE, JOINT_STATE_TYPE, (SENSOR_DRIVER, WRENCH_SENSOR, CAMERA_SENSOR),
            (CONTACT_GEOMETRY,),
            'a reading of the sensor in `fingertip`, stamped when it was read; NaN is no contact '
            'or not measured',
            (
                Field('azimuth', 'rad', 'azimuth of the contact'),
                Field('elevation', 'rad', 'elevation of the contact; pi/2 is the pole'),
                Field('normal_force', 'N', 'normal force, in `effort` instead', array='effort'),
                Field('tangential_force', 'N',
                    'force along the surface, in `effort` instead; of `wrench_sensor` alone',
                    array='effort'),
            ),
        ),
        Topic(JOINT_STATES, JOINT_STATE_TYPE, ('the finger', *PLANTS),
            (CONTACT_GEOMETRY, PUSH_CONTROLLER, FINGER_SERVO),
            'angles of the moving joints of the finger; the parameters `joint_names` name them; a '
            'finger whose wrist holds the tip straight adds `wrist_joint`',
            (
                Field('proximal_joint', 'rad', 'angle of the first moving joint'),
                Field('distal_joint', 'rad', 'angle of the second moving joint'),
            ),
        ),
        Topic(CONTACT, POSE_TYPE, (CONTACT_GEOMETRY,), (PUSH_CONTROLLER, *PLANTS, LIVE_PAGE),
            'in `finger_disk`: the position is the contact point [m], the yaw is theta [rad]; '
            'stamped as the reading; nothing is published without a contact',
        ),
        Topic(GEOMETRY_STATE, JOINT_STATE_TYPE, (CONTACT_GEOMETRY,), PLANTS,
            'what became of each reading; published while somebody subscribes',
            (
                Field('azimuth', 'rad', 'azimuth of the reading'),
                Field('elevation', 'rad', 'elevation of the reading'),
                Field('joint_angle', 'rad', 'how far the joints had turned the finger tip'),
                Field('theta', 'rad', 'angle of the pushed edge; NaN if the reading was refused'),
                Field('refusal', '', 'why the reading was refused', 'tactile.REFUSALS'),
            ),
        ),
        Topic(COMMAND, TWIST_TYPE, (PUSH_CONTROLLER,),
            ('the finger', FINGER_SERVO, *PLANTS, PUSH_CONTROLLER),
            'in `finger_base`: `linear.x` [m/s], and `linear.y` [m/s] against the belt\'s motion, '
            '0 but for a finger of two axes; nothing before the first contact, 0 when the contact '
            'is lost. `finger_servo` keeps a line and refuses any other `linear.y`',
        ),
        Topic(SERVO_COMMANDS, VELOCITIES_TYPE, (FINGER_SERVO,),
            ('the finger', *PLANTS, FINGER_SERVO),
            'velocities of the joints in the order of `joint_names` [rad/s], as the velocity '
            'controllers of ros2_control take them; all 0 before the first command',
        ),
        Topic(SERVO_STATE, JOINT_STATE_TYPE, (FINGER_SERVO,), PLANTS,
            'everything that the servo used and gave whenever it gave velocities',
            (
                Field('v_x', 'm/s', 'commanded velocity across the belt; NaN if there is none'),
                Field('first_velocity', 'rad/s', 'velocity of the first joint; m/s if it slides'),
                Field('second_velocity', 'rad/s', 'velocity of the second joint; NaN if none'),
                Field('share', '',
                    'share of the command that the bounds on speed allow; NaN unless following'),
                Field('finger_x', 'm', 'position of the finger across the belt'),
                Field('finger_y', 'm', 'position of the finger along the belt'),
                Field('line', 'm', 'the finger_y that is kept; NaN before the first command'),
                Field('deviation', 'm',
                    'distance from where the commands of the last second should have led'),
                Field('state', '', 'what the servo does', 'control.SERVO_STATES'),
                Field('stop_reason', '', 'why the joints stand', 'control.SERVO_STOP_REASONS'),
                Field('command_age', 's', 'age of the command'),
                Field('joint_age', 's', 'age of the joint states'),
            ),
        ),
        Topic(CONTROLLER_STATE, JOINT_STATE_TYPE, (PUSH_CONTROLLER,),
            (ACTIVE_SENSING, LIVE_PAGE),
            'everything that one control period used and gave',
            (
                Field('theta', 'rad', 'angle of the pushed edge'),
                Field('theta_desired', 'rad', 'desired angle of the edge, as trimmed'),
                Field('phi', 'rad', 'push angle; 90° is straight ahead'),
                Field('v_x', 'm/s', 'commanded velocity; NaN if none was commanded'),
                Field('kp', 'rad/rad', 'proportional gain of the law'),
                Field('kd', 'rad/rad', 'derivative gain of the law'),
                Field('silence', 's',
                    'time since the last contact; negative if it is stamped ahead'),
                Field('saturated', '', '1 if phi is at a bound'),
                Field('limited', '', '1 if v_x is at a bound'),
                Field('finger_x', 'm', 'position of the finger across the belt'),
                Field('state', '', 'what the controller does', 'control.STATES'),
                Field('stop_reason', '', 'why the finger is stopped', 'control.STOP_REASONS'),
                Field('ticks', '', 'control periods since activation'),
                Field('ticks_lost', '', 'control periods that passed without a tick'),
                Field('elapsed', 's', 'time since the last tick by a clock that cannot be set'),
                Field('finger_age', 's', 'age of finger_x and psi'),
                Field('psi', 'rad', 'angle of the finger tip; 90° is straight ahead'),
                Field('trim', 'rad', 'by how much steadying has moved theta_desired'),
                Field('v_y', 'm/s', 'commanded velocity along the belt, against its motion'),
                Field('apart', '', '1 while the finger is off the object on purpose'),
            ),
        ),
        Topic(OBJECT_POSE, UNCERTAIN_POSE_TYPE, (ACTIVE_SENSING,), (LIVE_PAGE,),
            "in `finger_disk`: estimate of the object's centre of mass and orientation with its "
            'covariance; stamped as the reading; nothing is published while nothing is known or '
            'readings contradict the object',
        ),
        Topic(SENSING_STATE, JOINT_STATE_TYPE, (ACTIVE_SENSING,), (PUSH_CONTROLLER, LIVE_PAGE),
            'the estimate after each control period, as of the last reading; NaN is unknown',
            (
                *_estimated('d', 'm', 'contact location along the edge'),
                *_estimated('c', 'm', 'm_max / f_max of the support'),
                *_estimated('mu_c', '', 'friction between finger and object'),
                Field('theta', 'rad', 'angle of the edge without the noise of the readings'),
                Field('edge', '', 'the likeliest edge, 0 from the first corner to the second'),
                Field('edge_weight', '', 'probability of that edge'),
                Field('surprise', '', 'how unexpected the readings are; 1 on average'),
                Field('contradiction', '', 'how the readings contradict the object',
                    'estimation.CONTRADICTIONS'),
                Field('readings', '', 'readings used since everything was forgotten'),
                Field('age', 's', 'age of the last reading; negative if it is stamped ahead'),
                Field('theta_deviation', 'rad', 'standard deviation of theta'),
                Field('d_deviation', 'm', 'the same of d, if the likeliest edge is pushed'),
                Field('log_c_deviation', '', 'the same of the logarithm of c'),
                Field('l', 'm', 'distance from the likeliest edge to the centre of mass'),
                Field('radius', 'm', "effective radius of the finger's disk"),
                Field('c_squared', 'm^2', 'c^2 of an object that hardly turns'),
                Field('growth', '', 'by how much c^2 grows until the object only spins, a share'),
                Field('shape', '', 'share of the load that is spread as the outline is'),
                Field('tilt', 'm', 'mu_s times the height of the contact above the belt'),
                Field('moment_along', '',
                    "second moment of the outline's area along the edge, over the root of their "
                    'determinant'),
                Field('moment_mixed', '', 'the mixed one'),
                Field('moment_across', '', 'the one across the edge'),
                Field('edge_start', 'm', 'end of the likeliest edge at which d is least'),
                Field('edge_end', 'm', 'its other end'),
                Field('noise', 'rad', 'standard deviation of a reading of theta, as expected'),
            ),
        ),
        Topic(SENSING_MARKERS, MARKERS_TYPE, (ACTIVE_SENSING,), (),
            'the outline at its estimated pose, the centre of mass along the 95 % and the '
            'guaranteed interval; published while somebody subscribes',
            recorded=False,
        ),
        Topic(PLACE_GOAL, POSE_TYPE, (EXPERIMENT, 'your node'), (PUSH_CONTROLLER,),
            'where to let go, in `finger_base`: `position.x` is where the centre of mass is to be '
            'across the belt [m], the yaw is theta of the pushed edge [rad]; with the law `steer` '
            'where to carry the object straight ahead, whatever the yaw is; with the law `settle` '
            'the angle alone, wherever that is',
        ),
        Topic(PLACE_STATE, JOINT_STATE_TYPE, (PUSH_CONTROLLER,), (EXPERIMENT, *PLANTS),
            'what becomes of the goal, in each control period unless the law is `push`; stamped as '
            '`push_controller/state`; NaN is unknown, or not what the law is for',
            (
                Field('stage', '', 'what the law does', 'control.placing.STAGES'),
                Field('refusal', '', 'why the last goal was refused', 'control.placing.REFUSALS'),
                Field('goals', '', 'goals taken since activation'),
                Field('refused', '', 'goals refused since activation'),
                Field('released', '', 'objects let go since activation'),
                Field('goal_x', 'm', 'where the centre of mass is to be across the belt'),
                Field('goal_theta', 'rad', 'the angle that the pushed edge is to have'),
                Field('x', 'm', 'where the centre of mass is now, as believed'),
                Field('theta', 'rad', 'the same of the angle'),
                Field('d', 'm', 'the same of the contact along the edge'),
                Field('x_miss', 'm', 'where the plan ends, less goal_x'),
                Field('theta_miss', 'rad', 'the same of the angle'),
                Field('way_left', 'm', 'belt that the plan takes'),
                Field('belt_left', 'm', 'belt that is left for the goal'),
                Field('reachable', '', 'whether the goal can be reached, as of the last look',
                    'control.placing.VERDICTS'),
                Field('reach_reason', '', 'what forbids it', 'control.placing.REASONS'),
                Field('nearest_x', 'm', 'goal_x of the nearest goal in reach, if it is another'),
                Field('nearest_theta', 'rad', 'goal_theta of the nearest goal in reach'),
                Field('let_go_in', 's',
                    'time from the stamp until `place/release` says so, if that is within the '
                    'period'),
                Field('estimate_age', 's', 'age of the estimate that was used'),
                Field('turning', 'rad/m', 'by how much the finger tip turns for its way'),
                Field('finger_y', 'm', 'where the finger is along the belt, in `finger_base`'),
                Field('bend', '',
                    'where the second link is bent to from the first: 1 counterclockwise, -1 '
                    'clockwise, 0 if a wrist holds the tip'),
            ),
        ),
        Topic(PLACE_RELEASE, BOOL_TYPE, (PUSH_CONTROLLER,), ('the finger', *PLANTS),
            'true at the moment to let the object go, false when the finger is to be down again',
        ),
        Topic(TRUE_POSE, POSE_TYPE, PLANTS, (LIVE_PAGE,),
            "in `finger_disk`: the object's true centre of mass and orientation",
        ),
        Topic(TRUE_STATE, JOINT_STATE_TYPE, PLANTS, (LIVE_PAGE,),
            'what only the simulator knows',
            (
                Field('theta', 'rad', 'true angle of the edge; NaN without a contact'),
                Field('d', 'm', 'true contact along the edge; NaN without a contact'),
                Field('phi', 'rad', 'push angle of the finger as it moves'),
                Field('mode', '', 'how the contact moves', 'mechanics.MODES'),
                Field('v_x', 'm/s', 'velocity of the finger'),
                Field('v_x_commanded', 'm/s', 'velocity that it was commanded'),
                Field('finger_x', 'm', 'position of the finger across the belt'),
                Field('psi', 'rad', "direction of the finger tip's pole"),
                Field('belt_speed', 'm/s', 'speed of the belt'),
                Field('belt_travel', 'm', 'how far the belt has moved'),
                Field('object_x', 'm',
                    "place of the object's centre of mass across the belt in `finger_base`"),
                Field('edge_angle', 'rad',
                    'true angle of the edge that is pushed or was pushed last'),
                Field('lifted', '', '1 while the finger is lifted off the object'),
                Field('along', 'm', 'how far the finger is off its line along the belt'),
            ),
        ),
        Topic(MARKERS, MARKERS_TYPE, PLANTS, (),
            'finger, object, belt, contact normal, friction cone and push ray',
            recorded=False,
        ),
        Topic(CLOCK, 'rosgraph_msgs/msg/Clock', (*PLANTS, BAG_PLAYER), tuple(NODES),
            "simulated time, with the parameter `publish_clock`; a bag's time, with `clock`; nodes "
            'with `use_sim_time` follow it',
        ),
        Topic(DIAGNOSTICS, 'diagnostic_msgs/msg/DiagnosticArray', tuple(NODES), (LIVE_PAGE,),
            'health of each node with ages, counts by reason and their rates; once a second, and '
            'at once when the level changes',
        ),
        Topic(PARAMETER_EVENTS, 'rcl_interfaces/msg/ParameterEvent', tuple(NODES), (),
            "changes of a node's parameters, which every ROS 2 node publishes",
        ),
    )
}
# fmt: on
RECORDED = tuple(name for name, topic in TOPICS.items() if topic.recorded)

SERVICES = (
    Service(
        TARE,
        'std_srvs/srv/Trigger',
        WRENCH_SENSOR,
        'takes the present wrench for that of a tip that touches nothing',
    ),
    Service(
        TAKE_REFERENCE,
        'std_srvs/srv/Trigger',
        CAMERA_SENSOR,
        'takes the last images for those of a tip that touches nothing',
    ),
    Service(
        RESUME,
        'std_srvs/srv/Trigger',
        PUSH_CONTROLLER,
        'lets the controller push again after a stop that waits for somebody to look',
    ),
    Service(
        CANCEL,
        'std_srvs/srv/Trigger',
        PUSH_CONTROLLER,
        'gives up the goal: the finger stands still, and the object is not let go',
    ),
    Service(PAUSE, 'std_srvs/srv/SetBool', BAG_PLAYER, 'pauses and resumes'),
    Service(STEP, 'std_srvs/srv/Trigger', BAG_PLAYER, 'plays one message'),
)


def is_frame(frame: str, expected: str) -> bool:
    """Return whether a message's frame is one of `FINGER_BASE` and so on, or not given.

    A second finger's may have a prefix.
    """
    return not frame or frame.endswith(expected)


def own_name(topic: str) -> str | None:
    """Return the name in `TOPICS` that the full name of a topic ends with, None if there is none.

    The longest one counts: `ground_truth/object_pose` is not `object_pose`.
    """
    if topic in TOPICS and topic[0] == '/':
        return topic
    relative = [name for name in TOPICS if name[0] != '/' and topic.endswith(f'/{name}')]
    return max(relative, key=len, default=None)


def fingers(topics: Mapping[str, str], having: Collection[str]) -> dict[str, set[str]]:
    """Return the package's topics of each finger in a bag, by the finger's namespace.

    `topics` are the types of the bag's topics by full name. A topic is the package's if its name
    and its type are. A finger counts if it has one of the relative names `having`. Namespaces are
    ``''`` or such as ``'/left'``, in the order of the first such topic.
    """
    found: dict[str, set[str]] = {}
    present = []
    for topic, type_name in topics.items():
        own = own_name(topic)
        if own is not None and own[0] != '/' and type_name == TOPICS[own].type_name:
            namespace = topic.removesuffix(f'/{own}')
            present.append((namespace, own))
            if own in having:
                found[namespace] = set()
    for namespace, own in present:
        if namespace in found:
            found[namespace].add(own)
    return found


def node_in(namespace: str, node: str) -> str:
    """Return the name by which a bag's recorded parameters know a finger's node."""
    return f'{namespace}/{node}'.removeprefix('/')
