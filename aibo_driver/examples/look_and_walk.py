#!/usr/bin/env python3
"""Stands up, turns the head to the left, takes a picture, and walks for two seconds."""
import rospy
from aibo_driver.srv import TakePicture
from geometry_msgs.msg import Twist
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint


def call(name, service_type, **request):
    """Calls a service of the driver, and ends the program if the robot refuses."""
    rospy.wait_for_service(name, timeout=20)
    answer = rospy.ServiceProxy(name, service_type)(**request)
    if not answer.success:
        raise SystemExit(f'{name}: {answer.message}')
    return answer


def publisher(topic, message_type):
    """What is published before the driver has subscribed is lost."""
    made = rospy.Publisher(topic, message_type, queue_size=1)
    while made.get_num_connections() == 0 and not rospy.is_shutdown():
        rospy.sleep(0.05)
    return made


rospy.init_node('look_and_walk')
joints, velocity = publisher('joint_trajectory', JointTrajectory), publisher('cmd_vel', Twist)

call('stand', Trigger)  # returns when the robot stands
way = JointTrajectoryPoint(positions=[0.5], time_from_start=rospy.Duration(1.0))
joints.publish(JointTrajectory(joint_names=['head_pan'], points=[way]))
rospy.sleep(1.5)
picture = call('take_picture', TakePicture)
with open('look.jpg', 'wb') as file:
    file.write(picture.image.data)

forward = Twist()
forward.linear.x = 0.1  # m/s
rate = rospy.Rate(10)  # the robot stops by itself half a second after the last velocity
for _ in range(20):
    velocity.publish(forward)
    rate.sleep()
velocity.publish(Twist())
print('look.jpg has', len(picture.image.data), 'bytes')
