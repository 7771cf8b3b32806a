#!/usr/bin/env python3
"""An MJPEG driver with OpenCV: VideoCapture decodes, cv_bridge makes the message.

    opencv_reader.py URL
"""
import cv2
import rospy
from cv_bridge import CvBridge
from sensor_msgs.msg import Image


def main():
    cv2.setNumThreads(1)
    rospy.init_node("opencv_reader", anonymous=True)
    publisher = rospy.Publisher("camera/image_raw", Image, queue_size=1)
    capture = cv2.VideoCapture(rospy.myargv()[1], cv2.CAP_FFMPEG)
    bridge = CvBridge()
    while not rospy.is_shutdown():
        good, picture = capture.read()
        if not good:
            break
        image = bridge.cv2_to_imgmsg(picture, encoding="bgr8")
        image.header.stamp = rospy.Time.now()
        publisher.publish(image)


if __name__ == "__main__":
    main()
