#!/usr/bin/env python3
"""Parks block1 of a paused world with its own thrusters: a PD controller in lock-step with the simulation.

    roslaunch block_world block_world.launch count:=1 paused:=true
    rosrun block_world park_block.py    (or build/devel/lib/block_world/park_block.py)

The service ~step carries the commands and answers with the state, so no clock but the simulated one plays a part: the
same bits come out every time, however busy the computer is.
"""
import math

import rospy
from block_world.msg import Thrust
from block_world.srv import Step, StepRequest

TARGET = (0.0, 0.0, 0.0)    # m, m, rad
PERIOD = 0.02               # s
STRENGTH, ARM = 1.5, 0.9    # N; m from the centre of mass to the thrusters of a block 3 m tall
SIDEWAYS = 0.4              # share of the strength that the sideways thrusters have


def levels(block):
    """Levels of the six thrusters, by the errors of position and angle and by the velocities."""
    force = [0.5 * (TARGET[0] - block.x) - 1.0 * block.vx, 0.5 * (TARGET[1] - block.y) - 1.0 * block.vy]
    torque = 1.0 * (TARGET[2] - block.angle) - 1.3 * block.omega
    c, s = math.cos(block.angle), math.sin(block.angle)
    along_x, along_y = c * force[0] + s * force[1], -s * force[0] + c * force[1]
    upper, lower = (along_x / 2 - torque / (2 * ARM)), (along_x / 2 + torque / (2 * ARM))
    pairs = [(-upper, SIDEWAYS), (upper, SIDEWAYS), (along_y, 1.0), (-along_y, 1.0), (-lower, SIDEWAYS), (lower, SIDEWAYS)]
    return [min(max(push / (share * STRENGTH), 0.0), 1.0) for push, share in pairs]


def main():
    rospy.init_node('park_block', anonymous=True)
    rospy.wait_for_service('block_world/step', timeout=30)
    step = rospy.ServiceProxy('block_world/step', Step, persistent=True)
    answer = step(StepRequest())
    for _ in range(int(60 / PERIOD)):
        if not answer.success:
            raise SystemExit('step: ' + answer.message)
        block = next(body for body in answer.state.bodies if body.name == 'block1')
        thrust = Thrust(body='block1', levels=levels(block), duration=2 * PERIOD)
        answer = step(StepRequest(duration=PERIOD, thrust=[thrust]))
    block = next(body for body in answer.state.bodies if body.name == 'block1')
    print('block1 at (%.2g, %.2g) m, %.2g rad; state_hash %d' % (block.x, block.y, block.angle, answer.state.state_hash))


if __name__ == '__main__':
    main()
