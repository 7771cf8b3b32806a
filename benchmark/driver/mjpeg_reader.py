#!/usr/bin/env python3
"""An MJPEG driver as most people write it, in Python: reads line by line and publishes each JPEG.

    mjpeg_reader.py URL
"""
import sys
import urllib.request

import rospy
from sensor_msgs.msg import CompressedImage


def read_headers(stream):
    headers = {}
    while True:
        line = stream.readline()
        if not line:
            sys.exit("the camera has closed the connection")
        line = line.strip()
        if not line and headers:
            return headers
        name, colon, value = line.partition(b":")
        if colon:
            headers[name.lower()] = value.strip()


def main():
    rospy.init_node("mjpeg_reader", anonymous=True)
    publisher = rospy.Publisher("camera/image_raw/compressed", CompressedImage, queue_size=1)
    stream = urllib.request.urlopen(rospy.myargv()[1])
    while not rospy.is_shutdown():
        size = int(read_headers(stream)[b"content-length"])
        image = CompressedImage()
        image.header.stamp = rospy.Time.now()
        image.header.frame_id = "camera_optical_frame"
        image.format = "jpeg"
        image.data = stream.read(size)
        publisher.publish(image)


if __name__ == "__main__":
    main()
