# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Topics of other people's software, some of them named like ours."""

BOOL = ('std_msgs/msg/Bool', 'cdr', 'ros2msg', b'bool data', b'\0\1\0\0\1')
IDL = b'module foxglove { struct SceneUpdate { long number; }; };'
# Not named like ours, and of types that ROS does not know or cannot name.
OTHERS = [
    ('/scene', 'foxglove::SceneUpdate', 'cdr', 'omgidl', IDL, b'\0\1\0\0' + bytes(4)),
    ('/bare', '', 'cdr', '', b'', b'\0\1\0\0' + bytes(8)),
    ('/proto', 'foxglove.Log', 'protobuf', 'protobuf', b'\n\xff\xfe', b'\x08\x01'),
    ('/text', '', 'json', '', b'', b'{}'),
    ('/module', 'std_msgs/msg/_bool', 'cdr', 'ros2msg', b'bool data', b'\0\1\0\0\1'),
    ('/service', 'std_srvs/srv/Empty', 'cdr', 'ros2msg', b'', b'\0\1\0\0\0'),
]
# Named like ours, and of other types.
NAMESAKES = [
    ('/hand/contact', *BOOL),
    ('/glove/tactile', '', 'cdr', '', b'', b'\0\1\0\0' + bytes(8)),
    ('/web/contact', 'foxglove.PoseInFrame', 'json', 'jsonschema', b'{}', b'{}'),
    ('/sim/push_controller/state', *BOOL),
]
