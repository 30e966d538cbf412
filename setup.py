# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
"""Build of the package, for pip and for colcon alike."""

import runpy
from glob import glob
from pathlib import Path

from setuptools import find_packages, setup

NAME = 'tactile_push'
# Read without importing the package, which needs more than the build has.
NODES = runpy.run_path(str(Path(__file__).parent / NAME / 'interface.py'))['NODES']

# Wheels of ROS 2 exist for these machines alone; elsewhere ROS comes from a workspace.
WHEELS = "platform_system == 'Linux' and platform_machine == 'x86_64' and python_version < '3.14'"
AIOHTTP = 'aiohttp>=3.9,<4'
MUJOCO = 'mujoco>=3.2,<5'  # for 0.1 GB, and 2 s with a fast connection
CAMERA = ['opencv-python-headless>=4.8,<6', 'scipy>=1.11,<2']

setup(
    name=NAME,
    version='0.1.0',
    description='Manipulation and active sensing by pushing with tactile feedback alone',
    author='The tactile_push authors',
    license='Apache-2.0',
    python_requires='>=3.10',
    packages=find_packages(include=[NAME, f'{NAME}.*']),
    package_data={f'{NAME}.{room}': ['assets/*'] for room in ('report', 'watching')},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{NAME}']),
        (f'share/{NAME}', ['package.xml']),
        (f'share/{NAME}/config', glob('config/*')),
        (f'share/{NAME}/launch', glob('launch/*')),
        (f'share/{NAME}/urdf', glob('urdf/*')),
    ],
    install_requires=[
        'lz4>=4.3,<5',
        'matplotlib>=3.8,<4',
        'mcap>=1.5,<2',
        'mcap-ros2-support>=0.5.5,<1',
        'numba>=0.59,<1',
        'numpy>=1.26,<3',
        'plotly>=6.3,<8',
        'pyserial>=3.5,<4',
        'pyyaml>=6,<7',
        'rich>=13,<16',
        'zstandard>=0.22,<1',
    ],
    extras_require={
        'camera': CAMERA,
        'docs': [
            'myst-parser>=3,<6',
            'sphinx>=7.2,<10',
            'sphinx-rtd-theme>=2,<4',
        ],
        'mujoco': [MUJOCO],
        'ros': [
            f'ros-jazzy-common-interfaces>=5.3,<6; {WHEELS}',
            f'ros-jazzy-rclpy[fastrtps]>=7.1,<8; {WHEELS}',
        ],
        'test': [
            *CAMERA,
            AIOHTTP,
            'colcon-core>=0.18,<1',
            'colcon-python-setup-py>=0.2.9,<1',
            'colcon-ros>=0.5,<1',
            'hypothesis>=6,<7',
            'import-linter>=2.1,<3',
            MUJOCO,
            'mypy>=1.13,<3',
            'numpydoc>=1.8,<2',
            'playwright>=1.45,<2',
            'pytest>=8,<10',
            'pytest-benchmark>=5,<6',
            'pytest-xdist>=3.6,<4',
            'reuse>=5,<7',
            'rosbags>=0.10,<1',
            'ruff>=0.8,<1',
            'setuptools<80',
            'xacro>=2,<3',
        ],
        'watch': [AIOHTTP],
    },
    zip_safe=False,
    entry_points={
        'console_scripts': [
            f'{NAME} = {NAME}.cli:main',
            *(f'{node} = {NAME}.nodes.{node}:main' for node in NODES),
        ],
        # By the module's own name: loaded by name as well, it is the same plugin and not a second.
        'pytest11': [f'{NAME}.testing.plugin = {NAME}.testing.plugin'],
    },
)
